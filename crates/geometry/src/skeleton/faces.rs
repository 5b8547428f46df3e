//! Assembly and verification of the faces of a skeleton.

use glam::{DVec2, I64Vec2};
use smallvec::SmallVec;

use super::coarse::{coarsen, widen};
use super::edge::{SkeletonEdge, metres};
use super::skeleton::{Peak, Skeleton};
use super::wavefront::{Arc, WavefrontTrace};
use crate::planar::twice_area;
use burgeon_base::error::{Error, Result};

/// Tolerance (m) for the borders of faces.
const MERGED: f64 = 1e-3;
/// Maximum distance (m) of a corner from the plane of its face.
const OFF_PLANE: f64 = 5e-3;

/// Reusable lists for the assembly and verification of faces.
#[derive(Debug, Default)]
pub(super) struct FaceLists {
    /// End index of each face's borders in `borders`.
    ends: Vec<usize>,
    borders: Vec<[usize; 2]>,
    /// A face of each peak, and the next peak of that face.
    next: Vec<[usize; 2]>,
    /// Position (m) of each corner of a face along its edge.
    along: Vec<f64>,
}

impl FaceLists {
    /// Assembles the faces; fails if they do not form a valid roof over `rings`.
    pub(super) fn assemble(
        &mut self,
        rings: &[Vec<I64Vec2>],
        traced: &mut WavefrontTrace,
    ) -> Result<Skeleton> {
        let WavefrontTrace { edges, peaks, arcs } = traced;
        self.next.clear();
        self.next.resize(peaks.len(), [usize::MAX; 2]);
        let mut faces = self.chains(rings, arcs)?;
        coarsen(peaks, edges.len(), edges, &mut faces);
        widen(peaks, edges.len(), edges, &faces);
        verify(rings, edges, peaks, &faces, &mut self.along)?;
        let paces = edges.iter().map(|edge| edge.pace).collect();
        Ok(Skeleton { peaks: peaks.clone(), faces, paces })
    }

    /// Assembles the faces' rings from the edges and the borders between them.
    fn chains(&mut self, rings: &[Vec<I64Vec2>], arcs: &[Arc]) -> Result<Vec<Vec<usize>>> {
        let arcs = || arcs.iter().filter(|arc| arc.edges[0] != arc.edges[1]);
        let count = rings.iter().map(Vec::len).sum::<usize>();
        let Self { ends, borders, next, .. } = self;
        // One border of each face is the edge itself.
        ends.clear();
        ends.resize(count + 1, 1);
        ends[0] = 0;
        for &Arc { edges: [before, after], .. } in arcs() {
            ends[before + 1] += 1;
            ends[after + 1] += 1;
        }
        let mut before = 0;
        for end in &mut *ends {
            before += *end;
            *end = before;
        }
        borders.resize(before, [0; 2]);
        // Used as insertion indices here: each begins at the start of its face and advances to the end.
        let mut add = |edge: usize, border: [usize; 2]| {
            borders[ends[edge]] = border;
            ends[edge] += 1;
        };
        let mut first = 0;
        for ring in rings {
            (0..ring.len())
                .for_each(|index| add(first + index, [first + index, first + (index + 1) % ring.len()]));
            first += ring.len();
        }
        for &Arc { edges: [before, after], ends: [from, to] } in arcs() {
            add(before, [from, to]);
            add(after, [to, from]);
        }
        let mut faces = Vec::with_capacity(count);
        let mut begin = 0;
        for (face, &end) in ends[..count].iter().enumerate() {
            let own = &mut borders[begin..end];
            faces.push(match simple_chain(own, face, next) {
                Some(ring) => ring,
                None => chain(own)?,
            });
            begin = end;
        }
        Ok(faces)
    }
}

/// Assembles the result of [`chain`] directly, if no two of the borders begin at one peak.
fn simple_chain(borders: &[[usize; 2]], face: usize, next: &mut [[usize; 2]]) -> Option<Vec<usize>> {
    for &[from, to] in borders {
        next[from] = [face, to];
    }
    let [first, mut at] = borders[0];
    let mut ring = Vec::with_capacity(borders.len());
    ring.push(first);
    while at != first && ring.len() < borders.len() && next[at][0] == face {
        ring.push(at);
        at = next[at][1];
    }
    (at == first && ring.len() == borders.len()).then_some(ring)
}

