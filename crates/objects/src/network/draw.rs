//! How a network shows itself: carriageways, kerbs, sidewalks, painted lines and the blocks between.

use glam::{DVec2, DVec3};

use super::object::Network;
use burgeon_base::error::Result;
use burgeon_geometry::{Polygon, face};
use burgeon_kit::{Color, Drawing};
use burgeon_scene::{Material, Normal, Part};
use burgeon_streets::{PieceId, Sidewalk};

/// How high (m) paint lies over the street.
const PAINT: f64 = 0.02;
/// The colour of paint.
const WHITE: Color = Color([0.78, 0.78, 0.76, 1.0]);
/// Length (m) of a dash of a middle line, and of the gap behind it.
const DASH: f64 = 3.0;
/// Width (m) of a painted line.
const LINE: f64 = 0.18;
/// Width (m) of a stripe of a crossing, and of the gap beside it; its length.
const STRIPE: [f64; 2] = [0.5, 3.0];

impl Network {
    /// Everything that it shows.
    pub(super) fn draw(&self) -> Result<Drawing> {
        let mut drawing = Drawing::default();
        let surfaces = self.network.surfaces(self.surface_options());
        let mut paint = |color: Color| {
            let material = Material { base_color: color.0, roughness: 0.92, ..Material::default() };
            drawing.material(&material)
        };
        let [asphalt, paving, white] = [self.options.asphalt, self.options.paving, WHITE].map(&mut paint);
        let ground = self.options.ground.map(paint);
        let part = drawing.part(asphalt);
        for surface in &surfaces.carriageways {
            let mut middle = vec![surface.middle];
            middle.extend(&surface.outline);
            fan(part, &middle, 0.0);
        }
        let part = drawing.part(paving);
        for sidewalk in &surfaces.sidewalks {
            self.draw_sidewalk(part, sidewalk);
        }
        if let Some(ground) = ground {
            let part = drawing.part(ground);
            for rings in self.network.blocks(self.surface_options()) {
                let polygon = Polygon::new(rings)?;
                let points: Vec<DVec2> = polygon.points().collect();
                let first = flat(part, &points, self.options.kerb);
                for corners in polygon.triangles()? {
                    #[allow(clippy::cast_possible_truncation, reason = "a block has few corners")]
                    part.triangles.push(corners.map(|corner| corner as u32 + first));
                }
            }
        }
        if self.options.markings {
            let part = drawing.part(white);
            for (piece, _) in self.network.pieces() {
                self.draw_markings(part, piece)?;
            }
        }
        Ok(drawing)
    }

    /// The walk, and the kerb down to the carriageway.
    fn draw_sidewalk(&self, part: &mut Part, sidewalk: &Sidewalk) {
        let count = sidewalk.kerb.len();
        let height = self.options.kerb;
        for index in 0..count {
            let next = (index + 1) % count;
            let (a, b) = (sidewalk.kerb[index], sidewalk.kerb[next]);
            let (c, d) = (sidewalk.edge[next], sidewalk.edge[index]);
            let first = flat(part, &[a, b, c, d], height);
            for corners in [[0, 1, 2], [0, 2, 3]] {
                let [p, q, r] = corners.map(|corner: usize| [a, b, c, d][corner]);
                if (q - p).perp_dot(r - p) > 1e-9 {
                    #[allow(clippy::cast_possible_truncation, reason = "four corners")]
                    part.triangles.push(corners.map(|corner| corner as u32 + first));
                }
            }
            if let Some(out) = (a - b).try_normalize().map(DVec2::perp)
                && height > 0.0
            {
                let base = next_vertex(part);
                for (at, z) in [(b, 0.0), (a, 0.0), (a, height), (b, height)] {
                    part.positions.push(at.extend(z).as_vec3());
                    part.normals.push(Normal::from(out.extend(0.0)));
                    part.uvs.push(glam::Vec2::new(0.0, z_of(z)));
                }
                part.triangles.push([base, base + 1, base + 2]);
                part.triangles.push([base, base + 2, base + 3]);
            }
        }
    }

    /// The dashes in the middle of a piece, and the crossings at its ends.
    fn draw_markings(&self, part: &mut Part, piece: PieceId) -> Result<()> {
        let options = self.surface_options();
        let half = self.network.carriageway(piece, options) / 2.0;
        let [from, to] = self.network.line(piece);
        let (way, length) = ((to - from).normalize_or_zero(), from.distance(to));
        let mut stretch = [0.0, length];
        for (side, end) in self.network.ends(piece).into_iter().enumerate() {
            let reach = self.network.begins(end, piece, options);
            let (sign, at) = if side == 0 { (1.0, 0.0) } else { (-1.0, length) };
            let mut margin = reach;
            if self.network.junctions()[end as usize].degree() > 2 && half > 2.0 {
                let [width, long] = STRIPE;
                #[allow(clippy::cast_possible_truncation, reason = "few stripes")]
                let count = ((half - 0.4) / width) as i32;
                let middle = at + sign * (reach + 0.6 + long / 2.0);
                for stripe in (-count..=count).filter(|stripe| stripe % 2 == 0) {
                    let aside = f64::from(stripe) * width;
                    let center = from + way * middle + way.perp() * aside;
                    painted(part, center, way, [long, width])?;
                }
                margin += long + 1.6;
            }
            stretch[side] = at + sign * margin;
        }
        let [mut at, end] = stretch;
        while half > 2.4 && at + DASH <= end {
            painted(part, from + way * (at + DASH / 2.0), way, [DASH, LINE])?;
            at += 2.0 * DASH;
        }
        Ok(())
    }
}

#[allow(clippy::cast_possible_truncation, reason = "texture coordinates are f32")]
fn z_of(z: f64) -> f32 {
    z as f32
}

/// A painted rectangle around a place.
fn painted(part: &mut Part, center: DVec2, way: DVec2, [length, width]: [f64; 2]) -> Result<()> {
    let (along, aside) = (way * length / 2.0, way.perp() * width / 2.0);
    let corners = [-along - aside, along - aside, along + aside, aside - along];
    let corners: Vec<DVec3> = corners.iter().map(|corner| (center + *corner).extend(PAINT)).collect();
    face(part, &corners)
}

fn next_vertex(part: &Part) -> u32 {
    u32::try_from(part.positions.len()).unwrap_or(u32::MAX)
}

/// Adds points at a height (m) that look up; gives the number of the first.
fn flat(part: &mut Part, points: &[DVec2], height: f64) -> u32 {
    let first = next_vertex(part);
    for at in points {
        part.positions.push(at.extend(height).as_vec3());
        part.normals.push(Normal::from(DVec3::Z));
        part.uvs.push(at.as_vec2());
    }
    first
}

/// Adds triangles from the first point to each edge of the ring that the others are.
fn fan(part: &mut Part, points: &[DVec2], height: f64) {
    let first = flat(part, points, height);
    #[allow(clippy::cast_possible_truncation, reason = "some dozens of points")]
    let count = points.len() as u32 - 1;
    for index in 0..count {
        part.triangles.push([first, first + 1 + index, first + 1 + (index + 1) % count]);
    }
}
