//! Patches of joints: smooth surfaces that connect the rings of tubes.
//!
//! Each side of a face between two rings is a cubic curve that leaves both rings in the direction of the tubes, so the
//! surface continues the tubes without an edge. A. Vlachos et al., "Curved PN triangles", 2001, fill the inside of such
//! faces in the same way.

use glam::{DVec3, Vec2};
use rustc_hash::FxHashMap;

use super::body::{EndRing, EndRings};
use super::tree::{JointPlace, TubeTree};
use burgeon_scene::Part;

/// Mark of a vertex that does not exist.
const NONE: u32 = u32::MAX;
/// Length of the handles of a curve, as a part of the distance of its ends.
const HANDLE: f64 = 0.4;
/// Number of smoothing steps of the inner points, and the part of the way to the mean of the neighbours.
const SMOOTHING: (usize, f64) = (3, 0.4);

/// A patch under construction.
#[derive(Default)]
pub(super) struct JointPatch {
    points: Vec<DVec3>,
    normals: Vec<DVec3>,
    /// Direction along the tube towards the joint at each point of a ring, and the maximum length (m) of a handle.
    handles: Vec<(DVec3, f64)>,
    triangles: Vec<[u32; 3]>,
    /// First inner point of the curve between two points of rings, by their numbers in ascending order.
    curves: FxHashMap<(u32, u32), u32>,
    means: Vec<(DVec3, f64)>,
    /// For each point the vertices to the left of the seam, at their place, and to the right of it.
    vertices: Vec<[u32; 3]>,
    rows: [Vec<u32>; 2],
}

impl JointPatch {
    /// Adds the patch of a joint; `steps` is the number of pieces of each curve, at least 2.
    pub(super) fn add(
        &mut self,
        part: &mut Part,
        tree: &TubeTree,
        joint: &JointPlace,
        all: &EndRings,
        steps: u32,
    ) {
        let rings: Vec<EndRing> = joint.ends.iter().filter_map(|end| all.of[end.edge][end.end]).collect();
        if rings.len() != joint.ends.len() || joint.faces.is_empty() {
            return;
        }
        self.begin(joint, &rings, all);
        let fixed = self.points.len();
        let mut owners = Vec::with_capacity(fixed);
        for (number, ring) in rings.iter().enumerate() {
            owners.extend(std::iter::repeat_n(number, ring.count));
        }
        for face in &joint.faces {
            let [a, b, c] = face.map(|corner| owners[corner as usize]);
            // The first two corners are those on one ring.
            match () {
                () if a == b => self.strip(*face, steps),
                () if b == c => self.strip([face[1], face[2], face[0]], steps),
                () if c == a => self.strip([face[2], face[0], face[1]], steps),
                () => self.fill(*face, steps),
            }
        }
        self.smooth(fixed);
        self.shade(fixed);
        self.draw(part, tree, joint, &rings, all);
    }

    /// Takes the rings of the joint.
    fn begin(&mut self, joint: &JointPlace, rings: &[EndRing], all: &EndRings) {
        self.points.clear();
        self.normals.clear();
        self.handles.clear();
        self.triangles.clear();
        self.curves.clear();
        for (ring, end) in rings.iter().zip(&joint.ends) {
            let inwards = ring.frame.tangent * if end.end == 0 { -1.0 } else { 1.0 };
            let longest = 0.95 * (joint.centre - ring.frame.centre).dot(inwards).max(0.0);
            for index in ring.first..ring.first + ring.count {
                let normal = all.normals[index];
                self.points.push(all.points[index]);
                self.normals.push(normal);
                self.handles.push((inwards.reject_from_normalized(normal).normalize_or(inwards), longest));
            }
        }
    }

    /// Returns the inner control points of the curve from one point of a ring to another.
    fn controls(&self, from: u32, to: u32) -> [DVec3; 2] {
        let [a, b] = [from, to].map(|index| self.points[index as usize]);
        let length = HANDLE * a.distance(b);
        [(from, a), (to, b)].map(|(index, at)| {
            let (direction, longest) = self.handles[index as usize];
            at + direction * length.min(longest)
        })
    }

