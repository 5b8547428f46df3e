//! Limits of coordinates, and sizes of small lists.

/// Maximum length (m) that counts as zero: about the f32 rounding error of a coordinate of a few metres.
pub(crate) const NOTHING: f64 = 1.0 / (1 << 22) as f64;

/// Maximum coordinate (m) and factor: squares and products of them fit into f32 and f64.
pub(crate) const MOST: f64 = 1e9;

/// Number of points of a rectangle, the usual section of small solids: its rings need no heap memory.
pub(crate) const FEW: usize = 4;
