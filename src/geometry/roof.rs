//! Roofs: the faces of a straight skeleton raised along a profile, and roofs that need no skeleton.

use glam::{DVec2, DVec3};

use super::cap;
use super::skeleton::{Pace, Skeleton};
use crate::error::{Error, Result};
use crate::scene::Part;

/// The height of a roof (m) over the distance from its outline (m): corners of a line from (0, 0) on.
///
/// Two corners at one distance make a vertical step.
pub type Profile = [DVec2];

/// What a patch is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Patch {
    /// Rain falls on it.
    Slope,
    /// An upright face below the end of a ridge.
    Gable,
    /// An upright face of a step in the profile.
    Step,
}

/// A flat polygon: its corners (m), counter-clockwise seen from outside, and its direction on the ground.
pub type Polygon = (Patch, DVec2, Vec<DVec3>);

/// Corners that are as near to a level of the profile as this (m) are on it.
const ON_LEVEL: f64 = 2e-3;

/// The polygons of a roof over `skeleton` at height `base` (m); edges of speed 0 have gables.
///
/// They join without gaps: corners of neighbours are equal to the last bit.
pub fn patches(skeleton: &Skeleton, paces: &[Pace], profile: &Profile, base: f64) -> Vec<Polygon> {
    let mut levels: Vec<f64> = profile.iter().map(|corner| corner.x).collect();
    levels.dedup();
    // Points of the plan with their times; crossings with levels are added.
    let mut points: Vec<DVec3> = skeleton
        .peaks
        .iter()
        .map(|peak| {
            let near = levels.iter().find(|level| (*level - peak.time).abs() <= ON_LEVEL);
            peak.at.extend(near.copied().unwrap_or(peak.time))
        })
        .collect();
    let mut polygons = Vec::new();
    for (face, pace) in skeleton.faces.iter().zip(paces) {
        let along = (points[face[1]] - points[face[0]]).truncate().normalize_or_zero();
        let kind = if pace.moves() { Patch::Slope } else { Patch::Gable };
        let mut pieces = vec![face.clone()];
        for (index, pair) in profile.windows(2).enumerate() {
            let [from, to] = [pair[0], pair[1]];
            if from.x == to.x {
                for piece in &pieces {
                    let [a, b] = [points[piece[0]].truncate(), points[piece[1]].truncate()];
                    let [low, high] = [base + from.y, base + to.y];
                    let corners = vec![a.extend(low), b.extend(low), b.extend(high), a.extend(high)];
                    polygons.push((Patch::Step, along, corners));
                }
                continue;
            }
            let last = index + 2 == profile.len();
            let mut above = Vec::new();
            for piece in pieces {
                let below = if last { piece } else { divide(&piece, to.x, &mut points, &mut above) };
                let raise = |&index: &usize| {
                    let point = points[index];
                    let fraction = (point.z - from.x) / (to.x - from.x);
                    // Exact at both ends, so that neighbours agree.
                    let height = if point.z == to.x { to.y } else { from.y + (to.y - from.y) * fraction };
                    point.truncate().extend(base + height)
                };
                if below.len() > 2 {
                    polygons.push((kind, along, below.iter().map(raise).collect()));
                }
            }
            pieces = above;
        }
    }
    polygons
}

/// The part of `piece` up to `level`; the parts beyond are added to `above`. Each begins with its lowest edge.
fn divide(piece: &[usize], level: f64, points: &mut Vec<DVec3>, above: &mut Vec<Vec<usize>>) -> Vec<usize> {
    let mut ring = Vec::with_capacity(piece.len() + 2);
    for (index, &a) in piece.iter().enumerate() {
        ring.push(a);
        let b = piece[(index + 1) % piece.len()];
        // From the same end for both neighbours, so that they agree to the last bit.
        let [low, high] =
            if points[a].z < points[b].z { [points[a], points[b]] } else { [points[b], points[a]] };
        if low.z < level && high.z > level {
            let at = low.truncate().lerp(high.truncate(), (level - low.z) / (high.z - low.z));
            ring.push(points.len());
            points.push(at.extend(level));
        }
    }
    let mut below = Vec::with_capacity(ring.len());
    let mut index = 0;
    while index < ring.len() {
        below.push(ring[index]);
        let mut end = index + 1;
        while end < ring.len() && points[ring[end]].z > level {
            end += 1;
        }
        if end > index + 1 {
            let mut part = vec![ring[end % ring.len()]];
            part.extend_from_slice(&ring[index..end]);
            above.push(part);
        }
        index = end;
    }
    below
}

