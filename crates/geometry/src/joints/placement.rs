//! Distances from a joint at which the rings around it stop, and the triangles that connect them.
//!
//! Seen from the joint, each ring covers a cone. If no two cones overlap, circles of their angles on a sphere are
//! disjoint, so each of them is a face of the convex hull of all circles; the other faces connect the rings. J. A.
//! Bærentzen, M. K. Misztal, K. Wełnicka, "Converting skeletal structures to quad dominant meshes", 2012, and Z. Ji, L.
//! Liu, Y. Wang, "B-Mesh: a modeling system for base meshes of 3D articulated shapes", 2010, also connect tubes by hulls.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec3;

use super::axis::rounding;
use super::hull::sphere_hull;
use super::outline::Outlines;
use super::route::{Route, RouteFrame};
use super::tree::{EdgeEnd, TubeTree};
use burgeon_base::Stop;
use burgeon_base::error::Result;

/// Number of joints between two checks for cancellation.
const STRETCH: usize = 256;
/// Part of the smaller radius that is added to each distance, for a rounded transition.
const FILLET: f64 = 0.7;
/// Part of the angle between two rings that they may cover together.
const COVER: f64 = 0.95;
/// Maximum half angle (radians) of the cone of a ring.
const WIDEST: f64 = 1.4;
/// Minimum half angle (radians) of the circle of a ring.
const NARROWEST: f64 = 0.03;
/// Factor by which rings that overlap move outwards.
const OUTWARDS: f64 = 1.15;
/// Maximum number of moves.
const MOVES: usize = 24;
/// Maximum number of ends of edges at a joint.
const MOST_ENDS: usize = 32;
/// Part of an edge that a joint may take if the other end is open, and if it belongs to another joint.
const SHARES: [f64; 2] = [0.9, 0.5];

/// A ring around a joint.
struct JointRing {
    end: EdgeEnd,
    frame: RouteFrame,
    /// Unit vector from the joint.
    direction: DVec3,
    /// Distance (m) along the axis from the joint, and its maximum.
    distance: f64,
    limit: f64,
    /// Half angle (radians) of the cone that the ring covers.
    cone: f64,
    points: Vec<DVec3>,
}

/// Places the rings of all joints, and sets the cuts of the edges and the faces of the joints. An edge whose ring does
/// not fit is removed from the joint.
pub(super) fn place_rings(tree: &mut TubeTree) -> Result<()> {
    for joint in 0..tree.joints.len() {
        if joint % STRETCH == STRETCH - 1 {
            Stop::check_current()?;
        }
        let mut ends = tree.joints[joint].ends.clone();
        ends.truncate(MOST_ENDS);
        let mut faces = Vec::new();
        while ends.len() > 1 {
            match rings(tree, joint, &ends) {
                Ok(rings) => {
                    let Some(found) = connect(tree, &rings) else {
                        ends.pop();
                        continue;
                    };
                    faces = found;
                    for JointRing { end, frame, .. } in rings {
                        tree.edges[end.edge].cuts[end.end] = Some(frame);
                    }
                    break;
                }
                Err(culprit) => {
                    ends.remove(culprit);
                }
            }
        }
        if faces.is_empty() {
            ends.clear();
        }
        let all = std::mem::replace(&mut tree.joints[joint].ends, ends);
        // Without a patch, all edges but the first are separate.
        let mut rest = usize::from(faces.is_empty());
        for end in all {
            let edge = &mut tree.edges[end.edge];
            if edge.cuts[end.end].is_none() {
                edge.joints[end.end] = None;
                if rest > 0 {
                    rest -= 1;
                } else {
                    tree.separate.push(end);
                }
            }
        }
        tree.joints[joint].faces = faces;
    }
    Ok(())
}

