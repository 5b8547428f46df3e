//! Measurements of a geometry, and simple shapes around it.

use burgeon_geometry::Rings;
use burgeon_geometry::planar::twice_area;
use geo::{Centroid, MinimumRotatedRect};
use glam::{DVec2, DVec3};

use super::Geometry;
use super::edges::with_heights;
use super::plane::{Plane, collect_lines, collect_polygons};

impl Geometry {
    /// Returns the horizontal area (m²) inside outer rings, without holes; 0 for lines and points.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    ///
    /// let yard = Geometry::from_wkt("POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0), (4 4, 6 4, 6 6, 4 6, 4 4))")?;
    /// assert_eq!((yard.area(), yard.perimeter(), yard.length()), (96.0, 48.0, 0.0));
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn area(&self) -> f64 {
        let mut sum = 0.0;
        if self.is_sound() {
            collect_polygons(self, &mut |rings| {
                let mut areas = rings.iter().map(|ring| twice_area(ring.iter().copied()).abs() / 2.0);
                sum += areas.next().unwrap_or(0.0) - areas.sum::<f64>();
            });
        }
        sum
    }

    /// Returns the horizontal length (m) of the lines; 0 for areas, whose rings have a
    /// [perimeter](Self::perimeter).
    pub fn length(&self) -> f64 {
        let mut sum = 0.0;
        if self.is_sound() {
            collect_lines(self, &mut |line| sum += length(line));
        }
        sum
    }

    /// Returns the horizontal length (m) of the rings; 0 for lines and points.
    pub fn perimeter(&self) -> f64 {
        let mut sum = 0.0;
        if self.is_sound() {
            collect_polygons(self, &mut |rings| {
                for ring in rings.iter() {
                    sum += length(ring);
                    if let [first, .., last] = ring[..] {
                        sum += first.truncate().distance(last.truncate());
                    }
                }
            });
        }
        sum
    }

    /// Returns the axis-parallel bounding rectangle; a line or a point if its width or height is 0.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    ///
    /// let path = Geometry::from_wkt("LINESTRING (1 1, 4 3, 2 5)")?;
    /// assert_eq!(path.envelope().to_wkt(), "POLYGON ((1 1, 4 1, 4 5, 1 5, 1 1))");
    /// assert_eq!(Geometry::from_wkt("LINESTRING (1 1, 4 1)")?.envelope().to_wkt(), "LINESTRING (1 1, 4 1)");
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn envelope(&self) -> Self {
        let Some([low, high]) = self.bounds().filter(|_| self.is_sound()) else {
            return Self::empty(self.dimension());
        };
        let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
        shape_of(corners.to_vec())
    }

    /// Returns the centroid of the areas, of the lines if it has no area, or of the points if it has no
    /// lines. Empty for an empty geometry.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    ///
    /// let angle = Geometry::from_wkt("POLYGON ((0 0, 4 0, 4 2, 2 2, 2 4, 0 4, 0 0))")?;
    /// let centre = angle.centroid();
    /// assert!(centre.distance(&Geometry::point([5.0 / 3.0, 5.0 / 3.0, 0.0])).is_some_and(|it| it < 1e-12));
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn centroid(&self) -> Self {
        let centre = |whole: &Self| {
            let plane = Plane::of(&[whole]);
            plane.geo(whole).centroid().map(|at| plane.back(DVec2::new(at.x(), at.y())))
        };
        let is_around = |at: &DVec3| {
            let at = at.truncate();
            self.bounds().is_some_and(|[low, high]| low.cmple(at).all() && at.cmple(high).all())
        };
        // In self-crossing rings, parts with opposite orientations may cancel each other.
        let found =
            centre(self).map(|at| if is_around(&at) { at } else { centre(&self.dissolved()).unwrap_or(at) });
        with_heights(Self::Point(found), &[self])
    }

