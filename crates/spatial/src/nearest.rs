//! Distances and nearest points.

use geo::Intersects;
use glam::DVec3;

use super::Geometry;
use super::edges::{Edge, EdgeTree, edges};
use super::plane::Plane;

impl Geometry {
    /// Returns the horizontal distance (m) between the nearest points of both geometries; `None` if either is
    /// empty.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    ///
    /// let lawn = Geometry::from_wkt("POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0))")?;
    /// assert_eq!(lawn.distance(&Geometry::from_wkt("POINT (13 14)")?), Some(5.0));
    /// assert_eq!(lawn.distance(&Geometry::from_wkt("POINT (5 5)")?), Some(0.0));
    /// assert_eq!(lawn.distance(&Geometry::default()), None);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn distance(&self, other: &Self) -> Option<f64> {
        let [a, b] = self.nearest_points(other)?;
        Some(a.truncate().distance(b.truncate()))
    }

    /// Returns the point of this geometry that is nearest to another; empty if either is empty.
    pub fn nearest_point(&self, other: &Self) -> Self {
        Self::Point(self.nearest_points(other).map(|[own, _]| own))
    }

    /// Returns the horizontally nearest points of both geometries; `None` if either is empty.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    /// use glam::DVec3;
    ///
    /// let street = Geometry::from_wkt("LINESTRING (0 0, 10 0)")?;
    /// let house = Geometry::from_wkt("POLYGON ((4 3, 8 5, 4 7, 4 3))")?;
    /// assert_eq!(house.nearest_points(&street), Some([DVec3::new(4.0, 3.0, 0.0), DVec3::new(4.0, 0.0, 0.0)]));
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn nearest_points(&self, other: &Self) -> Option<[DVec3; 2]> {
        if !self.is_sound() || !other.is_sound() {
            return None;
        }
        let (own, others) = (edges(self), edges(other));
        if own.is_empty() || others.is_empty() {
            return None;
        }
        let plane = Plane::of(&[self, other]);
        let meeting = self
            .bounds()
            .zip(other.bounds())
            .is_some_and(|([a, b], [c, d])| a.cmple(d).all() && c.cmple(b).all());
        if meeting && plane.geo(self).intersects(&plane.geo(other)) {
            return Some([common(self, other, &own, &others, plane); 2]);
        }
        let one = least(&own, &others)?;
        let [b, a] = least(&others, &own)?;
        let far = |[a, b]: [DVec3; 2]| a.truncate().distance_squared(b.truncate());
        Some(if far(one) <= far([a, b]) { one } else { [a, b] })
    }
}

/// Returns the end of an edge of `from` that is nearest to an edge of `to`, and the nearest point there.
fn least(from: &[Edge], to: &[Edge]) -> Option<[DVec3; 2]> {
    let ends = from.iter().flat_map(|edge| edge.ends);
    let far = |[a, b]: &[DVec3; 2]| a.truncate().distance_squared(b.truncate());
    let nearest = |pairs: &mut dyn Iterator<Item = [DVec3; 2]>| {
        pairs.reduce(|best, pair| if far(&pair) < far(&best) { pair } else { best })
    };
    if from.len() * to.len() <= FEW {
        return nearest(&mut ends.filter_map(|end| {
            let points = to.iter().map(|edge| [end, edge.nearest(end.truncate())]);
            nearest(&mut points.into_iter())
        }));
    }
    let tree = EdgeTree::new(to.to_vec());
    nearest(&mut ends.filter_map(|end| Some([end, tree.nearest(end.truncate())?])))
}

/// Maximum number of pairs for which direct comparison is faster than building a tree.
const FEW: usize = 2000;

/// Returns a common point of two intersecting geometries: an end of an edge, or the crossing of two edges.
fn common(one: &Geometry, two: &Geometry, own: &[Edge], others: &[Edge], plane: Plane) -> DVec3 {
    for (from, to) in [(own, two), (others, one)] {
        let to = plane.geo(to);
        let ends = from.iter().flat_map(|edge| edge.ends);
        if let Some(inside) = ends.into_iter().find(|end| to.intersects(&plane.coord(*end))) {
            return inside;
        }
    }
    let line = |edge: &Edge| geo::Line::new(plane.coord(edge.ends[0]), plane.coord(edge.ends[1]));
    for a in own {
        for b in others {
            let (first, second) = (line(a), line(b));
            if first.intersects(&second)
                && let Some(geo::LineIntersection::SinglePoint { intersection, .. }) =
                    geo::line_intersection::line_intersection(first, second)
            {
                let place = plane.back(glam::DVec2::new(intersection.x, intersection.y));
                return a.nearest(place.truncate());
            }
        }
    }
    own.first().map_or(DVec3::ZERO, |edge| edge.ends[0])
}
