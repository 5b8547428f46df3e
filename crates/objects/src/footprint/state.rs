//! The state of a building under construction: its edges, its walls so far, and its progress.

use std::borrow::Cow;

use glam::DVec2;

use super::neighbors::Touch;
use crate::facade::{FacadeFace, FacadeLayout};
use burgeon_geometry::Plan;
use burgeon_geometry::roof::STEEPEST_EAVES;

/// The progress of a building.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shell {
    /// Height (m) reached so far.
    pub top: f64,
    /// Height (m) at which walls begin, for textures.
    pub bottom: f64,
    /// Set once there is a floor.
    pub begun: bool,
    /// Set once there is a roof.
    pub closed: bool,
}

impl Shell {
    pub(super) fn new(plan: &Plan) -> Self {
        let low = if plan.polygon().is_empty() { 0.0 } else { plan.ground().0 };
        Self { top: low, bottom: low, begun: false, closed: false }
    }
}

/// The properties of the edges of a plan, over all its rings.
#[derive(Debug, Default)]
pub(super) struct Edges {
    pub keywords: Vec<Vec<Cow<'static, str>>>,
    /// Flag for each edge: true if the script gave it the keyword "blind", regardless of neighbours.
    pub always_blind: Vec<bool>,
    pub touch: Touch,
    pub street: Option<usize>,
    /// Edge of the plan for each given edge, if there is one.
    pub stands_for: Vec<Option<usize>>,
}

/// The walls over an edge.
#[derive(Debug, Clone, Copy)]
pub(super) struct Side {
    /// Part of the drawing with the material of the topmost storey.
    pub part: usize,
    /// Projection (m) of the outermost storey.
    jut: f64,
    /// Overhang (m) at which open eaves of the steepest permitted slope pass above all faces, for walls that end at
    /// height 0.
    clear: f64,
}

/// Fraction of a storey's area that determines its projection: at least this fraction projects that far.
const MOST_OF_IT: f64 = 0.5;
/// Minimum projection (m). A smaller projection is ignored.
const LEAST: f64 = 1e-3;

impl Default for Side {
    fn default() -> Self {
        Self { part: usize::MAX, jut: 0.0, clear: f64::NEG_INFINITY }
    }
}

impl Side {
    /// Adds a storey of this size (m) that begins at height `from` (m).
    pub(super) fn add(&mut self, laid: &FacadeLayout<'_>, size: DVec2, from: f64) {
        let mut fronts: Vec<[f64; 2]> = Vec::new();
        for FacadeFace { at, right, up, .. } in &laid.faces {
            if right.z != 0.0 || up.z != 0.0 || at.z < LEAST {
                continue;
            }
            fronts.push([at.z, right.x * up.y]);
            self.clear = self.clear.max(at.z + (from + at.y + up.y) / STEEPEST_EAVES);
        }
        fronts.sort_by(|a, b| b[0].total_cmp(&a[0]));
        let mut area = 0.0;
        for [depth, more] in fronts {
            area += more;
            if area >= MOST_OF_IT * size.x * size.y {
                self.jut = self.jut.max(depth);
                break;
            }
        }
    }

    /// Returns the projection (m) below a roof at height `base` (m), whose eaves may be open.
    pub(super) fn stands_out(&self, base: f64, open: bool) -> f64 {
        let below = if open { self.clear - base / STEEPEST_EAVES } else { 0.0 };
        let furthest = self.jut.max(below);
        if furthest < LEAST { 0.0 } else { furthest }
    }
}

/// Plain walls that are not drawn yet, because more walls may follow above them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plain {
    /// Height (m) at which they begin.
    pub from: f64,
    pub part: usize,
    pub maker: u32,
}
