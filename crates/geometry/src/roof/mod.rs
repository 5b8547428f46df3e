//! Roofs: over every polygon with holes, as patches that close the building below.
//!
//! Comes in: the walls as a [`Support`], and a [`Shape`]. Goes out: flat patches. Nothing is drawn here.

mod build;
mod fill;
mod lines;
mod outset;
mod overhang;
mod patches;
mod plate;
#[cfg(test)]
mod row_tests;
mod shape;
mod shed;
#[cfg(test)]
mod sliver_tests;
mod subdivision;
mod support;
#[cfg(test)]
mod tests;

use glam::{DVec2, DVec3};

pub use build::Cover;
pub use build::floor;
pub use fill::fill;
pub use lines::{Line, LineKind, lines, normal};
pub use shape::{Border, Eaves, Ends, Rise, STEEPEST_EAVES, Shape, Surface};
pub use support::Support;

/// What a patch is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PatchKind {
    /// Rain falls on it.
    Slope,
    /// An upright face under the end of a ridge, or under the higher edges of a roof of one slope.
    Gable,
    /// An upright face along the outline, or of a border.
    Fascia,
    /// It looks down, beyond the walls.
    Underside,
}

/// A flat face of a roof.
#[derive(Debug, Clone, PartialEq)]
pub struct Patch {
    /// What it is.
    pub kind: PatchKind,
    /// The edge of the outline that it belongs to.
    pub edge: usize,
    /// Which part of the slope it is, from the eaves up, from 0.
    pub flap: usize,
    /// The direction of its edge on the plan.
    pub along: DVec2,
    /// Its rings (m): the first counter-clockwise as seen from outside, holes clockwise.
    pub rings: Vec<Vec<DVec3>>,
}

/// The edges of a ring, each with its two points.
fn edges<T: Copy>(ring: &[T]) -> impl Iterator<Item = [T; 2]> + '_ {
    (0..ring.len()).map(|index| [ring[index], ring[(index + 1) % ring.len()]])
}
