//! The patches that a roof consists of.

use crate::planar::Ring;
use glam::{DVec2, DVec3};

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
    pub rings: Vec<Ring<DVec3>>,
}

impl Patch {
    /// The patch of one ring, without corners that repeat the one before; `None` if fewer than three are left.
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
