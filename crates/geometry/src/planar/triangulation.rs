//! Triangulation of polygons, such as the ends of a sweep, without T-junctions or slivers.

use geo::TriangulateEarcut;
use glam::DVec2;
use rustc_hash::FxHashSet;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use super::measure::twice_area;
use super::sides::Sides;
use super::strings::geo_polygon;
use super::touching_points::triangulate_touching;
use burgeon_base::error::{Error, Result};

/// Triangulates a polygon, and returns counter-clockwise triangles of indices into the concatenated points of
/// `rings`.
///
/// The first ring is the counter-clockwise outline, the others are clockwise holes; rings touch at most at equal points. Every
/// edge of a ring is an edge of exactly one triangle, even if points lie on a straight line. Fails if the
/// polygon is too narrow to triangulate.
///
/// Method: ear clipping (D. Eberly, "Triangulation by Ear Clipping", 2002). Edges that skip a collinear point
/// are split there. Then edges are flipped until the triangulation is constrained Delaunay (C. Lawson,
/// "Software for C1 surface interpolation", 1977), which removes slivers. If points are collinear up to
/// rounding, such as the corners of many holes in rotated rows, clipping may choose wrong ears. In that case
/// all points are triangulated with exact predicates, which is slower.
pub(crate) fn triangulate(rings: &[impl AsRef<[DVec2]>]) -> Result<Vec<[usize; 3]>> {
    let points: Vec<DVec2> = rings.iter().flat_map(AsRef::as_ref).copied().collect();
    let border = border(rings);
    let is_sound = |triangles: &Vec<[usize; 3]>| {
        triangles.iter().all(|&[a, b, c]| twice_area([points[a], points[b], points[c]]) > 0.0)
            && unmatched_edges(triangles, &Sides::of(triangles, points.len()), &border).is_empty()
    };
    Some(clip_ears(rings, &points, &border))
        .filter(is_sound)
        .or_else(|| delaunay(&points, &border).filter(is_sound))
        .or_else(|| triangulate_touching(&points, &border))
        .ok_or_else(|| {
            Error::geometry(
                "the cross-section cannot be filled with triangles, as it is too narrow somewhere",
            )
            .help("move the points that almost touch another edge away from it, or remove them")
        })
}

/// Triangulates by ear clipping, without T-junctions or slivers; the result may be wrong if points are nearly
/// collinear.
fn clip_ears(rings: &[impl AsRef<[DVec2]>], points: &[DVec2], border: &[usize]) -> Vec<[usize; 3]> {
    let mut triangles = earcut(rings, points);
    let mut sides = Sides::of(&triangles, points.len());
    for _ in 0..points.len() {
        let unmatched = unmatched_edges(&triangles, &sides, border);
        if unmatched.is_empty() {
            break;
        }
        split_at_skipped_points(&mut triangles, points, &unmatched);
        sides = Sides::of(&triangles, points.len());
    }
    flip(&mut triangles, &mut sides, points);
    triangles
}

/// Returns the triangles of the constrained Delaunay triangulation that lie inside the rings; `None` if rings
/// intersect.
fn delaunay(points: &[DVec2], border: &[usize]) -> Option<Vec<[usize; 3]>> {
    let border: Vec<[usize; 2]> = border.iter().enumerate().map(|(from, &to)| [from, to]).collect();
    triangulate_constrained(points, &border, &[])
}

