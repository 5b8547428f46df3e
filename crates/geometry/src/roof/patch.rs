//! Patches of a roof.

use crate::planar::Ring;
use glam::{DVec2, DVec3};

/// Type of a patch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PatchKind {
    /// A face that rain falls on.
    Slope,
    /// An upright face below the end of a ridge, or below the higher edges of a roof of one slope.
    Gable,
    /// An upright face along the outline, or a face of a border.
    Fascia,
    /// A face that points downwards, beyond the walls.
    Underside,
}

/// A flat face of a roof.
#[derive(Debug, Clone, PartialEq)]
pub struct Patch {
    /// Type of the patch.
    pub kind: PatchKind,
    /// Index of the edge of the outline that it belongs to.
    pub edge: usize,
    /// Index of its part of the slope, from the eaves up, from 0.
    pub flap: usize,
    /// Horizontal direction of its edge.
    pub along: DVec2,
    /// Rings (m): the first counter-clockwise as seen from outside, holes clockwise.
    pub rings: Vec<Ring<DVec3>>,
}

impl Patch {
    /// Creates a patch of one ring without repeated corners; `None` if fewer than three corners remain.
    pub(super) fn new(
        kind: PatchKind,
        edge: usize,
        flap: usize,
        along: DVec2,
        ring: Vec<DVec3>,
    ) -> Option<Self> {
        let ring = Ring::without_repeats(ring)?;
        Some(Self { kind, edge, flap, along, rings: vec![ring] })
    }
}
