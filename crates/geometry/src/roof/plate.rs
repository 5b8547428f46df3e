//! Plate of open eaves: the parts of a roof's faces beyond the walls.

use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;

use super::levels::{at_level, is_at};
use crate::planar::edges;

/// Maximum distance (m) of a slope from a corner of the walls, at the top of the walls.
const AT_CORNER: f64 = 5e-3;
/// Horizontal distance (m) within which points lie above each other.
const UPRIGHT: f64 = 1e-6;

/// Adds corners to the faces `rings` of a skeleton where they reach the walls, `beyond` (m) from the outline.
///
/// `ends` are the ends of each wall. Over `free` edges, the roof may continue beyond the wall. `rests` (m) is
/// the time that each edge stands still.
///
/// Fails with the edges whose faces do not reach the walls at their corners.
pub(super) fn at_walls(
    rings: &[Vec<usize>],
    points: &mut Vec<DVec3>,
    beyond: f64,
    ends: &[[DVec2; 2]],
    free: &[bool],
    rests: &[f64],
) -> Result<Vec<Vec<usize>>, Vec<usize>> {
    let mut between: FxHashMap<[usize; 2], usize> = FxHashMap::default();
    let mut faces = Vec::with_capacity(rings.len());
    let before = previous_edges(rings);
    stand_still(rings, &before, points, rests);
    for (face, &[left, right]) in rings.iter().zip(ends) {
        let mut ring = Vec::with_capacity(face.len() + 2);
        for [a, b] in edges(face) {
            ring.push(a);
            let [low, high] = if points[a].z < points[b].z { [a, b] } else { [b, a] };
            if points[low].z < beyond && points[high].z > beyond {
                ring.push(*between.entry([low, high]).or_insert_with(|| {
                    points.push(at_level(points[low], points[high], beyond));
                    points.len() - 1
                }));
            }
        }
        for &index in &ring {
            let corners = [left, right].into_iter();
            let at = points[index];
            let near = |corner: &DVec2| is_at(at, beyond) && corner.distance(at.truncate()) < AT_CORNER;
            if let Some(corner) = corners.clone().find(near) {
                points[index] = corner.extend(beyond);
            }
        }
        faces.push(ring);
    }
    let passes: Vec<Option<[bool; 2]>> =
        faces.iter().zip(ends).map(|(face, ends)| passes(face, points, beyond, *ends)).collect();
    // If both faces extend beyond their common corner, neither reaches it.
    let misses = |one: usize, two: usize| {
        !free[one] && !free[two] && matches!((passes[one], passes[two]), (Some([_, true]), Some([true, _])))
    };
    let is_astray = |edge: &usize| {
        !free[*edge]
            && (passes[*edge].is_none() || misses(before[*edge], *edge) || misses(*edge, faces[*edge][1]))
    };
    let astray: Vec<usize> = (0..faces.len()).filter(is_astray).collect();
    if astray.is_empty() { Ok(faces) } else { Err(astray) }
}

/// Returns the previous edge of each edge.
fn previous_edges(rings: &[Vec<usize>]) -> Vec<usize> {
    // A corner of the outline has the index of the edge that begins there.
    let mut before = vec![0; rings.len()];
    for (edge, face) in rings.iter().enumerate() {
        before[face[1]] = edge;
    }
    before
}

/// Moves points above a corner of the outline exactly there, up to the time when one of its edges starts to
/// move.
fn stand_still(rings: &[Vec<usize>], before: &[usize], points: &mut [DVec3], rests: &[f64]) {
    for face in rings {
        for (corner, next) in [(face[0], face[face.len() - 1]), (face[1], face[2])] {
            let still = rests[before[corner]].min(rests[corner]);
            let (at, above) = (points[corner].truncate(), points[next]);
            let is_due = is_at(above, still) || still.is_infinite();
            if still > 0.0 && is_due && above.truncate().distance(at) < AT_CORNER {
                points[next] = at.extend(above.z);
            }
        }
    }
}

/// Reports whether a face crosses the top of the walls beyond the left and the right end of its wall (true),
/// in its line, or exactly at the ends (false); `None` for any other crossing.
fn passes(face: &[usize], points: &[DVec3], beyond: f64, [left, right]: [DVec2; 2]) -> Option<[bool; 2]> {
    let mut found: Vec<DVec2> = face
        .iter()
        .map(|&index| points[index])
        .filter(|at| is_at(*at, beyond))
        .map(DVec3::truncate)
        .collect();
    found.dedup();
    let &[from, to] = found.as_slice() else { return None };
    let along = (right - left).normalize_or_zero();
    let is_beyond = |at: DVec2, end: DVec2, way: f64| {
        let off = at - end;
        let in_line =
            off == DVec2::ZERO || (along.perp_dot(off).abs() < AT_CORNER && way * along.dot(off) > 0.0);
        in_line.then_some(off != DVec2::ZERO)
    };
    Some([is_beyond(to, left, -1.0)?, is_beyond(from, right, 1.0)?])
}

/// Returns the points of a face from its right end to its left end, up to a level; of points above each other
/// only the highest.
pub(super) fn border(face: &[usize], points: &[DVec3], level: f64) -> Vec<DVec3> {
    let mut border: Vec<DVec3> = Vec::with_capacity(face.len());
    let around = face[1..].iter().chain(&face[..1]);
    for point in around.map(|&index| points[index]).filter(|point| point.z <= level) {
        match border.last_mut() {
            Some(last) if is_above(*last, point) || is_above(point, *last) => {
                if last.z < point.z {
                    *last = point;
                }
            }
            _ => border.push(point),
        }
    }
    border
}

/// Returns true if a point lies above another one.
fn is_above(point: DVec3, other: DVec3) -> bool {
    point.z > other.z && point.truncate().distance(other.truncate()) < UPRIGHT
}

/// Returns the part of a face between two levels, from its lowest edge on.
pub(super) fn part(face: &[usize], points: &[DVec3], [from, to]: [f64; 2]) -> Vec<DVec3> {
    let mut part: Vec<DVec3> =
        face.iter().map(|&index| points[index]).filter(|point| (from..=to).contains(&point.z)).collect();
    // If the face begins higher than its edge, its left end is the last point.
    if from > 0.0 && part.last().is_some_and(|last| is_at(*last, from)) {
        part.rotate_right(1);
    }
    part
}
