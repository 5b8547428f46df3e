//! Roofs: over every polygon with holes, as patches that close the building below.
//!
//! Comes in: the walls as a [`Support`], and a [`RoofShape`]. Goes out: flat patches. Nothing is drawn here.

mod build;
mod fill;
mod lines;
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

pub use build::RoofCover;
pub use build::floor;
pub use fill::fill;
pub use lines::{RoofLine, RoofLineKind, lines, normal};
pub use patch::{Patch, PatchKind};
pub use shape::{Border, Eaves, Ends, Rise, RoofShape, RoofSurface, STEEPEST_EAVES};
pub use support::Support;
