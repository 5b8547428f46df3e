//! One subdivision of all borders of a roof's faces, so that none is thinner than meshes can show.

use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};
use smallvec::SmallVec;

use super::patches::ON_LEVEL;
use crate::planar::edges;

/// Corners nearer than this (m) to a border are on it, and those as near to each other are one.
const NEAR: f64 = 2.5e-4;
/// How often borders are divided at most.
const ROUNDS: usize = 16;

/// A part of a face.
#[derive(Debug, Clone)]
pub(super) struct FacePiece {
    /// The edge of the outline that it belongs to.
    pub edge: usize,
    /// The number of the interval of the profile that it is in.
    pub number: usize,
    /// Its corners, counter-clockwise.
    pub ring: Vec<usize>,
    /// Whether others draw what lies here, so that its borders stay as they are.
    pub is_fixed: bool,
}

/// The ends of a border, the lesser one first.
type BorderEnds = [usize; 2];

fn border([a, b]: [usize; 2]) -> BorderEnds {
    [a.min(b), a.max(b)]
}

/// Corners that are to be one, and for each border those that all but touch it, in their order from its lesser end.
#[derive(Default)]
struct Touches {
    same: Vec<[usize; 2]>,
    between: FxHashMap<BorderEnds, SmallVec<[(f64, usize); 2]>>,
}

/// The corners of all pieces, and what is known of them.
pub(super) struct PieceCorners<'a> {
    /// Their places (m), with the distances from the outline as heights.
    pub points: &'a [DVec3],
    /// How many of them, the first, are those of the outline.
    pub outline: usize,
    /// From here on they are where borders pass a level.
    pub passes: usize,
    /// The levels.
    pub levels: &'a [f64],
}

