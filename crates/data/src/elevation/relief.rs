//! Raster in the metres of a run, with the height at each position.

use std::fmt;
use std::sync::Arc;

use glam::{DMat2, DVec2, DVec3};

use super::lattice::Lattice;
use super::raster::Raster;
use crate::heights::{SampleGrid, count};
use burgeon_base::error::{Error, Result};
use burgeon_spatial::ReferenceFrame;

/// Number of parts into which each edge is divided to compute the bounding box.
const PIECES: usize = 256;
/// Tolerance (samples) for positions beyond the edge, because projecting rounds.
const ROUNDING: f64 = 1e-6;
/// Tolerance (samples) for finding the position of a sample, and maximum number of iterations.
const CLOSE: f64 = 1e-9;
const MOST_STEPS: usize = 12;

/// Measured heights over the terrain of a run; immutable.
pub struct Relief {
    raster: Arc<Raster>,
    way: RasterMapping,
    low: DVec3,
    high: DVec3,
    step: f64,
    /// Distances (m) between adjacent samples at the centre, from west to east and from south to north.
    unit: DVec2,
}

/// Mapping from positions (m) to columns and rows of the raster, counted from the centre of the first sample.
enum RasterMapping {
    /// Mapping between parallel axes.
    Straight { first: DVec2, step: DVec2 },
    /// Mapping through a projection.
    Bent(Lattice),
}

impl fmt::Debug for Relief {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "relief of {} x {} heights", self.raster.columns, self.raster.rows)
    }
}

impl Relief {
    /// Transforms `raster` into `frame`; creates the frame if there is none. A raster without a coordinate system is in
    /// the metres of the run, and creates no frame.
    ///
    /// Fails if the raster cannot be projected, or is too far away.
    pub fn new(raster: Arc<Raster>, frame: &mut Option<ReferenceFrame>) -> Result<Self> {
        let Some(crs) = &raster.crs else {
            let SampleGrid { first, step } = raster.grid;
            let way = RasterMapping::Straight { first: first.into(), step: step.into() };
            let edge = corners(&raster, 1);
            return Self::along(raster, way, edge, step.into());
        };
        let [west, south, east, north] = raster.bounds();
        let middle = [(west + east) / 2.0, (south + north) / 2.0];
        let frame = match frame {
            Some(frame) => frame,
            None => frame.insert(ReferenceFrame::around(crs, middle, &raster.name)?),
        };
        let passage = frame.passage(crs)?;
        let edge: Vec<DVec2> = corners(&raster, PIECES);
        let edge: Vec<DVec2> = edge.into_iter().map(|at| passage.enter(at.into()).into()).collect();
        let SampleGrid { first, step } = raster.grid;
        let at = |x: f64, y: f64| DVec2::from(passage.enter([x, y]));
        let begin = at(middle[0], middle[1]);
        let steps = [at(middle[0] + step[0], middle[1]), at(middle[0], middle[1] + step[1])];
        let unit = DVec2::from(steps.map(|end| end.distance(begin)));
        let way = if passage.stays {
            RasterMapping::Straight {
                first: DVec2::from(first) - DVec2::from(frame.origin),
                step: step.into(),
            }
        } else {
            let (low, high) = around(&edge);
            check_near(&raster, low, high)?;
            let exact = |place: DVec2| {
                let [mut x, y] = passage.leave(place.into());
                if crs.is_geographic() {
                    // Across the date line, longitudes continue.
                    x = middle[0] + (x - middle[0] + 180.0).rem_euclid(360.0) - 180.0;
                }
                DVec2::new((x - first[0]) / step[0], (first[1] - y) / step[1])
            };
            RasterMapping::Bent(Lattice::over(low, high, unit, exact).ok_or_else(|| {
                Error::data(format!(
                    "{} cannot be projected from {} to {}",
                    raster.name,
                    crs.name(),
                    frame.name
                ))
                .help("cut out a part of it, or convert it: gdalwarp -t_srs EPSG:4326 IN OUT.tif")
            })?)
        };
        Self::along(raster, way, edge, unit)
    }

    /// Creates a relief from a raster with a known edge (m) and mapping.
    fn along(raster: Arc<Raster>, way: RasterMapping, edge: Vec<DVec2>, unit: DVec2) -> Result<Self> {
        let (low, high) = around(&edge);
        check_near(&raster, low, high)?;
        let [lowest, highest] = raster.range().map(f64::from);
        let (low, high) = (low.extend(lowest), high.extend(highest));
        Ok(Self { raster, way, low, high, step: unit.min_element(), unit })
    }

