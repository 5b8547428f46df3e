//! Tone mapping: converts light to display colours.

use glam::Vec3;
use std::sync::OnceLock;

/// Compresses light of any strength to 0 to 1, preserving the hue and saturation of colours that are not glaring.
///
/// Method: Khronos Group, "PBR Neutral Tone Mapper", 2024, with half of its contrast in the shadows, because the full
/// contrast makes dark colours too strong.
pub(super) fn compress(light: Vec3) -> Vec3 {
    const START: f32 = 0.8 - 0.02;
    const DESATURATION: f32 = 0.15;
    let light = light.max(Vec3::ZERO);
    let least = light.min_element();
    let offset = if least < 0.08 { 0.5 * least - 3.125 * least * least } else { 0.02 };
    let light = light - offset;
    let peak = light.max_element();
    if peak < START {
        return light;
    }
    let span = 1.0 - START;
    let compressed = 1.0 - span * span / (peak + span - START);
    let faded = 1.0 - 1.0 / (DESATURATION * (peak - compressed) + 1.0);
    (light * (compressed / peak)).lerp(Vec3::splat(compressed), faded)
}

/// Bytes of sRGB, and the linear values at which they begin.
struct ByteTable {
    /// Byte of the least value in each of equal intervals from 0 to 1.
    bytes: Vec<u8>,
    /// Least linear value of each byte, and infinity.
    least: Vec<f32>,
}

/// Number of intervals in a table of bytes; in each of them are at most two bytes.
const INTERVALS: usize = 4096;

impl ByteTable {
    /// Computes the table. The least value of a byte is found by bisection of the bit patterns, which have the order of the
    /// values.
    fn new() -> Self {
        let least = |byte: u8| {
            let (mut low, mut high) = (0_u32, 1.0_f32.to_bits());
            while low < high {
                let middle = low + (high - low) / 2;
                if compute(f32::from_bits(middle)) >= byte {
                    high = middle;
                } else {
                    low = middle + 1;
                }
            }
            f32::from_bits(low)
        };
        let least: Vec<f32> = (0..=u8::MAX).map(least).chain([f32::INFINITY]).collect();
        let bytes = (0..=INTERVALS).map(|i| compute(i as f32 / INTERVALS as f32)).collect();
        Self { bytes, least }
    }
}

/// Converts a linear value from 0 to 1 to an sRGB byte.
pub(super) fn encode(linear: f32) -> u8 {
    static TABLE: OnceLock<ByteTable> = OnceLock::new();
    let table = TABLE.get_or_init(ByteTable::new);
    let x = linear.clamp(0.0, 1.0);
    let byte = table.bytes[(x * INTERVALS as f32) as usize];
    if x >= table.least[usize::from(byte) + 1] { byte + 1 } else { byte }
}

/// Computes the sRGB byte of a linear value from 0 to 1.
fn compute(x: f32) -> u8 {
    let curved = if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
    (curved * 255.0 + 0.5) as u8
}

/// Converts an sRGB value from 0 to 1 to a linear value.
pub(super) fn decode(curved: f32) -> f32 {
    if curved <= 0.040_45 { curved / 12.92 } else { ((curved + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_survives_decoding_and_encoding() {
        let bytes = (0..=255_u8).filter(|byte| encode(decode(f32::from(*byte) / 255.0)) == *byte).count();
        assert_eq!(bytes, 256);
    }

    #[test]
    fn the_table_of_bytes_agrees_with_the_formula() {
        for i in 0..=1_000_000 {
            let x = i as f32 / 1e6;
            assert_eq!(encode(x), compute(x), "{x}");
        }
        assert_eq!((encode(f32::NAN), encode(-1.0), encode(7.0)), (0, 0, 255));
    }

    #[test]
    fn more_light_is_never_darker_and_never_too_bright() {
        let mut last = 0.0;
        for i in 1..1000 {
            let now = compress(Vec3::splat(i as f32 * 0.02)).x;
            assert!(now > last && now <= 1.0, "{now} after {last}");
            last = now;
        }
    }
}
