//! What a roof has to know of the walls over each edge: what they are made of, and how far they stand out.

use glam::DVec2;

use super::Footprint;
use crate::facade::{FacadeFace, FacadeLayout};
use burgeon_geometry::roof::STEEPEST_EAVES;
use burgeon_scene::Material;

/// The walls over an edge.
#[derive(Debug, Clone, Copy)]
pub(super) struct Side {
    /// The part of the drawing that holds what its topmost storey is made of.
    pub part: usize,
    /// How far (m) its outermost storey stands out.
    jut: f64,
    /// How far (m) a roof has to stand out so that open eaves, which fall as steeply as they may, pass above all faces:
    /// if the walls ended at height 0.
    clear: f64,
}

/// A storey stands out as far as this part of it does.
const MOST_OF_IT: f64 = 0.5;
/// What stands out less (m) than this does not stand out.
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

    /// How far (m) it stands out below a roof at height `base` (m), whose eaves may be open.
    fn stands_out(&self, base: f64, open: bool) -> f64 {
        let below = if open { self.clear - base / STEEPEST_EAVES } else { 0.0 };
        let furthest = self.jut.max(below);
        if furthest < LEAST { 0.0 } else { furthest }
    }
}

impl Footprint {
    /// Notes that the walls over `edge` are made of what part `part` holds.
    pub(super) fn note_part(&mut self, edge: usize, part: usize) {
        if self.sides.len() <= edge {
            self.sides.resize(self.plan.polygon().size(), Side::default());
        }
        self.sides[edge].part = part;
    }

    /// Notes what a storey is like over `edge`, of this size (m) and from height `from` (m) on.
    pub(super) fn note_storey(&mut self, edge: usize, laid: &FacadeLayout<'_>, size: DVec2, from: f64) {
        self.sides[edge].add(laid, size, from);
    }

    /// How far (m) the walls over each edge stand out below a roof, whose eaves may be open; empty if nothing does.
    pub(super) fn juts(&self, open: bool) -> Vec<f64> {
        let base = self.shell.top;
        let juts: Vec<f64> = self.sides.iter().map(|side| side.stands_out(base, open)).collect();
        if juts.iter().all(|jut| *jut == 0.0) { Vec::new() } else { juts }
    }
}

/// The material of what a wall shows most of, apart from images that cover a face once: that of the template if it
/// shows at all.
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
