//! Lines of streets on the grid.

use crate::plan::grid::GridPlace;

/// Part of a street with all positions on the grid.
#[derive(Debug, Clone)]
pub(crate) struct StreetStrand {
    /// Index of the street.
    pub(crate) street: usize,
    pub(crate) level: i32,
    /// Length (m) of the input.
    pub(crate) length: f64,
    pub(crate) places: Vec<GridPlace>,
}
