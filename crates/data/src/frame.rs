//! Frames of tables: the most suitable one, and the transformation into one.

use glam::DVec3;
use rayon::prelude::*;

use super::features::feature::Feature;
use super::features::table::FeatureTable;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::{number, shown};
use burgeon_spatial::crs::REMEDY;
use burgeon_spatial::{Crs, ReferenceFrame};

/// Returns the most suitable frame for `table`. Features with impossible positions are removed from the table.
///
/// A projected layer keeps its projection, in metres. A geographic layer, or a layer in Mercator projection, whose
/// lengths are too long, is projected by a transverse Mercator projection around its centre, rounded to 0.1
/// degrees. Lengths are then accurate to 1e-5 within 25 km of the centre, and north is up, whereas a UTM zone would
/// shorten all lengths by 4e-4 and rotate north by up to 3 degrees.
///
/// If features are too far apart for one model, those around the median decide.
pub(crate) fn frame_for(table: &mut FeatureTable) -> Result<ReferenceFrame> {
    let crs = table.crs.clone()?;
    refuse_odd_degrees(&crs, table)?;
    let (place, half) = centre(&crs, table, |_| true)?;
    let frame = ReferenceFrame::around(&crs, place, &table.shown)?;
    // Half of the maximum distance is close enough in any projection.
    if half * crs.metres() < ReferenceFrame::FARTHEST / 2.0 {
        return Ok(frame);
    }
    let reached = |frame: &ReferenceFrame| -> Result<Vec<bool>> {
        let passage = frame.passage(&crs)?;
        let near = |at: &DVec3| ReferenceFrame::is_near(passage.enter([at[0], at[1]]));
        Ok(table.features.par_iter().map(|feature| feature.geometry.points().all(near)).collect())
    };
    if reached(&frame)?.iter().all(|near| *near) {
        return Ok(frame);
    }
    let middle = ReferenceFrame::around(&crs, median(&crs, table), &table.shown)?;
    let near = reached(&middle)?;
    let mut each = near.iter();
    let Ok((place, _)) = centre(&crs, table, |_| each.next().is_some_and(|near| *near)) else {
        return Ok(frame);
    };
    let better = ReferenceFrame::around(&crs, place, &table.shown)?;
    let kept = reached(&better)?.iter().zip(&near).all(|(here, there)| here | !there);
    Ok(if kept { better } else { middle })
}

/// Transforms the features of `table` into `frame`; features without a position in it are removed.
pub(crate) fn bring_into(frame: &ReferenceFrame, table: &mut FeatureTable) -> Result<()> {
    let crs = table.crs.clone()?;
    refuse_odd_degrees(&crs, table)?;
    let passage = frame.passage(&crs)?;
    table.refuse_those(|name, feature| {
            let place = |point: &mut DVec3| -> Option<DVec3> {
                let was = *point;
                [point.x, point.y] = passage.enter([was.x, was.y]);
                let near = ReferenceFrame::is_near([point.x, point.y]) && was.z.abs() <= ReferenceFrame::FARTHEST;
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
                Error::data(format!("{feature} cannot be projected from {} to {}, at {at}", crs.name(), frame.name))
                    .help(REMEDY)
            })
        })
}

