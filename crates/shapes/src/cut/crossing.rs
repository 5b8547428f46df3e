//! The part of a face on one side of a plane.

use burgeon_geometry::planar::{contains, twice_area};
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;

use super::plane::{CutPlane, FaceRings};
use crate::Scope;
use crate::mesh::{EdgeSums, PolygonFace, PolygonMesh};

/// Position of a point relative to a plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PlaneSide {
    Below,
    On,
    Above,
}

impl PlaneSide {
    /// Returns the side at a signed distance (m); within `tolerance` (m) a point lies on the plane.
    pub(crate) fn of(distance: f64, tolerance: f64) -> Self {
        if distance > tolerance {
            Self::Above
        } else if distance < -tolerance {
            Self::Below
        } else {
            Self::On
        }
    }
}

/// Cuts faces of a mesh, which share new points.
pub(super) struct FaceCutter<'a> {
    pub plane: &'a CutPlane,
    pub mesh: &'a PolygonMesh,
    pub sides: &'a [PlaneSide],
    /// The side to keep. Points on the plane count as points of the other side.
    pub side: PlaneSide,
    /// Points of the mesh, and new ones.
    pub points: Vec<DVec3>,
    /// New point on each edge.
    pub new: FxHashMap<[u32; 2], u32>,
}

/// Consecutive kept points of a ring, between two points on the plane.
struct KeptRun {
    points: Vec<u32>,
    /// Positions of the first and the last point along the plane.
    ends: [f64; 2],
}

impl FaceCutter<'_> {
    /// Adds the kept parts of a face to `faces`, and their edges on the plane, reversed, to `rim`.
    pub(crate) fn cut(&mut self, face: &PolygonFace, faces: &mut Vec<PolygonFace>, rim: &mut EdgeSums) {
        let normal = self.mesh.normal(face);
        let inward = if self.side == PlaneSide::Above { self.plane.normal } else { -self.plane.normal };
        let along = inward.cross(normal).normalize_or_zero();
        let (mut runs, mut whole): (Vec<KeptRun>, Vec<Vec<u32>>) = (Vec::new(), Vec::new());
        for ring in &face.rings {
            if ring.iter().all(|point| self.keeps(*point)) {
                whole.push(ring.clone());
            } else {
                self.add_runs(ring, along, &mut runs);
            }
        }
        // A point on the plane between two crossings stays a corner, since other faces may have it.
        let on = face.rings.iter().flatten().filter(|point| self.sides[**point as usize] == PlaneSide::On);
        let mut on: Vec<(f64, u32)> =
            on.map(|&point| (self.points[point as usize].dot(along), point)).collect();
        on.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut rings: Vec<Vec<u32>> = Vec::new();
        for mut ring in join_runs(&runs, &on, rim) {
            ring.dedup();
            while ring.len() > 1 && ring.first() == ring.last() {
                ring.pop();
            }
            if ring.len() > 2 {
                rings.push(ring);
            }
        }
        rings.extend(whole);
        self.nest(rings, normal, faces);
    }

    fn keeps(&self, point: u32) -> bool {
        self.sides[point as usize] == self.side
    }

    /// Adds the runs of kept points of a ring.
    fn add_runs(&mut self, ring: &[u32], along: DVec3, runs: &mut Vec<KeptRun>) {
        let count = ring.len();
        let starts: Vec<usize> = (0..count)
            .filter(|&index| self.keeps(ring[index]) && !self.keeps(ring[(index + count - 1) % count]))
            .collect();
        for start in starts {
            let mut points = vec![self.crossing([ring[(start + count - 1) % count], ring[start]])];
            let mut index = start;
            while self.keeps(ring[index % count]) {
                points.push(ring[index % count]);
                index += 1;
            }
            points.push(self.crossing([ring[(index + count - 1) % count], ring[index % count]]));
            let place = |point: &u32| self.points[*point as usize].dot(along);
            let ends = [place(&points[0]), place(&points[points.len() - 1])];
            runs.push(KeptRun { points, ends });
        }
    }

    /// Returns the point where an edge crosses the plane: an end on the plane, or a new point.
    fn crossing(&mut self, [from, to]: [u32; 2]) -> u32 {
        if let Some(on) = [from, to].into_iter().find(|point| self.sides[*point as usize] == PlaneSide::On) {
            return on;
        }
        let key = [from.min(to), from.max(to)];
        let points = &mut self.points;
        let plane = self.plane;
        *self.new.entry(key).or_insert_with(|| {
            let [a, b] = key.map(|point| points[point as usize]);
            let (before, after) = (plane.distance(a), plane.distance(b));
            points.push(a.lerp(b, before / (before - after)));
            u32::try_from(points.len() - 1).unwrap_or(u32::MAX)
        })
    }

    /// Adds faces of rings: the counter-clockwise ones, with the others as their holes.
    fn nest(&self, rings: Vec<Vec<u32>>, normal: DVec3, faces: &mut Vec<PolygonFace>) {
        if let [_] = rings.as_slice() {
            faces.push(PolygonFace { rings: rings.into_iter().collect(), style: None });
            return;
        }
        let turn = Scope::face_axes(normal, glam::DMat3::IDENTITY).transpose();
        let flat = |ring: &Vec<u32>| -> Vec<DVec2> {
            ring.iter().map(|point| (turn * self.points[*point as usize]).truncate()).collect()
        };
        let first = faces.len();
        let mut outlines: Vec<Vec<DVec2>> = Vec::new();
        let mut holes: Vec<(Vec<u32>, DVec2)> = Vec::new();
        for ring in rings {
            let places = flat(&ring);
            if twice_area(places.iter().copied()) > 0.0 {
                faces.push(PolygonFace { rings: FaceRings::from_iter([ring]), style: None });
                outlines.push(places);
            } else {
                let place =
                    places.iter().sum::<DVec2>() / f64::from(u32::try_from(places.len()).unwrap_or(1));
                // The middle of a hole may lie outside of it, but its first point may lie on the plane.
                let inner = if contains(&places, place) { place } else { places[1] };
                holes.push((ring, inner));
            }
        }
        for (hole, inner) in holes {
            let around = outlines.iter().position(|outline| contains(outline, inner));
            if let Some(at) = around {
                faces[first + at].rings.push(hole);
            }
        }
    }
}

