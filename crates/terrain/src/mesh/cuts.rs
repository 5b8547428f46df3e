//! Areas that replace the ground: the triangles of the ground end at their borders, at the heights of the
//! areas.

use burgeon_geometry::Polygon;
use burgeon_geometry::planar::{contains, distance, foot};
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;
use smallvec::SmallVec;

/// Side length (m) of the squares of the spatial index.
const SQUARE: f64 = 32.0;
/// Maximum distance (m) of a point on the border of an area.
const ON: f64 = 1e-4;
/// Minimum area (m²) of a triangle.
const LEAST: f64 = 1e-6;
/// Difference (m²) below which the remaining part of a triangle is the whole triangle.
const SAME: f64 = 1e-7;

/// An area that replaces the ground.
#[derive(Debug, Clone, PartialEq)]
pub struct GroundCut {
    /// Border (m).
    pub outline: Polygon,
    /// Line (m) that defines the heights, level across.
    pub line: Vec<DVec3>,
}

impl GroundCut {
    /// Returns the height (m) of the area at the nearest point of its line.
    fn height(&self, at: DVec2) -> f64 {
        let mut best = (f64::INFINITY, self.line.first().map_or(0.0, |first| first.z));
        for pair in self.line.windows(2) {
            let part = foot([pair[0], pair[1]], at);
            let place = pair[0].lerp(pair[1], part);
            let far = place.truncate().distance(at);
            if far < best.0 {
                best = (far, place.z);
            }
        }
        best.1
    }

    /// Returns the distance (m) of a point from the border.
    fn distance(&self, at: DVec2) -> f64 {
        self.outline.edges().map(|edge| distance(edge, at)).fold(f64::INFINITY, f64::min)
    }
}

/// Areas that replace the ground, with a spatial index.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct GroundCuts {
    cuts: Vec<GroundCut>,
    squares: FxHashMap<[i64; 2], Vec<u32>>,
}

/// A corner of a part of a triangle: a corner of the triangle, or a point on a border with its height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum PartCorner {
    Own(usize),
    Border(DVec3),
}

impl GroundCuts {
    /// Creates an index of areas; the height of the first area applies where borders meet.
    pub fn new(cuts: Vec<GroundCut>) -> Self {
        let mut squares: FxHashMap<[i64; 2], Vec<u32>> = FxHashMap::default();
        for (number, cut) in (0u32..).zip(&cuts) {
            let Some([low, high]) = cut.outline.bounds() else { continue };
            for square in squares_of(low - ON, high + ON) {
                squares.entry(square).or_default().push(number);
            }
        }
        Self { cuts, squares }
    }

    /// Returns true if there are no areas.
    pub fn is_empty(&self) -> bool {
        self.cuts.is_empty()
    }

