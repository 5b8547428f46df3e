//! Points of the plane, with or without a height.

use glam::{DVec2, DVec3};

/// A place in the plane, and perhaps what goes with it, such as a height.
pub trait Point: Copy + PartialEq {
    /// The place (m) as seen from above.
    fn flat(self) -> DVec2;

    /// Whether all of it is a finite number.
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
