//! Measured elevation: rasters of heights, in the formats that surveys publish and that programs exchange.
//!
//! Comes in: a file, and what it cannot tell ([`HeightOptions`]). Goes out: a [`Raster`] without holes, in the coordinates of
//! the file, and a [`Relief`] of it, which knows the height of each place in the metres of a run. Readers
//! (`heights`, and those of `formats`, which a program may be built without) only read; holes, bad heights and places are
//! looked after once, in `raster`.

mod fill;
mod format;
mod holes;
#[cfg(test)]
mod hostile;
mod lattice;
pub(crate) mod missing;
mod mosaic;
mod raster;
mod relief;
mod spline;
#[cfg(test)]
mod tests;

pub use crate::heights::names::{png_text, tiff_key};
pub use crate::heights::{HeightOptions, MOST, SampleGrid};
pub use missing::UndeclaredMarks;
pub use raster::Raster;
pub use relief::Relief;