/// Assembles directed borders to a closed ring that begins with the first border.
fn chain(borders: &mut [[usize; 2]]) -> Result<Vec<usize>> {
    // Pairs of opposite borders bound nothing.
    let (mut index, mut count) = (1, borders.len());
    while index < count {
        let [from, to] = borders[index];
        match borders[index + 1..count].iter().position(|&border| border == [to, from]) {
            Some(back) => {
                borders.copy_within(index + 2 + back..count, index + 1 + back);
                borders.copy_within(index + 1..count - 1, index);
                count -= 2;
            }
            None => index += 1,
        }
    }
    let borders = &mut borders[..count];
    let [first, mut at] = borders[0];
    let mut ring = Vec::with_capacity(borders.len());
    ring.push(first);
    let mut left = borders.len() - 1;
    borders.swap(0, left);
    while at != first {
        ring.push(at);
        let Some(next) = borders[..left].iter().position(|border| border[0] == at) else {
            return Err(Error::geometry("roof face is not closed"));
        };
        at = borders[next][1];
        left -= 1;
        borders.swap(next, left);
    }
    if left > 0 {
        return Err(Error::geometry("roof face is in several pieces"));
    }
    Ok(ring)
}

/// Fails unless `faces` cover the polygon once, each in the plane of its edge.
///
/// If all edges have the same pace, faces are monotone along their edges. Otherwise they may be non-monotone
/// (T. Biedl et al., "Weighted straight skeletons in the plane", 2015), but must not cross themselves.
fn verify(
    rings: &[Vec<I64Vec2>],
    edges: &[SkeletonEdge],
    peaks: &[Peak],
    faces: &[Vec<usize>],
    along: &mut Vec<f64>,
) -> Result<()> {
    let whole: f64 = rings.iter().map(|ring| twice_area(ring.iter().map(|&at| metres(at)))).sum();
    let is_even = || edges.windows(2).all(|pair| pair[0].pace == pair[1].pace);
    let mut sum = 0.0;
    for (edge, face) in edges.iter().zip(faces) {
        if face.len() < 3 {
            return Err(Error::geometry("roof face has only the corners of its edge"));
        }
        let corners = || face.iter().map(|&peak| &peaks[peak]);
        if corners().any(|peak| edge.distance_ahead(peak.at, peak.time).abs() > OFF_PLANE) {
            return Err(Error::geometry("roof face is not flat"));
        }
        let area = twice_area(corners().map(|peak| peak.at));
        along.clear();
        along.extend(corners().map(|peak| peak.at.dot(edge.along)));
        if area <= 0.0 {
            // Upright faces may be off their plane by as much as short borders are long.
            let length = along.iter().copied().fold(f64::NEG_INFINITY, f64::max)
                - along.iter().copied().fold(f64::INFINITY, f64::min);
            if area < -MERGED * length || edge.pace.moves() {
                return Err(Error::geometry("roof face is turned over"));
            }
        }
        sum += area;
        let monotone = |within| is_monotone(along, within * MERGED);
        // Peaks may replace others that are 2 mm away, at both ends of a border.
        if !monotone(2.0) && (is_even() && !monotone(4.0) || crosses_itself(edge, peaks, face)) {
            return Err(Error::geometry("roof face self-intersects"));
        }
    }
    if (sum - whole).abs() > 1e-6 * whole {
        return Err(Error::geometry("roof faces do not cover the plan"));
    }
    Ok(())
}

/// Returns true if a ring of positions (m) along its edge runs once there and once back, except for steps
/// `within` a length (m).
fn is_monotone(along: &[f64], within: f64) -> bool {
    let (mut first, mut last) = (0.0f64, 0.0f64);
    let mut turns = 0;
    let mut at = along[along.len() - 1];
    for &next in along {
        let step = next - std::mem::replace(&mut at, next);
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

/// Returns true if two borders cross in the plane of the face.
fn crosses_itself(edge: &SkeletonEdge, peaks: &[Peak], face: &[usize]) -> bool {
    let flat = |&peak: &usize| DVec2::new(peaks[peak].at.dot(edge.along), peaks[peak].time);
    let ring: SmallVec<[DVec2; 32]> = face.iter().map(flat).collect();
    let border = |index: usize| [ring[index], ring[(index + 1) % ring.len()]];
    // Returns true if the ends of one border lie on different sides of the other.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ring_is_found_at_once_only_where_it_is_the_one_that_a_search_finds() {
        let mut next = vec![[usize::MAX; 2]; 5];
        let mut both = |face: usize, mut borders: Vec<[usize; 2]>| {
            (simple_chain(&borders, face, &mut next), chain(&mut borders).ok())
        };
        let ring = Some(vec![0, 1, 3, 4]);
        assert_eq!(both(0, vec![[0, 1], [4, 0], [1, 3], [3, 4]]), (ring.clone(), ring));
        // A pair of opposite borders, a peak that is passed twice, two rings, and an open ring.
        assert_eq!(both(1, vec![[0, 1], [1, 2], [3, 4], [2, 0], [4, 3]]), (None, Some(vec![0, 1, 2])));
        assert_eq!(both(2, vec![[0, 1], [1, 2], [2, 3], [3, 1], [1, 4], [4, 0]]).0, None);
        assert_eq!(both(3, vec![[0, 1], [1, 0], [2, 3], [3, 4], [4, 2]]), (None, None));
        assert_eq!(both(4, vec![[0, 1], [1, 2], [2, 3]]), (None, None));
    }
}
