//! Map from the coordinates of a run to the ellipsoid.

use burgeon_base::error::{Error, Result};
use burgeon_spatial::{Crs, Passage, ReferenceFrame};
use glam::{DAffine3, DMat3, DVec3};

use super::{GeoidGrid, east_north_up, from_degrees};

/// Map from the coordinates of a run to geocentric coordinates (m).
pub struct EarthMap<'a> {
    passage: Passage<'a>,
    /// Height (m) of the origin of heights above the ellipsoid.
    geoid: f64,
    grid: Option<GeoidGrid>,
}

/// Local axes of a tile: east, north and up at its origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TileAxes {
    /// Longitude and latitude (degrees) of the origin.
    pub degrees: [f64; 2],
    /// Transform from the local axes to geocentric coordinates (m).
    pub transform: DAffine3,
}

/// Map from the coordinates of a run to the local axes of a tile around one point, exact to a micrometre within a
/// kilometre.
///
/// Method: Taylor's expansion of second degree; the coefficients are differences of the exact map.
pub struct LocalMap {
    /// Point (m) in the coordinates of the run.
    from: DVec3,
    /// Image (m) of the point.
    pub to: DVec3,
    /// Derivative at the point.
    pub slope: DMat3,
    /// Halves of the second derivatives: xx, yy, zz, xy, yz, zx.
    bend: [DVec3; 6],
}

/// Distance (m) of the points whose differences give the expansion.
const STEP: f64 = 100.0;

/// Distance (m) up to which the expansion is used.
pub(super) const NEAR: f64 = 1000.0;

impl<'a> EarthMap<'a> {
    /// Creates the map of `frame`, whose heights begin `geoid` (m) above the ellipsoid.
    pub fn new(frame: &'a ReferenceFrame, geoid: f64) -> Result<Self> {
        Ok(Self { passage: frame.passage(&Crs::epsg(4326)?)?, geoid, grid: None })
    }

    /// Returns the map whose heights are above the geoid of a grid. Axes keep their height.
    #[must_use]
    pub fn above(self, grid: Option<GeoidGrid>) -> Self {
        Self { grid, ..self }
    }

    /// Returns the longitude and the latitude (degrees) of a position (m) of the run.
    pub fn degrees(&self, [x, y]: [f64; 2]) -> Result<[f64; 2]> {
        let degrees = self.passage.leave([x, y]);
        if degrees.iter().all(|angle| angle.is_finite()) {
            return Ok(degrees);
        }
        Err(Error::data(format!("the position {x}, {y} of the model has no longitude and latitude"))
            .help("specify the coordinate system of the file: source(file, { crs = 2154 })"))
    }

    /// Returns the geocentric coordinates (m) of a point (m) of the run.
    pub fn geocentric(&self, point: DVec3) -> Result<DVec3> {
        let degrees = self.degrees([point.x, point.y])?;
        let geoid = self.grid.as_ref().map_or(Ok(self.geoid), |grid| grid.height(degrees))?;
        Ok(from_degrees(degrees, point.z + geoid))
    }

    /// Returns the local axes at a position (m) of the run, at height 0 of the run.
    pub fn axes(&self, place: [f64; 2]) -> Result<TileAxes> {
        let degrees = self.degrees(place)?;
        Ok(TileAxes { degrees, transform: east_north_up(degrees, self.geoid) })
    }

    /// Returns the position (m) of a point (m) of the run in the local axes.
    pub fn local(&self, axes: &TileAxes, point: DVec3) -> Result<DVec3> {
        Ok(axes.enter(self.geocentric(point)?))
    }

    /// Returns the map around a point (m) of the run into the local axes.
    pub fn around(&self, axes: &TileAxes, from: DVec3) -> Result<LocalMap> {
        let at = |x: f64, y: f64, z: f64| self.local(axes, from + DVec3::new(x, y, z) * STEP);
        let to = at(0.0, 0.0, 0.0)?;
        let [[east, west], [north, south], [up, down]] = [
            [at(1.0, 0.0, 0.0)?, at(-1.0, 0.0, 0.0)?],
            [at(0.0, 1.0, 0.0)?, at(0.0, -1.0, 0.0)?],
            [at(0.0, 0.0, 1.0)?, at(0.0, 0.0, -1.0)?],
        ];
        let slope = |plus: DVec3, minus: DVec3| (plus - minus) / (2.0 * STEP);
        let bend = |plus: DVec3, minus: DVec3| (plus + minus - 2.0 * to) / (2.0 * STEP * STEP);
        let mixed = |both: DVec3, one: DVec3, other: DVec3| (both - one - other + to) / (STEP * STEP);
        Ok(LocalMap {
            from,
            to,
            slope: DMat3::from_cols(slope(east, west), slope(north, south), slope(up, down)),
            bend: [
                bend(east, west),
                bend(north, south),
                bend(up, down),
                mixed(at(1.0, 1.0, 0.0)?, east, north),
                mixed(at(0.0, 1.0, 1.0)?, north, up),
                mixed(at(1.0, 0.0, 1.0)?, east, up),
            ],
        })
    }
}

