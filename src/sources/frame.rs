//! Coordinate systems, and the one projection and origin in which all sources of a run meet.

use std::borrow::Cow;

use proj4rs::Proj;
use proj4rs::transform::transform;
use rayon::prelude::*;

use super::table::{Feature, Table};
use crate::error::{Error, Result};

/// The farthest (m) that a coordinate may lie from the origin.
pub(super) const FARTHEST: f64 = 2_000_000.0;

/// What to do about a coordinate system that cannot be used.
const REMEDY: &str = "name the right one: source(file, { crs = 4326 }), or convert the file to EPSG:4326";

/// A coordinate system: of the EPSG's registry, or a transverse Mercator projection around a middle.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Crs {
    /// Its number in the registry.
    pub code: Option<u16>,
    name: String,
    definition: Cow<'static, str>,
}

impl Crs {
    /// The coordinate system with the number `code`.
    pub fn epsg(code: u32) -> Result<Self> {
        // Numbers that were in use before there was one of EPSG's.
        let code = if matches!(code, 900_913 | 102_100 | 102_113) { 3857 } else { code };
        let found = u16::try_from(code).ok().and_then(crs_definitions::from_code);
        let found = found.ok_or_else(|| {
            Error::new(format!("the coordinate system EPSG:{code} is not known")).help(REMEDY)
        })?;
        let definition = Cow::Borrowed(found.proj4);
        Ok(Self { code: Some(found.code), name: format!("EPSG:{}", found.code), definition })
    }

    /// The transverse Mercator projection around a middle, a longitude and a latitude (degrees) of WGS 84, from where
    /// its metres are counted.
    pub(crate) fn around([longitude, latitude]: [f64; 2]) -> Self {
        Self {
            code: None,
            name: format!("transverse Mercator around {longitude:?}, {latitude:?}"),
            definition: Cow::Owned(format!(
                "+proj=tmerc +lat_0={latitude:?} +lon_0={longitude:?} +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m +no_defs"
            )),
        }
    }

    /// Such as `EPSG:3067`.
    pub fn name(&self) -> String {
        self.name.clone()
    }

    /// Whether coordinates are longitude and latitude (degrees).
    pub fn is_geographic(&self) -> bool {
        self.definition.contains("+proj=longlat")
    }

    /// What its angles are multiplied by to be radians; 1 where it has none.
    fn unit(&self) -> f64 {
        if self.is_geographic() { 1f64.to_radians() } else { 1.0 }
    }

    fn projection(&self) -> Result<Proj> {
        let cannot = |why: String| {
            Error::new(format!("the coordinate system {} cannot be used: {why}", self.name())).help(REMEDY)
        };
        if self.definition.contains("+proj=geocent") {
            return Err(cannot("it counts from the centre of the earth".into()));
        }
        Proj::from_proj_string(&self.definition).map_err(|error| cannot(error.to_string()))
    }

    /// Whether its metres are those of the ground, but for the thousandths that every projection costs.
    fn is_true(&self) -> bool {
        !self.is_geographic() && !matches!(self.code, Some(3857 | 3785 | 3395))
    }

    /// Its definition with metres as the unit, and with east and north.
    fn in_metres(&self) -> String {
        let kept = self.definition.split_whitespace().filter(|part| {
            !["+units=", "+to_meter=", "+axis="].iter().any(|prefix| part.starts_with(prefix))
        });
        format!("{} +units=m", kept.collect::<Vec<_>>().join(" "))
    }
}

/// The projection and the origin of a run.
#[derive(Clone)]
pub struct Frame {
    /// What it is called.
    pub name: String,
    /// Where its origin lies in the projection (m): whole hundreds.
    pub origin: [f64; 2],
    /// The longitude and the latitude (degrees) that a transverse Mercator projection of the run's own is around.
    pub middle: Option<[f64; 2]>,
    definition: String,
    projection: Proj,
}

