//! Triangulation of rings that touch at points.

use glam::DVec2;
use rustc_hash::{FxHashMap, FxHashSet};

use super::measure::twice_area;
use super::triangulation::triangulate_constrained;

/// Returns counter-clockwise triangles of rings that touch themselves or each other at equal points; `None` if they cross or
/// share an edge, and if no points are equal.
///
/// `border` has the next point of each point in its ring. The first of equal points stands for all of them. Every edge of a ring
/// is an edge of exactly one triangle.
pub(super) fn triangulate_touching(points: &[DVec2], border: &[usize]) -> Option<Vec<[usize; 3]>> {
    let (mut places, mut first): (Vec<DVec2>, Vec<usize>) = (Vec::new(), Vec::new());
    let mut known: FxHashMap<[u64; 2], usize> = FxHashMap::default();
    let mut numbers = Vec::with_capacity(points.len());
    for (index, at) in points.iter().enumerate() {
        let key = (*at + DVec2::ZERO).to_array().map(f64::to_bits);
        numbers.push(*known.entry(key).or_insert_with(|| {
            places.push(*at);
            first.push(index);
            first.len() - 1
        }));
    }
    if places.len() == points.len() {
        return None;
    }
    let edges: Vec<[usize; 2]> =
        border.iter().enumerate().map(|(from, to)| [numbers[from], numbers[*to]]).collect();
    let rim: FxHashSet<[usize; 2]> = edges.iter().copied().collect();
    if rim.len() < edges.len() || rim_turns_back(&edges, &rim) {
        return None;
    }
    let triangles = triangulate_constrained(&places, &edges, &[])?;
    let sides = || triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let all: FxHashSet<[usize; 2]> = sides().collect();
    let is_sound = triangles.iter().all(|corners| twice_area(corners.map(|corner| places[corner])) > 0.0)
        && all.len() == 3 * triangles.len()
        && edges.iter().all(|edge| all.contains(edge))
        && sides().all(|[from, to]| all.contains(&[to, from]) != rim.contains(&[from, to]));
    is_sound.then(|| triangles.into_iter().map(|corners| corners.map(|corner| first[corner])).collect())
}

/// Returns true if two of the edges have the same ends in opposite directions.
fn rim_turns_back(edges: &[[usize; 2]], rim: &FxHashSet<[usize; 2]>) -> bool {
    edges.iter().any(|[from, to]| rim.contains(&[*to, *from]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::planar::triangulate;

    fn ring(points: &[(f64, f64)]) -> Vec<DVec2> {
        points.iter().copied().map(DVec2::from).collect()
    }

    /// Returns the area of the triangles, each of which is to the left of its edges.
    fn triangulated_area(rings: &[Vec<DVec2>]) -> f64 {
        let points: Vec<DVec2> = rings.iter().flatten().copied().collect();
        let triangles = triangulate(rings).expect("rings that touch at points");
        let areas = triangles.iter().map(|corners| twice_area(corners.map(|corner| points[corner])) / 2.0);
        areas.inspect(|area| assert!(*area > 0.0)).sum()
    }

    #[test]
    fn holes_that_touch_the_outline_or_each_other_at_points_are_filled_around() {
        let square = ring(&[(0., 0.), (4., 0.), (4., 4.), (0., 4.)]);
        let at_border = ring(&[(0., 2.), (1., 3.), (2., 2.), (1., 1.)]);
        let outline = ring(&[(0., 0.), (4., 0.), (4., 4.), (0., 4.), (0., 2.)]);
        assert!((triangulated_area(&[outline, at_border]) - 14.0).abs() < 1e-12);
        let low = ring(&[(1., 1.), (1., 2.), (2., 2.), (2., 1.)]);
        let high = ring(&[(2., 2.), (2., 3.), (3., 3.), (3., 2.)]);
        assert!((triangulated_area(&[square, low, high]) - 14.0).abs() < 1e-12);
    }

    #[test]
    fn a_ring_that_touches_itself_is_triangulated_area() {
        // Two squares that share a corner, as one ring.
        let pair = ring(&[(0., 0.), (1., 0.), (1., 1.), (2., 1.), (2., 2.), (1., 2.), (1., 1.), (0., 1.)]);
        assert!((triangulated_area(&[pair]) - 2.0).abs() < 1e-12);
    }

    #[test]
    fn rings_that_share_an_edge_are_refused() {
        let square = ring(&[(0., 0.), (4., 0.), (4., 4.), (0., 4.)]);
        let beside = ring(&[(0., 0.), (0., 4.), (1., 4.), (1., 0.)]);
        assert!(triangulate(&[square, beside]).is_err());
    }
}
