//! Areas made of triangles: connected components, and their boundary rings.

use glam::DVec2;
use rustc_hash::{FxHashMap, FxHashSet};

use super::cover::StreetCover;
use burgeon_geometry::Rings;
use burgeon_geometry::planar::twice_area;

/// Triangle: its corners, counter-clockwise, and the triangle beyond each of its edges, in the same order.
#[derive(Debug, Clone, Copy)]
pub(super) struct MeshTriangle {
    pub(super) corners: [u32; 3],
    pub(super) beyond: [Option<u32>; 3],
}

/// Returns the areas without streets that streets enclose, as indices of triangles.
pub(super) fn components(triangles: &[MeshTriangle], covered: &[StreetCover]) -> Vec<Vec<u32>> {
    let mut seen = vec![false; triangles.len()];
    let mut found = Vec::new();
    for first in 0..triangles.len() {
        if seen[first] || covered[first] != StreetCover::Free {
            continue;
        }
        seen[first] = true;
        let (mut all, mut is_enclosed) = (Vec::new(), true);
        let mut due = vec![u32::try_from(first).unwrap_or(u32::MAX)];
        while let Some(number) = due.pop() {
            all.push(number);
            for beyond in triangles[number as usize].beyond {
                let Some(beyond) = beyond else {
                    is_enclosed = false;
                    continue;
                };
                if covered[beyond as usize] == StreetCover::Free
                    && !std::mem::replace(&mut seen[beyond as usize], true)
                {
                    due.push(beyond);
                }
            }
        }
        if is_enclosed {
            all.sort_unstable();
            found.push(all);
        }
    }
    found
}

/// Returns the boundary rings of connected triangles, the outer one first and counter-clockwise; the rings may touch at
/// corners.
pub(super) fn loops(triangles: &[[u32; 3]], points: &[DVec2]) -> Rings<DVec2> {
    let sides = triangles.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
    let all: FxHashSet<[u32; 2]> = sides.collect();
    let mut next: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
    let mut border: Vec<[u32; 2]> = all.iter().copied().filter(|[a, b]| !all.contains(&[*b, *a])).collect();
    border.sort_unstable();
    for [a, b] in &border {
        next.entry(*a).or_default().push(*b);
    }
    let mut rings: Vec<Vec<u32>> = Vec::new();
    for [first, _] in border {
        let mut path: Vec<u32> = vec![first];
        while let Some(here) = path.last().copied() {
            let Some(to) = next.get_mut(&here).and_then(Vec::pop) else { break };
            // A path that returns to an earlier point closes a separate ring.
            if let Some(begin) = path.iter().rposition(|at| *at == to) {
                rings.push(path.split_off(begin));
                path.push(to);
            } else {
                path.push(to);
            }
        }
    }
    let place = |ring: &Vec<u32>| ring.iter().map(|at| points[*at as usize]).collect::<Vec<DVec2>>();
    let mut rings: Vec<Vec<DVec2>> =
        rings.iter().map(place).map(straighten).filter(|ring| ring.len() > 2).collect();
    rings.sort_by(|a, b| twice_area(b.iter().copied()).total_cmp(&twice_area(a.iter().copied())));
    Rings(rings)
}

/// Removes points that are exactly on the line between their neighbours.
fn straighten(ring: Vec<DVec2>) -> Vec<DVec2> {
    let count = ring.len();
    let is_turn = |index: &usize| {
        let [before, at, after] = [index + count - 1, *index, index + 1].map(|index| ring[index % count]);
        (at - before).perp_dot(after - at) != 0.0
    };
    (0..count).filter(is_turn).map(|index| ring[index]).collect()
}
