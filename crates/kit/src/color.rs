//! Colours of fields and arguments.

use std::sync::LazyLock;

use super::{Expectation, Parameter, Value, colors};

/// A linear colour with opacity; scripts give it as sRGB.
///
/// ```
/// use burgeon_kit::{Color, Parameter, Value};
///
/// let named = Color::from_value(Value::Text("orange".into())).map_err(|_| "a colour").expect("a colour");
/// assert_eq!(named.into_value(), Value::Text("#ffa500".into()));
/// assert_eq!(named, Color::of_bytes([255, 165, 0, 255]));
/// assert!(Color::from_value(Value::Text("#ff".into())).is_err());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Color(pub [f32; 4]);

/// Linear value of each byte of sRGB.
static LINEAR: LazyLock<[f32; 256]> = LazyLock::new(|| {
    let mut byte = 0.0;
    std::array::from_fn(|_| {
        let value = narrow(linear(byte / 255.0));
        byte += 1.0;
        value
    })
});

impl Parameter for Color {
    fn luau() -> String {
        "Color".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let what = || {
            Expectation::new(
                "a colour: \"#rrggbb\", a name such as \"lightblue\", or { red, green, blue } from 0 to 1",
            )
        };
        let channels: Vec<f64> = match value {
            Value::Text(text) => match colors::color_bytes(&text) {
                Ok(bytes) => return Ok(Self::of_bytes(bytes)),
                Err(Some(near)) => return Err(Expectation::new(format!("a colour, such as \"{near}\""))),
                Err(None) => return Err(what()),
            },
            value => Vec::<f64>::from_value(value).map_err(|_| what())?,
        };
        if matches!(channels.len(), 3 | 4)
            && channels.iter().any(|channel| *channel > 1.0)
            && are_bytes(&channels)
        {
            let hex: String =
                channels.iter().map(|channel| format!("{:02x}", clamp_byte(*channel))).collect();
            return Err(Expectation::new(format!(
                "a colour with numbers from 0 to 1, or \"#{hex}\" for these"
            )));
        }
        if !matches!(channels.len(), 3 | 4) || channels.iter().any(|channel| !(0.0..=1.0).contains(channel)) {
            return Err(what());
        }
        let mut color = [1.0; 4];
        for (index, channel) in channels.iter().enumerate() {
            color[index] = if index == 3 { narrow(*channel) } else { narrow(linear(*channel)) };
        }
        Ok(Self(color))
    }

    fn into_value(self) -> Value {
        let byte = |channel: f32| (srgb(f64::from(channel)) * 255.0).round();
        let [red, green, blue, _] = self.0;
        let hex = [red, green, blue].map(|channel| format!("{:02x}", clamp_byte(byte(channel)))).concat();
        Value::Text(format!("#{hex}").into())
    }
}

impl Color {
    /// Converts bytes to a colour: red, green and blue in sRGB, then opacity.
    pub fn of_bytes([red, green, blue, opacity]: [u8; 4]) -> Self {
        let channel = |byte: u8| LINEAR[usize::from(byte)];
        Self([channel(red), channel(green), channel(blue), narrow(f64::from(opacity) / 255.0)])
    }
}

/// Returns true if all channels are integers from 0 to 255.
fn are_bytes(channels: &[f64]) -> bool {
    channels.iter().all(|channel| channel.fract() == 0.0 && (0.0..=255.0).contains(channel))
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a float to integer cast saturates"
)]
fn clamp_byte(value: f64) -> u8 {
    value as u8
}

#[allow(clippy::cast_possible_truncation, reason = "colours are f32")]
fn narrow(value: f64) -> f32 {
    value as f32
}

/// Converts an sRGB channel to linear by the transfer function of IEC 61966-2-1.
fn linear(channel: f64) -> f64 {
    if channel <= 0.04045 { channel / 12.92 } else { ((channel + 0.055) / 1.055).powf(2.4) }
}

fn srgb(channel: f64) -> f64 {
    if channel <= 0.003_130_8 { channel * 12.92 } else { 1.055 * channel.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_colour_reads_hexadecimal_and_lists_and_writes_back() {
        let hex = Color::from_value(Value::Text("#336699".into())).unwrap();
        assert_eq!(hex.into_value().to_string(), "\"#336699\"");
        let list = Color::from_value(vec![0.2, 0.4, 0.6].into_value()).unwrap();
        assert_eq!(list.into_value().to_string(), "\"#336699\"");
        let bytes = Color::from_value(vec![255.0, 128.0, 0.0].into_value()).unwrap_err().item(1);
        assert!(bytes.ends_with("from 0 to 1, or \"#ff8000\" for these"), "{bytes}");
        for wrong in ["#33669", "#gggggg", "", "#", "no colour", "é", "#é00000"] {
            assert!(Color::from_value(Value::Text(wrong.into())).is_err(), "{wrong}");
        }
        for right in ["LightSteelBlue", "#369", "336699"] {
            assert!(Color::from_value(Value::Text(right.into())).is_ok(), "{right}");
        }
    }
}
