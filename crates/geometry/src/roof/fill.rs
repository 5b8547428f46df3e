//! Triangulation of flat polygons in space.

use glam::{DVec2, DVec3};
use smallvec::SmallVec;

use crate::planar::{Ring, triangulate};
use burgeon_base::error::{Error, Limit, Result};
use burgeon_scene::Part;

/// Minimum width (m) of the triangles of a fan.
const WIDE: f64 = 0.01;
/// Minimum width (m) of triangles that are not slivers.
const SLIVER: f64 = 1e-3;
/// Maximum number of corners of a ring for a second triangulation without slivers.
const MOST: usize = 200;
/// Maximum number of corners of a small ring.
const SMALL: usize = 16;

/// Triangles as indices into a ring.
pub(super) type TriangleIndices = SmallVec<[[usize; 3]; 16]>;

/// Adds a flat polygon with holes to `part`, counter-clockwise as seen against its normal.
///
/// Texture coordinates are in metres from `origin`: u along `right`, v perpendicular to it. Every edge of a
/// ring is an edge of exactly one triangle.
///
/// ```
/// use burgeon_geometry::{Ring, fill};
/// use burgeon_scene::Part;
/// use glam::DVec3;
///
/// // A wall, 4 m wide and 3 m high, that faces south.
/// let wall = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0)].map(|(x, z)| DVec3::new(x, 0.0, z));
/// let mut part = Part::default();
/// fill(&mut part, &[Ring::new(wall.to_vec())?], DVec3::X, DVec3::ZERO)?;
/// assert_eq!((part.positions.len(), part.triangles.len()), (4, 2));
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
pub fn fill(part: &mut Part, rings: &[Ring<DVec3>], right: DVec3, origin: DVec3) -> Result<()> {
    let FilledPolygon { normal, corners, triangles } = FilledPolygon::new(rings, right, origin)?;
    let base = u32::try_from(part.positions.len())
        .map_err(|_| Error::limit(Limit::Size, "a mesh has too many vertices"))?;
    part.make_room(corners.len(), triangles.len());
    part.positions.extend(rings.iter().flatten().map(DVec3::as_vec3));
    part.normals.resize(part.positions.len(), normal.into());
    part.uvs.extend(corners.iter().map(DVec2::as_vec2));
    #[allow(clippy::cast_possible_truncation, reason = "a polygon has fewer than 2^32 corners")]
    part.triangles.extend(triangles.into_iter().map(|triangle| triangle.map(|corner| corner as u32 + base)));
    Ok(())
}

/// A flat polygon with holes, and its triangulation.
pub(super) struct FilledPolygon {
    /// Unit normal.
    pub normal: DVec3,
    /// Corners of all rings in the polygon's plane (m).
    pub corners: SmallVec<[DVec2; 16]>,
    /// Counter-clockwise triangles as indices of corners.
    pub triangles: TriangleIndices,
}

impl FilledPolygon {
    pub(super) fn new(rings: &[impl AsRef<[DVec3]>], right: DVec3, origin: DVec3) -> Result<Self> {
        let rings: SmallVec<[&[DVec3]; 2]> = rings.iter().map(AsRef::as_ref).collect();
        let normal = rings.iter().fold(DVec3::ZERO, |sum, ring| sum + newell(ring)).normalize_or_zero();
        let right = (right - normal * normal.dot(right)).normalize_or_zero();
        let up = normal.cross(right);
        let flat = |point: &DVec3| DVec2::new((*point - origin).dot(right), (*point - origin).dot(up));
        let corners: SmallVec<[DVec2; 16]> = rings.iter().flat_map(|ring| ring.iter()).map(flat).collect();
        let triangles: TriangleIndices = match rings.as_slice() {
            [_] => match star(&corners) {
                Some(apex) => fan(corners.len(), apex).collect(),
                None => {
                    let clipped = triangulate(&[corners.as_slice()]).map(TriangleIndices::from);
                    // If clipping fails, the ring almost touches itself.
                    let triangles =
                        clipped.unwrap_or_else(|_| fan(corners.len(), widest(&corners)).collect());
                    without_slivers(&corners, triangles)
                }
            },
            _ => {
                let mut rest = corners.as_slice();
                let nested = rings.iter().map(|ring| {
                    let (own, others) = rest.split_at(ring.len());
                    rest = others;
                    own
                });
                triangulate(&nested.collect::<Vec<_>>())?.into()
            }
        };
        Ok(Self { normal, corners, triangles })
    }

    /// Returns the width of a triangle (m), negative if it is clockwise.
    pub(super) fn width(&self, triangle: [usize; 3]) -> f64 {
        width(&self.corners, triangle)
    }
}