/// Returns the rings at `ends`; fails with the index of an end that does not fit.
fn rings(tree: &TubeTree, joint: usize, ends: &[EdgeEnd]) -> std::result::Result<Vec<JointRing>, usize> {
    let centre = tree.joints[joint].centre;
    let mut begins: Vec<(DVec3, f64, f64)> = Vec::with_capacity(ends.len());
    for (index, end) in ends.iter().enumerate() {
        let (edge, route) = (&tree.edges[end.edge], &tree.routes[tree.edges[end.edge].axis]);
        let other = 1 - end.end;
        let limit = match (edge.cuts[other], edge.joints[other]) {
            (Some(cut), _) => (cut.at - edge.span[end.end]).abs() * SHARES[0],
            (None, Some(_)) => edge.length() * SHARES[1],
            (None, None) => edge.length() * SHARES[0],
        };
        // The radius at the joint itself; slightly within the edge, because the axis may bend there.
        let inner = edge.span[end.end] + (edge.span[other] - edge.span[end.end]) * 1e-3;
        let frame = route.frame(inner).ok_or(index)?;
        let direction = frame.tangent * if end.end == 0 { 1.0 } else { -1.0 };
        begins.push((direction, frame.radius * route.outlines.reach, limit));
    }
    let mut rings: Vec<JointRing> = Vec::with_capacity(ends.len());
    for (index, end) in ends.iter().enumerate() {
        let (direction, radius, limit) = begins[index];
        let others = begins.iter().enumerate().filter(|(other, _)| *other != index);
        let distance = others.map(|(_, other)| {
            distance_apart(radius, other.1, direction.angle_between(other.0)) + FILLET * radius.min(other.1)
        });
        let distance = distance.fold(0.0, f64::max).clamp(limit * 1e-2, limit);
        let frame = tree.routes[tree.edges[end.edge].axis].frame(0.0).ok_or(index)?;
        let points = Vec::new();
        rings.push(JointRing { end: *end, frame, direction, distance, limit, cone: 0.0, points });
        move_ring(tree, centre, &mut rings[index]);
    }
    for _ in 0..MOVES {
        let overlaps = overlaps(&rings);
        if overlaps.is_empty() {
            return Ok(rings);
        }
        // A ring at its maximum distance does not move. If no ring moves, the last of those that overlap is removed.
        let mut moved = false;
        let mut moving: Vec<usize> = overlaps.into_iter().flatten().collect();
        moving.sort_unstable();
        moving.dedup();
        for index in moving {
            let ring = &mut rings[index];
            if ring.distance < ring.limit {
                ring.distance = (ring.distance * OUTWARDS).min(ring.limit);
                move_ring(tree, centre, ring);
                moved = true;
            }
        }
        if !moved {
            break;
        }
    }
    match overlaps(&rings).into_iter().flatten().max() {
        Some(last) => Err(last),
        None => Ok(rings),
    }
}

/// Returns the pairs of rings that overlap as seen from the joint; a ring that covers too much is a pair with itself.
fn overlaps(rings: &[JointRing]) -> Vec<[usize; 2]> {
    let mut found = Vec::new();
    for (index, ring) in rings.iter().enumerate() {
        if ring.cone > WIDEST {
            found.push([index, index]);
        }
        for (before, other) in rings[..index].iter().enumerate() {
            let angle = ring.direction.angle_between(other.direction);
            if ring.cone + other.cone > COVER * angle || angle < NARROWEST {
                found.push([before, index]);
            }
        }
    }
    found
}

/// Sets the frame, direction and cone of a ring from its distance.
fn move_ring(tree: &TubeTree, centre: DVec3, ring: &mut JointRing) {
    let edge = &tree.edges[ring.end.edge];
    let route = &tree.routes[edge.axis];
    let along = if ring.end.end == 0 { ring.distance } else { -ring.distance };
    let Some(mut frame) = route.frame(edge.span[ring.end.end] + along) else { return };
    frame.radius = frame.radius.max(least_radius(frame.centre, &route.outlines));
    ring.frame = frame;
    ring.points.clear();
    add_points(route, &frame, &mut ring.points);
    let way = frame.centre - centre;
    ring.direction = way.try_normalize().unwrap_or(frame.tangent);
    if way.length() <= 2.0 * rounding(centre) {
        ring.cone = FRAC_PI_2;
        return;
    }
    let cosine = |point: &DVec3| (*point - centre).normalize_or_zero().dot(ring.direction);
    ring.cone = ring.points.iter().map(cosine).fold(1.0, f64::min).acos();
}

/// Adds the points (m) of the ring at `frame`.
pub(super) fn add_points(route: &Route, frame: &RouteFrame, points: &mut Vec<DVec3>) {
    let outlines = &route.outlines;
    let place = |index| frame.point(outlines.point(frame.control, frame.part, index));
    points.extend((0..outlines.count()).map(place));
}