    /// Returns the raster.
    pub fn raster(&self) -> &Raster {
        &self.raster
    }

    /// Returns the minimum corner of the bounding box (m).
    pub fn low(&self) -> DVec3 {
        self.low
    }

    /// Returns the maximum corner of the bounding box (m).
    pub fn high(&self) -> DVec3 {
        self.high
    }

    /// Returns the distance (m) between adjacent samples at the centre, in the direction where it is smaller.
    pub fn step(&self) -> f64 {
        self.step
    }

    /// Returns the height (m) at `place` (m), interpolated between the surrounding samples; `None` outside the raster.
    ///
    /// The surface passes through the samples with a continuous slope, and stays within the range of the 16 surrounding
    /// samples. Method: Catmull and Rom, "A class of local interpolating splines", 1974, in both directions.
    ///
    /// ```
    /// use burgeon_data::elevation::{Raster, Relief, SampleGrid};
    /// use glam::DVec2;
    /// use std::sync::Arc;
    ///
    /// // A slope to the east: samples every 10 m, in rows from the north.
    /// let heights = (0..25).map(|at| (at % 5) as f32).collect();
    /// let grid = SampleGrid { first: [0.0, 40.0], step: [10.0, 10.0] };
    /// let relief = Relief::new(Arc::new(Raster::new("slope", [5, 5], heights, grid, None)), &mut None)?;
    /// assert_eq!(relief.height(DVec2::new(20.0, 20.0)), Some(2.0));
    /// assert!((relief.height(DVec2::new(15.0, 20.0)).expect("inside") - 1.5).abs() < 1e-6);
    /// assert_eq!(relief.height(DVec2::new(100.0, 20.0)), None);
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn height(&self, place: DVec2) -> Option<f64> {
        let at = self.find(place)?;
        self.raster.covers(at.x, at.y, ROUNDING).then(|| self.around(at).0)
    }

    /// Returns the height (m) and the slope (m/m) at `place` (m), also slightly outside the raster; `None` far away.
    /// The height is linear between samples unless `smooth` is set.
    pub fn ground(&self, place: DVec2, smooth: bool) -> Option<(f64, f64)> {
        let at = self.find(place).filter(|at| at.is_finite())?;
        // Outside all parts, the terrain continues for one sample.
        if !self.raster.parts.is_empty() && !self.raster.covers(at.x, at.y, 1.0) {
            return None;
        }
        let (height, slope) = self.around(at);
        Some((if smooth { height } else { self.straight(at) }, slope))
    }

    /// Returns the column and the row of the last sample.
    fn last(&self) -> DVec2 {
        DVec2::new(count(self.raster.columns - 1), count(self.raster.rows - 1))
    }

    /// Returns the smooth height (m) and the slope (m/m) at a column and a row; the terrain is level beyond the
    /// outermost samples.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the samples")]
    fn around(&self, at: DVec2) -> (f64, f64) {
        let at = at.clamp(DVec2::ZERO, self.last());
        let (column, row) = (at.x as usize, at.y as usize);
        let part = at - at.floor();
        let (u, v) = (weights(part.x), weights(part.y));
        let (du, dv) = (changes(part.x), changes(part.y));
        let (columns, rows) = (self.raster.columns, self.raster.rows);
        let across = around_index(column, columns);
        let (mut sum, mut low, mut high) = (0.0, f64::INFINITY, f64::NEG_INFINITY);
        let mut slope = DVec2::ZERO;
        for (line, (weight, change)) in around_index(row, rows).into_iter().zip(v.into_iter().zip(dv)) {
            let line = &self.raster.heights[line * columns..][..columns];
            let samples = across.map(|column| f64::from(line[column]));
            for (sample, (part, by)) in samples.into_iter().zip(u.into_iter().zip(du)) {
                sum += sample * part * weight;
                slope += sample * DVec2::new(by * weight, part * change);
                low = low.min(sample);
                high = high.max(sample);
            }
        }
        (sum.clamp(low, high), (slope / self.unit).length())
    }

