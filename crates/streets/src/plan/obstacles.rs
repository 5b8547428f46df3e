//! Obstacles to streets: water, steep terrain, buildings, and the area outside a limit.

use std::sync::Arc;

use glam::DVec2;
use rstar::primitives::{GeomWithData, Line as IndexLine, Rectangle};
use rstar::{AABB, RTree};

use super::grid::{crossing, foot};
use burgeon_geometry::planar::contains;
use burgeon_geometry::{Polygon, planar};

type ObstacleEdge = GeomWithData<IndexLine<[f64; 2]>, u32>;

/// Areas (m) that streets avoid.
///
/// ```
/// use burgeon_geometry::{Polygon, Rings};
/// use burgeon_streets::{Constraints, Obstacle, Obstacles, StreetNetwork};
/// use glam::DVec2;
///
/// let pond = [(0.0, 0.0), (40.0, 0.0), (40.0, 30.0), (0.0, 30.0)].map(DVec2::from).to_vec();
/// let area = Polygon::new(Rings(vec![pond]))?;
/// let obstacles = Obstacles::new(vec![Obstacle { area, is_limit: false, can_be_bridged: true }]);
/// assert!(obstacles.at(DVec2::new(10.0, 10.0)).is_some());
/// let mut network = StreetNetwork::new(Constraints::default(), obstacles)?;
/// assert!(network.begin(DVec2::new(10.0, 10.0)).is_err());
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
#[derive(Clone, Default)]
pub struct Obstacles {
    areas: Arc<[Obstacle]>,
    /// Bounding boxes of the areas that are not limits.
    boxes: Arc<RTree<GeomWithData<Rectangle<[f64; 2]>, u32>>>,
    edges: Arc<RTree<ObstacleEdge>>,
}

/// Area that streets avoid, or a limit that they stay within.
#[derive(Debug, Clone)]
pub struct Obstacle {
    /// Outline.
    pub area: Polygon,
    /// Marks a limit: streets stay inside the area instead of outside.
    pub is_limit: bool,
    /// Set if bridges may cross the area.
    pub can_be_bridged: bool,
}

impl Obstacles {
    /// Creates an index of the areas.
    pub fn new(areas: Vec<Obstacle>) -> Self {
        let edges = (0..).zip(&areas).flat_map(|(number, obstacle): (u32, &Obstacle)| {
            let pieces = obstacle.area.edges();
            pieces.map(move |[a, b]| GeomWithData::new(IndexLine::new(a.to_array(), b.to_array()), number))
        });
        let edges = RTree::bulk_load(edges.collect());
        let boxes = (0..).zip(&areas).filter(|(_, obstacle)| !obstacle.is_limit);
        let boxes = boxes.filter_map(|(number, obstacle): (u32, &Obstacle)| {
            let points = || obstacle.area.points();
            let (low, high) = (points().reduce(DVec2::min)?, points().reduce(DVec2::max)?);
            let of_all = Rectangle::from_corners(low.to_array(), high.to_array());
            Some(GeomWithData::new(of_all, number))
        });
        let boxes = RTree::bulk_load(boxes.collect());
        Self { areas: areas.into(), boxes: Arc::new(boxes), edges: Arc::new(edges) }
    }

    /// Returns true if there are no areas.
    pub fn is_empty(&self) -> bool {
        self.areas.is_empty()
    }

    /// Returns the obstacle that contains a position, or the limit that does not contain it.
    pub fn at(&self, place: DVec2) -> Option<&Obstacle> {
        let around = self.boxes.locate_all_at_point(&place.to_array()).map(|found| found.data);
        let inside = around.filter(|number| self.areas[*number as usize].area.contains(place)).min();
        inside.map(|number| &self.areas[number as usize]).or_else(|| {
            self.areas.iter().find(|obstacle| obstacle.is_limit && !obstacle.area.contains(place))
        })
    }

    /// Returns true if the area inside a ring (m) intersects an obstacle or extends beyond a limit.
    pub fn reach_into(&self, ring: &[DVec2]) -> bool {
        let Some(first) = ring.first().filter(|_| !self.is_empty()) else { return false };
        if self.at(*first).is_some() {
            return true;
        }
        let [low, high] = ring.iter().fold([*first; 2], |[low, high], at| [low.min(*at), high.max(*at)]);
        let around = AABB::from_corners(low.to_array(), high.to_array());
        let mut near = self.edges.locate_in_envelope_intersecting(&around);
        near.any(|edge| {
            let ends = [edge.geom().from, edge.geom().to].map(DVec2::from);
            contains(ring, ends[0]) || planar::edges(ring).any(|side| first_within(side, ends, 0.0).is_some())
        })
    }