    /// Returns point number `step` of `steps` of the curve from one point of a ring to another; adds it if it is new.
    fn on_curve(&mut self, from: u32, to: u32, step: u32, steps: u32) -> u32 {
        if step == 0 {
            return from;
        }
        if step == steps {
            return to;
        }
        let (low, high) = (from.min(to), from.max(to));
        let first = match self.curves.get(&(low, high)) {
            Some(first) => *first,
            None => {
                let first = self.points.len() as u32;
                let [p, q] = self.controls(low, high);
                let [a, b] = [low, high].map(|index| self.points[index as usize]);
                for step in 1..steps {
                    let t = f64::from(step) / f64::from(steps);
                    let s = 1.0 - t;
                    self.points
                        .push(a * (s * s * s) + (p * (s * s * t) + q * (s * t * t)) * 3.0 + b * (t * t * t));
                }
                self.curves.insert((low, high), first);
                first
            }
        };
        first + if from == low { step - 1 } else { steps - step - 1 }
    }

    /// Adds the triangles of a face whose corners `a` and `b` are neighbours on a ring.
    fn strip(&mut self, [a, b, c]: [u32; 3], steps: u32) {
        for step in 0..steps {
            let [p, q] = [a, b].map(|from| self.on_curve(from, c, step, steps));
            let [r, s] = [b, a].map(|from| self.on_curve(from, c, step + 1, steps));
            if step + 1 == steps {
                self.triangles.push([p, q, c]);
                continue;
            }
            let length = |i: u32, j: u32| self.points[i as usize].distance_squared(self.points[j as usize]);
            let split =
                if length(p, r) <= length(q, s) { [[p, q, r], [p, r, s]] } else { [[p, q, s], [q, r, s]] };
            self.triangles.extend(split);
        }
    }

    /// Adds the triangles of a face between three rings: a cubic triangle.
    fn fill(&mut self, [a, b, c]: [u32; 3], steps: u32) {
        let corners = [a, b, c].map(|index| self.points[index as usize]);
        let sides = [[a, b], [b, c], [c, a]].map(|[from, to]| self.controls(from, to));
        let edge: DVec3 = sides.iter().flatten().sum::<DVec3>() / 6.0;
        let middle = edge + (edge - corners.iter().sum::<DVec3>() / 3.0) / 2.0;
        let [mut before, mut row] = std::mem::take(&mut self.rows);
        before.clear();
        before.push(c);
        // Rows from the corner `c` to the side from `a` to `b`.
        for step in 1..=steps {
            row.clear();
            for place in 0..=step {
                let vertex = if place == 0 {
                    self.on_curve(c, a, step, steps)
                } else if place == step {
                    self.on_curve(c, b, step, steps)
                } else if step == steps {
                    self.on_curve(a, b, place, steps)
                } else {
                    let whole = f64::from(steps);
                    let weight = [step - place, place, steps - step].map(|it| f64::from(it) / whole);
                    self.points.push(inside(corners, sides, middle, weight));
                    self.points.len() as u32 - 1
                };
                row.push(vertex);
            }
            for place in 0..step as usize {
                self.triangles.push([before[place], row[place], row[place + 1]]);
                if place + 1 < step as usize {
                    self.triangles.push([before[place], row[place + 1], before[place + 1]]);
                }
            }
            std::mem::swap(&mut before, &mut row);
        }
        self.rows = [before, row];
    }

    /// Moves the points from number `fixed` on towards the mean of their neighbours.
    fn smooth(&mut self, fixed: usize) {
        for _ in 0..SMOOTHING.0 {
            self.means.clear();
            self.means.resize(self.points.len(), (DVec3::ZERO, 0.0));
            for triangle in &self.triangles {
                for side in 0..3 {
                    let (from, to) = (triangle[side] as usize, triangle[(side + 1) % 3] as usize);
                    self.means[from].0 += self.points[to];
                    self.means[from].1 += 1.0;
                }
            }
            for (point, (sum, count)) in self.points.iter_mut().zip(&self.means).skip(fixed) {
                if *count > 0.0 {
                    *point = point.lerp(*sum / *count, SMOOTHING.1);
                }
            }
        }
    }