    /// Returns the smallest convex geometry that contains it: a line if all points are collinear, a point if
    /// all are equal.
    ///
    /// Method: quickhull (C. Barber and others, "The quickhull algorithm for convex hulls", 1996), through `geo`.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    ///
    /// let trees = Geometry::from_wkt("MULTIPOINT ((0 0), (4 0), (2 1), (4 3))")?;
    /// assert_eq!(trees.convex_hull().area(), 6.0);
    /// assert_eq!(Geometry::from_wkt("LINESTRING (0 0, 3 3, 1 1)")?.convex_hull().length(), 18f64.sqrt());
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn convex_hull(&self) -> Self {
        let plane = Plane::of(&[self]);
        let hull = self.hull_around(plane);
        let hull: Vec<DVec2> = hull.into_iter().map(|place| plane.back(place).truncate()).collect();
        with_heights(if hull.is_empty() { Self::empty(self.dimension()) } else { shape_of(hull) }, &[self])
    }

    /// Returns the corners of the hull, counter-clockwise; two if all points are collinear, one if all are
    /// equal.
    pub(crate) fn hull_around(&self, plane: Plane) -> Vec<DVec2> {
        if !self.is_sound() {
            return Vec::new();
        }
        let points: Vec<DVec2> = self.points().map(|point| plane.flat(*point)).collect();
        let order = |a: &&DVec2, b: &&DVec2| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y));
        let (Some(first), Some(last)) = (points.iter().min_by(order), points.iter().max_by(order)) else {
            return points;
        };
        match burgeon_geometry::hull(points.iter().copied()) {
            Some(hull) => hull.into_points(),
            None if first == last => vec![*first],
            None => vec![*first, *last],
        }
    }

    /// Returns the smallest bounding rectangle of any direction; a line or a point if its width or height is
    /// 0.
    ///
    /// Method: one side of the rectangle lies along a side of the hull (H. Freeman and R. Shapira,
    /// "Determining the minimum-area encasing rectangle for an arbitrary closed curve", 1975), through `geo`.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    ///
    /// let diamond = Geometry::from_wkt("POLYGON ((5 0, 10 5, 5 10, 0 5, 5 0))")?;
    /// assert_eq!(diamond.envelope().area(), 100.0);
    /// assert!((diamond.oriented_envelope().area() - 50.0).abs() < 1e-9);
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn oriented_envelope(&self) -> Self {
        let plane = Plane::of(&[self]);
        let hull = self.hull_around(plane);
        let back = |at: &DVec2| plane.back(*at).truncate();
        if hull.len() < 3 {
            let hull: Vec<DVec2> = hull.iter().map(back).collect();
            return with_heights(if hull.is_empty() { Self::empty(2) } else { shape_of(hull) }, &[self]);
        }
        let around = plane.geo(self).minimum_rotated_rect();
        let around = around.map_or(Self::empty(2), |around| Self::Polygon(plane.rings(&around)));
        with_heights(around, &[self])
    }

    /// Returns the extent along x (m); 0 for an empty geometry.
    pub fn envelope_width(&self) -> f64 {
        self.bounds().map_or(0.0, |[low, high]| high.x - low.x)
    }

    /// Returns the extent along y (m); 0 for an empty geometry.
    pub fn envelope_height(&self) -> f64 {
        self.bounds().map_or(0.0, |[low, high]| high.y - low.y)
    }
}

/// Returns the polygon with these corners, or a line or a point if it has only two or one distinct corners.
fn shape_of(mut corners: Vec<DVec2>) -> Geometry {
    corners.dedup();
    while corners.len() > 1 && corners.first() == corners.last() {
        corners.pop();
    }
    let corners: Vec<DVec3> = corners.into_iter().map(|at| at.extend(0.0)).collect();
    match corners[..] {
        [only] => Geometry::Point(Some(only)),
        // A rectangle without width runs there and back.
        [_, _] | [_, _, _, _]
            if corners.len() == 2 || corners[0] == corners[3] && corners[1] == corners[2] =>
        {
            Geometry::Line(corners[..2].to_vec())
        }
        _ => Geometry::Polygon(Rings(vec![corners])),
    }
}

/// Returns the horizontal length (m) of a polyline.
pub(crate) fn length(points: &[DVec3]) -> f64 {
    points.windows(2).map(|pair| pair[0].truncate().distance(pair[1].truncate())).sum()
}