/// Replaces the triangles of a ring if some of them are slivers and a better triangulation exists: the one
/// whose thinnest triangle is widest.
///
/// Method: dynamic programming over the parts of the ring beyond each diagonal (G. Klincsek, "Minimal
/// triangulations of polygonal domains", 1980).
fn without_slivers(ring: &[DVec2], triangles: TriangleIndices) -> TriangleIndices {
    let count = ring.len();
    let thinnest = triangles.iter().map(|&triangle| width(ring, triangle)).fold(f64::INFINITY, f64::min);
    if thinnest >= SLIVER || count > MOST {
        return triangles;
    }
    // Minimum width beyond each diagonal, and the tip of the adjacent triangle.
    let mut best = vec![(f64::INFINITY, 0); count * count];
    for step in 2..count {
        for from in 0..count - step {
            let to = from + step;
            let least = |tip: usize| {
                let sides = best[from * count + tip].0.min(best[tip * count + to].0);
                if sides > 0.0 { sides.min(width(ring, [from, tip, to])) } else { sides }
            };
            let tips = (from + 1..to).map(|tip| (least(tip), tip));
            best[from * count + to] =
                tips.fold((f64::NEG_INFINITY, 0), |best, other| if other.0 > best.0 { other } else { best });
        }
    }
    if best[count - 1].0 <= thinnest {
        return triangles;
    }
    let (mut found, mut pending) = (TriangleIndices::new(), vec![[0, count - 1]]);
    while let Some([from, to]) = pending.pop() {
        if to > from + 1 {
            let tip = best[from * count + to].1;
            found.push([from, tip, to]);
            pending.extend([[from, tip], [tip, to]]);
        }
    }
    found
}

/// Returns the width of a triangle (m), negative if it is clockwise.
fn width(points: &[DVec2], triangle: [usize; 3]) -> f64 {
    let [a, b, c] = triangle.map(|corner| points[corner]);
    let longest = [a - b, b - c, c - a].map(DVec2::length_squared).into_iter().fold(0.0, f64::max);
    (b - a).perp_dot(c - a) / longest.sqrt().max(f64::MIN_POSITIVE)
}

/// Returns the triangles between a corner of a ring and all edges without that corner.
fn fan(count: usize, apex: usize) -> impl Iterator<Item = [usize; 3]> {
    (1..count - 1).map(move |step| [apex, (apex + step) % count, (apex + step + 1) % count])
}

/// Returns the corner of a small ring from which a fan fills the ring without thin triangles.
fn star(ring: &[DVec2]) -> Option<usize> {
    let count = ring.len();
    let is_wide = |triangle: [usize; 3]| {
        let [a, b, c] = triangle.map(|corner| ring[corner]);
        let area = (b - a).perp_dot(c - a);
        let longest = [a - b, b - c, c - a].map(DVec2::length_squared).into_iter().fold(0.0, f64::max);
        area > 0.0 && area * area > WIDE * WIDE * longest
    };
    let mut corners = 0..if count <= SMALL { count } else { 0 };
    corners.find(|&apex| count == 3 || fan(count, apex).all(is_wide))
}

/// Returns the corner whose fan has the largest smallest triangle.
fn widest(ring: &[DVec2]) -> usize {
    let area = |[a, b, c]: [usize; 3]| (ring[b] - ring[a]).perp_dot(ring[c] - ring[a]);
    let thinnest = |apex: usize| fan(ring.len(), apex).map(area).fold(f64::INFINITY, f64::min);
    (0..ring.len()).max_by(|&a, &b| thinnest(a).total_cmp(&thinnest(b))).unwrap_or(0)
}

/// Returns the sum of the normals of a ring's triangles, each with a length of twice its area.
fn newell(ring: &[DVec3]) -> DVec3 {
    let from = ring[0];
    ring.windows(2)
        .map(|edge| (edge[0] - from).cross(edge[1] - from))
        .fold(DVec3::ZERO, |sum, normal| sum + normal)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rings_are_filled_by_fans_or_otherwise_without_thin_triangles() {
        // A square, an L, a T without a corner that sees all others, and a square with a point on an edge.
        let rings: [&[(f64, f64)]; 4] = [
            &[(0., 0.), (4., 0.), (4., 4.), (0., 4.)],
            &[(0., 0.), (4., 0.), (4., 1.), (1., 1.), (1., 4.), (0., 4.)],
            &[(1., 0.), (2., 0.), (2., 3.), (4., 3.), (4., 4.), (-1., 4.), (-1., 3.), (1., 3.)],
            &[(0., 0.), (2., 0.), (4., 0.), (4., 4.), (0., 4.)],
        ];
        for (corners, (sees_all, whole)) in
            rings.iter().zip([(true, 16.), (true, 7.), (false, 8.), (true, 16.)])
        {
            let flat: Vec<DVec2> = corners.iter().copied().map(DVec2::from).collect();
            assert_eq!(star(&flat).is_some(), sees_all, "{corners:?}");
            let ring = Ring::new(flat.iter().map(|at| at.extend(1.0)).collect()).expect("a ring");
            let mut part = Part::default();
            fill(&mut part, &[ring], DVec3::X, DVec3::ZERO).expect("a flat ring");
            let area = |corners: [u32; 3]| {
                let [a, b, c] = corners.map(|corner| flat[corner as usize]);
                (b - a).perp_dot(c - a) / 2.0
            };
            assert_eq!(part.triangles.len(), flat.len() - 2);
            assert!(part.triangles.iter().all(|triangle| area(triangle) > 0.4), "{corners:?}");
            let sum: f64 = part.triangles.iter().map(area).sum();
            assert!((sum - whole).abs() < 1e-9, "{sum} m²");
        }
    }
}
