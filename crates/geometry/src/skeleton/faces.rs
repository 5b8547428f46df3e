//! The faces of a skeleton: put together from their borders, and verified.

use glam::{DVec2, I64Vec2};
use smallvec::SmallVec;

use super::coarse::{coarsen, widen};
use super::edge::{SkeletonEdge, metres};
use super::wavefront::WavefrontTrace;
use super::{Peak, Skeleton};
use crate::planar::twice_area;
use burgeon_base::error::{Error, Result};

/// How far (m) borders may be off each other.
const MERGED: f64 = 1e-3;
/// How far (m) a corner may be off the plane of its face.
const OFF_PLANE: f64 = 5e-3;

/// The directed borders of a face: the two peaks of each.
type Borders = SmallVec<[[usize; 2]; 8]>;

/// Puts the faces together; fails if they are not those of a roof over `rings`.
pub(super) fn assemble(rings: &[Vec<I64Vec2>], traced: WavefrontTrace) -> Result<Skeleton> {
    let WavefrontTrace { edges, mut peaks, arcs } = traced;
    let mut borders: Vec<Borders> = Vec::with_capacity(edges.len());
    let mut first = 0;
    for ring in rings {
        let next = |index: usize| first + (index + 1) % ring.len();
        borders.extend((0..ring.len()).map(|index| Borders::from_iter([[first + index, next(index)]])));
        first += ring.len();
    }
    for arc in &arcs {
        let [from, to] = arc.ends;
        if arc.edges[0] != arc.edges[1] {
            borders[arc.edges[0]].push([from, to]);
            borders[arc.edges[1]].push([to, from]);
        }
    }
    let mut faces: Vec<Vec<usize>> = borders.into_iter().map(chain).collect::<Result<_>>()?;
    coarsen(&peaks, edges.len(), &edges, &mut faces);
    widen(&mut peaks, edges.len(), &edges, &faces);
    verify(rings, &edges, &peaks, &faces)?;
    let paces = edges.iter().map(|edge| edge.pace).collect();
    Ok(Skeleton { peaks, faces, paces })
}

/// The closed ring that directed borders form, beginning with the first of them.
fn chain(mut borders: Borders) -> Result<Vec<usize>> {
    // What runs both ways bounds nothing.
    let mut index = 1;
    while index < borders.len() {
        let [from, to] = borders[index];
        match borders[index + 1..].iter().position(|&border| border == [to, from]) {
            Some(back) => {
                borders.remove(index + 1 + back);
                borders.remove(index);
            }
            None => index += 1,
        }
    }
    let [first, mut at] = borders[0];
    let mut ring = Vec::with_capacity(borders.len());
    ring.push(first);
    let mut left = borders.len() - 1;
    borders.swap(0, left);
    while at != first {
        ring.push(at);
        let Some(next) = borders[..left].iter().position(|border| border[0] == at) else {
            return Err(Error::geometry("a face of the roof is not closed"));
        };
        at = borders[next][1];
        left -= 1;
        borders.swap(next, left);
    }
    if left > 0 {
        return Err(Error::geometry("a face of the roof is in several pieces"));
    }
    Ok(ring)
}

/// Fails unless `faces` cover the polygon once, each in the plane of its edge.
///
/// Where all edges move alike, faces are monotone along their edges; otherwise they need not be (T. Biedl et al., "Weighted
/// straight skeletons in the plane", 2015), and must not cross themselves.
fn verify(
    rings: &[Vec<I64Vec2>],
    edges: &[SkeletonEdge],
    peaks: &[Peak],
    faces: &[Vec<usize>],
) -> Result<()> {
    let whole: f64 = rings.iter().map(|ring| twice_area(ring.iter().map(|&at| metres(at)))).sum();
    let even = edges.windows(2).all(|pair| pair[0].pace == pair[1].pace);
    let mut sum = 0.0;
    for (edge, face) in edges.iter().zip(faces) {
        if face.len() < 3 {
            return Err(Error::geometry("a face of the roof has no corners but its edge's"));
        }
        if face.iter().any(|&peak| edge.ahead(peaks[peak].at, peaks[peak].time).abs() > OFF_PLANE) {
            return Err(Error::geometry("a face of the roof is not flat"));
        }
        let area = twice_area(face.iter().map(|&peak| peaks[peak].at));
        // What stands upright may be off its plane by as much as borders are short.
        let along = face.iter().map(|&peak| peaks[peak].at.dot(edge.along));
        let (low, high) =
            along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
        if area < -MERGED * (high - low) || (edge.pace.moves() && area <= 0.0) {
            return Err(Error::geometry("a face of the roof is turned over"));
        }
        sum += area;
        let monotone = |within| monotone(edge, peaks, face, within * MERGED);
        // Peaks may stand for others that are 2 mm away, at both ends of a border.
        if !monotone(2.0) && (even && !monotone(4.0) || crosses_itself(edge, peaks, face)) {
            return Err(Error::geometry("a face of the roof overlaps itself"));
        }
    }
    if (sum - whole).abs() > 1e-6 * whole {
        return Err(Error::geometry("the faces of the roof do not cover the plan"));
    }
    Ok(())
}

/// Whether the ring goes once there and once back along its edge, but for steps `within` a length (m).
fn monotone(edge: &SkeletonEdge, peaks: &[Peak], face: &[usize], within: f64) -> bool {
    let along = |index: usize| peaks[face[index % face.len()]].at.dot(edge.along);
    let mut last = 0.0f64;
    let mut first = 0.0f64;
    let mut turns = 0;
    for index in 0..face.len() {
        let step = along(index + 1) - along(index);
        if step.abs() > within {
            if first == 0.0 {
                first = step;
            }
            turns += usize::from(last * step < 0.0);
            last = step;
        }
    }
    turns + usize::from(last * first < 0.0) <= 2
}

/// Whether two borders cross, in the plane of the face.
fn crosses_itself(edge: &SkeletonEdge, peaks: &[Peak], face: &[usize]) -> bool {
    let flat = |&peak: &usize| DVec2::new(peaks[peak].at.dot(edge.along), peaks[peak].time);
    let ring: SmallVec<[DVec2; 32]> = face.iter().map(flat).collect();
    let border = |index: usize| [ring[index], ring[(index + 1) % ring.len()]];
    // Whether the ends of one lie on different sides of the other.
    let parted = |[a, b]: [DVec2; 2], ends: [DVec2; 2]| {
        let way = (b - a).normalize_or_zero();
        let [from, to] = ends.map(|end| way.perp_dot(end - a));
        from.min(to) < -MERGED && from.max(to) > MERGED
    };
    let mut pairs = (0..ring.len()).flat_map(|a| (a + 2..ring.len()).map(move |b| [a, b]));
    pairs.any(|pair| {
        let [a, b] = pair.map(border);
        parted(a, b) && parted(b, a)
    })
}
