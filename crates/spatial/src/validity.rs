//! Whether geometries are what their kinds promise, and what can be made of those that are not.

use burgeon_geometry::Rings;
use burgeon_geometry::planar::twice_area;
use geo::Validation;
use geo::bool_ops::FillRule;
use glam::DVec3;

use super::Geometry;
use super::edges::with_heights;
use super::overlay::filled;
use super::plane::Plane;

impl Geometry {
    /// Whether its rings neither cross nor overlap and holes lie inside, and no line is without length.
    pub fn is_valid(&self) -> bool {
        self.validity_reason().is_none()
    }

    /// Why it is not valid; none if it is.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    ///
    /// let bow_tie = Geometry::from_wkt("POLYGON ((0 0, 4 4, 4 0, 0 4, 0 0))")?;
    /// assert_eq!(bow_tie.validity_reason().as_deref(), Some("exterior ring has a self-intersection"));
    /// assert_eq!(bow_tie.make_valid().area(), 8.0);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn validity_reason(&self) -> Option<String> {
        if let Err(error) = self.check() {
            return Some(error.message().to_owned());
        }
        let mut short = None;
        super::plane::collect_lines(self, &mut |line: &[DVec3]| {
            if line.first().is_some_and(|first| line.iter().all(|point| point.truncate() == first.truncate()))
            {
                short = Some("a line has no length".to_owned());
            }
        });
        let mut flat = None;
        super::plane::collect_polygons(self, &mut |rings: &Rings| {
            if rings.iter().any(|ring| !ring.is_empty() && twice_area(ring.iter().copied()) == 0.0) {
                flat = Some("a ring has no area".to_owned());
            }
        });
        let plane = Plane::of(&[self]);
        short.or_else(|| plane.geo(self).check_validation().err().map(|reason| reason.to_string())).or(flat)
    }

    /// The same where it is valid; else the valid geometry that is most like it: of areas, what its rings go around an odd
    /// number of times, of lines without length their places.
    ///
    /// Method: boolean operations on polygons by the even-odd rule (i_overlay, through `geo`).
    #[must_use]
    pub fn make_valid(&self) -> Self {
        if self.is_valid() {
            return self.clone();
        }
        if !self.is_sound() {
            return Self::empty(self.dimension());
        }
        let plane = Plane::of(&[self]);
        let made = match self {
            Self::Polygon(_) | Self::MultiPolygon(_) => {
                let areas = plane.areas(&filled(&plane.polygons(self), FillRule::EvenOdd));
                // Of rings without an area their lines are left.
                if areas.is_empty() { self.boundary().dissolved().make_valid() } else { areas }
            }
            Self::Line(line) => Self::Point(line.first().copied()),
            Self::Collection(members) => Self::Collection(members.iter().map(Self::make_valid).collect()),
            other => Self::gathered(other.parts().iter().map(Self::make_valid).collect()),
        };
        with_heights(made, &[self])
    }
}