    /// Returns the height (m) at a column and a row, interpolated linearly between samples.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the samples")]
    fn straight(&self, at: DVec2) -> f64 {
        let at = at.clamp(DVec2::ZERO, self.last());
        let (column, row) = (at.x as usize, at.y as usize);
        let part = at - at.floor();
        let [_, west, east, _] = around_index(column, self.raster.columns);
        let [_, north, south, _] = around_index(row, self.raster.rows);
        let sample =
            |column: usize, row: usize| f64::from(self.raster.heights[row * self.raster.columns + column]);
        let along = |row: usize| sample(west, row) * (1.0 - part.x) + sample(east, row) * part.x;
        along(north) * (1.0 - part.y) + along(south) * part.y
    }

    /// Returns the positions (m) of the samples in the box from `low` to `high` (m), row by row.
    pub fn samples(&self, low: DVec2, high: DVec2) -> Vec<DVec2> {
        let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
        // A projected raster may bulge beyond the box between its corners, by less than one sample per 1/16 of a side.
        let along = (0..4).flat_map(|side| (0..16).map(move |part| (side, f64::from(part) / 16.0)));
        let rim: Vec<DVec2> = along
            .filter_map(|(side, part)| self.find(corners[side].lerp(corners[(side + 1) % 4], part)))
            .collect();
        let (first, last) = around(&rim);
        if !(first.is_finite() && last.is_finite()) {
            return Vec::new();
        }
        let first = (first.ceil() - 1.0).max(DVec2::ZERO);
        let last = (last.floor() + 1.0).min(self.last());
        let mut places = Vec::new();
        let mut row = first.y;
        while row <= last.y {
            let mut column = first.x;
            let mut near = low.midpoint(high);
            while column <= last.x {
                near = self.place(DVec2::new(column, row), near);
                if self.raster.covers(column, row, 0.0) && near.cmpge(low).all() && near.cmple(high).all() {
                    places.push(near);
                }
                column += 1.0;
            }
            row += 1.0;
        }
        places
    }

    /// Returns the position (m) of a column and a row, starting the search at the nearby position `near` (m).
    fn place(&self, at: DVec2, near: DVec2) -> DVec2 {
        match &self.way {
            RasterMapping::Straight { first, step } => {
                DVec2::new(first.x + at.x * step.x, first.y - at.y * step.y)
            }
            RasterMapping::Bent(lattice) => {
                // Newton's method: the lattice is nearly linear.
                let mut place = near;
                for _ in 0..MOST_STEPS {
                    let off = at - lattice.at(place);
                    let [east, north] = [DVec2::X, DVec2::Y]
                        .map(|way| lattice.at(place + way * self.step) - lattice.at(place));
                    let by = DMat2::from_cols(east, north).inverse() * off * self.step;
                    place += by;
                    // A step that is not a number does not improve the position either.
                    if by.length() <= self.step * CLOSE || by.is_nan() {
                        break;
                    }
                }
                place
            }
        }
    }

    /// Returns the relative distance of a position (m) from the nearest samples: 0 at a measured height, 1 halfway
    /// between two or four samples, smooth in between.
    pub fn between(&self, place: DVec2) -> f64 {
        let Some(at) = self.find(place) else { return 0.0 };
        let [x, y] = at.to_array().map(|at| (at * std::f64::consts::PI).cos().powi(2));
        1.0 - x * y
    }

    /// Returns the column and the row of a position (m); `None` far outside, where the lattice is not defined.
    fn find(&self, place: DVec2) -> Option<DVec2> {
        match &self.way {
            RasterMapping::Straight { first, step } => {
                Some(DVec2::new((place.x - first.x) / step.x, (first.y - place.y) / step.y))
            }
            RasterMapping::Bent(lattice) => {
                let (low, high) = (self.low.truncate() - self.step, self.high.truncate() + self.step);
                (place.cmpge(low).all() && place.cmple(high).all()).then(|| lattice.at(place))
            }
        }
    }
}

/// Returns points along the edge of a raster in its own coordinates, `pieces` per side.
fn corners(raster: &Raster, pieces: usize) -> Vec<DVec2> {
    let [west, south, east, north] = raster.bounds();
    let corners = [(west, south), (east, south), (east, north), (west, north)].map(DVec2::from);
    let sides = (0..4).map(|side| (corners[side], corners[(side + 1) % 4]));
    let along = |(from, to): (DVec2, DVec2)| {
        (0..pieces).map(move |piece| from.lerp(to, count(piece) / count(pieces)))
    };
    sides.flat_map(along).collect()
}

