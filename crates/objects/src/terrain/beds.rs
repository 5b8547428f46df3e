//! A spatial index of river beds, in which nothing grows.

use glam::DVec2;
use rstar::primitives::{GeomWithData, Line};
use rstar::{PointDistance, RTree};

use super::river::River;

/// The segments of rivers, each with half of its river's width (m).
#[derive(Default)]
pub(super) struct RiverBeds {
    segments: RTree<GeomWithData<Line<[f64; 2]>, f64>>,
    /// Half of the width (m) of the widest river.
    widest: f64,
}

impl RiverBeds {
    /// Indexes the beds of `rivers`.
    pub(super) fn new(rivers: &[River]) -> Self {
        let segments = rivers.iter().flat_map(|river| {
            river.way.windows(2).map(|pair| {
                let [from, to] = [pair[0], pair[1]].map(|at| at.truncate().to_array());
                GeomWithData::new(Line::new(from, to), river.width / 2.0)
            })
        });
        let widest = rivers.iter().map(|river| river.width / 2.0).fold(0.0, f64::max);
        Self { segments: RTree::bulk_load(segments.collect()), widest }
    }

    /// Returns true if the position (m) is in a bed.
    pub(super) fn contain(&self, place: DVec2) -> bool {
        let place = place.to_array();
        self.segments
            .locate_within_distance(place, self.widest * self.widest)
            .any(|segment| segment.distance_2(&place) <= segment.data * segment.data)
    }
}
