//! The drawing of a network: carriageways, kerbs, sidewalks, medians, painted lines and the blocks between.

use glam::{DVec3, Vec3};

use super::bridge::{beside_spans, draw_deck, draw_span, spans_beside};
use super::grounds::{WATER, WATER_LEVEL, draw_water};
use super::object::Network;
use super::vertices::{add_points, upright};
use crate::surface::plain_material;
use burgeon_base::error::Result;
use burgeon_kit::{Color, Drawing, Show};
use burgeon_scene::{Material, Part, Scene};
use burgeon_streets::{Sidewalk, StreetSurface};

/// Height (m) of paint above the street.
const PAINT: f64 = 0.02;
/// Depth (m) of the sides of streets in the ground.
const SKIRT: f64 = 6.0;
/// Colour of paint.
const WHITE: Color = Color([0.78, 0.78, 0.76, 1.0]);

impl Show for Network {
    fn triangles(&self) -> usize {
        self.network.size() * 40
    }

    fn show(&self, scene: &mut Scene, name: &str, feature: Option<&str>) -> Result<()> {
        self.draw()?.show(scene, name, feature)
    }
}

impl Network {
    /// Draws the whole network.
    fn draw(&self) -> Result<Drawing> {
        let mut drawing = Drawing::default();
        let (options, fit) = (self.surface_options(), self.fit()?);
        let profiles = &fit.profiles;
        let surfaces = self.network.surfaces(options, profiles);
        let mut paint = |color: Color| {
            let material = Material { base_color: color.0, roughness: 0.92, ..Material::default() };
            drawing.material(&material)
        };
        let [asphalt, paving, white] = [self.options.asphalt, self.options.paving, WHITE].map(&mut paint);
        let ground = self.options.block_color.map(&mut paint);
        let inks: Vec<_> = self.options.streets.iter().map(|kind| kind.asphalt.map(&mut paint)).collect();
        let kerb = self.options.kerb;
        let of_kinds: Vec<usize> = inks.iter().map(|ink| ink.unwrap_or(asphalt)).collect();
        for surface in &surfaces.carriageways {
            let kind = (surface.depth as usize).min(of_kinds.len() - 1);
            add_surface(drawing.part(of_kinds[kind]), surface, 0.0);
        }
        let spans = self.network.spans(options, profiles);
        let part = drawing.part(paving);
        for sidewalk in &surfaces.sidewalks {
            draw_sidewalk(part, sidewalk, kerb);
        }
        let merged = &surfaces.merged;
        for walk in &merged.walks {
            add_surface(part, walk, kerb);
        }
        for [a, b] in &merged.kerbs {
            // The lower carriageway is in front of the kerb.
            upright(part, [*a, *b], kerb);
        }
        for edge in merged.edges.iter().map(|[a, b]| [*b, *a]) {
            // The sides extend down to the blocks, which are level without a terrain, or into the ground.
            let skirt = if self.options.on.is_some() { SKIRT } else { edge[0].z.max(edge[1].z) };
            if skirt > 0.0 {
                upright(part, edge.map(|at| at + DVec3::Z * (kerb - skirt)), skirt);
            }
        }
        for deck in &merged.decks {
            draw_deck(part, deck, kerb)?;
        }
        if self.options.on.is_some() {
            // The ground next to a street is lower by its tolerance, and by more where another street is lower. Below a
            // bridge there are no sides.
            for edge in surfaces.sidewalks.iter().map(|walk| &walk.edge) {
                let near = spans_beside(edge, &spans);
                for (a, b) in edge.iter().zip(edge.iter().cycle().skip(1)) {
                    for pair in beside_spans([*b, *a], &near) {
                        upright(part, pair.map(|at| at + DVec3::Z * (kerb - SKIRT)), SKIRT);
                    }
                }
            }
        }
        for line in surfaces.medians.iter().flat_map(|median| &median.kerbs) {
            for pair in line.windows(2) {
                upright(part, [pair[0], pair[1]], kerb);
            }
        }
        let part = drawing.part(paving);
        for span in &spans {
            draw_span(part, span, kerb, self.water_level().unwrap_or(WATER_LEVEL))?;
        }
        let part = drawing.part(ground.unwrap_or(paving));
        for median in &surfaces.medians {
            add_surface(part, &median.top, kerb);
        }
        if let Some(ground) = ground {
            let part = drawing.part(ground);
            let water = self.draw_ground(part, &fit)?;
            if water.is_some() {
                let index = drawing.material(&plain_material(WATER, 0.15, 0.0));
                draw_water(drawing.part(index), &self.water, water)?;
            }
        }
        if self.options.markings {
            let part = drawing.part(white);
            for marking in self.network.markings(options, profiles, &self.kinds) {
                let first = add_points(part, &marking.corners, PAINT);
                part.triangles.extend([[0, 1, 2], [0, 2, 3]].map(|face| face.map(|corner| corner + first)));
            }
        }
        Ok(drawing)
    }
}

/// Draws the sidewalk, and the kerb down to the carriageway.
fn draw_sidewalk(part: &mut Part, sidewalk: &Sidewalk, kerb: f64) {
    let count = sidewalk.kerb.len();
    for index in 0..count {
        let next = (index + 1) % count;
        let (a, b) = (sidewalk.kerb[index], sidewalk.kerb[next]);
        let corners = [a, b, sidewalk.edge[next], sidewalk.edge[index]];
        let faces = [[0, 1, 2], [0, 2, 3]].into_iter().filter(|face: &[usize; 3]| {
            let [p, q, r] = face.map(|corner| corners[corner].truncate());
            (q - p).perp_dot(r - p) > 1e-9
        });
        let faces: Vec<[usize; 3]> = faces.collect();
        if !faces.is_empty() {
            let first = add_points(part, &corners, kerb);
            for face in faces {
                #[allow(clippy::cast_possible_truncation, reason = "four corners")]
                part.triangles.push(face.map(|corner| corner as u32 + first));
            }
        }
        upright(part, [a, b], kerb);
    }
}

fn add_surface(part: &mut Part, surface: &StreetSurface, lift: f64) {
    let first = add_points(part, &surface.points, lift);
    for corners in &surface.triangles {
        // Triangles of very short streets between junctions may have no area after rounding.
        let [a, b, c] = corners.map(|corner| part.positions[(corner + first) as usize]);
        if (b - a).cross(c - a) != Vec3::ZERO {
            part.triangles.push(corners.map(|corner| corner + first));
        }
    }
}
