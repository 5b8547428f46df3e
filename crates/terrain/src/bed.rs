//! What something that lies on the ground asks of it: to be level with its bed, and beside it no steeper than earth stays.

use burgeon_geometry::planar::contains;
use glam::DVec2;
use serde::{Deserialize, Serialize};

use super::edits::{mix, to_line};

/// The bed of a street, or of something else that is narrow or flat.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GroundBed {
    /// Its middle (m), with heights; of an area its outline.
    pub line: Vec<[f64; 3]>,
    /// How wide (m) it is; an area reaches half of that beyond its outline.
    pub width: f64,
    /// Whether the line is the outline of an area.
    pub is_area: bool,
    /// How steep (m/m) the ground beside it is at most.
    pub slope: f64,
    /// Up to which distance (m) beside it the ground changes.
    pub margin: f64,
}

impl GroundBed {
    pub(super) fn reach(&self) -> f64 {
        self.width / 2.0 + self.margin
    }

    /// The distance (m) of a place from it, and its height (m) where it is nearest; `None` farther than its margin.
    pub(super) fn beside(&self, place: DVec2) -> Option<(f64, f64)> {
        let flat: Vec<[f64; 2]> = self.line.iter().map(|[x, y, _]| [*x, *y]).collect();
        let (mut distance, piece, along) = to_line(&flat, place, self.is_area);
        let next = self.line.get((piece + 1) % self.line.len().max(1));
        let height = match (self.line.get(piece), next) {
            (Some(from), Some(to)) => mix(from[2], to[2], along),
            _ => return None,
        };
        if self.is_area && contains(&flat, place) {
            distance = 0.0;
        }
        let beyond = (distance - self.width / 2.0).max(0.0);
        (beyond <= self.margin).then_some((beyond, height))
    }
}
