//! Validity of geometries by OGC Simple Features, and the repair of invalid ones.

use burgeon_geometry::Rings;
use burgeon_geometry::overlay::Fill;
use burgeon_geometry::planar::is_flat;
use glam::DVec3;

use super::Geometry;
use super::edges::with_heights;
use super::overlay::{area_of, filled, geometry_of};
use super::plane::Plane;
use super::ways::{multi_polygon_flaw, polygon_flaw};
use burgeon_base::budget::Budget;
use burgeon_base::error::Result;

impl Geometry {
    /// Returns true if rings neither cross nor overlap, holes lie inside, the interior of each polygon is
    /// connected, and every line has a length.
    pub fn is_valid(&self) -> bool {
        self.validity_reason().is_none()
    }

    /// Returns the reason why the geometry is invalid; `None` if it is valid.
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
        self.validity_reason_within(&Budget::default()).ok().flatten()
    }

    /// Returns the reason why the geometry is invalid, if the check does not exceed the budget.
    pub fn validity_reason_within(&self, budget: &Budget) -> Result<Option<String>> {
        if let Err(error) = self.check() {
            return Ok(Some(error.into_message()));
        }
        let mut short = None;
        super::plane::collect_lines(self, &mut |line: &[DVec3]| {
            if line.first().is_some_and(|first| line.iter().all(|point| point.truncate() == first.truncate()))
            {
                short = Some("a line has no length");
            }
        });
        let mut flat = None;
        super::plane::collect_polygons(self, &mut |rings: &Rings| {
            let is_flat = |ring: &Vec<DVec3>| is_flat(ring.iter().map(|point| point.truncate()));
            if rings.iter().any(|ring| !ring.is_empty() && is_flat(ring)) {
                flat = Some("a ring has no area");
            }
        });
        let flaw = match short {
            None => area_flaw(&Plane::of(&[self]).geo(self), budget)?,
            Some(_) => None,
        };
        Ok(flaw.or_else(|| Some(short.or(flat)?.to_owned())))
    }

    /// Returns the most similar valid geometry: itself if it is valid.
    ///
    /// For invalid areas, it is the area with odd winding numbers. A line without length becomes a point.
    ///
    /// An area whose interior is connected only by points becomes several areas.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    ///
    /// let bow_tie = Geometry::from_wkt("POLYGON ((0 0, 4 4, 4 0, 0 4, 0 0))")?;
    /// let valid = bow_tie.make_valid();
    /// assert!(!bow_tie.is_valid() && valid.is_valid());
    /// assert_eq!((valid.num_geometries(), valid.area()), (2, 8.0));
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    #[must_use]
    pub fn make_valid(&self) -> Self {
        if self.is_valid() {
            return self.clone();
        }
        if !self.is_sound() {
            return Self::empty(self.dimension());
        }
        let made = match self {
            Self::Polygon(_) | Self::MultiPolygon(_) => {
                let areas = filled(&Plane::absolute().polygons(self), Fill::EvenOdd);
                let areas = geometry_of(&area_of(&areas));
                // Rings without area become lines.
                if areas.is_empty() { self.boundary().dissolved().make_valid() } else { areas }
            }
            Self::Line(line) => Self::Point(line.first().copied()),
            Self::Collection(members) => Self::Collection(members.iter().map(Self::make_valid).collect()),
            other => Self::gathered(other.parts().iter().map(Self::make_valid).collect()),
        };
        with_heights(made, &[self])
    }
}

/// Returns the reason why the areas of a geometry are invalid; `None` if they are valid.
fn area_flaw(geometry: &geo::Geometry, budget: &Budget) -> Result<Option<String>> {
    match geometry {
        geo::Geometry::Polygon(polygon) => polygon_flaw(polygon, budget),
        geo::Geometry::MultiPolygon(polygons) => multi_polygon_flaw(polygons, budget),
        geo::Geometry::GeometryCollection(members) => {
            for (number, member) in members.iter().enumerate() {
                if let Some(flaw) = area_flaw(member, budget)? {
                    return Ok(Some(format!("geometry at index {number} is invalid: {flaw}")));
                }
            }
            Ok(None)
        }
        _ => Ok(None),
    }
}
