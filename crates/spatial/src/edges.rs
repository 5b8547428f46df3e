//! Edges of geometries, in a tree for fast search of the nearest edge.

use burgeon_geometry::planar::foot;
use glam::{DVec2, DVec3};
use rstar::{AABB, PointDistance, RTree, RTreeObject};

use super::Geometry;
use super::plane::{collect_lines, collect_points, collect_polygons};

/// A numbered edge, or a point as an edge without length.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Edge {
    pub(crate) ends: [DVec3; 2],
    pub(crate) number: usize,
}

impl Edge {
    /// Returns the point of the edge that is nearest to a position, with its height.
    pub(crate) fn nearest(&self, place: DVec2) -> DVec3 {
        let [a, b] = self.ends;
        let along = foot(self.ends, place);
        // The ends are returned exactly.
        if along <= 0.0 {
            a
        } else if along >= 1.0 {
            b
        } else {
            a + (b - a) * along
        }
    }
}

impl RTreeObject for Edge {
    type Envelope = AABB<[f64; 2]>;

    fn envelope(&self) -> Self::Envelope {
        let [a, b] = self.ends.map(|end| end.truncate());
        AABB::from_corners(a.min(b).to_array(), a.max(b).to_array())
    }
}

impl PointDistance for Edge {
    fn distance_2(&self, place: &[f64; 2]) -> f64 {
        let place = DVec2::from_array(*place);
        self.nearest(place).truncate().distance_squared(place)
    }
}

/// Returns the edges of the lines and rings of a geometry, and its points, in order.
pub(crate) fn edges(geometry: &Geometry) -> Vec<Edge> {
    let mut found: Vec<[DVec3; 2]> = Vec::new();
    collect_points(geometry, &mut |point| found.push([point; 2]));
    collect_lines(geometry, &mut |line| {
        found.extend(line.windows(2).map(|pair| [pair[0], pair[1]]));
    });
    collect_polygons(geometry, &mut |rings| {
        found.extend(rings.iter().flat_map(|ring| burgeon_geometry::planar::edges(ring)));
    });
    found.into_iter().enumerate().map(|(number, ends)| Edge { ends, number }).collect()
}

/// A tree of edges.
pub(crate) struct EdgeTree(RTree<Edge>);

impl EdgeTree {
    pub(crate) fn new(edges: Vec<Edge>) -> Self {
        Self(RTree::bulk_load(edges))
    }

    /// Returns the point on the edges that is nearest to a position; of several, the point on the first edge.
    /// `None` without edges.
    pub(crate) fn nearest(&self, place: DVec2) -> Option<DVec3> {
        self.nearest_edge(place).map(|(_, nearest)| nearest)
    }

    /// Returns the nearest edge, and its point nearest to a position.
    pub(crate) fn nearest_edge(&self, place: DVec2) -> Option<(Edge, DVec3)> {
        let place_array = place.to_array();
        let mut near = self.0.nearest_neighbor_iter_with_distance_2(&place_array);
        let (mut best, least) = near.next()?;
        for (edge, _) in near.take_while(|(_, distance)| *distance <= least) {
            if edge.number < best.number {
                best = edge;
            }
        }
        Some((*best, best.nearest(place)))
    }
}

/// Sets the heights of the points of `made` to the heights of the nearest points on the lines and borders of
/// its sources.
pub(crate) fn with_heights(mut made: Geometry, from: &[&Geometry]) -> Geometry {
    if !from.iter().any(|geometry| geometry.has_heights()) {
        return made;
    }
    let mut all: Vec<Edge> = from.iter().filter(|it| it.is_sound()).flat_map(|it| edges(it)).collect();
    all.iter_mut().enumerate().for_each(|(number, edge)| edge.number = number);
    let tree = EdgeTree::new(all);
    for point in made.points_mut() {
        point.z = tree.nearest(point.truncate()).map_or(0.0, |nearest| nearest.z);
    }
    made
}