/// Joins runs to rings along the plane, over the points `on` it, and adds the joining edges, reversed, to `rim`.
///
/// Along the plane, with the kept side on the left, the border of the face alternately leaves the kept side, where a
/// run ends, and enters it, where a run begins.
fn join_runs(runs: &[KeptRun], on: &[(f64, u32)], rim: &mut EdgeSums) -> Vec<Vec<u32>> {
    let mut leaves: Vec<usize> = (0..runs.len()).collect();
    let mut enters = leaves.clone();
    leaves.sort_by(|&a, &b| runs[a].ends[1].total_cmp(&runs[b].ends[1]));
    enters.sort_by(|&a, &b| runs[a].ends[0].total_cmp(&runs[b].ends[0]));
    let mut next = vec![0; runs.len()];
    leaves.iter().zip(&enters).for_each(|(&leave, &enter)| next[leave] = enter);
    let mut used = vec![false; runs.len()];
    let mut rings = Vec::new();
    for start in 0..runs.len() {
        let (mut ring, mut at) = (Vec::new(), start);
        while !std::mem::replace(&mut used[at], true) {
            let (run, following) = (&runs[at], &runs[next[at]]);
            ring.extend_from_slice(&run.points);
            let (from, to) = (run.ends[1], following.ends[0]);
            let first = on.partition_point(|(place, _)| *place <= from);
            let between = on[first..].iter().take_while(|(place, _)| *place < to).map(|(_, point)| *point);
            let mut last = ring[ring.len() - 1];
            for point in between.chain([following.points[0]]) {
                rim.add([point, last]);
                ring.push(point);
                last = point;
            }
            at = next[at];
        }
        if !ring.is_empty() {
            rings.push(ring);
        }
    }
    rings
}
