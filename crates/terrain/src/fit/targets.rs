//! Height maps as targets of a fit: five named maps, and arbitrary heights.

use crate::octaves;
use burgeon_base::error::{Error, Result};

/// Number of cells per side of the named maps.
const ACROSS: usize = 128;

/// Function of the height (m) at a position: fractions (0 to 1) from the west and from the south.
type Formula = fn(f64, f64) -> f64;

/// Named maps.
const NAMED: [(&str, Formula); 5] =
    [("hill", hill), ("ridge", ridge), ("crater", crater), ("plain", plain), ("mountains", mountains)];

/// A square height map.
#[derive(Debug, Clone, PartialEq)]
pub struct Target {
    across: usize,
    heights: Vec<f64>,
}

impl Target {
    /// Creates a map of `across` x `across` `heights` (m), row by row from the north-west.
    ///
    /// Fails unless `across` is a power of two from 2 to 2048, and the heights are complete and finite.
    pub fn new(across: usize, heights: Vec<f64>) -> Result<Self> {
        check_across(across)?;
        if heights.len() != across * across {
            let count = heights.len();
            return Err(Error::argument(format!(
                "{count} heights do not fill a target of {across} cells across"
            ))
            .help(format!("it has {}", across * across)));
        }
        if heights.iter().any(|height| !height.is_finite()) {
            return Err(Error::argument("a target has a height that is not finite")
                .help("fill the gaps of the height map first"));
        }
        Ok(Self { across, heights })
    }

    /// Returns the map named `name`: hill, ridge, crater, plain or mountains.
    ///
    /// Fails with the nearest name if the name is unknown.
    pub fn named(name: &str) -> Result<Self> {
        let names = || NAMED.iter().map(|(name, _)| *name);
        let Some((_, height)) = NAMED.iter().find(|(known, _)| *known == name) else {
            let all = names().collect::<Vec<_>>().join(", ");
            let message = format!("unknown target `{name}`");
            return Err(
                Error::not_found("target", name, names(), message).help(format!("the targets are {all}"))
            );
        };
        let middle = |cell: usize| (number(cell) + 0.5) / number(ACROSS);
        let heights =
            (0..ACROSS * ACROSS).map(|at| height(middle(at % ACROSS), 1.0 - middle(at / ACROSS))).collect();
        Self::new(ACROSS, heights)
    }

    /// Creates a map of `across` x `across` cells from a map of `columns` x `rows` `heights` (m), row by row
    /// from the north-west, stretched to a square. Larger cells have mean heights, smaller cells are
    /// interpolated linearly between cell centres.
    ///
    /// Fails like [`new`](Self::new), or if the number of heights is not `columns` x `rows`.
    ///
    /// ```
    /// use burgeon_terrain::fit::Target;
    ///
    /// let target = Target::resample(4, 2, &[0.0, 2.0, 4.0, 6.0, 0.0, 2.0, 4.0, 6.0], 2)?;
    /// assert_eq!(target.heights(), [1.0, 5.0, 1.0, 5.0]);
    /// assert!(Target::resample(4, 2, &[0.0; 8], 3).is_err(), "3 is not a power of two");
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn resample(columns: usize, rows: usize, heights: &[f64], across: usize) -> Result<Self> {
        if columns == 0 || rows == 0 || columns.checked_mul(rows) != Some(heights.len()) {
            let count = heights.len();
            return Err(Error::argument(format!(
                "{count} heights are not {columns} columns and {rows} rows"
            ))
            .help("give one height per cell"));
        }
        check_across(across)?;
        let (east, south) = (weights(columns, across), weights(rows, across));
        let cells = (0..across * across).map(|at| {
            let (right, down) = (&east[at % across], &south[at / across]);
            let row =
                |y: usize| right.iter().map(|(x, weight)| heights[y * columns + x] * weight).sum::<f64>();
            down.iter().map(|(y, weight)| row(*y) * weight).sum()
        });
        Self::new(across, cells.collect())
    }

    /// Returns the number of cells per side.
    pub fn across(&self) -> usize {
        self.across
    }

    /// Returns the heights (m), row by row from the north-west.
    pub fn heights(&self) -> &[f64] {
        &self.heights
    }

    /// Returns the minimum and maximum height (m).
    pub fn range(&self) -> (f64, f64) {
        range(&self.heights)
    }

    /// Returns the error of the map `heights` with the same number of cells: the root mean square of the
    /// difference, after scaling each map to 0..1 by its own minimum and maximum. A flat map is 0 everywhere.
    ///
    /// ```
    /// use burgeon_terrain::fit::Target;
    ///
    /// let target = Target::new(2, vec![0.0, 1.0, 2.0, 3.0])?;
    /// // Only the shape counts, not the height.
    /// assert_eq!(target.error(&[10.0, 20.0, 30.0, 40.0]), 0.0);
    /// assert!(target.error(&[3.0, 2.0, 1.0, 0.0]) > 0.5);
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn error(&self, heights: &[f64]) -> f64 {
        error(&self.heights, heights)
    }
}