/// Returns the corners of the bounding box of points, ignoring NaN.
fn around(points: &[DVec2]) -> (DVec2, DVec2) {
    let known = || points.iter().filter(|point| point.is_finite());
    let low = known().fold(DVec2::INFINITY, |low, point| low.min(*point));
    (low, known().fold(DVec2::NEG_INFINITY, |high, point| high.max(*point)))
}

/// Fails if the raster is too far from the origin, or has no finite position.
fn check_near(raster: &Raster, low: DVec2, high: DVec2) -> Result<()> {
    let corners = [low.x, low.y, high.x, high.y];
    if corners.iter().all(|value| value.abs() <= ReferenceFrame::FARTHEST) {
        return Ok(());
    }
    let [west, south, ..] = raster.bounds();
    if raster.crs.is_none() {
        return Err(Error::data(format!(
            "{} has no coordinate system, and its coordinates are too large for metres of the run: {west}, {south}",
            raster.name
        ))
        .help("specify its EPSG code: elevation(file, { crs = 3067 }), or put a .prj file next to it"));
    }
    Err(Error::data(format!(
        "{} is more than 2,000 km from the centre, or extends that far, at {west}, {south}",
        raster.name
    ))
    .help("all sources of a run share one model; check the coordinates and the coordinate system, or cut out a part"))
}

/// Returns the indices of the samples before, at, and the two after `index`, limited to `number`.
#[inline]
fn around_index(index: usize, number: usize) -> [usize; 4] {
    [index.saturating_sub(1), index, (index + 1).min(number - 1), (index + 2).min(number - 1)]
}

/// Returns the weights of four consecutive samples at `t` between the middle ones.
#[inline]
fn weights(t: f64) -> [f64; 4] {
    let (a, b) = (t * t, t * t * t);
    [(2.0 * a - b - t) / 2.0, (2.0 - 5.0 * a + 3.0 * b) / 2.0, (t + 4.0 * a - 3.0 * b) / 2.0, (b - a) / 2.0]
}

