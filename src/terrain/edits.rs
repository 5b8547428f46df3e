//! Changes of the ground that are kept apart from what the rules give: flattened places, cuts and banks.

use super::block::Area;
use super::world::World;

/// Changes of the ground, in the order in which they were made.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Edits {}

impl Edits {
    /// Changes the heights (m) of the cells of `area` at `level`.
    pub fn apply(&self, _world: &World, _level: u32, _area: Area, _heights: &mut [f64]) {}
}