    /// Returns the areas that may intersect the box from `low` to `high` (m), in order.
    fn cuts_near(&self, low: DVec2, high: DVec2) -> SmallVec<[u32; 8]> {
        let mut found: SmallVec<[u32; 8]> = SmallVec::new();
        for square in squares_of(low, high) {
            found.extend(self.squares.get(&square).into_iter().flatten().copied().filter(|number| {
                let bounds = self.cuts[*number as usize].outline.bounds();
                bounds.is_some_and(|[from, to]| from.cmple(high).all() && to.cmpge(low).all())
            }));
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Returns the height (m) of the nearest area whose border contains a point.
    fn border(&self, near: &[u32], at: DVec2) -> Option<f64> {
        let far = |number: &u32| (self.cuts[*number as usize].distance(at), *number);
        let nearest = near.iter().map(far).reduce(|best, next| if next.0 < best.0 { next } else { best });
        nearest.filter(|(far, _)| *far <= ON).map(|(_, number)| self.cuts[number as usize].height(at))
    }

    /// Returns the parts of a counter-clockwise triangle that lie outside all areas; `None` if it intersects
    /// none.
    pub(crate) fn parts_outside(&self, corners: [DVec2; 3]) -> Option<Vec<[PartCorner; 3]>> {
        let [low, high] =
            corners[1..].iter().fold([corners[0]; 2], |[low, high], at| [low.min(*at), high.max(*at)]);
        let near = self.cuts_near(low, high);
        if near.is_empty() {
            return None;
        }
        let triangle = Polygon::new(vec![corners.to_vec()]).ok()?;
        let others: Vec<Polygon> =
            near.iter().map(|number| self.cuts[*number as usize].outline.clone()).collect();
        let is_within =
            |of: &Polygon| of.len() == 1 && corners.iter().all(|at| contains(&of[0], *at)) && is_convex(of);
        // Fast path: most affected triangles lie within a convex area.
        if others.iter().any(is_within) {
            return Some(Vec::new());
        }
        let left = triangle.without(&others);
        let area: f64 = left.iter().map(Polygon::area).sum();
        if (area - triangle.area()).abs() <= SAME {
            return None;
        }
        let mut parts = Vec::new();
        for part in left {
            let points: Vec<DVec2> = part.points().collect();
            let Ok(triangles) = part.triangles() else { continue };
            let corner = |at: DVec2| {
                if let Some(height) = self.border(&near, at) {
                    return PartCorner::Border(at.extend(height));
                }
                let own = (0..3).min_by(|&a, &b| corners[a].distance(at).total_cmp(&corners[b].distance(at)));
                PartCorner::Own(own.unwrap_or(0))
            };
            let kinds: Vec<PartCorner> = points.iter().map(|at| corner(*at)).collect();
            for [a, b, c] in triangles {
                if (points[b] - points[a]).perp_dot(points[c] - points[a]) > 2.0 * LEAST {
                    parts.push([kinds[a], kinds[b], kinds[c]]);
                }
            }
        }
        Some(parts)
    }
}

fn is_convex(polygon: &Polygon) -> bool {
    let ring = &polygon[0];
    let at = |index: usize| ring[index % ring.len()];
    (0..ring.len()).all(|index| (at(index + 1) - at(index)).perp_dot(at(index + 2) - at(index + 1)) >= 0.0)
}

/// Returns the squares that intersect a box from `low` to `high` (m).
#[allow(clippy::cast_possible_truncation, reason = "places are within 1e9 m")]
fn squares_of(low: DVec2, high: DVec2) -> impl Iterator<Item = [i64; 2]> {
    let [from, to] = [low, high].map(|at| [(at.x / SQUARE).floor() as i64, (at.y / SQUARE).floor() as i64]);
    (from[1]..=to[1]).flat_map(move |y| (from[0]..=to[0]).map(move |x| [x, y]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(outline: &[(f64, f64)], line: &[(f64, f64, f64)]) -> GroundCut {
        let outline =
            Polygon::new(vec![outline.iter().copied().map(DVec2::from).collect()]).expect("an outline");
        GroundCut { outline, line: line.iter().copied().map(DVec3::from).collect() }
    }

    #[test]
    fn triangles_end_at_the_border_of_a_street_at_its_height() {
        let street = cut(&[(0., -3.), (100., -3.), (100., 3.), (0., 3.)], &[(0., 0., 5.), (100., 0., 15.)]);
        let cuts = GroundCuts::new(vec![street]);
        let triangle = [(40., -10.), (60., -10.), (50., 10.)].map(DVec2::from);
        let parts = cuts.parts_outside(triangle).expect("parts");
        let place = |corner: PartCorner| match corner {
            PartCorner::Own(index) => triangle[index],
            PartCorner::Border(at) => {
                assert!((at.y.abs() - 3.0).abs() < 1e-6 && (at.z - 5.0 - at.x / 10.0).abs() < 1e-6, "{at}");
                at.truncate()
            }
        };
        let area = |part: &[PartCorner; 3]| {
            let [a, b, c] = part.map(place);
            (b - a).perp_dot(c - a) / 2.0
        };
        // A width of 20 m at the bottom, 13 m and 7 m at the borders.
        let wanted = 7.0 * (20.0 + 13.0) / 2.0 + 7.0 * 7.0 / 2.0;
        assert!((parts.iter().map(area).sum::<f64>() - wanted).abs() < 1e-6);
        assert!(parts.iter().all(|part| area(part) > 0.0));
        let within = [(40., -1.), (42., -1.), (41., 1.)].map(DVec2::from);
        assert_eq!(cuts.parts_outside(within), Some(Vec::new()));
        let beside = [(40., 4.), (42., 4.), (41., 6.)].map(DVec2::from);
        assert_eq!(cuts.parts_outside(beside), None);
    }

    #[test]
    fn areas_that_meet_leave_nothing_between_them() {
        let line = [(0., 0., 0.), (20., 0., 0.)];
        let left = cut(&[(0., -3.1), (10.3, -3.1), (9.7, 2.9), (0., 2.9)], &line);
        let right = cut(&[(10.3, -3.1), (20., -3.1), (20., 2.9), (9.7, 2.9)], &line);
        let cuts = GroundCuts::new(vec![left, right]);
        let triangle = [(5., -2.), (15., -2.), (10., 2.)].map(DVec2::from);
        assert_eq!(cuts.parts_outside(triangle), Some(Vec::new()));
    }
}
