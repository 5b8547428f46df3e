//! Coarsening of the faces below a millimetre: short borders shrink, thin spikes close.

use glam::DVec3;
use smallvec::SmallVec;

use super::edge::SkeletonEdge;
use super::skeleton::Peak;

/// Maximum length (m), horizontally and in time, of short borders, and maximum width of thin spikes.
const FINEST: f64 = 1e-3;
/// Minimum distance (m) between a peak and a border, so that a mesh of 32-bit numbers separates them.
const NARROW: f64 = 2.5e-4;

/// Shrinks short borders and closes thin spikes, as long as the faces remain a planar map.
///
/// Two peaks merge only if the border between them is all that the faces around them share. A peak on a
/// straight border between two faces is removed. A spike is closed if one of its borders runs along the
/// other; then the faces beyond them meet there. No face loses its edge or touches itself, and no two faces
/// get a second border between the same peaks. The first `fixed` peaks stay.
pub(super) fn coarsen(peaks: &[Peak], fixed: usize, edges: &[SkeletonEdge], faces: &mut [Vec<usize>]) {
    // Merged peaks may invert spikes by twice as much; next to upright faces this would tilt them.
    let turned = if edges.iter().all(|edge| edge.pace.moves()) { 2.0 * FINEST } else { FINEST };
    if faces.iter().all(|face| is_coarse(peaks, fixed, face, turned)) {
        return;
    }
    let mut short = short_borders(peaks, fixed, faces);
    let mut map = PeakMap::new(peaks.len(), faces);
    // An operation that is impossible at first may become possible after others.
    let mut done = true;
    while done {
        done = false;
        for (_, [kept, gone]) in short {
            let far = way(peaks, [kept, gone]).length();
            done |= map.shrinks(kept, gone, far, faces);
        }
        for face in 0..faces.len() {
            while faces[face].len() > 3 {
                let found: SmallVec<[[usize; 3]; 4]> = spikes_of(peaks, &faces[face], turned).collect();
                let mut found = found.into_iter().filter(|spike| spike[1] >= fixed);
                if !found.any(|spike| map.closes(face, spike, peaks, faces)) {
                    break;
                }
                done = true;
            }
        }
        for peak in fixed..peaks.len() {
            done |= map.straightens(peak, peaks, faces);
        }
        short = short_borders(peaks, fixed, faces);
    }
}

/// Widens faces that are nearly cut in two: a peak that nearly touches a border of its face moves away from
/// it, by less than the length of short borders.
///
/// Faces over edges that stand still at first are upright there, and are skipped.
pub(super) fn widen(peaks: &mut [Peak], fixed: usize, edges: &[SkeletonEdge], faces: &[Vec<usize>]) {
    for (face, _) in faces.iter().zip(edges).filter(|(face, edge)| face.len() > 4 && edge.pace.moves()) {
        for (index, &a) in face.iter().enumerate() {
            let b = face[(index + 1) % face.len()];
            let (from, way) = (peaks[a].at, peaks[b].at - peaks[a].at);
            let square = way.length_squared();
            for &peak in face[2..].iter().filter(|&&peak| peak >= fixed && peak != a && peak != b) {
                let there = peaks[peak].at - from;
                let across = way.perp_dot(there);
                // Most peaks are far away, which needs no square root.
                if across * across < 2.0 * NARROW * NARROW * square {
                    let length = square.sqrt();
                    let (far, on) = (across / length, way.dot(there) / length);
                    if far.abs() < NARROW && on > NARROW && on < length - NARROW {
                        peaks[peak].at += way.perp() / length * (NARROW - far);
                    }
                }
            }
        }
    }
}

/// Returns true if a face has neither short borders nor spikes.
fn is_coarse(peaks: &[Peak], fixed: usize, face: &[usize], turned: f64) -> bool {
    let count = face.len();
    let mut back = way(peaks, [face[1], face[0]]);
    (1..count).all(|index| {
        let (from, to) = (face[index], face[(index + 1) % count]);
        let on = way(peaks, [from, to]);
        let ways = [std::mem::replace(&mut back, -on), on];
        !((from.max(to) >= fixed && square(on) <= FINEST * FINEST)
            || (index > 1 && count > 3 && is_spike(ways, turned)))
    })
}