/// Returns the triangles of the constrained Delaunay triangulation to the left of the edges `border`, which form closed rings.
/// Edges and `lines` are sides of triangles; `None` if they cross, or if two points are equal.
pub(crate) fn triangulate_constrained(
    points: &[DVec2],
    border: &[[usize; 2]],
    lines: &[[usize; 2]],
) -> Option<Vec<[usize; 3]>> {
    let mut all = ConstrainedDelaunayTriangulation::<Point2<f64>>::new();
    let insert = |point: &DVec2| all.insert(Point2::new(point.x, point.y)).ok();
    let places: Vec<_> = points.iter().map(insert).collect::<Option<_>>()?;
    if all.num_vertices() != points.len() {
        return None;
    }
    for &[from, to] in border.iter().chain(lines) {
        if !all.can_add_constraint(places[from], places[to]) {
            return None;
        }
        all.add_constraint(places[from], places[to]);
    }
    // The area lies to the left of each edge of a ring.
    let mut pending = Vec::with_capacity(points.len());
    for &[from, to] in border {
        let edge = all.get_edge_from_neighbors(places[from], places[to])?;
        pending.push(edge.face().as_inner()?.fix());
    }
    let rings: FxHashSet<[usize; 2]> = border.iter().map(|[a, b]| [*a.min(b), *a.max(b)]).collect();
    let mut inside = vec![false; all.num_all_faces()];
    while let Some(face) = pending.pop() {
        if !std::mem::replace(&mut inside[face.index()], true) {
            let edges = all.face(face).adjacent_edges().into_iter();
            let open = edges.filter(|edge| {
                let [from, to] = edge.vertices().map(|end| end.fix().index());
                !(edge.is_constraint_edge() && rings.contains(&[from.min(to), from.max(to)]))
            });
            pending.extend(open.filter_map(|edge| Some(edge.rev().face().as_inner()?.fix())));
        }
    }
    let chosen = all.inner_faces().filter(|face| inside[face.fix().index()]);
    Some(chosen.map(|face| face.vertices().map(|corner| corner.fix().index())).collect())
}

/// Triangulates by ear clipping, with counter-clockwise triangles in total.
fn earcut(rings: &[impl AsRef<[DVec2]>], points: &[DVec2]) -> Vec<[usize; 3]> {
    let raw = geo_polygon(rings).earcut_triangles_raw();
    let mut triangles: Vec<[usize; 3]> =
        raw.triangle_indices.chunks_exact(3).map(|corner| [corner[0], corner[1], corner[2]]).collect();
    // A single triangle may be so thin that the sign of its area is a rounding error.
    let sum: f64 = triangles.iter().map(|&[a, b, c]| twice_area([points[a], points[b], points[c]])).sum();
    if sum < 0.0 {
        triangles.iter_mut().for_each(|triangle| triangle.reverse());
    }
    triangles
}

/// Returns the directed edges of the rings: for each point, the index of the next point of its ring.
fn border(rings: &[impl AsRef<[DVec2]>]) -> Vec<usize> {
    let mut first = 0;
    let mut next = Vec::with_capacity(rings.iter().map(|ring| ring.as_ref().len()).sum());
    for ring in rings.iter().map(AsRef::as_ref) {
        next.extend((0..ring.len()).map(|i| first + (i + 1) % ring.len()));
        first += ring.len();
    }
    next
}

/// Returns the directed edges that lack a neighbour: triangle edges with neither an opposite triangle edge
/// nor a border edge, and reversed border edges without a triangle.
fn unmatched_edges(triangles: &[[usize; 3]], sides: &Sides, border: &[usize]) -> Vec<(usize, usize)> {
    let all = triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
    let missing = border.iter().enumerate().filter(|&(a, &b)| sides.owner(a, b).is_none());
    let lonely = all.filter(|&(a, b)| sides.owner(b, a).is_none() && border[a] != b);
    lonely.chain(missing.map(|(a, &b)| (b, a))).collect()
}

/// Splits each triangle with an unmatched edge at the endpoints of other unmatched edges that lie on that
/// edge.
fn split_at_skipped_points(triangles: &mut Vec<[usize; 3]>, points: &[DVec2], unmatched: &[(usize, usize)]) {
    let mut ends: Vec<usize> = unmatched.iter().flat_map(|&(a, b)| [a, b]).collect();
    ends.sort_unstable();
    ends.dedup();
    let lonely: FxHashSet<(usize, usize)> = unmatched.iter().copied().collect();
    let mut result = Vec::with_capacity(triangles.len() + ends.len());
    for &triangle in triangles.iter() {
        let turned = (0..3).map(|k| [triangle[k], triangle[(k + 1) % 3], triangle[(k + 2) % 3]]);
        let split = turned.filter(|&[a, b, _]| lonely.contains(&(a, b))).find_map(|[a, b, c]| {
            let on_edge = skipped_points(points, &ends, a, b);
            (!on_edge.is_empty()).then_some((a, b, c, on_edge))
        });
        let Some((a, b, c, on_edge)) = split else {
            result.push(triangle);
            continue;
        };
        let mut from = a;
        for to in on_edge.into_iter().chain([b]) {
            result.push([from, to, c]);
            from = to;
        }
    }
    *triangles = result;
}

