//! Points inside geometries.

use burgeon_base::error::{Error, Result};
use geo::TriangulateEarcut;
use glam::{DVec2, DVec3};

use super::edges::with_heights;
use super::measure::length;
use super::overlay::dissolved;
use super::plane::{Plane, collect_lines};
use super::{Geometry, GeometryKind, PreparedGeometry};

impl Geometry {
    /// Returns a point of the geometry: well inside if it has an area, not an end if it has a length. Empty
    /// for an empty geometry.
    ///
    /// Method: the midpoint of the widest section along x, halfway between the two corners nearest to the
    /// middle of the area's y range (as in JTS).
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    ///
    /// let ring_road = Geometry::from_wkt("POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (1 1, 8 1, 8 8, 1 8, 1 1))")?;
    /// assert!(ring_road.contains(&ring_road.point_on_surface()) && !ring_road.contains(&ring_road.centroid()));
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn point_on_surface(&self) -> Self {
        if !self.is_sound() {
            return Self::Point(None);
        }
        let plane = Plane::of(&[self]);
        let areas = dissolved(plane.polygons(self));
        let cuts = areas.iter().filter_map(widest_cut);
        let widest = cuts.reduce(|best, cut| if cut.0 > best.0 { cut } else { best });
        let found =
            widest.map(|(_, place)| plane.back(place)).or_else(|| self.middle_of_lines()).or_else(|| {
                let centre = self.centroid();
                let centre = centre.points().next()?.truncate();
                let far = |point: &&DVec3| point.truncate().distance_squared(centre);
                self.points().min_by(|a, b| far(a).total_cmp(&far(b))).copied()
            });
        with_heights(Self::Point(found), &[self])
    }

    /// Returns the midpoint of the longest line; `None` if no line has a length.
    fn middle_of_lines(&self) -> Option<DVec3> {
        let mut longest: Option<(f64, &[DVec3])> = None;
        collect_lines(self, &mut |line| {
            let long = length(line);
            if long > longest.map_or(0.0, |(longest, _)| longest) {
                longest = Some((long, line));
            }
        });
        let (long, line) = longest?;
        Some(super::lines::along(line, long / 2.0))
    }

    /// Returns the point selected by two numbers from 0 to 1: random numbers give uniformly distributed
    /// points of the areas, of the lines if it has no area, or of the points if it has no lines. Empty for an
    /// empty geometry.
    ///
    /// Fails if one of the numbers is not from 0 to 1.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    ///
    /// let lawn = Geometry::from_wkt("POLYGON ((0 0, 8 0, 8 8, 4 1, 0 8, 0 0))")?;
    /// for step in 0..=100 {
    ///     let number = f64::from(step) / 100.0;
    ///     assert!(lawn.covers(&lawn.random_point(number, 1.0 - number * number)?));
    /// }
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn random_point(&self, u: f64, v: f64) -> Result<Self> {
        PreparedGeometry::new(self).random_point(u, v)
    }
}

impl PreparedGeometry {
    /// Returns the result of [`Geometry::random_point`]; the areas are triangulated once.
    pub fn random_point(&self, u: f64, v: f64) -> Result<Geometry> {
        if let Some(wrong) = [u, v].into_iter().find(|number| !(0.0..=1.0).contains(number)) {
            return Err(Error::argument(format!("random_point takes two numbers from 0 to 1, not {wrong}"))
                .help("write geometry:random_point(random(), random())"));
        }
        let whole = &self.whole;
        if !self.is_sound {
            return Ok(Geometry::Point(None));
        }
        let plane = Plane::of(&[whole]);
        let triangles = self.triangles.get_or_init(|| triangles(whole, plane));
        let area = |[a, b, c]: &[DVec2; 3]| (*b - *a).perp_dot(*c - *a).abs();
        let sum: f64 = triangles.iter().map(area).sum();
        let found = if sum > 0.0 {
            let mut rest = u * sum;
            let mut chosen = triangles[0];
            for triangle in triangles {
                chosen = *triangle;
                if rest <= area(triangle) {
                    break;
                }
                rest -= area(triangle);
            }
            let [a, b, c] = chosen;
            // The remainder of the first number is uniformly distributed within the triangle.
            let across = (rest / area(&chosen).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0).sqrt();
            Some(plane.back(a + (b - a) * (across * (1.0 - v)) + (c - a) * (across * v)))
        } else if whole.length() > 0.0 {
            let mut lines = Vec::new();
            collect_lines(whole, &mut |line| lines.push(line));
            let mut rest = u * whole.length();
            let mut found = None;
            for line in lines {
                found = Some(super::lines::along(line, rest));
                if rest <= length(line) {
                    break;
                }
                rest -= length(line);
            }
            found
        } else {
            let points: Vec<&DVec3> = whole.points().collect();
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to the count")]
            let index = (u * points.len() as f64) as usize;
            points.get(index.min(points.len().saturating_sub(1))).map(|point| **point)
        };
        let made = Geometry::Point(found);
        Ok(if whole.kind() == GeometryKind::Point { whole.clone() } else { with_heights(made, &[whole]) })
    }
}

/// Triangulates the areas of a geometry.
fn triangles(geometry: &Geometry, plane: Plane) -> Vec<[DVec2; 3]> {
    let place = |at: geo::Coord| DVec2::new(at.x, at.y);
    let areas = dissolved(plane.polygons(geometry));
    let triangles = areas.iter().flat_map(|polygon| polygon.earcut_triangles());
    triangles.map(|triangle| triangle.to_array().map(place)).collect()
}

/// Returns the width and the midpoint of the widest section of a polygon along x; `None` without an area.
fn widest_cut(polygon: &geo::Polygon) -> Option<(f64, DVec2)> {
    let corners = || polygon.exterior().0.iter();
    let low = corners().map(|at| at.y).fold(f64::INFINITY, f64::min);
    let high = corners().map(|at| at.y).fold(f64::NEG_INFINITY, f64::max);
    let middle = low.midpoint(high);
    let rings = || std::iter::once(polygon.exterior()).chain(polygon.interiors());
    let heights = || rings().flat_map(|ring| ring.0.iter()).map(|at| at.y);
    let below = heights().filter(|y| *y <= middle).fold(low, f64::max);
    let above = heights().filter(|y| *y > middle).fold(high, f64::min);
    let y = below.midpoint(above);
    let mut crossed: Vec<f64> = rings()
        .flat_map(geo::LineString::lines)
        .filter(|edge| (edge.start.y <= y) != (edge.end.y <= y))
        .map(|edge| {
            let part = (y - edge.start.y) / (edge.end.y - edge.start.y);
            edge.start.x + (edge.end.x - edge.start.x) * part
        })
        .collect();
    crossed.sort_by(f64::total_cmp);
    let cuts = crossed.chunks_exact(2).map(|pair| (pair[1] - pair[0], pair[0].midpoint(pair[1])));
    let widest = cuts.reduce(|best, cut| if cut.0 > best.0 { cut } else { best });
    widest.filter(|(wide, _)| *wide > 0.0).map(|(wide, x)| (wide, DVec2::new(x, y)))
}