impl Frame {
    /// The frame that suits `table` best.
    ///
    /// A projected layer keeps its projection, in metres. A geographic one, or one in Mercator's projection, whose
    /// metres are longer than those of the ground, is projected by a transverse Mercator projection around its
    /// centre, rounded to a tenth of a degree: lengths are true to 1e-5 within 25 km of it, and north is up, where
    /// a UTM zone would shorten all lengths by 4e-4 and turn north by up to 3 degrees.
    pub fn new(table: &Table) -> Result<Self> {
        let crs = table.crs.clone()?;
        check_degrees(&crs, table)?;
        Self::around(&crs, centre(&crs, table)?, &table.shown)
    }

    /// The frame that suits best what lies around the point `x`, `y` of `crs`, and is called `shown`.
    pub fn around(crs: &Crs, [x, y]: [f64; 2], shown: &str) -> Result<Self> {
        let source = crs.projection()?;
        let (name, definition, middle) = if crs.is_true() {
            (crs.name(), crs.in_metres(), None)
        } else {
            let degrees = if crs.is_geographic() {
                [x, y]
            } else {
                let mut point = (x, y, 0.0);
                transform(&source, &Crs::epsg(4326)?.projection()?, &mut point).map_err(|error| {
                    Error::new(format!("{shown} cannot be projected: {error}")).help(REMEDY)
                })?;
                [point.0.to_degrees(), point.1.to_degrees()]
            };
            let middle = degrees.map(|angle| (angle * 10.0).round() / 10.0);
            let crs = Crs::around(middle);
            (crs.name(), crs.definition.into_owned(), Some(middle))
        };
        let projection = Proj::from_proj_string(&definition)
            .map_err(|error| Error::new(format!("{name} cannot be used: {error}")).help(REMEDY))?;
        let mut frame = Self { name, origin: [0.0; 2], middle, definition, projection };
        let centre = frame.passage(crs)?.enter([x, y]);
        frame.origin = centre.map(|value| (value / 100.0).round() * 100.0);
        if frame.origin.iter().any(|value| !value.is_finite()) {
            return Err(Error::new(format!("{shown} cannot be projected to {}", frame.name)).help(REMEDY));
        }
        Ok(frame)
    }

    /// The way from `crs` into this frame, and back.
    pub(super) fn passage(&self, crs: &Crs) -> Result<Passage<'_>> {
        let stays = normal(&crs.definition) == normal(&self.definition);
        Ok(Passage { frame: self, outside: crs.projection()?, unit: crs.unit(), stays })
    }

    /// The EPSG code of its projection; `None` if it is none of EPSG's, or one whose unit was changed to metres.
    pub fn epsg(&self) -> Option<u16> {
        let crs = Crs::epsg(self.name.strip_prefix("EPSG:")?.parse().ok()?).ok()?;
        if normal(&crs.definition) == normal(&self.definition) { crs.code } else { None }
    }

    /// Brings the features of `table` into this frame.
    pub(super) fn bring(&self, table: &mut Table) -> Result<()> {
        let crs = table.crs.clone()?;
        check_degrees(&crs, table)?;
        let passage = self.passage(&crs)?;
        let shown = &table.shown;
        let place = |feature: &mut Feature| -> Option<Error> {
            for point in feature.geometry.points_mut() {
                let was = *point;
                [point[0], point[1]] = passage.enter([was[0], was[1]]);
                // A comparison with what is no number fails.
                if point.iter().all(|value| value.abs() <= FARTHEST) {
                    continue;
                }
                let where_ = format!("feature {} of {shown}", feature.id);
                let at = format!("{}, {}", was[0], was[1]);
                return Some(if point.iter().all(|value| value.is_finite()) {
                    Error::new(format!("{where_} lies more than 2,000 km from the middle, at {at}")).help(
                        "all sources of a run share one model; check the coordinates and the coordinate system, or read a part",
                    )
                } else {
                    Error::new(format!(
                        "{where_} cannot be projected from {} to {}, at {at}",
                        crs.name(),
                        self.name
                    ))
                    .help(REMEDY)
                });
            }
            None
        };
        table.features.par_iter_mut().find_map_first(place).map_or(Ok(()), Err)
    }
}

