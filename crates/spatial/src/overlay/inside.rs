//! Whether places lie inside of areas, without asking all of their edges.

use geo::{Kernel, MultiPolygon, Orientation, kernels::RobustKernel};
use rstar::{AABB, RTree, RTreeObject};

/// The edges of areas.
pub(super) struct Inside(RTree<UpEdge>);

struct UpEdge([geo::Coord; 2]);

impl RTreeObject for UpEdge {
    type Envelope = AABB<[f64; 2]>;

    fn envelope(&self) -> Self::Envelope {
        let [a, b] = self.0;
        AABB::from_corners([a.x, a.y], [b.x, b.y])
    }
}

impl Inside {
    pub(super) fn new(areas: &MultiPolygon) -> Self {
        let rings = areas.iter().flat_map(|it| std::iter::once(it.exterior()).chain(it.interiors()));
        let edges = rings.flat_map(geo::LineString::lines).map(|edge| UpEdge([edge.start, edge.end]));
        Self(RTree::bulk_load(edges.collect()))
    }

    /// Whether a place that is on no edge lies inside: areas that overlap count as often as they do.
    ///
    /// Method: how often edges cross a ray to the right upwards and downwards, by exact predicates.
    pub(super) fn holds(&self, place: geo::Coord) -> bool {
        let ray = AABB::from_corners([place.x, place.y], [f64::MAX, place.y]);
        let winding: i32 = self
            .0
            .locate_in_envelope_intersecting(&ray)
            .map(|UpEdge([a, b])| {
                if a.y <= place.y && place.y < b.y {
                    i32::from(RobustKernel::orient2d(*a, *b, place) == Orientation::CounterClockwise)
                } else if b.y <= place.y && place.y < a.y {
                    -i32::from(RobustKernel::orient2d(*a, *b, place) == Orientation::Clockwise)
                } else {
                    0
                }
            })
            .sum();
        winding != 0
    }
}