/// Returns the minimum radius (m) of a ring whose points differ at export precision.
pub(super) fn least_radius(centre: DVec3, outlines: &Outlines) -> f64 {
    rounding(centre) * (outlines.count() + 1) as f64
}

/// Returns the distance (m) from a joint along a tube at which its ring and that of another tube touch on a sphere.
fn distance_apart(radius: f64, other: f64, angle: f64) -> f64 {
    let (least, most) = (radius.min(other), radius.max(other));
    if most <= 0.0 {
        return 0.0;
    }
    // On a sphere of radius `most`, the larger ring covers a half angle of 90 degrees.
    let sphere = if (least / most).asin() + FRAC_PI_2 <= angle {
        most
    } else {
        let square = radius * radius + other * other + 2.0 * radius * other * angle.cos();
        square.max(0.0).sqrt() / angle.sin().max(1e-9)
    };
    (sphere * sphere - radius * radius).max(0.0).sqrt()
}

/// Returns the triangles that connect the rings; `None` if they would not be a closed surface with the tubes.
fn connect(tree: &TubeTree, rings: &[JointRing]) -> Option<Vec<[u32; 3]>> {
    let centre = tree.joints[tree.edges[rings[0].end.edge].joints[rings[0].end.end]?].centre;
    let mut points = Vec::new();
    let mut owners: Vec<(u32, u32)> = Vec::new();
    for (number, ring) in rings.iter().enumerate() {
        let gap = |(other, it): (usize, &JointRing)| {
            let apart = ring.direction.angle_between(it.direction) - it.cone;
            if other == number { f64::INFINITY } else { apart }
        };
        let room = rings.iter().enumerate().map(gap).fold(f64::INFINITY, f64::min);
        let cone = ring.cone.max(NARROWEST.min(0.4 * room));
        let first = points.len();
        add_circle(ring, centre, cone, &mut points);
        owners.extend((0..points.len() - first).map(|corner| (number as u32, corner as u32)));
    }
    let hull = sphere_hull(&points)?;
    let ring_of = |corner: u32| owners[corner as usize].0;
    let is_inside =
        |face: &[u32; 3]| ring_of(face[0]) == ring_of(face[1]) && ring_of(face[1]) == ring_of(face[2]);
    let faces: Vec<[u32; 3]> = hull.into_iter().filter(|face| !is_inside(face)).collect();
    // Each edge of a ring belongs to one face, and no face has another line across a ring.
    let mut edges = 0;
    for face in &faces {
        for (from, to) in [(face[0], face[1]), (face[1], face[2]), (face[2], face[0])] {
            if ring_of(from) != ring_of(to) {
                continue;
            }
            let ring = &rings[ring_of(from) as usize];
            let (a, b) = (owners[from as usize].1 as usize, owners[to as usize].1 as usize);
            let (low, high) = if ring.end.end == 0 { (b, a) } else { (a, b) };
            if (low + 1) % ring.points.len() != high {
                return None;
            }
            edges += 1;
        }
    }
    (edges == points.len() && faces.len() + 4 == points.len() + 2 * rings.len()).then_some(faces)
}

/// Adds the points of a circle with the half angle `cone` on the unit sphere, in the directions of the ring's points.
fn add_circle(ring: &JointRing, centre: DVec3, cone: f64, points: &mut Vec<DVec3>) {
    let flat = |point: &DVec3| (*point - centre).reject_from_normalized(ring.direction).normalize_or_zero();
    let count = ring.points.len();
    let first = points.len();
    points.extend(ring.points.iter().map(flat));
    // Seen from outside, the points of a ring at the start of an edge are counter-clockwise.
    let axis = if ring.end.end == 0 { ring.direction } else { -ring.direction };
    let turn = |index: usize| points[first + index].cross(points[first + (index + 1) % count]).dot(axis);
    let least = (TAU / count as f64).sin().abs() * 0.05;
    if (0..count).any(|index| turn(index) < least) {
        // The ring is not star-shaped from the joint, so its points are distributed evenly.
        let x = points[first].try_normalize().unwrap_or_else(|| axis.any_orthonormal_vector());
        let y = axis.cross(x);
        for index in 0..count {
            let (sin, cos) = (TAU * index as f64 / count as f64).sin_cos();
            points[first + index] = x * cos + y * sin;
        }
    }
    let (sin, cos) = cone.sin_cos();
    points[first..].iter_mut().for_each(|point| *point = ring.direction * cos + *point * sin);
}
