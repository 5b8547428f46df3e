//! What every file of heights has in common, and the formats that need no other program's code to be read.
//!
//! Comes in: bytes. Goes out: a [`RasterHeader`], which says how many heights there are and where they lie, and reads them.
//! Nothing is filled or mended here.

pub(crate) mod ascii;
mod header;
pub(crate) mod hgt;
pub(crate) mod marks;
pub(crate) mod names;
mod options;
pub(crate) mod raw;

pub use header::SampleGrid;
pub(crate) use header::{RasterHeader, check_size, count, narrow};
pub use options::{HeightOptions, MOST};
