//! Points of the plane, with or without a height.

use std::fmt::Write as _;

use glam::{DVec2, DVec3};

use burgeon_base::error::{Error, Result};

/// A point of the plane, optionally with more data, such as a height.
pub trait Point: Copy + PartialEq {
    /// Returns the horizontal position (m).
    fn flat(self) -> DVec2;

    /// Returns true if all coordinates are finite.
    fn is_finite(self) -> bool {
        self.flat().is_finite()
    }
}

impl Point for DVec2 {
    fn flat(self) -> DVec2 {
        self
    }
}

impl Point for DVec3 {
    fn flat(self) -> DVec2 {
        self.truncate()
    }

    fn is_finite(self) -> bool {
        DVec3::is_finite(self)
    }
}

impl Point for [f64; 2] {
    fn flat(self) -> DVec2 {
        self.into()
    }
}

/// Fails if a point of `name` is not finite or repeats the previous point.
pub(super) fn check<P: Point>(name: &str, points: &[P]) -> Result<()> {
    for (number, point) in (1..).zip(points) {
        if !point.is_finite() {
            return Err(Error::geometry(format!("point {number} of {name} is {}", point_text(*point)))
                .help("give finite coordinates in metres"));
        }
        if number > 1 && points[number - 2] == *point {
            let message =
                format!("point {number} of {name} repeats point {}, {}", number - 1, point_text(*point));
            return Err(Error::geometry(message).help("remove one of them"));
        }
    }
    Ok(())
}

/// Formats a point for a message.
pub(super) fn point_text<P: Point>(point: P) -> String {
    let DVec2 { x, y } = point.flat();
    let mut text = format!("({x}, {y})");
    if !point.is_finite() && point.flat().is_finite() {
        let _ = write!(text, " with a height that is not a number");
    }
    text
}