impl TileAxes {
    /// Returns the position (m) of a geocentric point (m) in the local axes.
    pub fn enter(&self, point: DVec3) -> DVec3 {
        // The axes are orthonormal, so the transpose is the inverse.
        self.transform.matrix3.transpose() * (point - self.transform.translation)
    }
}

impl LocalMap {
    /// Returns the image (m) of a point (m) of the run, relative to [`to`](Self::to).
    pub fn apply(&self, point: DVec3) -> DVec3 {
        let d = point - self.from;
        let [xx, yy, zz, xy, yz, zx] = self.bend;
        self.slope * d
            + xx * (d.x * d.x)
            + yy * (d.y * d.y)
            + zz * (d.z * d.z)
            + xy * (d.x * d.y)
            + yz * (d.y * d.z)
            + zx * (d.z * d.x)
    }

    /// Returns true if the expansion is exact enough at a point (m) of the run.
    pub fn reaches(&self, point: DVec3) -> bool {
        point.distance_squared(self.from) < NEAR * NEAR
    }

    /// Returns the rotation nearest to the derivative.
    pub fn rotation(&self) -> DMat3 {
        let DMat3 { x_axis, y_axis, .. } = self.slope;
        let up = x_axis.cross(y_axis).normalize();
        // Half of the angle between the axes' images is corrected at each axis.
        let east = (x_axis.normalize() + y_axis.normalize().cross(up)).normalize();
        DMat3::from_cols(east, up.cross(east), up)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(code: u32, place: [f64; 2]) -> ReferenceFrame {
        ReferenceFrame::around(&Crs::epsg(code).unwrap(), place, "a town").unwrap()
    }

    #[test]
    fn the_expansion_is_the_map_to_a_tenth_of_a_millimetre_within_a_kilometre() {
        for (code, place) in
            [(2154, [652_000.0, 6_862_000.0]), (3067, [385_000.0, 6_671_000.0]), (4326, [2.0, 48.0])]
        {
            let frame = frame(code, place);
            let map = EarthMap::new(&frame, 44.0).unwrap();
            let axes = map.axes([120.0, -3000.0]).unwrap();
            let from = DVec3::new(900.0, -2000.0, 15.0);
            let local = map.around(&axes, from).unwrap();
            for number in 0..200_u32 {
                let part =
                    |shift: u32| f64::from(number.wrapping_mul(2_654_435_761) >> shift & 1023) / 1023.0 - 0.5;
                let point = from + DVec3::new(part(2) * 1000.0, part(9) * 1000.0, part(17) * 300.0);
                let exact = map.local(&axes, point).unwrap();
                let error = (local.to + local.apply(point) - exact).length();
                assert!(error < 1e-4, "{code}: {error}");
            }
        }
    }

    #[test]
    fn a_hundred_metres_to_the_true_north_stay_a_hundred_metres() {
        let frame = frame(4326, [2.0, 48.0]);
        let map = EarthMap::new(&frame, 0.0).unwrap();
        let axes = map.axes([0.0; 2]).unwrap();
        let north = map.local(&axes, DVec3::new(0.0, 100.0, 0.0)).unwrap();
        assert!((north - DVec3::new(0.0, 100.0, -100.0 * 100.0 / 2.0 / 6.36e6)).length() < 0.003, "{north}");
        // The grid of Lambert-93 is turned by degrees away from its meridian, but lengths stay.
        let frame = self::frame(2154, [1_000_000.0, 6_300_000.0]);
        let map = EarthMap::new(&frame, 0.0).unwrap();
        let axes = map.axes([0.0; 2]).unwrap();
        let north = map.local(&axes, DVec3::new(0.0, 100.0, 0.0)).unwrap();
        assert!((north.length() - 100.0).abs() < 0.1 && north.x.abs() > 4.0, "{north}");
        assert!((map.around(&axes, DVec3::ZERO).unwrap().rotation().determinant() - 1.0).abs() < 1e-12);
    }
}
