//! Measured elevation: rasters of heights, in the formats that surveys publish and that programs exchange.
//!
//! Comes in: a file, and what it cannot tell ([`HeightOptions`]). Goes out: a [`Raster`] without holes, in the coordinates of
//! the file, and a [`Relief`] of it, which knows the height of each place in the metres of a run. Readers (`ascii`,
//! `hgt` and `raw`, and those of other formats, which a program may be built without) only read; holes, bad heights and places are looked after once, in `raster`.

mod ascii;
mod fill;
mod format;
pub(crate) mod hgt;
mod lattice;
pub(crate) mod names;
pub(crate) mod raster;
pub(crate) mod raw;
mod relief;

pub use names::{png_text, tiff_key};
pub use raster::{Raster, SampleGrid};
pub use relief::Relief;

/// The most heights of a raster.
pub const MOST: usize = 200_000_000;

/// What a file of heights cannot tell, or tells wrongly.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct HeightOptions {
    /// The EPSG code of its coordinates.
    pub crs: Option<u32>,
    /// The height (m) of black in a 16-bit PNG.
    pub low: Option<f64>,
    /// The height (m) of white in a 16-bit PNG.
    pub high: Option<f64>,
    /// West, south, east and north: the outer edges of the samples, in the file's coordinate system, or in the metres
    /// of the run if it has none.
    pub bounds: Option<[f64; 4]>,
    /// Whether the colours of a PNG are heights, as Mapbox encodes them.
    pub terrain_rgb: bool,
}

#[cfg(test)]
mod hostile;
#[cfg(test)]
mod tests;
