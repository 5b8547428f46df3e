//! Points of the plane, with or without a height.

use glam::{DVec2, DVec3};

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