/// The way from a coordinate system into a frame, and back.
pub(super) struct Passage<'a> {
    frame: &'a Frame,
    outside: Proj,
    /// What the outside's coordinates are multiplied by to be radians, or 1.
    unit: f64,
    /// Whether both have the same projection, so that coordinates stay as they are.
    pub(super) stays: bool,
}

impl Passage<'_> {
    /// Where a point of the coordinate system lies in the frame (m); NaN if it cannot be projected.
    pub(super) fn enter(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let mut point = (x * self.unit, y * self.unit, 0.0);
        if self.stays {
            point = (x, y, 0.0);
        } else if transform(&self.outside, &self.frame.projection, &mut point).is_err() {
            return [f64::NAN; 2];
        }
        [point.0 - self.frame.origin[0], point.1 - self.frame.origin[1]]
    }

    /// Which point of the coordinate system lies at a place of the frame (m); NaN if it cannot be projected.
    pub(super) fn leave(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let mut point = (x + self.frame.origin[0], y + self.frame.origin[1], 0.0);
        if self.stays {
            return [point.0, point.1];
        }
        match transform(&self.frame.projection, &self.outside, &mut point) {
            Ok(()) => [point.0 / self.unit, point.1 / self.unit],
            Err(_) => [f64::NAN; 2],
        }
    }
}

/// The parts of a definition in the order of the alphabet, without those that mean nothing here.
fn normal(definition: &str) -> Vec<&str> {
    let mut parts: Vec<&str> = definition.split_whitespace().collect();
    parts.retain(|part| !matches!(*part, "+no_defs" | "+type=crs"));
    parts.sort_unstable();
    parts
}

/// Refuses coordinates that are no numbers, and degrees that there are not.
fn check_degrees(crs: &Crs, table: &Table) -> Result<()> {
    let wrong =
        |feature: &Feature, why: &str| Error::new(format!("feature {} of {} {why}", feature.id, table.shown));
    let geographic = crs.is_geographic();
    let look = |feature: &Feature| -> Option<Error> {
        for point in feature.geometry.points() {
            if point.iter().any(|value| !value.is_finite()) {
                let error = wrong(feature, "has a coordinate that is not a finite number");
                return Some(error.help("repair the file, or leave the feature out"));
            }
            if geographic && (point[0].abs() > 360.0 || point[1].abs() > 90.0) {
                let what = format!("lies at {}, {}, which is no longitude and latitude", point[0], point[1]);
                let error = wrong(feature, &what);
                return Some(
                    error.help("name the coordinate system of the file: source(file, { crs = 3067 })"),
                );
            }
        }
        None
    };
    table.features.par_iter().find_map_first(look).map_or(Ok(()), Err)
}

/// The middle of the features' bounds. Longitudes are counted on from the first one, across the date line.
fn centre(crs: &Crs, table: &Table) -> Result<[f64; 2]> {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    let (mut first, geographic) = (None, crs.is_geographic());
    for point in table.features.iter().flat_map(|feature| feature.geometry.points()) {
        let mut x = point[0];
        if geographic {
            let first = *first.get_or_insert(x);
            x = first + (x - first + 180.0).rem_euclid(360.0) - 180.0;
        }
        for (axis, value) in [x, point[1]].into_iter().enumerate() {
            low[axis] = low[axis].min(value);
            high[axis] = high[axis].max(value);
        }
    }
    let middle = [0, 1].map(|axis| (low[axis] + high[axis]) / 2.0);
    if middle.iter().all(|value| value.is_finite()) {
        Ok(middle)
    } else {
        Err(Error::new(format!("{} has no features", table.shown)))
    }
}

#[cfg(test)]
mod tests {
    use super::super::table::Geometry;
    use super::*;

    fn table(code: u32, points: &[[f64; 2]]) -> Table {
        let mut table = Table::new("a", "a", Crs::epsg(code));
        for [x, y] in points {
            table.push("p", vec![Geometry::Point([*x, *y, 5.0])], Vec::new());
        }
        table
    }

    fn placed(frame: &Frame, mut table: Table) -> Vec<[f64; 3]> {
        frame.bring(&mut table).unwrap();
        table.features.iter().flat_map(|feature| feature.geometry.points().copied()).collect()
    }

