//! Header of a file of heights.

use super::MOST;
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_spatial::Crs;

/// Positions of samples, in the units of a coordinate system.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SampleGrid {
    /// Centre of the north-west sample.
    pub first: [f64; 2],
    /// Distances between samples towards the east and the south; both are positive.
    pub step: [f64; 2],
}

impl SampleGrid {
    /// Returns the grid of `columns` by `rows` samples between outer edges: west, south, east and north.
    pub(crate) fn between([west, south, east, north]: [f64; 4], columns: usize, rows: usize) -> Self {
        let step = [(east - west) / count(columns), (north - south) / count(rows)];
        Self { first: [west + step[0] / 2.0, north - step[1] / 2.0], step }
    }
}

/// Converts a number of samples to a factor.
#[allow(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
pub(crate) fn count(number: usize) -> f64 {
    number as f64
}

/// Header that a reader found, and the function that reads the heights.
pub(crate) struct RasterHeader<'a> {
    pub columns: usize,
    pub rows: usize,
    /// Positions of the heights, if known.
    pub grid: Option<SampleGrid>,
    /// Coordinate system; an error if it is unknown, which options can override.
    pub crs: Result<Option<Crs>>,
    /// Set if the file or the options define the lowest and highest height; then no height is a marker of missing
    /// values.
    pub is_told: bool,
    /// Set if the file declares the unit of its heights; the heights are then converted to metres.
    pub has_unit: bool,
    /// Function that reads the heights, some of which may be missing (NaN). Called only after all other checks have
    /// succeeded.
    pub heights: ReadHeights<'a>,
}

/// Function that reads all heights of a file, row by row.
pub(crate) type ReadHeights<'a> = Box<dyn FnOnce(&Budget) -> Result<Vec<f32>> + 'a>;

/// Fails for impossible sizes, before memory is allocated.
pub(crate) fn check_size(name: &str, columns: usize, rows: usize) -> Result<()> {
    if columns < 2 || rows < 2 {
        return Err(Error::data(format!("{name} has {columns} x {rows} heights"))
            .help("at least 2 x 2 heights are needed for interpolation"));
    }
    if columns.checked_mul(rows).is_none_or(|all| all > MOST) {
        return Err(Error::limit(
            Limit::Size,
            format!("{name} has {columns} x {rows} heights, more than {} million", MOST / 1_000_000),
        )
        .help("cut out a part: gdal_translate -srcwin LEFT TOP COLUMNS ROWS"));
    }
    Ok(())
}

/// Converts a height (m) to the precision of rasters: one millimetre below 16 km.
#[allow(clippy::cast_possible_truncation, reason = "heights are f32")]
pub(crate) fn narrow(height: f64) -> f32 {
    height as f32
}
