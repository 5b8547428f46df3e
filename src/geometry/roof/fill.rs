//! Flat polygons as triangles.

use glam::{DVec2, DVec3};
use smallvec::SmallVec;

use super::super::cap;
use crate::error::{Error, Result};
use crate::scene::Part;

/// Adds a flat polygon with holes to `part`, counter-clockwise as seen along `-normal`.
///
/// Texture coordinates are metres: u along `right`, v across, from `origin` on. Every edge of a ring is the edge
/// of one triangle.
pub(crate) fn fill(part: &mut Part, rings: &[Vec<DVec3>], right: DVec3, origin: DVec3) -> Result<()> {
    let normal = rings.iter().fold(DVec3::ZERO, |sum, ring| sum + newell(ring)).normalize_or_zero();
    let right = (right - normal * normal.dot(right)).normalize_or_zero();
    let up = normal.cross(right);
    let flat = |point: &DVec3| DVec2::new((*point - origin).dot(right), (*point - origin).dot(up));
    let flats: SmallVec<[DVec2; 16]> = rings.iter().flatten().map(flat).collect();
    let triangles: SmallVec<[[usize; 3]; 16]> = match rings {
        [ring] if ring.len() == 3 || (ring.len() <= 8 && is_convex(&flats)) => {
            (2..ring.len()).map(|corner| [0, corner - 1, corner]).collect()
        }
        [_] => cap::triangulate(&[flats.to_vec()]).unwrap_or_else(|_| fan(&flats)).into(),
        _ => {
            let mut rest = flats.as_slice();
            let nested = rings.iter().map(|ring| {
                let (own, others) = rest.split_at(ring.len());
                rest = others;
                own.to_vec()
            });
            cap::triangulate(&nested.collect::<Vec<_>>())?.into()
        }
    };
    let base =
        u32::try_from(part.positions.len()).map_err(|_| Error::new("a mesh holds too many vertices"))?;
    part.make_room(flats.len(), triangles.len());
    part.positions.extend(rings.iter().flatten().map(DVec3::as_vec3));
    part.normals.resize(part.positions.len(), normal.into());
    part.uvs.extend(flats.iter().map(DVec2::as_vec2));
    #[allow(clippy::cast_possible_truncation, reason = "a polygon has fewer than 2^32 corners")]
    part.triangles.extend(triangles.into_iter().map(|triangle| triangle.map(|corner| corner as u32 + base)));
    Ok(())
}

/// The triangles between a corner and all edges of a ring that almost touches itself; the corner whose thinnest
/// triangle is the thickest.
fn fan(ring: &[DVec2]) -> Vec<[usize; 3]> {
    let count = ring.len();
    let around = |apex: usize| {
        (1..count - 1).map(move |step| [apex, (apex + step) % count, (apex + step + 1) % count])
    };
    let area = |[a, b, c]: [usize; 3]| (ring[b] - ring[a]).perp_dot(ring[c] - ring[a]);
    let thinnest = |apex: usize| around(apex).map(area).fold(f64::INFINITY, f64::min);
    let best = (0..count).max_by(|&a, &b| thinnest(a).total_cmp(&thinnest(b))).unwrap_or(0);
    around(best).collect()
}

/// The sum of the normals of a ring's triangles, each as long as twice its area.
fn newell(ring: &[DVec3]) -> DVec3 {
    let from = ring[0];
    ring.windows(2)
        .map(|edge| (edge[0] - from).cross(edge[1] - from))
        .fold(DVec3::ZERO, |sum, normal| sum + normal)
}

/// Whether every corner turns left by enough to be the corner of a triangle.
fn is_convex(ring: &[DVec2]) -> bool {
    (0..ring.len()).all(|index| {
        let [a, b, c] = [0, 1, 2].map(|offset| ring[(index + offset) % ring.len()]);
        (b - a).perp_dot(c - b) > 1e-6
    })
}
