//! The properties of the walls over each edge that a roof depends on: their material and their projection.

use glam::DVec2;

use super::Footprint;
use crate::facade::{FacadeFace, FacadeLayout};
use burgeon_geometry::roof::STEEPEST_EAVES;
use burgeon_scene::Material;

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
    fn add(&mut self, laid: &FacadeLayout<'_>, size: DVec2, from: f64) {
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
    fn stands_out(&self, base: f64, open: bool) -> f64 {
        let below = if open { self.clear - base / STEEPEST_EAVES } else { 0.0 };
        let furthest = self.jut.max(below);
        if furthest < LEAST { 0.0 } else { furthest }
    }
}

impl Footprint {
    /// Records that the walls over `edge` have the material of part `part`.
    pub(super) fn note_part(&mut self, edge: usize, part: usize) {
        if self.sides.len() <= edge {
            self.sides.resize(self.plan.polygon().size(), Side::default());
        }
        self.sides[edge].part = part;
    }

    /// Records the layout of a storey over `edge`, of this size (m) and from height `from` (m).
    pub(super) fn note_storey(&mut self, edge: usize, laid: &FacadeLayout<'_>, size: DVec2, from: f64) {
        self.sides[edge].add(laid, size, from);
    }

    /// Returns the projection (m) of the walls over each edge below a roof, whose eaves may be open. Empty if no wall
    /// projects.
    pub(super) fn juts(&self, open: bool) -> Vec<f64> {
        let base = self.shell.top;
        let juts: Vec<f64> = self.sides.iter().map(|side| side.stands_out(base, open)).collect();
        if juts.iter().all(|jut| *jut == 0.0) { Vec::new() } else { juts }
    }
}

/// Returns the material with the largest area of a wall, ignoring images that cover a face once. The template's own
/// material takes precedence if it is visible at all.
pub(super) fn material_of<'a>(laid: &FacadeLayout<'a>, template: &'a Material) -> &'a Material {
    let mut shown: Vec<(&'a Material, f64)> = Vec::new();
    for face in laid.faces.iter().filter(|face| !face.stretched && face.up.z == 0.0 && face.right.z == 0.0) {
        let Some(material) = face.material else { return template };
        let area = face.right.x * face.up.y;
        match shown.iter_mut().find(|(known, _)| std::ptr::eq(*known, material)) {
            Some((_, sum)) => *sum += area,
            None => shown.push((material, area)),
        }
    }
    shown.into_iter().max_by(|a, b| a.1.total_cmp(&b.1)).map_or(template, |(material, _)| material)
}