    /// Returns the first obstacle in the path of a street of a `width` (m), with its position along the path, from 0 to
    /// 1.
    pub(crate) fn first_on(&self, [a, b]: [DVec2; 2], width: f64) -> Option<(f64, &Obstacle)> {
        if self.is_empty() {
            return None;
        }
        let length = a.distance(b);
        let half = width / 2.0;
        let around = AABB::from_corners((a.min(b) - half).to_array(), (a.max(b) + half).to_array());
        let near = self.edges.locate_in_envelope_intersecting(&around);
        let met = near.filter_map(|edge| {
            let ends = [edge.geom().from, edge.geom().to].map(DVec2::from);
            let along = first_within([a, b], ends, half)?;
            Some((along, &self.areas[edge.data as usize], edge.data))
        });
        let first = met.min_by(|(a, _, of_a), (b, _, of_b)| a.total_cmp(b).then(of_a.cmp(of_b)));
        match self.at(a) {
            Some(inside) if length > 0.0 => Some((0.0, inside)),
            _ => first.map(|(along, obstacle, _)| (along, obstacle)),
        }
    }

    /// Returns the position along a path, from 0 to 1, at which it has passed all bridgeable obstacles; `None` if it
    /// ends in an obstacle or meets one that cannot be bridged.
    pub(crate) fn bridged_until(&self, [a, b]: [DVec2; 2], width: f64) -> Option<f64> {
        let half = width / 2.0;
        let around = AABB::from_corners((a.min(b) - half).to_array(), (a.max(b) + half).to_array());
        let near = self.edges.locate_in_envelope_intersecting(&around);
        let mut last = 0.0_f64;
        for edge in near {
            let ends = [edge.geom().from, edge.geom().to].map(DVec2::from);
            if let Some(back) = first_within([b, a], ends, half) {
                if !self.areas[edge.data as usize].can_be_bridged {
                    return None;
                }
                last = last.max(1.0 - back);
            }
        }
        (last < 1.0 && self.at(b).is_none()).then_some(last)
    }
}

/// Returns the first position along the path from `a` to `b`, from 0 to 1, within `distance` (m) of an edge.
fn first_within([a, b]: [DVec2; 2], [c, d]: [DVec2; 2], distance: f64) -> Option<f64> {
    let length = a.distance(b);
    if length == 0.0 || foot(a, [c, d]).0 <= distance {
        return (foot(a, [c, d]).0 <= distance).then_some(0.0);
    }
    let mut first = f64::INFINITY;
    let mut meet = |along: f64| {
        if (0.0..=1.0).contains(&along) {
            first = first.min(along);
        }
    };
    // The region within `distance` of the edge is bounded by two parallel lines and a circle at each end.
    if let Some(normal) = (d - c).try_normalize().map(DVec2::perp) {
        for side in [-distance, distance] {
            let beside = [c + normal * side, d + normal * side];
            if let Some(along) = crossing([a, b], beside)
                && crossing(beside, [a, b]).is_some_and(|on| (0.0..=1.0).contains(&on))
            {
                meet(along);
            }
        }
    }
    let way = (b - a) / length;
    for center in [c, d] {
        let (middle, aside) = ((center - a).dot(way), (center - a).perp_dot(way).abs());
        if aside <= distance {
            meet((middle - (distance * distance - aside * aside).sqrt()) / length);
        }
    }
    first.is_finite().then_some(first)
}

#[cfg(test)]
mod tests {
    use super::*;
    use burgeon_geometry::Rings;

    fn pond(is_limit: bool) -> Obstacles {
        let square = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)].map(DVec2::from);
        let area = Polygon::new(Rings(vec![square.to_vec()])).expect("a square");
        Obstacles::new(vec![Obstacle { area, is_limit, can_be_bridged: true }])
    }

    #[test]
    fn a_way_comes_to_an_area_by_half_its_width_before_it() {
        let pond = pond(false);
        let way = [DVec2::new(-10.0, 5.0), DVec2::new(30.0, 5.0)];
        let (along, _) = pond.first_on(way, 4.0).expect("the pond");
        assert!((along * 40.0 - 8.0).abs() < 1e-9);
        assert!((pond.bridged_until(way, 4.0).expect("the other side") * 40.0 - 22.0).abs() < 1e-9);
        // The path passes the pond at a distance of 1 m.
        let way = [DVec2::new(-10.0, 11.0), DVec2::new(30.0, 11.0)];
        assert!(pond.first_on(way, 1.8).is_none());
        assert!(pond.first_on(way, 2.2).is_some());
    }

    #[test]
    fn a_limit_is_left_where_it_ends() {
        let island = pond(true);
        let (along, _) = island.first_on([DVec2::splat(5.0), DVec2::new(25.0, 5.0)], 2.0).expect("the shore");
        assert!((along * 20.0 - 4.0).abs() < 1e-9);
        assert!(island.at(DVec2::splat(11.0)).is_some() && island.at(DVec2::splat(9.0)).is_none());
    }
}