/// Returns the `candidates` between the points `a` and `b`, in order from `a`.
fn skipped_points(points: &[DVec2], candidates: &[usize], a: usize, b: usize) -> Vec<usize> {
    let along = points[b] - points[a];
    let square = along.length_squared();
    let mut found: Vec<(f64, usize)> = candidates
        .iter()
        .map(|&candidate| (points[candidate] - points[a], candidate))
        .filter(|(offset, _)| along.perp_dot(*offset).abs() <= square * 1e-9)
        .map(|(offset, candidate)| (along.dot(offset) / square, candidate))
        .filter(|&(fraction, candidate)| candidate != a && candidate != b && fraction > 0.0 && fraction < 1.0)
        .collect();
    found.sort_by(|x, y| x.0.total_cmp(&y.0));
    found.into_iter().map(|(_, candidate)| candidate).collect()
}

/// Flips inner edges whose opposite angles add up to more than half a turn, until none is left.
fn flip(triangles: &mut [[usize; 3]], sides: &mut Sides, points: &[DVec2]) {
    let mut pending: Vec<(usize, usize)> =
        triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]).filter(|(a, b)| a < b).collect();
    // Each flip increases the smallest angles, so the loop terminates; the limit handles angles that are
    // equal up to rounding.
    let mut left = 16 * triangles.len() * triangles.len().min(64);
    while let Some((a, b)) = pending.pop() {
        let (Some(one), Some(two)) = (sides.owner(a, b), sides.owner(b, a)) else { continue };
        let (c, d) = (opposite_corner(triangles[one], a, b), opposite_corner(triangles[two], a, b));
        let [pa, pb, pc, pd] = [a, b, c, d].map(|index| points[index]);
        let convex = twice_area([pa, pd, pc]) > 0.0 && twice_area([pd, pb, pc]) > 0.0;
        // Two angles of at most a quarter turn add up to at most half a turn.
        let small = (pa - pc).dot(pb - pc) >= 0.0 && (pb - pd).dot(pa - pd) >= 0.0;
        if !convex || small || !is_wide([pa - pc, pb - pc], [pb - pd, pa - pd]) || left == 0 {
            continue;
        }
        left -= 1;
        triangles[one] = [a, d, c];
        triangles[two] = [d, b, c];
        sides.remove(a, b);
        sides.remove(b, a);
        sides.add([a, d, c], one);
        sides.add([d, b, c], two);
        pending.extend([(a, d), (d, b), (b, c), (c, a)]);
    }
}

/// Returns the corner of `triangle` that is neither `a` nor `b`.
fn opposite_corner(triangle: [usize; 3], a: usize, b: usize) -> usize {
    triangle.into_iter().find(|&corner| corner != a && corner != b).unwrap_or(a)
}

