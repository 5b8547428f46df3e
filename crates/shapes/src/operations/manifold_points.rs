//! Points of solids that touch themselves.

use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};

/// Joins equal points, and gives each surface that passes through a point a point of its own: where parts of a solid touch at an edge or a point, the
/// number of a point in `corners`, three for each triangle, becomes that of a copy, which is added to `points` (m).
///
/// Around an edge of several parts, the triangles on both sides of the same material belong together. Edges between two points at
/// which the parts are joined are divided at a point for each part. So each edge has two triangles, as the crate `boolmesh`
/// requires. `values` has a number for each corner.
pub(super) fn separate_surfaces(points: &mut Vec<DVec3>, corners: &mut Vec<usize>, values: &mut Vec<f64>) {
    let mut first: FxHashMap<[u64; 3], usize> = FxHashMap::default();
    let numbers: Vec<usize> =
        (0..points.len()).map(|number| *first.entry(bits(points[number])).or_insert(number)).collect();
    corners.iter_mut().for_each(|corner| *corner = numbers[*corner]);
    let mut halves: FxHashMap<[usize; 2], Vec<usize>> = FxHashMap::default();
    let ends = |corners: &[usize], half: usize| {
        [corners[half], corners[if half % 3 == 2 { half - 2 } else { half + 1 }]]
    };
    let mut is_shared = false;
    for half in 0..corners.len() {
        let all = halves.entry(ends(corners, half)).or_default();
        all.push(half);
        is_shared |= all.len() > 1;
    }
    if !is_shared {
        return;
    }
    let partners = partners(points, corners, &halves);
    let next = |half: usize| if half % 3 == 2 { half - 2 } else { half + 1 };
    let mut sets = crate::mesh::FaceSets::new(corners.len());
    for (half, partner) in partners.iter().copied().enumerate().filter(|(half, partner)| half != partner) {
        sets.join(half, next(partner));
        sets.join(next(half), partner);
    }
    // The first surface keeps the point.
    let mut owners: FxHashMap<usize, usize> = FxHashMap::default();
    let mut copies: FxHashMap<usize, usize> = FxHashMap::default();
    let mut places = FreePlaces(first.into_keys().collect());
    for (number, corner) in corners.iter_mut().enumerate() {
        let (point, surface) = (*corner, sets.first(number));
        if *owners.entry(point).or_insert(surface) != surface {
            *corner = *copies.entry(surface).or_insert_with(|| {
                points.push(places.take(points[point]));
                points.len() - 1
            });
        }
    }
    divide_shared_edges(points, (corners, values), &partners, &mut places);
}

/// Places of points. The crate joins points at equal places, so each point needs one of its own.
struct FreePlaces(FxHashSet<[u64; 3]>);

impl FreePlaces {
    /// Returns the first free place (m) from a place on, in the direction of x, which is taken afterwards.
    fn take(&mut self, mut at: DVec3) -> DVec3 {
        while !self.0.insert(bits(at)) {
            at.x = at.x.next_up();
        }
        at
    }
}

/// Returns the bits of a place, which are the same for 0 and -0.
fn bits(at: DVec3) -> [u64; 3] {
    (at + DVec3::ZERO).to_array().map(f64::to_bits)
}

/// Returns for each side of a triangle the side of the triangle that belongs to it there, or itself without one. `halves` has the
/// sides in each direction. Each side is the partner of its partner.
fn partners(points: &[DVec3], corners: &[usize], halves: &FxHashMap<[usize; 2], Vec<usize>>) -> Vec<usize> {
    let mut partners: Vec<usize> = (0..corners.len()).collect();
    for half in 0..corners.len() {
        let from = corners[half];
        let to = corners[if half % 3 == 2 { half - 2 } else { half + 1 }];
        let (Some(own), Some(others)) = (halves.get(&[from, to]), halves.get(&[to, from])) else { continue };
        if let ([_], [other]) = (own.as_slice(), others.as_slice()) {
            partners[half] = *other;
            continue;
        }
        // Each edge once, with all of its sides.
        if from > to || own.first() != Some(&half) {
            continue;
        }
        let axis = (points[to] - points[from]).normalize_or_zero();
        let x = axis.any_orthonormal_vector();
        let y = axis.cross(x);
        let angle = |half: usize| {
            let third = if half.is_multiple_of(3) { half + 2 } else { half - 1 };
            let out = points[corners[third]] - points[from];
            out.dot(y).atan2(out.dot(x))
        };
        // The material lies in the direction of smaller angles of a side in the direction of the axis, and ends at one in the other
        // direction. So the sides are like brackets around the edge, also if angles of narrow triangles are uncertain.
        let sides = own.iter().map(|half| (angle(*half), true, *half));
        let mut sides: Vec<(f64, bool, usize)> =
            sides.chain(others.iter().map(|half| (angle(*half), false, *half))).collect();
        sides.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
        let mut begun: Vec<usize> = Vec::new();
        // The second round closes what begins before the start of the angles.
        for (_, begins, side) in sides.iter().chain(&sides).copied() {
            if partners[side] != side {
                continue;
            }
            if begins && !begun.contains(&side) {
                begun.push(side);
            } else if !begins && let Some(first) = begun.pop() {
                (partners[first], partners[side]) = (side, first);
            }
        }
    }
    partners
}

