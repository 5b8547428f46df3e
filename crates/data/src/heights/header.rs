//! What a file of heights says of them in its beginning.

use super::MOST;
use crate::Crs;
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Limit, Result};

/// Where samples lie, in the units of a coordinate system.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SampleGrid {
    /// The centre of the sample in the north-west.
    pub first: [f64; 2],
    /// The distances of samples towards the east and the south; both are positive.
    pub step: [f64; 2],
}

impl SampleGrid {
    /// That of `columns` by `rows` samples between outer edges: west, south, east and north.
    pub(crate) fn between([west, south, east, north]: [f64; 4], columns: usize, rows: usize) -> Self {
        let step = [(east - west) / count(columns), (north - south) / count(rows)];
        Self { first: [west + step[0] / 2.0, north - step[1] / 2.0], step }
    }
}

/// A number of samples as a factor.
#[allow(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
pub(crate) fn count(number: usize) -> f64 {
    number as f64
}

/// What a reader found in the beginning of a file, and how to read the rest.
pub(crate) struct RasterHeader<'a> {
    pub columns: usize,
    pub rows: usize,
    /// Where the heights lie.
    pub grid: Option<SampleGrid>,
    /// An error if it names a coordinate system that is not known, for which options can stand in.
    pub crs: Result<Option<Crs>>,
    /// Whether the file, or who reads it, says how low and how high the heights are: then none of them marks a missing one.
    pub is_told: bool,
    /// Reads the heights, of which some may be missing (NaN). Nobody asks before all else is known to be right.
    pub heights: ReadHeights<'a>,
}

/// Reads all heights of a file, row by row.
pub(crate) type ReadHeights<'a> = Box<dyn FnOnce(&Budget) -> Result<Vec<f32>> + 'a>;

/// Refuses sizes that cannot be meant, before room is made for them.
pub(crate) fn check_size(name: &str, columns: usize, rows: usize) -> Result<()> {
    if columns < 2 || rows < 2 {
        return Err(Error::data(format!("{name} has {columns} x {rows} heights"))
            .help("at least 2 x 2 are needed to know what is in between"));
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

/// A height (m) as rasters hold it: to a millimetre below 16 km.
#[allow(clippy::cast_possible_truncation, reason = "heights are f32")]
pub(crate) fn narrow(height: f64) -> f32 {
    height as f32
}
