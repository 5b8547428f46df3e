//! How high streets lie: junctions are level, and pieces lead from one to the other, level across.

use glam::DVec2;
use smallvec::SmallVec;

use crate::network::{JunctionId, PieceId, StreetNetwork};

/// Heights of the streets of a network; all of them are 0 in a flat one.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StreetProfiles {
    /// By junction (m).
    pub(crate) junctions: Vec<f64>,
    /// By piece: places along its way (m) from its first junction, with their heights (m).
    pub(crate) pieces: Vec<PieceProfile>,
}

pub(crate) type PieceProfile = SmallVec<[[f64; 2]; 2]>;

impl StreetProfiles {
    /// Tells if all streets are at height 0.
    pub fn is_flat(&self) -> bool {
        self.junctions.iter().all(|height| *height == 0.0)
            && self.pieces.iter().flatten().all(|[_, height]| *height == 0.0)
    }

    /// The height (m) of a junction.
    pub fn junction(&self, junction: JunctionId) -> f64 {
        self.junctions.get(junction as usize).copied().unwrap_or(0.0)
    }

    /// The height (m) of a piece so far (m) along its way.
    pub fn along(&self, piece: PieceId, at: f64) -> f64 {
        let stations = self.stations(piece);
        let after = stations.partition_point(|[along, _]| *along <= at);
        match (after.checked_sub(1).and_then(|before| stations.get(before)), stations.get(after)) {
            (Some([from, low]), Some([to, high])) => low + (high - low) * (at - from) / (to - from),
            (Some([_, height]), None) | (None, Some([_, height])) => *height,
            (None, None) => 0.0,
        }
    }

    /// Where along its way (m) the slope of a piece changes, with the heights there (m).
    pub fn stations(&self, piece: PieceId) -> &[[f64; 2]] {
        self.pieces.get(piece as usize).map_or(&[], |profile| profile)
    }

    /// The height (m) of a piece at the nearest of its places to `place` (m).
    pub fn near(&self, network: &StreetNetwork, piece: PieceId, place: DVec2) -> f64 {
        let [a, b] = network.line(piece);
        self.along(piece, (place - a).dot((b - a).normalize_or_zero()))
    }
}
