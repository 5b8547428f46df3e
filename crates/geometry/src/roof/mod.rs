//! Roofs over polygons with holes, as patches that close the building below.
//!
//! Input: the walls as a [`Support`], and a [`RoofShape`]. Output: flat patches. This module draws nothing.

mod build;
mod field;
mod fill;
mod levels;
mod lines;
mod mapped;
mod mesh;
mod outset;
mod overhang;
mod patch;
mod patches;
mod plate;
#[cfg(test)]
mod row_tests;
mod shape;
mod shed;
#[cfg(test)]
mod slit_tests;
#[cfg(test)]
mod sliver_tests;
mod support;
#[cfg(test)]
mod tests;
mod touching;

pub use build::RoofCover;
pub use build::floor;
pub use field::{FieldRoof, RidgeAxis};
pub use fill::fill;
pub use lines::{RoofLine, RoofLineKind, lines, normal};
pub use mapped::{MapLineKind, MapProblem, RoofMap, UnusedLine};
pub use patch::{Patch, PatchKind};
pub use shape::{Border, Eaves, Ends, Rise, RoofShape, RoofSurface, STEEPEST_EAVES};
pub use support::Support;