impl PieceCorners<'_> {
    /// Makes corners that all but touch each other one, and gives each border those that all but touch it, in the pieces
    /// on both of its sides alike. A piece that touches itself there falls into several, and one that is all border
    /// into none.
    ///
    /// What is on a level stays there, and so do the outline and the borders of fixed pieces.
    pub(super) fn subdivide(&self, mut pieces: Vec<FacePiece>) -> Vec<FacePiece> {
        for _ in 0..ROUNDS {
            let Touches { same, between } = self.touches(&pieces);
            let done = if same.is_empty() { between.is_empty() } else { !self.merge(&mut pieces, &same) };
            if done {
                break;
            }
            pieces = if same.is_empty() {
                divided(&pieces, &between)
            } else {
                divided(&pieces, &FxHashMap::default())
            };
        }
        pieces
    }

    fn touches(&self, pieces: &[FacePiece]) -> Touches {
        let mut found = Touches::default();
        for piece in pieces.iter().filter(|piece| !piece.is_fixed) {
            for [a, b] in edges(&piece.ring).map(border) {
                let (from, way) = (self.points[a], self.points[b] - self.points[a]);
                let square = way.length_squared();
                let is_level = way.z == 0.0 && self.levels.contains(&from.z);
                // Along a level what is as near to another corner as peaks are to it is one with it.
                let is_short = a >= self.passes && is_level && square < ON_LEVEL * ON_LEVEL;
                if square < NEAR * NEAR || is_short {
                    found.same.push([a, b]);
                    continue;
                }
                for &corner in &piece.ring {
                    let off = self.points[corner] - from;
                    let along = (off.dot(way) / square).clamp(0.0, 1.0);
                    if corner == a || corner == b || off.distance_squared(way * along) >= NEAR * NEAR {
                        continue;
                    }
                    if along == 0.0 || along == 1.0 {
                        found.same.push(border([corner, if along == 0.0 { a } else { b }]));
                    } else if !is_level || off.z == 0.0 {
                        let known = found.between.entry([a, b]).or_default();
                        if known.iter().all(|(_, known)| *known != corner) {
                            let rank = known.partition_point(|known| known.0 < along);
                            known.insert(rank, (along, corner));
                        }
                    }
                }
            }
        }
        found.same.retain(|&[a, b]| b >= self.outline && a != b);
        if !found.between.is_empty() {
            // Along both sides of a border there has to be one piece that may be divided.
            let mut sides: FxHashMap<BorderEnds, [usize; 2]> = FxHashMap::default();
            for piece in pieces {
                for ends in edges(&piece.ring) {
                    if found.between.contains_key(&border(ends)) {
                        let side = usize::from(ends[0] > ends[1]);
                        sides.entry(border(ends)).or_default()[side] += if piece.is_fixed { 2 } else { 1 };
                    }
                }
            }
            found.between.retain(|border, _| sides.get(border) == Some(&[1, 1]));
        }
        found
    }

    /// Lets one corner of each pair stand for both; whether any does.
    fn merge(&self, pieces: &mut [FacePiece], pairs: &[[usize; 2]]) -> bool {
        let fixed: FxHashSet<usize> = pieces
            .iter()
            .filter(|piece| piece.is_fixed)
            .flat_map(|piece| piece.ring.iter().copied())
            .collect();
        let is_level = |corner: usize| self.levels.contains(&self.points[corner].z);
        // The higher it is, the rather a corner stays.
        let rank = |corner: usize| (corner < self.outline, fixed.contains(&corner), is_level(corner));
        let mut same: FxHashMap<usize, usize> = FxHashMap::default();
        let stands_for = |same: &FxHashMap<usize, usize>, mut corner: usize| {
            while let Some(&other) = same.get(&corner) {
                corner = other;
            }
            corner
        };
        for pair in pairs {
            let [a, b] = pair.map(|corner| stands_for(&same, corner));
            let [kept, gone] = if rank(b) > rank(a) { [b, a] } else { [a, b] };
            let [to, from] = [kept, gone].map(|corner| self.points[corner]);
            let stays = gone < self.outline || fixed.contains(&gone) || (is_level(gone) && to.z != from.z);
            if a != b && !stays && to.distance_squared(from) < ON_LEVEL * ON_LEVEL {
                same.insert(gone, kept);
            }
        }
        for piece in pieces.iter_mut() {
            piece.ring.iter_mut().for_each(|corner| *corner = stands_for(&same, *corner));
            piece.ring.dedup();
            while piece.ring.len() > 1 && piece.ring.first() == piece.ring.last() {
                piece.ring.pop();
            }
        }
        !same.is_empty()
    }
}

/// The simple pieces that pieces fall into, with more corners `between` those of some borders.
fn divided(
    pieces: &[FacePiece],
    between: &FxHashMap<BorderEnds, SmallVec<[(f64, usize); 2]>>,
) -> Vec<FacePiece> {
    let parts = |piece: &FacePiece| {
        let mut ring = Vec::with_capacity(piece.ring.len() + 2);
        for ends in edges(&piece.ring) {
            ring.push(ends[0]);
            let more = between.get(&border(ends)).into_iter().flatten().map(|&(_, corner)| corner);
            if ends[0] < ends[1] {
                ring.extend(more);
            } else {
                ring.extend(more.rev());
            }
        }
        let piece = FacePiece { ring: Vec::new(), ..*piece };
        simple(&ring).into_iter().map(move |ring| FacePiece { ring, ..piece })
    };
    pieces.iter().flat_map(parts).collect()
}

/// The rings without repeated corners that a ring falls into; the one with its first corners is the first.
fn simple(ring: &[usize]) -> SmallVec<[Vec<usize>; 2]> {
    let mut left: Vec<usize> = Vec::with_capacity(ring.len());
    let mut parts = SmallVec::new();
    for &corner in ring {
        if let Some(at) = left.iter().position(|&other| other == corner) {
            if left.len() > at + 2 {
                parts.push(left[at..].to_vec());
            }
            left.truncate(at);
        }
        left.push(corner);
    }
    if left.len() > 2 {
        parts.insert(0, left);
    }
    parts
}