/// Returns the squared length of a border, the maximum of its horizontal and its time component.
fn square(way: DVec3) -> f64 {
    way.truncate().length_squared().max(way.z * way.z)
}

/// Returns true if one of two vectors from a corner runs along the other; an inverted corner may deviate by
/// up to `turned` (m).
fn is_spike([one, two]: [DVec3; 2], turned: f64) -> bool {
    let dot = one.dot(two);
    if dot <= 0.0 {
        return false;
    }
    let squares = [one.length_squared(), two.length_squared()];
    let (long, cross) = (squares[0].max(squares[1]), one.cross(two));
    let widest = if cross.z > 0.0 { turned } else { FINEST };
    4.0 * dot * dot > squares[0] * squares[1] && cross.length_squared() <= widest * widest * long
}

/// Returns the short borders, each with its squared length, the shortest first; the second of the two peaks
/// may be removed.
fn short_borders(peaks: &[Peak], fixed: usize, faces: &[Vec<usize>]) -> Vec<(f64, [usize; 2])> {
    let mut short = Vec::new();
    for face in faces {
        for (index, &from) in face.iter().enumerate() {
            let to = face[(index + 1) % face.len()];
            if from < to && to >= fixed {
                let square = square(way(peaks, [from, to]));
                if square <= FINEST * FINEST {
                    short.push((square, [from, to]));
                }
            }
        }
    }
    short.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    short
}

/// Returns the spikes of a face: three consecutive corners of which the first or the last lies on the border
/// between the two others.
///
/// Inverted spikes are at most `turned` (m) wide.
fn spikes_of(peaks: &[Peak], face: &[usize], turned: f64) -> impl Iterator<Item = [usize; 3]> {
    let count = face.len();
    // The first two corners are the ends of the edge.
    let corners = (2..count).map(move |index| [face[index - 1], face[index], face[(index + 1) % count]]);
    corners.filter(move |&[a, tip, b]| is_spike([way(peaks, [tip, a]), way(peaks, [tip, b])], turned))
}

/// Returns the vector from one peak to another, horizontally and in time.
fn way(peaks: &[Peak], [from, to]: [usize; 2]) -> DVec3 {
    (peaks[to].at - peaks[from].at).extend(peaks[to].time - peaks[from].time)
}

/// Faces around each peak, and the distance (m) of the farthest peak that it replaces.
struct PeakMap {
    around: Vec<SmallVec<[usize; 6]>>,
    spread: Vec<f64>,
}

/// Returns the corners before and after a corner of a ring; empty if the ring does not contain it.
fn ring_neighbours(ring: &[usize], peak: usize) -> SmallVec<[usize; 2]> {
    let count = ring.len();
    let at = ring.iter().position(|&other| other == peak);
    at.map(|at| SmallVec::from_slice(&[ring[(at + count - 1) % count], ring[(at + 1) % count]]))
        .unwrap_or_default()
}

impl PeakMap {
    fn new(count: usize, faces: &[Vec<usize>]) -> Self {
        let mut around = vec![SmallVec::new(); count];
        for (number, face) in faces.iter().enumerate() {
            face.iter().for_each(|&peak| around[peak].push(number));
        }
        Self { around, spread: vec![0.0; count] }
    }

    /// Returns the peaks that are connected to a peak by borders.
    fn neighbours(&self, peak: usize, faces: &[Vec<usize>]) -> SmallVec<[usize; 12]> {
        self.around[peak].iter().flat_map(|&face| ring_neighbours(&faces[face], peak)).collect()
    }