/// Returns true if the angles between two pairs of directions add up to more than half a turn, beyond
/// rounding.
///
/// Each pair is counter-clockwise and encloses less than half a turn.
fn is_wide([u, v]: [DVec2; 2], [w, z]: [DVec2; 2]) -> bool {
    let (crosses, dots) = ([u.perp_dot(v), w.perp_dot(z)], [u.dot(v), w.dot(z)]);
    // Sine and cosine of the sum of the angles, scaled by the product of all lengths.
    let sine = crosses[0] * dots[1] + dots[0] * crosses[1];
    let cosine = dots[0] * dots[1] - crosses[0] * crosses[1];
    let lengths = [u, v, w, z].map(DVec2::length_squared).iter().product::<f64>().sqrt();
    sine < if cosine < 0.0 { -1e-9 * lengths } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(points: &[(f64, f64)]) -> Vec<DVec2> {
        points.iter().map(|&(x, y)| DVec2::new(x, y)).collect()
    }

    fn filled(rings: &[Vec<DVec2>]) -> f64 {
        let points: Vec<DVec2> = rings.iter().flatten().copied().collect();
        let triangles = triangulate(rings).expect("a sound polygon");
        assert!(unmatched_edges(&triangles, &Sides::of(&triangles, points.len()), &border(rings)).is_empty());
        triangles.iter().map(|&[a, b, c]| twice_area([points[a], points[b], points[c]]) / 2.0).sum()
    }

    #[test]
    fn points_on_straight_edges_keep_their_edges() {
        let square = ring(&[(0., 0.), (1., 0.), (2., 0.), (2., 1.), (2., 2.), (1., 2.), (0., 2.), (0., 1.)]);
        assert!((filled(&[square]) - 4.0).abs() < 1e-12);
    }

    #[test]
    fn a_grid_of_square_holes_in_line_has_no_t_junctions() {
        let mut rings = vec![ring(&[(0., 0.), (9., 0.), (9., 9.), (0., 9.)])];
        for (x, y) in
            (0..3).flat_map(|i| (0..3).map(move |j| (1.0 + 3.0 * f64::from(i), 1.0 + 3.0 * f64::from(j))))
        {
            rings.push(ring(&[(x, y), (x, y + 1.), (x + 1., y + 1.), (x + 1., y)]));
        }
        assert!((filled(&rings) - 72.0).abs() < 1e-12);
    }

    #[test]
    fn a_turned_comb_has_no_slivers() {
        let mut comb = Vec::new();
        for tooth in 0..6 {
            let x = 2.0 * f64::from(tooth);
            comb.extend([(x, 1.), (x, 0.), (x + 1., 0.), (x + 1., 1.)]);
        }
        comb.extend([(11., 2.), (0., 2.)]);
        let turned: Vec<DVec2> = ring(&comb).into_iter().map(|p| DVec2::from_angle(0.3).rotate(p)).collect();
        let triangles = triangulate(std::slice::from_ref(&turned)).expect("a sound polygon");
        let thinnest = triangles
            .iter()
            .map(|&[a, b, c]| twice_area([turned[a], turned[b], turned[c]]))
            .fold(f64::INFINITY, f64::min);
        assert!(thinnest > 0.5, "{thinnest}");
        assert!((filled(&[turned]) - 17.0).abs() < 1e-12);
    }

    /// Returns a rotated rectangle with rows of equal holes, whose corners are collinear up to rounding, and
    /// its area.
    fn turned_grid(seed: u64) -> (Vec<Vec<DVec2>>, f64) {
        let mut random = crate::skeleton::samples::Random(seed);
        let mut whole = |from: f64, to: f64| from + (random.next() * (to - from + 1.0)).floor();
        let (columns, rows) = (whole(1.0, 7.0), whole(1.0, 7.0));
        let (wing, hole) = (whole(2.0, 8.0), DVec2::new(whole(3.0, 12.0), whole(3.0, 12.0)));
        let size = hole * DVec2::new(columns, rows) + wing * DVec2::new(columns + 1.0, rows + 1.0);
        let mut rings = vec![ring(&[(0., 0.), (size.x, 0.), (size.x, size.y), (0., size.y)])];
        for (column, row) in (0..columns as u32).flat_map(|x| (0..rows as u32).map(move |y| (x, y))) {
            let at = DVec2::new(f64::from(column), f64::from(row)) * (hole + wing) + wing;
            rings.push(vec![at, at + DVec2::new(0., hole.y), at + hole, at + DVec2::new(hole.x, 0.)]);
        }
        let turn = DVec2::from_angle(random.next() * std::f64::consts::TAU);
        let place = DVec2::new(random.next(), random.next()) * 1e4;
        let rings =
            rings.iter().map(|ring| ring.iter().map(|&at| turn.rotate(at) + place).collect()).collect();
        (rings, size.x * size.y - columns * rows * hole.x * hole.y)
    }

    #[test]
    fn turned_rows_of_holes_are_filled_by_clipping_and_by_exact_predicates() {
        for seed in 0..600 {
            let (rings, expected) = turned_grid(seed);
            assert!((filled(&rings) - expected).abs() < 1e-6 * expected, "{seed}");
            let points: Vec<DVec2> = rings.iter().flatten().copied().collect();
            let border = border(&rings);
            let exact = delaunay(&points, &border).expect("rings that do not meet");
            let sum: f64 =
                exact.iter().map(|&[a, b, c]| twice_area([points[a], points[b], points[c]]) / 2.0).sum();
            assert!((sum - expected).abs() < 1e-6 * expected, "{seed}");
        }
    }
}