/// The speeds for gables over `rings`, in place of the triangles of a hip roof: the shortest edges first, and
/// no two neighbours.
pub fn gables(rings: &[Vec<DVec2>], hip: &Skeleton) -> Vec<Pace> {
    let mut speeds = vec![Pace::default(); hip.faces.len()];
    let mut candidates: Vec<(f64, usize, [usize; 2])> = Vec::new();
    let mut first = 0;
    for ring in rings {
        let count = ring.len();
        for index in 0..count {
            let at = |offset: usize| ring[(index + offset) % count];
            let [a, b, c] = [at(1) - at(0), at(2) - at(1), at(3) - at(2)];
            let number = first + (index + 1) % count;
            // Both corners turn left by at least 65 degrees.
            let turns = [a.angle_to(b), b.angle_to(c)].iter().all(|turn| *turn > 65f64.to_radians());
            if turns && hip.faces[number].len() == 3 {
                candidates.push((b.length(), number, [first + index, first + (index + 2) % count]));
            }
        }
        first += count;
    }
    candidates.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    for (_, number, neighbours) in candidates {
        if neighbours.iter().all(|&neighbour| speeds[neighbour].moves()) {
            speeds[number] = Pace::STILL;
        }
    }
    speeds
}

/// A roof of one slope over `rings` at height `base` (m), 0 high at the place furthest from the longest edge.
///
/// `rise` gives the height (m) at that edge for the distance (m) between the two.
/// Gives the upright polygons along the outline, and the rings of the slope.
pub fn shed(rings: &[Vec<DVec2>], rise: impl Fn(f64) -> f64, base: f64) -> (Vec<Polygon>, Vec<Vec<DVec3>>) {
    let edges = |ring: &Vec<DVec2>| -> Vec<[DVec2; 2]> {
        (0..ring.len()).map(|index| [ring[index], ring[(index + 1) % ring.len()]]).collect()
    };
    let longest = edges(&rings[0]).into_iter().fold([DVec2::ZERO; 2], |best, edge| {
        let [a, b] = [best, edge].map(|[from, to]| from.distance(to));
        if b > a + 1e-6 { edge } else { best }
    });
    let inward = (longest[1] - longest[0]).normalize_or_zero().perp();
    let depth = |at: DVec2| inward.dot(at - longest[0]);
    let (near, far) = rings.iter().flatten().fold((f64::INFINITY, f64::NEG_INFINITY), |(near, far), &at| {
        (near.min(depth(at)), far.max(depth(at)))
    });
    let rise = rise(far - near);
    let top = |at: DVec2| {
        let height = rise * ((far - depth(at)) / (far - near).max(1e-9)).clamp(0.0, 1.0);
        at.extend(base + if height < ON_LEVEL { 0.0 } else { height })
    };
    let upright = |[a, b]: [DVec2; 2]| {
        let mut corners = vec![a.extend(base), b.extend(base), top(b), top(a)];
        corners.dedup();
        if corners.first() == corners.last() {
            corners.pop();
        }
        (corners.len() > 2).then(|| (Patch::Gable, (b - a).normalize_or_zero(), corners))
    };
    let sides = rings.iter().flat_map(edges).filter_map(upright).collect();
    (sides, rings.iter().map(|ring| ring.iter().map(|&at| top(at)).collect()).collect())
}

/// Adds a flat polygon with holes to `part`, counter-clockwise as seen along `-normal`.
///
/// Texture coordinates are metres: u along `right`, v across, from `origin` on. Every edge of a ring is the edge
/// of one triangle.
pub(crate) fn fill(part: &mut Part, rings: &[Vec<DVec3>], right: DVec3, origin: DVec3) -> Result<()> {
    let normal = rings.iter().fold(DVec3::ZERO, |sum, ring| sum + newell(ring)).normalize_or_zero();
    let right = (right - normal * normal.dot(right)).normalize_or_zero();
    let up = normal.cross(right);
    let flat = |point: &DVec3| DVec2::new((*point - origin).dot(right), (*point - origin).dot(up));
    let flats: Vec<Vec<DVec2>> = rings.iter().map(|ring| ring.iter().map(flat).collect()).collect();
    let triangles = match flats.as_slice() {
        [ring] if ring.len() == 3 => vec![[0, 1, 2]],
        [ring] if ring.len() == 4 && is_convex(ring) => vec![[0, 1, 2], [0, 2, 3]],
        _ => cap::triangulate(&flats)?,
    };
    let base =
        u32::try_from(part.positions.len()).map_err(|_| Error::new("a mesh holds too many vertices"))?;
    for (point, flat) in rings.iter().flatten().zip(flats.iter().flatten()) {
        part.positions.push(point.as_vec3());
        part.normals.push(normal.as_vec3());
        part.uvs.push(flat.as_vec2());
    }
    #[allow(clippy::cast_possible_truncation, reason = "a polygon has fewer than 2^32 corners")]
    part.triangles.extend(triangles.into_iter().map(|triangle| triangle.map(|corner| corner as u32 + base)));
    Ok(())
}

/// The sum of the normals of a ring's triangles, each as long as twice its area.
fn newell(ring: &[DVec3]) -> DVec3 {
    let from = ring[0];
    ring.windows(2)
        .map(|edge| (edge[0] - from).cross(edge[1] - from))
        .fold(DVec3::ZERO, |sum, normal| sum + normal)
}

fn is_convex(ring: &[DVec2]) -> bool {
    (0..4).all(|index| {
        let [a, b, c] = [0, 1, 2].map(|offset| ring[(index + offset) % 4]);
        (b - a).perp_dot(c - b) > 1e-6
    })
}
