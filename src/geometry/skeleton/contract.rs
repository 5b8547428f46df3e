//! Short borders of faces shrunk to points, as long as the faces stay a map of the plane.

use smallvec::SmallVec;

use super::Peak;
use super::wavefront::Arc;

/// Borders no longer than this (m), on the plan and in time, are short.
const SHORT: f64 = 1e-3;

/// Shrinks short borders, the shortest first.
///
/// Two peaks become one only where the border between them is all that the faces around them share: no face loses
/// its edge or touches itself, and no two faces get a second border. The first `fixed` peaks stay where they are.
pub(super) fn contract(peaks: &[Peak], arcs: &[Arc], fixed: usize, faces: &mut [Vec<usize>]) {
    let length = |[a, b]: [usize; 2]| {
        let [a, b] = [a, b].map(|peak| peaks[peak]);
        a.at.distance(b.at).max((a.time - b.time).abs())
    };
    let mut short: Vec<(f64, [usize; 2])> = arcs
        .iter()
        .filter(|arc| arc.edges[0] != arc.edges[1])
        .map(|arc| (length(arc.ends), arc.ends))
        .filter(|(length, _)| *length <= SHORT)
        .collect();
    if short.is_empty() {
        return;
    }
    short.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut map = Map::new(peaks.len(), faces);
    // What could not shrink may be able to once others have.
    loop {
        let before = short.len();
        short.retain(|&(_, ends)| {
            let [a, b] = ends.map(|peak| map.leader(peak));
            let [kept, gone] = [a.min(b), a.max(b)];
            kept != gone && !(gone >= fixed && length([kept, gone]) <= SHORT && map.shrinks(kept, gone, faces))
        });
        if short.len() == before {
            return;
        }
    }
}

/// The faces around each peak, and which peak stands for it.
struct Map {
    leaders: Vec<usize>,
    around: Vec<SmallVec<[usize; 6]>>,
}

impl Map {
    fn new(count: usize, faces: &[Vec<usize>]) -> Self {
        let mut around = vec![SmallVec::new(); count];
        for (number, face) in faces.iter().enumerate() {
            face.iter().for_each(|&peak| around[peak].push(number));
        }
        Self { leaders: (0..count).collect(), around }
    }

    fn leader(&self, mut peak: usize) -> usize {
        while self.leaders[peak] != peak {
            peak = self.leaders[peak];
        }
        peak
    }

    /// Lets `kept` stand for `gone`, if that is sound; whether it is.
    fn shrinks(&mut self, kept: usize, gone: usize, faces: &mut [Vec<usize>]) -> bool {
        let beside = |face: &[usize], peak: usize| -> SmallVec<[usize; 2]> {
            let at = face.iter().position(|&other| other == peak);
            let count = face.len();
            at.map(|at| SmallVec::from_slice(&[face[(at + 1) % count], face[(at + count - 1) % count]]))
                .unwrap_or_default()
        };
        let shared: SmallVec<[usize; 4]> =
            self.around[gone].iter().copied().filter(|face| self.around[kept].contains(face)).collect();
        let apart = shared.iter().any(|&face| {
            let ring = &faces[face];
            ring.len() <= 3 || !beside(ring, gone).contains(&kept)
        });
        if apart || shared.len() != 2 || shared[0] == shared[1] {
            return false;
        }
        let neighbours = |peak: usize| -> SmallVec<[usize; 8]> {
            self.around[peak].iter().flat_map(|&face| beside(&faces[face], peak)).collect()
        };
        let others = neighbours(kept);
        if neighbours(gone).iter().any(|peak| others.contains(peak)) {
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
        self.leaders[gone] = kept;
        true
    }
}