    /// Replaces `gone` by `kept` if both exist and the map stays valid; returns true on success.
    fn shrinks(&mut self, kept: usize, gone: usize, far: f64, faces: &mut [Vec<usize>]) -> bool {
        let spread = self.spread[kept].max(far + self.spread[gone]);
        if spread > 2.0 * FINEST {
            return false;
        }
        let shared: SmallVec<[usize; 4]> =
            self.around[gone].iter().copied().filter(|face| self.around[kept].contains(face)).collect();
        let apart =
            |&face: &usize| faces[face].len() <= 3 || !ring_neighbours(&faces[face], gone).contains(&kept);
        if shared.len() != 2 || shared[0] == shared[1] || shared.iter().any(apart) {
            return false;
        }
        let others = self.neighbours(kept, faces);
        if self.neighbours(gone, faces).iter().any(|peak| others.contains(peak)) {
            return false;
        }
        for face in std::mem::take(&mut self.around[gone]) {
            if shared.contains(&face) {
                faces[face].retain(|&peak| peak != gone);
            } else {
                faces[face].iter_mut().filter(|peak| **peak == gone).for_each(|peak| *peak = kept);
                self.around[kept].push(face);
            }
        }
        self.spread[kept] = spread;
        true
    }

    /// Removes a peak on a straight border between two faces; returns true on success.
    fn straightens(&mut self, peak: usize, peaks: &[Peak], faces: &mut [Vec<usize>]) -> bool {
        let [one, two] = self.around[peak][..] else { return false };
        let [a, b] = ring_neighbours(&faces[one], peak)[..] else { return false };
        let [there, whole] = [way(peaks, [a, peak]), way(peaks, [a, b])];
        // Both ends may be off by as much as merged peaks are.
        if there.cross(whole).length() > 3.0 * FINEST * whole.length()
            || faces[one].len().min(faces[two].len()) <= 3
            || self.neighbours(a, faces).contains(&b)
        {
            return false;
        }
        for face in [one, two] {
            faces[face].retain(|&other| other != peak);
        }
        self.around[peak].clear();
        true
    }

    /// Returns the face on the other side of a face's border; `None` at an edge of the polygon.
    fn face_across(&self, [from, to]: [usize; 2], faces: &[Vec<usize>]) -> Option<usize> {
        let runs = |face: &usize| {
            let ring = &faces[*face];
            let at = ring.iter().position(|&peak| peak == to);
            at.is_some_and(|at| ring[(at + 1) % ring.len()] == from)
        };
        self.around[to].iter().copied().find(runs)
    }

    /// Removes a spike from a face if the map stays valid; returns true on success.
    fn closes(
        &mut self,
        face: usize,
        [a, tip, b]: [usize; 3],
        peaks: &[Peak],
        faces: &mut [Vec<usize>],
    ) -> bool {
        let [Some(left), Some(right)] = [[a, tip], [tip, b]].map(|border| self.face_across(border, faces))
        else {
            return false;
        };
        if self.neighbours(a, faces).contains(&b) {
            return false;
        }
        let far = |peak: usize| way(peaks, [tip, peak]).length_squared();
        // The nearer end lies on the border to the other end, and becomes a corner of the face beyond that
        // border.
        let (beyond, middle, end) = if far(a) < far(b) { (right, a, b) } else { (left, b, a) };
        if left == right {
            // Only the two faces touch the tip.
            if self.around[tip].len() != 2 || faces[left].len() <= 3 {
                return false;
            }
            faces[left].retain(|&peak| peak != tip);
            self.around[tip].clear();
        } else if faces[beyond].contains(&middle) {
            return false;
        } else {
            let ring = &mut faces[beyond];
            let [one, two] = [tip, end].map(|end| ring.iter().position(|&peak| peak == end).unwrap_or(0));
            // The border may run from the last corner to the first.
            let at = if one.abs_diff(two) == 1 { one.max(two) } else { ring.len() };
            ring.insert(at, middle);
            self.around[middle].push(beyond);
            self.around[tip].retain(|around| *around != face);
        }
        faces[face].retain(|&peak| peak != tip);
        true
    }
}
