//! Triangulation of rings that touch at points.

use glam::DVec2;
use rustc_hash::FxHashMap;

use super::triangulation::triangulate_constrained;

/// Returns counter-clockwise triangles of rings that touch themselves or each other at equal points; `None` if they cross or
/// share an edge.
///
/// `border` has the next point of each point in its ring. A corner of a triangle at such a point is the one of its equal points
/// whose ring begins the sector that the triangle lies in, so that each edge of a ring belongs to exactly one triangle.
pub(super) fn triangulate_touching(points: &[DVec2], border: &[usize]) -> Option<Vec<[usize; 3]>> {
    let mut places: Vec<DVec2> = Vec::with_capacity(points.len());
    let mut known: FxHashMap<[u64; 2], usize> = FxHashMap::default();
    let numbers: Vec<usize> = points
        .iter()
        .map(|at| {
            let key = (*at + DVec2::ZERO).to_array().map(f64::to_bits);
            *known.entry(key).or_insert_with(|| {
                places.push(*at);
                places.len() - 1
            })
        })
        .collect();
    if places.len() == points.len() {
        return None;
    }
    // The point that each directed edge of a ring begins at.
    let mut begins: FxHashMap<[usize; 2], usize> = FxHashMap::default();
    let mut edges = Vec::with_capacity(border.len());
    for (from, to) in border.iter().enumerate() {
        let edge = [numbers[from], numbers[*to]];
        if begins.insert(edge, from).is_some() {
            return None;
        }
        edges.push(edge);
    }
    if edges.iter().any(|[from, to]| begins.contains_key(&[*to, *from])) {
        return None;
    }
    let triangles = triangulate_constrained(&places, &edges, &[])?;
    let mut third: FxHashMap<[usize; 2], usize> = FxHashMap::default();
    for [a, b, c] in &triangles {
        third.extend([([*a, *b], *c), ([*b, *c], *a), ([*c, *a], *b)]);
    }
    // Turns clockwise around a corner, to the edge of a ring that begins the sector.
    let begin = |corner: usize, mut next: usize| -> Option<usize> {
        for _ in 0..triangles.len() {
            if let Some(begin) = begins.get(&[corner, next]) {
                return Some(*begin);
            }
            next = *third.get(&[next, corner])?;
        }
        None
    };
    triangles.iter().map(|&[a, b, c]| Some([begin(a, b)?, begin(b, c)?, begin(c, a)?])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::planar::{triangulate, twice_area};

    fn ring(points: &[(f64, f64)]) -> Vec<DVec2> {
        points.iter().copied().map(DVec2::from).collect()
    }

    /// Returns the area of the triangles, each of which is to the left of its edges.
    fn filled(rings: &[Vec<DVec2>]) -> f64 {
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
        assert!((filled(&[outline, at_border]) - 14.0).abs() < 1e-12);
        let low = ring(&[(1., 1.), (1., 2.), (2., 2.), (2., 1.)]);
        let high = ring(&[(2., 2.), (2., 3.), (3., 3.), (3., 2.)]);
        assert!((filled(&[square, low, high]) - 14.0).abs() < 1e-12);
    }

    #[test]
    fn a_ring_that_touches_itself_is_filled() {
        // Two squares that share a corner, as one ring.
        let pair = ring(&[(0., 0.), (1., 0.), (1., 1.), (2., 1.), (2., 2.), (1., 2.), (1., 1.), (0., 1.)]);
        assert!((filled(&[pair]) - 2.0).abs() < 1e-12);
    }

    #[test]
    fn rings_that_share_an_edge_are_refused() {
        let square = ring(&[(0., 0.), (4., 0.), (4., 4.), (0., 4.)]);
        let beside = ring(&[(0., 0.), (0., 4.), (1., 4.), (1., 0.)]);
        assert!(triangulate(&[square, beside]).is_err());
    }
}
