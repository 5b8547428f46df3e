//! Options for files of heights, and their maximum size.

/// Maximum number of heights in a raster.
pub const MOST: usize = 200_000_000;

/// Information that a file of heights lacks or has wrong.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct HeightOptions {
    /// EPSG code of its coordinates.
    pub crs: Option<u32>,
    /// Height (m) of black in a 16-bit PNG.
    pub low: Option<f64>,
    /// Height (m) of white in a 16-bit PNG.
    pub high: Option<f64>,
    /// West, south, east and north outer edges of the samples, in the file's coordinate system, or in the metres of the
    /// run if there is none.
    pub bounds: Option<[f64; 4]>,
    /// Set if the colours of a PNG encode heights as in Mapbox Terrain-RGB.
    pub terrain_rgb: bool,
    /// Set if the position of the heights is irrelevant: `bounds` are then in metres, and the file's coordinate system
    /// is not used.
    pub anywhere: bool,
}
