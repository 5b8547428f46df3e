//! Common projection and origin of all sources in a run.

use super::projection::Projection;
use super::{Crs, REMEDY};
use burgeon_base::error::{Error, Result};

/// Projection and origin of a run.
#[derive(Clone)]
pub struct ReferenceFrame {
    /// Name.
    pub name: String,
    /// Origin in the projection (m), in multiples of 100.
    pub origin: [f64; 2],
    /// Centre (longitude and latitude in degrees) of a transverse Mercator projection specific to the run.
    pub middle: Option<[f64; 2]>,
    /// EPSG code of the projection; `None` if it has none, or if its unit was changed to metres.
    pub epsg: Option<u16>,
    definition: String,
    projection: Projection,
}

impl ReferenceFrame {
    /// Maximum absolute coordinate (m) relative to the origin.
    pub const FARTHEST: f64 = 2_000_000.0;

    /// Returns the most suitable frame around the point `x`, `y` of `crs`, called `shown` in messages.
    /// ```
    /// use burgeon_spatial::{Crs, ReferenceFrame};
    ///
    /// // Finland's projection has its middle at 27 degrees east, where its metres say 500,000.
    /// let frame = ReferenceFrame::around(&Crs::epsg(3067)?, [500_040.0, 6_671_460.0], "a place")?;
    /// assert_eq!((frame.epsg, frame.origin), (Some(3067), [500_000.0, 6_671_500.0]));
    /// let degrees = Crs::epsg(4326)?;
    /// let passage = frame.passage(&degrees)?;
    /// let [x, y] = passage.enter([27.0, 60.18]);
    /// assert!(x.abs() < 1e-6);
    /// let back = passage.leave([x, y]);
    /// assert!((back[0] - 27.0).abs() < 1e-9 && (back[1] - 60.18).abs() < 1e-9);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn around(crs: &Crs, [x, y]: [f64; 2], shown: &str) -> Result<Self> {
        let source = crs.projection()?;
        let (name, definition, middle, epsg) = if crs.is_true() {
            let definition = crs.in_metres();
            let epsg = crs.code.filter(|_| normal(&definition) == normal(&crs.definition));
            (crs.name(), definition, None, epsg)
        } else {
            let degrees = if crs.is_geographic() {
                [x, y]
            } else {
                let mut point = (x, y, 0.0);
                source.bring(&Crs::epsg(4326)?.projection()?, &mut point).map_err(|error| {
                    Error::data(format!("{shown} cannot be projected: {error}")).help(REMEDY)
                })?;
                [point.0.to_degrees(), point.1.to_degrees()]
            };
            let middle = degrees.map(|angle| (angle * 10.0).round() / 10.0);
            let crs = Crs::around(middle);
            (crs.name(), crs.definition, Some(middle), None)
        };
        let cannot = |why| Error::argument(format!("{name} cannot be used: {why}")).help(REMEDY);
        let projection = Projection::new(&definition, cannot)?;
        let mut frame = Self { name, origin: [0.0; 2], middle, epsg, definition, projection };
        let centre = frame.passage(crs)?.enter([x, y]);
        frame.origin = centre.map(|value| (value / 100.0).round() * 100.0);
        if frame.origin.iter().any(|value| !value.is_finite()) {
            return Err(Error::data(format!("{shown} cannot be projected to {}", frame.name)).help(REMEDY));
        }
        Ok(frame)
    }

    /// Returns the PROJ definition of the projection.
    pub fn definition(&self) -> &str {
        &self.definition
    }

    /// Returns the transformation from `crs` into this frame and back.
    pub fn passage(&self, crs: &Crs) -> Result<Passage<'_>> {
        let stays = normal(&crs.definition) == normal(&self.definition);
        Ok(Passage { frame: self, outside: crs.projection()?, unit: crs.unit(), stays })
    }

    /// Returns true if a position in a frame (m) is close enough for a model.
    pub fn is_near(place: [f64; 2]) -> bool {
        // A comparison with NaN is false.
        place.iter().all(|value| value.abs() <= Self::FARTHEST)
    }
}

/// Transformation from a coordinate system into a frame and back.
pub struct Passage<'a> {
    frame: &'a ReferenceFrame,
    outside: Projection,
    /// Factor that converts the coordinates of the other system to radians, or 1.
    unit: f64,
    /// Set if both have the same projection, so only the origin differs.
    pub stays: bool,
}

impl Passage<'_> {
    /// Returns the position in the frame (m) of a point in the coordinate system; NaN if it cannot be projected.
    pub fn enter(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let mut point = (x * self.unit, y * self.unit, 0.0);
        if self.stays {
            point = (x, y, 0.0);
        } else if self.outside.bring(&self.frame.projection, &mut point).is_err() {
            return [f64::NAN; 2];
        }
        [point.0 - self.frame.origin[0], point.1 - self.frame.origin[1]]
    }

    /// Returns the point in the coordinate system at a position in the frame (m); NaN if it cannot be projected.
    pub fn leave(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let mut point = (x + self.frame.origin[0], y + self.frame.origin[1], 0.0);
        if self.stays {
            return [point.0, point.1];
        }
        match self.frame.projection.bring(&self.outside, &mut point) {
            Ok(()) => [point.0 / self.unit, point.1 / self.unit],
            Err(_) => [f64::NAN; 2],
        }
    }
}

/// Number of points on a side of a box that is transformed.
const SIDE: u32 = 16;

impl Passage<'_> {
    /// Returns a box in the coordinate system (west, south, east, north) that contains the box in the frame (m); `None` if
    /// it cannot be projected, or crosses the date line.
    pub fn leave_box(&self, [west, south, east, north]: [f64; 4]) -> Option<[f64; 4]> {
        if self.stays {
            let [[west, south], [east, north]] =
                [[west, south], [east, north]].map(|place| self.leave(place));
            // The sum with the origin is rounded.
            return Some([west - 0.01, south - 0.01, east + 0.01, north + 0.01]);
        }
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for part in 0..=SIDE {
            let at = |from: f64, to: f64| from + (to - from) * f64::from(part) / f64::from(SIDE);
            let (x, y) = (at(west, east), at(south, north));
            for place in [[x, south], [x, north], [west, y], [east, y]] {
                let place = self.leave(place);
                if !place.iter().all(|value| value.is_finite()) {
                    return None;
                }
                for axis in 0..2 {
                    (low[axis], high[axis]) = (low[axis].min(place[axis]), high[axis].max(place[axis]));
                }
            }
        }
        // The sides are curves that bulge between the points.
        let margin = [0, 1].map(|axis| (high[axis] - low[axis]) / 50.0 + 1e-9 * low[axis].abs());
        let is_split = self.unit < 1.0 && high[0] - low[0] > 180.0;
        (!is_split).then_some([
            low[0] - margin[0],
            low[1] - margin[1],
            high[0] + margin[0],
            high[1] + margin[1],
        ])
    }
}

/// Returns the sorted parts of a definition, without those that have no effect here.
fn normal(definition: &str) -> Vec<&str> {
    let mut parts: Vec<&str> = definition.split_whitespace().collect();
    parts.retain(|part| !matches!(*part, "+no_defs" | "+type=crs"));
    parts.sort_unstable();
    parts
}
