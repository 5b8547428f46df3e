//! Common projection and origin of all sources in a run.

use glam::DVec3;
use rayon::prelude::*;

use super::crs::projection::Projection;
use super::crs::{Crs, REMEDY};
use super::features::feature::Feature;
use super::features::table::FeatureTable;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::{number, shown};

/// Maximum absolute coordinate (m) relative to the origin.
pub(super) const FARTHEST: f64 = 2_000_000.0;

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
    /// Returns the most suitable frame for `table`. Features with impossible positions are removed from the table.
    ///
    /// A projected layer keeps its projection, in metres. A geographic layer, or a layer in Mercator projection, whose
    /// lengths are too long, is projected by a transverse Mercator projection around its centre, rounded to 0.1
    /// degrees. Lengths are then accurate to 1e-5 within 25 km of the centre, and north is up, whereas a UTM zone would
    /// shorten all lengths by 4e-4 and rotate north by up to 3 degrees.
    ///
    /// If features are too far apart for one model, those around the median decide.
    pub fn new(table: &mut FeatureTable) -> Result<Self> {
        let crs = table.crs.clone()?;
        refuse_odd_degrees(&crs, table)?;
        let (place, half) = centre(&crs, table, |_| true)?;
        let frame = Self::around(&crs, place, &table.shown)?;
        // Half of the maximum distance is close enough in any projection.
        if half * crs.metres() < FARTHEST / 2.0 {
            return Ok(frame);
        }
        let reached = |frame: &Self| -> Result<Vec<bool>> {
            let passage = frame.passage(&crs)?;
            let near = |at: &DVec3| is_near(passage.enter([at[0], at[1]]));
            Ok(table.features.par_iter().map(|feature| feature.geometry.points().all(near)).collect())
        };
        if reached(&frame)?.iter().all(|near| *near) {
            return Ok(frame);
        }
        let middle = Self::around(&crs, median(&crs, table), &table.shown)?;
        let near = reached(&middle)?;
        let mut each = near.iter();
        let Ok((place, _)) = centre(&crs, table, |_| each.next().is_some_and(|near| *near)) else {
            return Ok(frame);
        };
        let better = Self::around(&crs, place, &table.shown)?;
        let kept = reached(&better)?.iter().zip(&near).all(|(here, there)| here | !there);
        Ok(if kept { better } else { middle })
    }

    /// Returns the most suitable frame around the point `x`, `y` of `crs`, called `shown` in messages.
    /// ```
    /// use burgeon_data::{Crs, ReferenceFrame};
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

    /// Transforms the features of `table` into this frame; features without a position in it are removed.
    pub(super) fn bring(&self, table: &mut FeatureTable) -> Result<()> {
        let crs = table.crs.clone()?;
        refuse_odd_degrees(&crs, table)?;
        let passage = self.passage(&crs)?;
        let name = table.shown.clone();
        table.refuse_those(|feature| {
            let place = |point: &mut DVec3| -> Option<DVec3> {
                let was = *point;
                [point.x, point.y] = passage.enter([was.x, was.y]);
                let near = is_near([point.x, point.y]) && was.z.abs() <= FARTHEST;
                (!near).then_some(was)
            };
            let at = feature.geometry.points_mut().find_map(place)?;
            let feature = format!("feature {} of {name}", shown(&feature.id));
            let [x, y] = passage.enter([at[0], at[1]]);
            let at = format!("{}, {}", number(at[0]), number(at[1]));
            Some(if x.is_finite() && y.is_finite() {
                Error::data(format!("{feature} is more than 2,000 km from the centre, at {at}")).help(
                    "all sources of a run share one model; check the coordinates and the coordinate system, or read a part",
                )
            } else {
                Error::data(format!("{feature} cannot be projected from {} to {}, at {at}", crs.name(), self.name))
                    .help(REMEDY)
            })
        })
    }
}