/// Returns the derivatives of the weights with respect to `t`.
#[inline]
fn changes(t: f64) -> [f64; 4] {
    let a = t * t;
    [
        (4.0 * t - 3.0 * a - 1.0) / 2.0,
        (9.0 * a - 10.0 * t) / 2.0,
        (1.0 + 8.0 * t - 9.0 * a) / 2.0,
        (3.0 * a - 2.0 * t) / 2.0,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use burgeon_spatial::Crs;

    /// Returns a raster of `columns` by `rows` heights at `first` with `step`, computed by `height`.
    fn raster(
        (columns, rows): (usize, usize),
        grid: SampleGrid,
        code: Option<u32>,
        height: impl Fn(f64, f64) -> f64,
    ) -> Arc<Raster> {
        let heights = (0..columns * rows).map(|at| height(count(at % columns), count(at / columns)) as f32);
        let crs = code.map(|code| Crs::epsg(code).unwrap());
        Arc::new(Raster::new("a", [columns, rows], heights.collect(), grid, crs))
    }

    #[test]
    fn a_slope_goes_on_between_samples_and_ends_level_at_the_edge() {
        let grid = SampleGrid { first: [100.0, 50.0], step: [10.0, 5.0] };
        let relief = Relief::new(raster((8, 9), grid, None, |x, y| 3.0 * x - 2.0 * y), &mut None).unwrap();
        let at = |x: f64, y: f64| relief.height(DVec2::new(x, y));
        // Column 2.5 and row 3.2.
        assert!((at(125.0, 34.0).unwrap() - (7.5 - 6.4)).abs() < 1e-9);
        assert_eq!(at(110.0, 45.0), Some(1.0));
        assert_eq!((at(95.0, 50.0), at(94.9, 50.0), at(95.0, 52.6)), (Some(0.0), None, None));
        assert_eq!(at(f64::NAN, 40.0), None);
        assert_eq!(
            (relief.low(), relief.high()),
            (DVec3::new(95.0, 7.5, -16.0), DVec3::new(175.0, 52.5, 21.0))
        );
        assert_eq!(relief.step(), 5.0);
    }

    #[test]
    fn a_step_does_not_overshoot() {
        let grid = SampleGrid { first: [0.0, 0.0], step: [1.0; 2] };
        let cliff = raster((10, 10), grid, None, |x, _| if x < 5.0 { 0.0 } else { 100.0 });
        let relief = Relief::new(cliff, &mut None).unwrap();
        for tenth in 0..90 {
            let height = relief.height(DVec2::new(f64::from(tenth) / 10.0, -4.3)).unwrap();
            assert!((0.0..=100.0).contains(&height), "{height}");
        }
        assert_eq!(relief.height(DVec2::new(4.5, -4.0)), Some(50.0));
    }

    /// Returns the maximum distance (m) between the positions in a relief and the exact positions.
    fn worst(relief: &Relief, frame: &ReferenceFrame) -> f64 {
        let crs = relief.raster.crs.clone().unwrap();
        let passage = frame.passage(&crs).unwrap();
        let SampleGrid { first, step } = relief.raster.grid;
        let (low, size) = (relief.low.truncate(), (relief.high - relief.low).truncate());
        let mut worst = 0.0;
        for at in 0..97 * 89 {
            let place = low + size * DVec2::new(f64::from(at % 97) / 96.0, f64::from(at / 97) / 88.0);
            let found = relief.find(place).unwrap();
            let back = passage.enter([first[0] + found.x * step[0], first[1] - found.y * step[1]]);
            let back = DVec2::from(back);
            worst = back.distance(place).max(worst);
        }
        worst
    }

    #[test]
    fn the_lattice_is_within_a_millimetre_of_the_projection() {
        let step = 1.0 / 1200.0;
        let tile = |[x, y]: [f64; 2], side: usize| {
            let grid = SampleGrid { first: [x, y + step * count(side - 1)], step: [step; 2] };
            raster((side, side), grid, Some(4326), |x, _| x)
        };
        // A central tile, an adjacent one, one far north, and one across the date line.
        let mut frame = None;
        for corner in [[7.0, 43.0], [8.0, 44.0], [6.0, 43.0]] {
            let relief = Relief::new(tile(corner, 1201), &mut frame).unwrap();
            let worst = worst(&relief, frame.as_ref().unwrap());
            assert!(worst < 1e-3, "{worst} m at {corner:?}");
        }
        for corner in [[15.0, 78.0], [179.5, -17.0]] {
            let mut frame = None;
            let relief = Relief::new(tile(corner, 1201), &mut frame).unwrap();
            let worst = worst(&relief, frame.as_ref().unwrap());
            assert!(worst < 1e-3, "{worst} m at {corner:?}");
            let middle = relief.low.midpoint(relief.high).truncate();
            assert!(relief.height(middle).is_some());
        }
        // A projected raster in the frame of another projection.
        let mut frame = Some(ReferenceFrame::around(&Crs::epsg(4326).unwrap(), [7.5, 43.5], "b").unwrap());
        let grid = SampleGrid { first: [360_000.0, 4_850_000.0], step: [25.0; 2] };
        let relief = Relief::new(raster((1000, 800), grid, Some(32632), |x, _| x), &mut frame).unwrap();
        let worst = worst(&relief, frame.as_ref().unwrap());
        assert!(worst < 1e-3, "{worst} m");
    }

    #[test]
    fn places_far_outside_have_no_height() {
        let grid = SampleGrid { first: [7.0, 44.0], step: [0.01; 2] };
        let relief = Relief::new(raster((101, 101), grid, Some(4326), |x, _| x), &mut None).unwrap();
        for far in [1e5, 1e6, 1e9, 1e300, f64::INFINITY, f64::NAN] {
            for place in [DVec2::new(far, 0.0), DVec2::new(-far, far), DVec2::new(0.0, -far)] {
                assert_eq!(relief.height(place), None, "{place}");
            }
        }
        assert!(relief.height(DVec2::ZERO).is_some());
        let step = relief.step();
        assert!((780.0..830.0).contains(&step), "{step}");
    }

    #[test]
    fn a_raster_in_the_frames_own_projection_is_not_bent() {
        let grid = SampleGrid { first: [385_405.0, 6_671_595.0], step: [10.0; 2] };
        let mut frame = None;
        let relief = Relief::new(raster((20, 20), grid, Some(3067), |x, y| x + y), &mut frame).unwrap();
        let frame = frame.unwrap();
        assert_eq!((frame.epsg, frame.origin), (Some(3067), [385_500.0, 6_671_500.0]));
        assert!(matches!(relief.way, RasterMapping::Straight { .. }));
        assert_eq!((relief.low().x, relief.high().y), (-100.0, 100.0));
        assert_eq!(relief.height(DVec2::new(-95.0, 95.0)), Some(0.0));
    }
}