/// Fails unless the number of cells per side can be divided into quadrants.
fn check_across(across: usize) -> Result<()> {
    if across.is_power_of_two() && (2..=2048).contains(&across) {
        return Ok(());
    }
    Err(Error::argument(format!("a target of {across} cells across cannot be divided into quadrants"))
        .help("the number of cells across must be a power of two from 2 to 2048"))
}

/// Returns the error between two maps, as defined by [`Target::error`].
pub(super) fn error(one: &[f64], other: &[f64]) -> f64 {
    let scaled = |(low, high): (f64, f64)| {
        move |height: f64| if high > low { (height - low) / (high - low) } else { 0.0 }
    };
    let (first, second) = (scaled(range(one)), scaled(range(other)));
    let squares: f64 = one.iter().zip(other).map(|(a, b)| (first(*a) - second(*b)).powi(2)).sum();
    (squares / number(one.len().max(1))).sqrt()
}

/// Returns the minimum and maximum of `heights`.
pub(super) fn range(heights: &[f64]) -> (f64, f64) {
    heights
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), height| (low.min(*height), high.max(*height)))
}

/// Returns, for each of `to` cells per side, the cells of `from` that it covers and their weights.
fn weights(from: usize, to: usize) -> Vec<Vec<(usize, f64)>> {
    let step = number(from) / number(to.max(1));
    let mut all = Vec::with_capacity(to);
    for cell in 0..to {
        // A cell is as wide as the larger of both sizes, so it averages the cells it covers or interpolates
        // between two centres.
        let width = step.max(1.0);
        let middle = (number(cell) + 0.5) * step;
        let (low, high) = (middle - width / 2.0, middle + width / 2.0);
        let mut parts: Vec<(usize, f64)> = Vec::new();
        let mut at = low.floor();
        while at < high {
            let part = (at + 1.0).min(high) - at.max(low);
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "it is within the cells"
            )]
            let known = at.clamp(0.0, number(from - 1)) as usize;
            if part > 1e-12 {
                parts.push((known, part / width));
            }
            at += 1.0;
        }
        all.push(parts);
    }
    all
}

#[allow(clippy::cast_precision_loss, reason = "no map has 2^53 cells")]
pub(super) fn number(count: usize) -> f64 {
    count as f64
}

/// Returns the bell curve: 1 at 0, and 0.61 at `width`.
fn bell(distance: f64, width: f64) -> f64 {
    (-0.5 * (distance / width).powi(2)).exp()
}

/// Returns a round hill, 300 m high, with its top at the centre.
fn hill(x: f64, y: f64) -> f64 {
    300.0 * bell((x - 0.5).hypot(y - 0.5), 0.18)
}

/// Returns a ridge of 250 m from the south-west to the north-east, steeper to the north, lower towards its
/// ends.
fn ridge(x: f64, y: f64) -> f64 {
    let (along, beside) = (0.9 * (x - 0.5) + 0.44 * (y - 0.5), 0.9 * (y - 0.5) - 0.44 * (x - 0.5));
    250.0 * bell(beside, if beside > 0.0 { 0.09 } else { 0.15 }) * (1.0 - 1.2 * along * along)
}

/// Returns a crater: a rim of 120 m at 0.28 of the square from the centre, and a floor 80 m below the
/// surrounding ground.
fn crater(x: f64, y: f64) -> f64 {
    let distance = (x - 0.5).hypot(y - 0.5);
    120.0 * bell(distance - 0.28, 0.07) - 80.0 * bell(distance, 0.16)
}

/// Returns a plain: three long waves, 10 m high in total.
fn plain(x: f64, y: f64) -> f64 {
    let wave = |turns: f64| (std::f64::consts::TAU * turns).sin();
    2.5 * wave(0.9 * x + 0.4 * y) + 1.5 * wave(0.7 * y - 1.2 * x + 0.2) + wave(1.3 * x + 1.7 * y + 0.6)
}

/// Returns a mountain range of up to 1800 m from the west to the east: peaks and passes of ridged noise along
/// its crest.
fn mountains(x: f64, y: f64) -> f64 {
    let place = glam::DVec2::new(x, y);
    let crest = 0.5 + 0.12 * (std::f64::consts::TAU * 0.8 * x).sin();
    let ridged = (0..4).map(|octave| {
        let scale = f64::from(1 << octave);
        (1.0 - 2.0 * octaves(place * 3.0 * scale, 1, 40 + octave).abs()) / scale
    });
    let ridged: f64 = ridged.sum();
    1000.0 * bell(y - crest, 0.2) * (1.0 + 0.4 * ridged) + 60.0 * ridged
}