/// Returns true if a position in a frame (m) is close enough for a model.
fn is_near(place: [f64; 2]) -> bool {
    // A comparison with NaN is false.
    place.iter().all(|value| value.abs() <= FARTHEST)
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

/// Removes features with coordinates that are not finite, or not valid degrees.
pub(super) fn refuse_odd_degrees(crs: &Crs, table: &mut FeatureTable) -> Result<()> {
    table.refuse_endless()?;
    if !crs.is_geographic() {
        return Ok(());
    }
    let name = table.shown.clone();
    table.refuse_those(|feature| {
        let DVec3 { x, y, .. } =
            *feature.geometry.points().find(|at| at.x.abs() > 360.0 || at.y.abs() > 90.0)?;
        let (id, x, y) = (shown(&feature.id), number(x), number(y));
        let message =
            format!("feature {id} of {name} is at {x}, {y}, which is not a valid longitude and latitude");
        let help = "specify the coordinate system of the file: source(file, { crs = 3067 })";
        Some(Error::data(message).help(help))
    })
}

/// Returns a position amid most features: the median of their first points along each axis.
fn median(crs: &Crs, table: &FeatureTable) -> [f64; 2] {
    let middle = |values: &mut Vec<f64>| {
        let half = values.len() / 2;
        if values.is_empty() { 0.0 } else { *values.select_nth_unstable_by(half, f64::total_cmp).1 }
    };
    let firsts = || table.features.iter().filter_map(|feature| feature.geometry.points().next());
    if !crs.is_geographic() {
        return [0, 1].map(|axis| middle(&mut firsts().map(|point| point[axis]).collect()));
    }
    // Longitudes have no order across the date line, but the coordinates of points on a sphere have.
    let on_sphere = firsts().map(|point| {
        let ((sin, cos), (up, out)) = (point[0].to_radians().sin_cos(), point[1].to_radians().sin_cos());
        [cos * out, sin * out, up]
    });
    let places: Vec<[f64; 3]> = on_sphere.collect();
    let [x, y, z] = [0, 1, 2].map(|axis| middle(&mut places.iter().map(|place| place[axis]).collect()));
    [y.atan2(x).to_degrees(), z.atan2(x.hypot(y)).to_degrees()]
}

/// Bounds of features in a coordinate system. Longitudes are relative to the first one, across the date line.
#[derive(Debug, Clone)]
pub(super) struct PointBounds {
    low: [f64; 2],
    high: [f64; 2],
    first: Option<f64>,
}

impl PointBounds {
    pub(super) fn new() -> Self {
        Self { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2], first: None }
    }

    /// Adds the points of `feature`; `is_geographic` if they are longitudes and latitudes.
    pub(super) fn add(&mut self, is_geographic: bool, feature: &Feature) {
        for point in feature.geometry.points() {
            let mut x = point[0];
            if is_geographic {
                let first = *self.first.get_or_insert(x);
                x = first + (x - first + 180.0).rem_euclid(360.0) - 180.0;
            }
            for (axis, value) in [x, point[1]].into_iter().enumerate() {
                self.low[axis] = self.low[axis].min(value);
                self.high[axis] = self.high[axis].max(value);
            }
        }
    }

    /// Returns the centre, and half of the longer side; `None` without points.
    pub(super) fn centre(&self) -> Option<([f64; 2], f64)> {
        let Self { low, high, .. } = self;
        let middle = [0, 1].map(|axis| (low[axis] + high[axis]) / 2.0);
        let half = (high[0] - low[0]).max(high[1] - low[1]) / 2.0;
        middle.iter().all(|value| value.is_finite()).then_some((middle, half))
    }
}

/// Returns the centre of the bounds of the features that `counts` accepts, and half of the longer side.
fn centre(
    crs: &Crs,
    table: &FeatureTable,
    mut counts: impl FnMut(&Feature) -> bool,
) -> Result<([f64; 2], f64)> {
    let (mut bounds, is_geographic) = (PointBounds::new(), crs.is_geographic());
    table
        .features
        .iter()
        .filter(|feature| counts(feature))
        .for_each(|feature| bounds.add(is_geographic, feature));
    bounds.centre().ok_or_else(|| Error::data(format!("{} has no features", table.shown)))
}

#[cfg(test)]
mod tests {
    use super::super::Geometry;
    use super::super::Layer;
    use super::*;

    fn table(code: u32, points: &[[f64; 2]]) -> FeatureTable {
        let mut table = FeatureTable::new("a", "a", Crs::epsg(code), &crate::SourceOptions::default());
        for [x, y] in points {
            table.push("p", vec![Geometry::point([*x, *y, 5.0])], Vec::new()).unwrap();
        }
        table
    }

    fn placed(frame: &ReferenceFrame, mut table: FeatureTable) -> Vec<[f64; 3]> {
        frame.bring(&mut table).unwrap();
        table.features.iter().flat_map(|feature| feature.geometry.points().map(DVec3::to_array)).collect()
    }

    #[test]
    fn degrees_become_true_metres_with_north_up() {
        // A second of latitude at 45 degrees is 30.87 m, one of longitude 21.90 m.
        let second = 1.0 / 3600.0;
        let points = [[7.0, 45.0], [7.0, 45.0 + second], [7.0 + second, 45.0]];
        let frame = ReferenceFrame::new(&mut table(4326, &points)).unwrap();
        let [a, b, c] = placed(&frame, table(4326, &points))[..] else { panic!("three") };
        assert!((b[1] - a[1] - 30.8702).abs() < 1e-3 && (b[0] - a[0]).abs() < 1e-6, "{a:?} {b:?}");
        assert!((c[0] - a[0] - 21.9014).abs() < 1e-3 && (c[1] - a[1]).abs() < 1e-2, "{a:?} {c:?}");
        assert!(a.iter().all(|value| value.abs() < 100.0) && a[2] == 5.0);
    }