    /// Sets the normals of the points from number `fixed` on to those of the faces around them.
    fn shade(&mut self, fixed: usize) {
        self.normals.resize(self.points.len(), DVec3::ZERO);
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|corner| self.points[corner as usize]);
            let normal = (b - a).cross(c - a);
            for &corner in triangle {
                if corner as usize >= fixed {
                    self.normals[corner as usize] += normal;
                }
            }
        }
        for normal in &mut self.normals[fixed..] {
            *normal = normal.normalize_or(DVec3::Z);
        }
    }

    /// Adds the triangles to `part`, with the texture coordinates of the first axis.
    fn draw(
        &mut self,
        part: &mut Part,
        tree: &TubeTree,
        joint: &JointPlace,
        rings: &[EndRing],
        all: &EndRings,
    ) {
        let (Some(first), Some(end)) = (rings.first(), joint.ends.first()) else { return };
        let axis = tree.edges[end.edge].axis;
        let frame = &first.frame;
        let (side, up) = (frame.side, frame.tangent.cross(frame.side));
        let begin = frame.at + (joint.centre - frame.centre).dot(frame.tangent);
        let mut places: Vec<(f64, f64)> = Vec::with_capacity(self.points.len());
        for (ring, end) in rings.iter().zip(&joint.ends) {
            let own = tree.edges[end.edge].axis == axis;
            for index in ring.first..ring.first + ring.count {
                let projected = || (f64::NAN, 0.0);
                places.push(if own { (all.us[index], ring.frame.at) } else { projected() });
            }
        }
        places.resize(self.points.len(), (f64::NAN, 0.0));
        for (place, point) in places.iter_mut().zip(&self.points) {
            if place.0.is_nan() {
                let away = *point - joint.centre;
                let turn = away.dot(up).atan2(away.dot(side)) / std::f64::consts::TAU;
                *place = ((turn.rem_euclid(1.0) - 0.5) * first.around, begin + away.dot(frame.tangent));
            }
        }
        part.make_room(self.points.len() + rings.len() * first.count, self.triangles.len());
        self.vertices.clear();
        self.vertices.resize(self.points.len(), [NONE; 3]);
        for triangle in &self.triangles {
            let us = triangle.map(|corner| places[corner as usize].0);
            // A triangle across the seam is on the side of its middle.
            let crosses =
                us.iter().copied().fold(f64::MIN, f64::max) - us.iter().copied().fold(f64::MAX, f64::min);
            let crosses = crosses > first.around / 2.0;
            let lifted = us.map(|u| if crosses && u < 0.0 { u + first.around } else { u });
            let back = if lifted.iter().sum::<f64>() / 3.0 > first.around / 2.0 { first.around } else { 0.0 };
            let mut corners = [0; 3];
            for (index, &corner) in triangle.iter().enumerate() {
                let shift = (lifted[index] - back - us[index]) / first.around.max(f64::MIN_POSITIVE);
                let shift = shift.round().clamp(-1.0, 1.0);
                let vertex = &mut self.vertices[corner as usize][(shift + 1.0) as usize];
                if *vertex == NONE {
                    *vertex = part.positions.len() as u32;
                    part.positions.push(self.points[corner as usize].as_vec3());
                    part.normals.push(self.normals[corner as usize].as_vec3().into());
                    let (u, v) = places[corner as usize];
                    part.uvs.push(Vec2::new((u + shift * first.around) as f32, v as f32));
                }
                corners[index] = *vertex;
            }
            part.triangles.push(corners);
        }
    }
}

/// Returns the point of a cubic triangle with these corners, control points of the sides and middle control point, at
/// the weights of the corners.
fn inside(corners: [DVec3; 3], sides: [[DVec3; 2]; 3], middle: DVec3, [u, v, w]: [f64; 3]) -> DVec3 {
    let [a, b, c] = corners;
    let [[ab, ba], [bc, cb], [ca, ac]] = sides;
    a * (u * u * u)
        + b * (v * v * v)
        + c * (w * w * w)
        + (ab * (u * u * v) + ba * (u * v * v) + bc * (v * v * w) + cb * (v * w * w)) * 3.0
        + (ca * (w * w * u) + ac * (w * u * u)) * 3.0
        + middle * (6.0 * u * v * w)
}
