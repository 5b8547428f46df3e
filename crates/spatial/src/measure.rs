//! What is measured on one geometry, and the simple shapes around it.

use burgeon_geometry::Rings;
use burgeon_geometry::planar::twice_area;
use geo::{Centroid, MinimumRotatedRect};
use glam::{DVec2, DVec3};

use super::Geometry;
use super::edges::with_heights;
use super::plane::{Plane, collect_lines, collect_polygons};

impl Geometry {
    /// Its area (m²) as seen from above: that inside outer rings, without holes; 0 of lines and points.
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

    /// The length (m) of its lines as seen from above; 0 of areas, whose rings make the [perimeter](Self::perimeter).
    pub fn length(&self) -> f64 {
        let mut sum = 0.0;
        if self.is_sound() {
            collect_lines(self, &mut |line| sum += length(line));
        }
        sum
    }

    /// The length (m) of its rings as seen from above; 0 of lines and points.
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

    /// The rectangle along the axes around it; a line or a point where it has no width or no height.
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

    /// The centre of mass of its areas; of its lines if it has no area, of its points if it has no lines. Empty of an
    /// empty one.
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
        // Of rings that cross themselves what they go around one way may weigh against what they go around the other way.
        let found =
            centre(self).map(|at| if is_around(&at) { at } else { centre(&self.dissolved()).unwrap_or(at) });
        with_heights(Self::Point(found), &[self])
    }

    /// The smallest convex geometry that it lies in: a line if all is on one, a point if all is in one place.
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

    /// The corners of the hull, counter-clockwise; two if all is on a line, one if it is in one place.
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

    /// The smallest rectangle of any direction around it; a line or a point where it has no width or no height.
    ///
    /// Method: one of its sides lies along one of the hull (H. Freeman and R. Shapira, "Determining the
    /// minimum-area encasing rectangle for an arbitrary closed curve", 1975), through `geo`.
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

    /// How wide it is along x (m); 0 of an empty one.
    pub fn envelope_width(&self) -> f64 {
        self.bounds().map_or(0.0, |[low, high]| high.x - low.x)
    }

    /// How wide it is along y (m); 0 of an empty one.
    pub fn envelope_height(&self) -> f64 {
        self.bounds().map_or(0.0, |[low, high]| high.y - low.y)
    }
}

/// The polygon with these corners, of which one or two may be all that there are.
fn shape_of(mut corners: Vec<DVec2>) -> Geometry {
    corners.dedup();
    while corners.len() > 1 && corners.first() == corners.last() {
        corners.pop();
    }
    let corners: Vec<DVec3> = corners.into_iter().map(|at| at.extend(0.0)).collect();
    match corners[..] {
        [only] => Geometry::Point(Some(only)),
        // There and back again, of a rectangle without width.
        [_, _] | [_, _, _, _]
            if corners.len() == 2 || corners[0] == corners[3] && corners[1] == corners[2] =>
        {
            Geometry::Line(corners[..2].to_vec())
        }
        _ => Geometry::Polygon(Rings(vec![corners])),
    }
}

/// The length (m) of a way from point to point.
pub(crate) fn length(points: &[DVec3]) -> f64 {
    points.windows(2).map(|pair| pair[0].truncate().distance(pair[1].truncate())).sum()
}