/// Removes features with coordinates that are not finite, or not valid degrees.
pub(super) fn refuse_odd_degrees(crs: &Crs, table: &mut FeatureTable) -> Result<()> {
    table.refuse_endless()?;
    if !crs.is_geographic() {
        return Ok(());
    }
    table.refuse_those(|name, feature| {
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
        bring_into(frame, &mut table).unwrap();
        table.features.iter().flat_map(|feature| feature.geometry.points().map(DVec3::to_array)).collect()
    }

    #[test]
    fn degrees_become_true_metres_with_north_up() {
        // A second of latitude at 45 degrees is 30.87 m, one of longitude 21.90 m.
        let second = 1.0 / 3600.0;
        let points = [[7.0, 45.0], [7.0, 45.0 + second], [7.0 + second, 45.0]];
        let frame = frame_for(&mut table(4326, &points)).unwrap();
        let [a, b, c] = placed(&frame, table(4326, &points))[..] else { panic!("three") };
        assert!((b[1] - a[1] - 30.8702).abs() < 1e-3 && (b[0] - a[0]).abs() < 1e-6, "{a:?} {b:?}");
        assert!((c[0] - a[0] - 21.9014).abs() < 1e-3 && (c[1] - a[1]).abs() < 1e-2, "{a:?} {c:?}");
        assert!(a.iter().all(|value| value.abs() < 100.0) && a[2] == 5.0);
    }

    #[test]
    fn projected_metres_stay_and_feet_and_mercator_become_metres() {
        let corner = [385_423.178, 6_671_463.227];
        let frame = frame_for(&mut table(3067, &[corner])).unwrap();
        assert_eq!((frame.origin, frame.name.as_str()), ([385_400.0, 6_671_500.0], "EPSG:3067"));
        let at = placed(&frame, table(3067, &[corner]))[0];
        assert_eq!(at[..2], [corner[0] - 385_400.0, corner[1] - 6_671_500.0]);
        // EPSG:2272 uses feet of 0.3048006 m.
        let feet = [[2_690_000.0, 235_000.0], [2_690_100.0, 235_000.0]];
        let frame = frame_for(&mut table(2272, &feet)).unwrap();
        let [a, b] = placed(&frame, table(2272, &feet))[..] else { panic!("two") };
        assert!((b[0] - a[0] - 30.480_06).abs() < 1e-4, "{a:?} {b:?}");
        // At 60 degrees, Mercator lengths are twice the true lengths.
        let mercator = [[1_113_194.908, 8_399_737.89], [1_113_294.908, 8_399_737.89]];
        let frame = frame_for(&mut table(3857, &mercator)).unwrap();
        let [a, b] = placed(&frame, table(3857, &mercator))[..] else { panic!("two") };
        assert!((b[0] - a[0] - 50.0).abs() < 0.3, "{a:?} {b:?}");
    }

    #[test]
    fn another_coordinate_system_comes_into_the_first_ones_frame() {
        // According to PROJ 9, 385600, 6671500 in EPSG:3067 is at about 24.93802 E, 60.16435 N; the round trip is
        // exact.
        let frame = frame_for(&mut table(3067, &[[385_600.0, 6_671_500.0]])).unwrap();
        let wgs = Crs::epsg(4326).unwrap();
        let point = frame.passage(&wgs).unwrap().leave([0.0; 2]);
        let [degrees] = placed(&frame, table(4326, &[point]))[..] else { panic!("one") };
        assert!(degrees[0].abs() < 1e-3 && degrees[1].abs() < 1e-3, "{degrees:?}");
        assert!((24.9..25.0).contains(&point[0]) && (60.1..60.2).contains(&point[1]));
    }

    #[test]
    fn a_layer_across_the_date_line_stays_together() {
        let points = [[179.9, -16.0], [-179.9, -16.0]];
        let frame = frame_for(&mut table(4326, &points)).unwrap();
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

    #[test]
    fn a_datum_without_a_shift_is_told_where_other_coordinates_are_derived() {
        let layer = |code: u32, at: [f64; 2], frame: &mut Option<ReferenceFrame>| {
            let mut table = FeatureTable::new("a", "a", Crs::epsg(code), &crate::SourceOptions::default());
            table.push("p", vec![Geometry::point([at[0], at[1], 0.0])], Vec::new()).unwrap();
            Layer::new(table, frame).unwrap().notes
        };
        // Anguilla 1957.
        let mut frame = None;
        let notes = layer(2000, [400_000.0, 2_014_000.0], &mut frame);
        assert!(notes[0].contains("no shift from Anguilla 1957 to WGS 84 is known"), "{notes:?}");
        // More coordinates of the same system lie right beside each other.
        assert!(layer(2000, [400_100.0, 2_014_000.0], &mut frame).is_empty());
        for (code, at) in
            [(3067, [385_000.0, 6_672_000.0]), (5514, [-740_000.0, -1_040_000.0]), (4326, [7.0, 44.0])]
        {
            assert!(layer(code, at, &mut None).is_empty(), "{code}");
        }
    }
}
