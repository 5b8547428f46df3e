//! Common parts of all height formats, and the formats that need no external crates.
//!
//! Input: bytes. Output: a [`RasterHeader`] with the number and the positions of the heights, and a function that reads
//! them. Heights are not filled or repaired here.

pub(crate) mod ascii;
mod header;
pub(crate) mod hgt;
pub(crate) mod marks;
mod options;
pub(crate) mod raw;

pub use header::SampleGrid;
pub(crate) use header::{RasterHeader, check_size, count, narrow};
pub use options::{HeightOptions, MOST};