    #[test]
    fn degrees_become_true_metres_with_north_up() {
        // A second of latitude at 45 degrees is 30.87 m, one of longitude 21.90 m.
        let second = 1.0 / 3600.0;
        let points = [[7.0, 45.0], [7.0, 45.0 + second], [7.0 + second, 45.0]];
        let frame = Frame::new(&table(4326, &points)).unwrap();
        let [a, b, c] = placed(&frame, table(4326, &points))[..] else { panic!("three") };
        assert!((b[1] - a[1] - 30.8702).abs() < 1e-3 && (b[0] - a[0]).abs() < 1e-6, "{a:?} {b:?}");
        assert!((c[0] - a[0] - 21.9014).abs() < 1e-3 && (c[1] - a[1]).abs() < 1e-2, "{a:?} {c:?}");
        assert!(a.iter().all(|value| value.abs() < 100.0) && a[2] == 5.0);
    }

    #[test]
    fn projected_metres_stay_and_feet_and_mercator_become_metres() {
        let corner = [385_423.178, 6_671_463.227];
        let frame = Frame::new(&table(3067, &[corner])).unwrap();
        assert_eq!((frame.origin, frame.name.as_str()), ([385_400.0, 6_671_500.0], "EPSG:3067"));
        let at = placed(&frame, table(3067, &[corner]))[0];
        assert_eq!(at[..2], [corner[0] - 385_400.0, corner[1] - 6_671_500.0]);
        // EPSG:2272 counts in feet of 0.3048006 m.
        let feet = [[2_690_000.0, 235_000.0], [2_690_100.0, 235_000.0]];
        let frame = Frame::new(&table(2272, &feet)).unwrap();
        let [a, b] = placed(&frame, table(2272, &feet))[..] else { panic!("two") };
        assert!((b[0] - a[0] - 30.480_06).abs() < 1e-4, "{a:?} {b:?}");
        // At 60 degrees Mercator's metres are twice those of the ground.
        let mercator = [[1_113_194.908, 8_399_737.89], [1_113_294.908, 8_399_737.89]];
        let frame = Frame::new(&table(3857, &mercator)).unwrap();
        let [a, b] = placed(&frame, table(3857, &mercator))[..] else { panic!("two") };
        assert!((b[0] - a[0] - 50.0).abs() < 0.3, "{a:?} {b:?}");
    }

    #[test]
    fn another_coordinate_system_comes_into_the_first_ones_frame() {
        // PROJ 9 has 385600, 6671500 of EPSG:3067 at 24.93802 E, 60.16435 N or so; there and back is exact.
        let frame = Frame::new(&table(3067, &[[385_600.0, 6_671_500.0]])).unwrap();
        let wgs = Crs::epsg(4326).unwrap();
        let mut point = (385_600.0, 6_671_500.0, 0.0);
        transform(&frame.projection, &wgs.projection().unwrap(), &mut point).unwrap();
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
        let frame = Frame::new(&table(4326, &points)).unwrap();
        let [a, b] = placed(&frame, table(4326, &points))[..] else { panic!("two") };
        assert!((b[0] - a[0] - 21_400.0).abs() < 50.0, "{a:?} {b:?}");
    }

    #[test]
    fn coordinates_that_cannot_be_are_refused() {
        let told = |code: u32, x: f64, y: f64| {
            let table = table(code, &[[x, y]]);
            let error = table.crs.clone().err().or_else(|| Frame::new(&table).err());
            error.map(|error| error.message().to_owned()).unwrap_or_default()
        };
        assert!(told(4326, 385_423.0, 6_671_463.0).contains("no longitude and latitude"));
        assert!(told(4326, f64::NAN, 1.0).contains("not a finite number"));
        assert!(told(3067, f64::INFINITY, 1.0).contains("not a finite number"));
        assert!(told(12, 1.0, 1.0).contains("EPSG:12 is not known"));
        assert!(told(4978, 1.0, 1.0).contains("cannot be used"));
        assert!(told(99_999, 1.0, 1.0).contains("EPSG:99999 is not known"));
    }
}
