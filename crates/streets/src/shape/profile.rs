//! Heights of streets: junctions are level, and segments between them are level across.

use glam::DVec2;
use smallvec::SmallVec;

use crate::plan::network::{JunctionId, PieceId, StreetNetwork};

/// Heights of the streets of a network; all 0 in a flat network.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StreetProfiles {
    /// Heights (m) by junction.
    pub(crate) junctions: Vec<f64>,
    /// Positions along each segment (m) from its first junction, with heights (m).
    pub(crate) pieces: Vec<PieceProfile>,
}

pub(crate) type PieceProfile = SmallVec<[[f64; 2]; 2]>;

impl StreetProfiles {
    /// Returns true if all streets are at height 0.
    pub fn is_flat(&self) -> bool {
        self.junctions.iter().all(|height| *height == 0.0)
            && self.pieces.iter().flatten().all(|[_, height]| *height == 0.0)
    }

    /// Returns the height (m) of a junction.
    pub fn junction(&self, junction: JunctionId) -> f64 {
        self.junctions.get(junction as usize).copied().unwrap_or(0.0)
    }

    /// Returns the height (m) of a segment at a distance (m) along it.
    pub fn height_along(&self, piece: PieceId, at: f64) -> f64 {
        let stations = self.stations(piece);
        let after = stations.partition_point(|[along, _]| *along <= at);
        match (after.checked_sub(1).and_then(|before| stations.get(before)), stations.get(after)) {
            (Some([from, low]), Some([to, high])) => low + (high - low) * (at - from) / (to - from),
            (Some([_, height]), None) | (None, Some([_, height])) => *height,
            (None, None) => 0.0,
        }
    }

    /// Returns the positions (m) along a segment at which its slope changes, with the heights (m) there.
    pub fn stations(&self, piece: PieceId) -> &[[f64; 2]] {
        self.pieces.get(piece as usize).map_or(&[], |profile| profile)
    }

    /// Returns the segment's height (m) at its point nearest to `place` (m).
    pub fn height_near(&self, network: &StreetNetwork, piece: PieceId, place: DVec2) -> f64 {
        let [a, b] = network.line(piece);
        self.height_along(piece, (place - a).dot((b - a).normalize_or_zero()))
    }
}
