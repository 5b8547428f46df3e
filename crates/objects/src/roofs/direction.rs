//! Directions of roofs: degrees or points of the compass.

use burgeon_base::error::{Error, Result};
use burgeon_geometry::roof::RidgeAxis;
use burgeon_kit::{Expectation, Parameter, Value};
use glam::DVec2;

/// Points of the compass, clockwise from north.
const POINTS: [&str; 16] =
    ["N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE", "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW"];

const ORIENTATIONS: [&str; 2] = ["along", "across"];

/// A direction of the compass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CompassDirection {
    /// Angle (degrees) clockwise from north.
    degrees: f64,
    /// Precision (degrees).
    within: f64,
}

impl Parameter for CompassDirection {
    fn luau() -> String {
        "number | string".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let expected = || Expectation::new("degrees or a point of the compass, such as \"NNE\"");
        match value {
            Value::Number(degrees) if degrees.is_finite() => {
                let within = if degrees.fract() == 0.0 { 10.0 } else { 0.5 };
                Ok(Self { degrees, within })
            }
            Value::Text(text) => {
                let index = POINTS.iter().position(|point| text.eq_ignore_ascii_case(point));
                let index = index.and_then(|index| u32::try_from(index).ok()).ok_or_else(expected)?;
                Ok(Self { degrees: 22.5 * f64::from(index), within: 45.0 })
            }
            _ => Err(expected()),
        }
    }

    fn into_value(self) -> Value {
        Value::Number(self.degrees)
    }
}

/// Returns the direction of a roof from both options; `None` if neither is given. Fails if both are given or one is unknown.
pub(super) fn axis(
    direction: Option<CompassDirection>,
    orientation: Option<&str>,
) -> Result<Option<RidgeAxis>> {
    match (direction, orientation) {
        (None, None) => Ok(None),
        (Some(CompassDirection { degrees, within }), None) => {
            let (east, north) = degrees.to_radians().sin_cos();
            Ok(Some(RidgeAxis::Facing { down: DVec2::new(east, north), snap: within.to_radians() }))
        }
        (None, Some("along")) => Ok(Some(RidgeAxis::Along)),
        (None, Some("across")) => Ok(Some(RidgeAxis::Across)),
        (None, Some(other)) => {
            let message = format!("footprint:roof: unknown orientation {other:?}");
            let error = Error::not_found("orientation", other, ORIENTATIONS, message);
            Err(error.help(format!("use {}", ORIENTATIONS.join(", "))))
        }
        (Some(_), Some(_)) => {
            Err(Error::argument("footprint:roof: direction and orientation exclude each other")
                .help("give one of them"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_of_the_compass_and_degrees_are_directions_and_other_texts_are_not() {
        let down = |value: Value| {
            let direction = CompassDirection::from_value(value).ok()?;
            match axis(Some(direction), None) {
                Ok(Some(RidgeAxis::Facing { down, snap })) => Some((down, snap.to_degrees())),
                _ => None,
            }
        };
        let text = |text: &str| Value::Text(text.to_string().into());
        let (east, snap) = down(text("E")).expect("east");
        assert!(east.distance(DVec2::X) < 1e-9 && (snap - 45.0).abs() < 1e-9);
        let (south, snap) = down(Value::Number(180.0)).expect("south");
        assert!(south.distance(DVec2::NEG_Y) < 1e-9 && (snap - 10.0).abs() < 1e-9);
        assert!((down(Value::Number(12.3)).expect("a direction").1 - 0.5).abs() < 1e-9);
        assert!(down(text("north")).is_none() && down(Value::Nil).is_none());
        assert!(axis(None, Some("diagonal")).is_err());
    }
}