/// Divides edges of more than two triangles at their middle, at a point for each pair of triangles that belong together.
fn divide_shared_edges(
    points: &mut Vec<DVec3>,
    (corners, values): (&mut Vec<usize>, &mut Vec<f64>),
    partners: &[usize],
    places: &mut FreePlaces,
) {
    let end = |half: usize| if half % 3 == 2 { half - 2 } else { half + 1 };
    let mut counts: FxHashMap<[usize; 2], usize> = FxHashMap::default();
    for half in 0..corners.len() {
        *counts.entry([corners[half], corners[end(half)]]).or_default() += 1;
    }
    let mut middles: FxHashMap<usize, usize> = FxHashMap::default();
    for half in 0..corners.len() {
        let (from, to, partner) = (corners[half], corners[end(half)], partners[half]);
        let is_pair = partner != half && partners[partner] == half;
        if from > to || !is_pair || counts.get(&[from, to]).is_none_or(|count| *count < 2) {
            continue;
        }
        points.push(places.take(points[from].midpoint(points[to])));
        middles.insert(half, points.len() - 1);
        middles.insert(partner, points.len() - 1);
    }
    if middles.is_empty() {
        return;
    }
    let (old, old_values) = (std::mem::take(corners), std::mem::take(values));
    for (number, (triangle, value)) in old.chunks_exact(3).zip(old_values.chunks_exact(3)).enumerate() {
        let middle = |side: usize| middles.get(&(3 * number + side)).copied();
        let found = [middle(0), middle(1), middle(2)];
        // Begins with the side before which there is no middle, if there is one.
        let first =
            (0..3).find(|side| found[*side].is_some() && found[(side + 2) % 3].is_none()).unwrap_or(0);
        let [a, b, c] = [0, 1, 2].map(|side| triangle[(first + side) % 3]);
        let faces: &[[usize; 3]] = match [0, 1, 2].map(|side| found[(first + side) % 3]) {
            [Some(m), None, None] => &[[m, b, c], [m, c, a]],
            [Some(m), Some(n), None] => &[[m, b, n], [m, n, c], [m, c, a]],
            [Some(m), Some(n), Some(o)] => &[[m, b, n], [n, c, o], [o, a, m], [m, n, o]],
            _ => &[[a, b, c]],
        };
        corners.extend(faces.iter().flatten());
        values.extend(faces.iter().flat_map(|_| value));
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use crate::{Shape, SolidOperation};

    fn cube(x: f64, y: f64) -> Shape {
        Shape::cuboid(DVec3::ONE).translate(DVec3::new(x, y, 0.0))
    }

    #[test]
    fn solids_that_touch_at_an_edge_can_be_cut() {
        let pair = cube(0.0, 0.0)
            .combine(&cube(1.0, 1.0), SolidOperation::Union)
            .expect("a union")
            .solid
            .expect("a solid");
        let hole = Shape::cuboid(DVec3::new(1.0, 1.0, 0.5)).translate(DVec3::new(0.5, 0.5, -0.25));
        let rest = pair.combine(&hole, SolidOperation::Difference).expect("a rest").solid.expect("a solid");
        assert!(rest.is_closed() && (rest.volume() - (2.0 - 2.0 * 0.0625)).abs() < 1e-9, "{}", rest.volume());
    }

    #[test]
    fn solids_that_are_joined_at_both_ends_of_an_edge_can_be_cut() {
        let union = |one: &Shape, two: &Shape| {
            one.combine(two, SolidOperation::Union).expect("a union").solid.expect("a solid")
        };
        let pair = union(&cube(0.0, 0.0), &cube(1.0, 1.0));
        // Plates above and below join the cubes at both ends of the edge that they share.
        let plate = |z: f64| Shape::cuboid(DVec3::new(2.0, 2.0, 0.5)).translate(DVec3::Z * z);
        let joined = union(&union(&pair, &plate(1.0)), &plate(-0.5));
        assert!((joined.volume() - 6.0).abs() < 1e-9, "{}", joined.volume());
        let hole = Shape::cuboid(DVec3::new(1.0, 1.0, 0.5)).translate(DVec3::new(0.5, 0.5, 0.25));
        let rest = joined.combine(&hole, SolidOperation::Difference).expect("a rest").solid.expect("a solid");
        assert!(rest.is_closed() && (rest.volume() - (6.0 - 2.0 * 0.125)).abs() < 1e-6, "{}", rest.volume());
    }
}