    #[test]
    fn projected_metres_stay_and_feet_and_mercator_become_metres() {
        let corner = [385_423.178, 6_671_463.227];
        let frame = ReferenceFrame::new(&mut table(3067, &[corner])).unwrap();
        assert_eq!((frame.origin, frame.name.as_str()), ([385_400.0, 6_671_500.0], "EPSG:3067"));
        let at = placed(&frame, table(3067, &[corner]))[0];
        assert_eq!(at[..2], [corner[0] - 385_400.0, corner[1] - 6_671_500.0]);
        // EPSG:2272 uses feet of 0.3048006 m.
        let feet = [[2_690_000.0, 235_000.0], [2_690_100.0, 235_000.0]];
        let frame = ReferenceFrame::new(&mut table(2272, &feet)).unwrap();
        let [a, b] = placed(&frame, table(2272, &feet))[..] else { panic!("two") };
        assert!((b[0] - a[0] - 30.480_06).abs() < 1e-4, "{a:?} {b:?}");
        // At 60 degrees, Mercator lengths are twice the true lengths.
        let mercator = [[1_113_194.908, 8_399_737.89], [1_113_294.908, 8_399_737.89]];
        let frame = ReferenceFrame::new(&mut table(3857, &mercator)).unwrap();
        let [a, b] = placed(&frame, table(3857, &mercator))[..] else { panic!("two") };
        assert!((b[0] - a[0] - 50.0).abs() < 0.3, "{a:?} {b:?}");
    }

    #[test]
    fn another_coordinate_system_comes_into_the_first_ones_frame() {
        // According to PROJ 9, 385600, 6671500 in EPSG:3067 is at about 24.93802 E, 60.16435 N; the round trip is
        // exact.
        let frame = ReferenceFrame::new(&mut table(3067, &[[385_600.0, 6_671_500.0]])).unwrap();
        let wgs = Crs::epsg(4326).unwrap();
        let mut point = (385_600.0, 6_671_500.0, 0.0);
        frame.projection.bring(&wgs.projection().unwrap(), &mut point).unwrap();
        let [degrees] = placed(&frame, table(4326, &[[point.0.to_degrees(), point.1.to_degrees()]]))[..]
        else {
            panic!("one")
        };
        assert!(degrees[0].abs() < 1e-3 && degrees[1].abs() < 1e-3, "{degrees:?}");
        assert!((24.9..25.0).contains(&point.0.to_degrees()) && (60.1..60.2).contains(&point.1.to_degrees()));
    }

    #[test]
    fn a_layer_across_the_date_line_stays_together() {
        let points = [[179.9, -16.0], [-179.9, -16.0]];
        let frame = ReferenceFrame::new(&mut table(4326, &points)).unwrap();
        let [a, b] = placed(&frame, table(4326, &points))[..] else { panic!("two") };
        assert!((b[0] - a[0] - 21_400.0).abs() < 50.0, "{a:?} {b:?}");
    }

    #[test]
    fn what_lies_far_from_the_others_is_left_out_alone() {
        let town: Vec<[f64; 2]> = (0..20).map(|at| [2.29 + f64::from(at) * 1e-3, 48.85]).collect();
        let date_line: Vec<[f64; 2]> = town.iter().map(|at| [at[0] + 177.7, at[1]]).collect();
        let metres: Vec<[f64; 2]> = town.iter().map(|at| [at[0] * 1e5, 6_671_463.0]).collect();
        for (code, town) in [(4326, town), (4326, date_line), (3067, metres)] {
            let alone = Layer::new(table(code, &town), &mut None).unwrap();
            let odd: &[[f64; 2]] = match code {
                4326 => &[[0.0, 0.0], [-120.0, -80.0], [1e9, 1.0], [f64::NAN, 1.0], [20.0, 91.0]],
                _ => &[[0.0, 0.0], [1e300, 1.0], [f64::INFINITY, 1.0], [-3e6, 6e6], [4e6, 9e6]],
            };
            for at in [0, 7, 20] {
                let mut all = town.clone();
                all.splice(at..at, odd.iter().copied());
                let layer = Layer::new(table(code, &all), &mut None).unwrap();
                assert_eq!(
                    (layer.features.len(), layer.refused.len()),
                    (20, 5),
                    "{code} {:?}",
                    layer.refused
                );
                assert_eq!(
                    (layer.origin, &layer.crs, layer.bounds),
                    (alone.origin, &alone.crs, alone.bounds)
                );
            }
        }
    }

    #[test]
    fn coordinates_that_cannot_be_are_refused() {
        let told = |code: u32, x: f64, y: f64| {
            let layer = Layer::new(table(code, &[[x, y]]), &mut None);
            layer.err().map(|error| error.message().to_owned()).unwrap_or_default()
        };
        assert!(told(4326, 385_423.0, 6_671_463.0).contains("not a valid longitude and latitude"));
        assert!(told(4326, f64::NAN, 1.0).contains("not a finite number"));
        assert!(told(3067, f64::INFINITY, 1.0).contains("not a finite number"));
        assert!(told(12, 1.0, 1.0).contains("unknown coordinate system EPSG:12"));
        assert!(told(4978, 1.0, 1.0).contains("cannot be used"));
        assert!(told(99_999, 1.0, 1.0).contains("unknown coordinate system EPSG:99999"));
    }
}
