//! Length of each segment that is free of other streets, for markings and objects along it.

use std::sync::Arc;

use glam::DVec2;

use crate::plan::grid::foot;
use crate::plan::merge_cache::ClearLengths;
use crate::plan::network::{PieceId, StreetNetwork};
use burgeon_base::locks::LockRecovery;

/// Sampling distance (m) along a segment.
const STEP: f64 = 1.0;

impl StreetNetwork {
    /// Returns the distance (m) from both ends within which each segment overlaps other streets.
    pub(crate) fn clear_lengths(&self) -> ClearLengths {
        let mut known = self.merge_cache.clear.lock().recover();
        let (_, lengths) = match &mut *known {
            Some(present) if present.0 == self.version() => present,
            other => other.insert((self.version(), clear_lengths(self).into())),
        };
        Arc::clone(lengths)
    }
}

/// Returns the distance (m) from the first and from the last junction within which other streets of the same level
/// overlap each segment. The two distances add up to the segment's length if no part is free.
fn clear_lengths(network: &StreetNetwork) -> Vec<[f64; 2]> {
    let mut lengths = vec![[0.0; 2]; network.pieces.len()];
    let streets = street_numbers(network);
    for (piece, _) in network.pieces() {
        lengths[piece as usize] = clear_length(network, piece, &streets);
    }
    lengths
}

/// Returns the street number of each segment; a street ends at a junction where it does not continue.
fn street_numbers(network: &StreetNetwork) -> Vec<u32> {
    let mut numbers = vec![u32::MAX; network.pieces.len()];
    for (number, way) in (0..).zip(network.ways_between(|junction| !network.goes_on(junction))) {
        way.iter().for_each(|course| numbers[course.piece as usize] = number);
    }
    numbers
}

fn clear_length(network: &StreetNetwork, piece: PieceId, streets: &[u32]) -> [f64; 2] {
    let (line, length) = (network.line(piece), network.length(piece));
    let level = network.attributes(piece).level;
    let way = (line[1] - line[0]).normalize_or_zero();
    let half = network.half(piece);
    let others: Vec<([DVec2; 2], f64)> = network
        .pieces_near(line, half + network.widest() / 2.0)
        .filter(|other| *other != piece && network.attributes(*other).level == level)
        .filter(|other| streets[*other as usize] != streets[piece as usize])
        .map(|other| (network.line(other), network.half(other)))
        .collect();
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "pieces are short")]
    let count = (length / STEP).ceil().max(1.0) as usize;
    #[allow(clippy::cast_precision_loss, reason = "pieces are short")]
    let along = |index: usize| length * index as f64 / count as f64;
    let is_free = |index: &usize| {
        let at = line[0] + way * along(*index);
        let asides = [-half, -half / 2.0, 0.0, half / 2.0, half].map(|aside| at + way.perp() * aside);
        others.iter().all(|(other, reach)| asides.iter().all(|place| foot(*place, *other).0 >= *reach))
    };
    // The longest stretch of free samples.
    let (mut best, mut begin) = ([0, 0], None);
    for index in 0..=count + 1 {
        if index <= count && is_free(&index) {
            begin.get_or_insert(index);
        } else if let Some(first) = begin.take()
            && index - 1 - first > best[1] - best[0]
        {
            best = [first, index - 1];
        }
    }
    if best[0] == best[1] { [length / 2.0; 2] } else { [along(best[0]), length - along(best[1])] }
}
