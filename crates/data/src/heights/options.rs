//! What a file of heights cannot tell, and how large one may be.

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
    /// Whether it does not matter where the heights lie: `bounds` are metres then, and the file's coordinate system is not read.
    pub anywhere: bool,
}
