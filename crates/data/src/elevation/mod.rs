//! Measured elevation: rasters of heights, in the formats that surveys publish and that programs exchange.
//!
//! Comes in: a file, and what it cannot tell ([`HeightOptions`]). Goes out: a [`Raster`] without holes, in the coordinates of
//! the file, and a [`Relief`] of it, which knows the height of each place in the metres of a run. Readers (`ascii`,
//! `hgt` and `raw`, and those of other formats, which a program may be built without) only read; holes, bad heights and places are looked after once, in `raster`.

mod ascii;
mod fill;
mod format;
pub(crate) mod hgt;
#[cfg(test)]
mod hostile;
mod lattice;
pub(crate) mod names;
mod options;
pub(crate) mod raster;
pub(crate) mod raw;
mod relief;
#[cfg(test)]
mod tests;

pub use names::{png_text, tiff_key};
pub use options::{HeightOptions, MOST};
pub use raster::{Raster, SampleGrid};
pub use relief::Relief;
