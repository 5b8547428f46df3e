//! Measured elevation: rasters of heights, in the formats that surveys publish and programs exchange.
//!
//! Input: a file, and information that it does not contain ([`HeightOptions`]). Output: a [`Raster`] without holes in
//! the file's coordinates, and a [`Relief`] that returns the height at each position in the metres of a run. Readers
//! (in `heights`, and in `formats`, which may be excluded from a build) only read. Holes, invalid heights and positions
//! are processed in one place, `opening`.

mod fill;
mod format;
#[cfg(test)]
mod geotiff_tests;
mod holes;
#[cfg(test)]
mod hostile;
mod lattice;
pub(crate) mod missing;
mod mosaic;
mod opening;
mod raster;
mod relief;
mod spline;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tiff_tests;

pub use crate::heights::{HeightOptions, MOST, SampleGrid};
pub use missing::UndeclaredMarks;
pub use raster::Raster;
pub use relief::Relief;
