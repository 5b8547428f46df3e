//! The properties of the walls over each edge that a roof depends on: their material and their projection.

use glam::{DVec2, DVec3};

use super::object::Footprint;
use super::state::Side;
use crate::facade::FacadeLayout;
use burgeon_scene::Material;

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

/// Returns the horizontal direction of an edge.
pub(super) fn horizontal_direction(from: DVec2, to: DVec2) -> DVec3 {
    (to - from).normalize_or_zero().extend(0.0)
}
