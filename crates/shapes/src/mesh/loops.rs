//! Rings of directed edges in a plane, as faces with holes.

use burgeon_geometry::planar::{contains, twice_area};
use glam::DVec2;
use rustc_hash::FxHashMap;
use smallvec::SmallVec;

/// Joins directed edges, with the area on their left, to faces: an outer ring and its holes.
///
/// At a point that several rings touch, each turns as far to the left as possible, so that no ring crosses itself.
/// Returns `None` if the edges do not form rings.
pub(crate) fn trace_loops(
    edges: &[[u32; 2]],
    at: impl Fn(u32) -> DVec2,
) -> Option<Vec<SmallVec<[Vec<u32>; 1]>>> {
    let mut leaving: FxHashMap<u32, SmallVec<[usize; 2]>> = FxHashMap::default();
    for (number, [from, _]) in edges.iter().enumerate() {
        leaving.entry(*from).or_default().push(number);
    }
    let mut used = vec![false; edges.len()];
    let mut rings: Vec<(Vec<u32>, Vec<DVec2>, f64)> = Vec::new();
    for start in 0..edges.len() {
        if used[start] {
            continue;
        }
        let mut ring = Vec::new();
        let mut number = start;
        loop {
            used[number] = true;
            let [from, to] = edges[number];
            ring.push(from);
            if to == edges[start].first().copied()? && closes(edges, &leaving, &used, start, number, &at) {
                break;
            }
            number = next_edge(edges, &leaving, &used, number, &at)?;
        }
        let places: Vec<DVec2> = ring.iter().map(|point| at(*point)).collect();
        let area = twice_area(places.iter().copied());
        if ring.len() > 2 && area != 0.0 {
            rings.push((ring, places, area));
        }
    }
    Some(nest(rings))
}

/// Returns true if the ring that began with the edge `start` ends with the edge `number`: no other edge turns further
/// to the left.
fn closes(
    edges: &[[u32; 2]],
    leaving: &FxHashMap<u32, SmallVec<[usize; 2]>>,
    used: &[bool],
    start: usize,
    number: usize,
    at: &impl Fn(u32) -> DVec2,
) -> bool {
    let next = next_edge(edges, leaving, used, number, at);
    next.is_none_or(|next| left_turn(edges, number, start, at) >= left_turn(edges, number, next, at))
}

/// Returns the unused edge after an edge that turns furthest to the left.
fn next_edge(
    edges: &[[u32; 2]],
    leaving: &FxHashMap<u32, SmallVec<[usize; 2]>>,
    used: &[bool],
    number: usize,
    at: &impl Fn(u32) -> DVec2,
) -> Option<usize> {
    let after = leaving.get(&edges[number][1])?.iter().copied().filter(|after| !used[*after]);
    after.max_by(|a, b| left_turn(edges, number, *a, at).total_cmp(&left_turn(edges, number, *b, at)))
}

/// Returns the angle (radians) by which a path turns to the left from one edge to the next.
fn left_turn(edges: &[[u32; 2]], from: usize, to: usize, at: &impl Fn(u32) -> DVec2) -> f64 {
    let direction = |number: usize| at(edges[number][1]) - at(edges[number][0]);
    direction(from).angle_to(direction(to))
}

/// Assigns holes, which are clockwise, to the smallest outer ring around them. A hole outside of all rings is dropped.
fn nest(rings: Vec<(Vec<u32>, Vec<DVec2>, f64)>) -> Vec<SmallVec<[Vec<u32>; 1]>> {
    let (outer, holes): (Vec<_>, Vec<_>) = rings.into_iter().partition(|(_, _, area)| *area > 0.0);
    let mut faces: Vec<SmallVec<[Vec<u32>; 1]>> = Vec::with_capacity(outer.len());
    let shells: Vec<(Vec<DVec2>, f64, Vec<u32>)> =
        outer.into_iter().map(|(ring, places, area)| (places, area, ring)).collect();
    faces.extend(shells.iter().map(|(_, _, ring)| smallvec::smallvec![ring.clone()]));
    for (hole, places, area) in holes {
        let around = (0..shells.len()).filter(|&shell| {
            let (ring, size, points) = &shells[shell];
            // A point that both share is on the border, so another one decides.
            let free = hole.iter().position(|point| !points.contains(point));
            let inner = free.map_or_else(|| places[0].midpoint(places[1]), |index| places[index]);
            *size > -area && contains(ring, inner)
        });
        if let Some(shell) = around.min_by(|&a, &b| shells[a].1.total_cmp(&shells[b].1)) {
            faces[shell].push(hole);
        }
    }
    faces
}
