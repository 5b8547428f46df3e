//! Keys of places, for answers to the module that is at a place.

use glam::DVec3;

/// A place as a key: equal for equal coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct PlaceKey([u64; 3]);

impl From<DVec3> for PlaceKey {
    fn from(place: DVec3) -> Self {
        // Adding 0 turns -0 into 0.
        Self((place + DVec3::ZERO).to_array().map(f64::to_bits))
    }
}
