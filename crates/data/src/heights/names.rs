//! What stands in files of heights under a name or a number, for those who read and those who write them.

/// Keys of GeoTIFF, and values of theirs.
pub mod tiff_key {
    /// Whether coordinates are projected or geographic.
    pub const MODEL: u16 = 1024;
    /// Coordinates are projected.
    pub const IS_PROJECTED: u16 = 1;
    /// Whether a sample is an area or a point.
    pub const RASTER: u16 = 1025;
    /// A sample is an area.
    pub const AREA: u16 = 1;
    /// A sample is a point.
    pub const POINT: u16 = 2;
    /// The EPSG code of geographic coordinates.
    pub const GEOGRAPHIC: u16 = 2048;
    /// Longitude and latitude of WGS 84.
    pub const WGS_84: u16 = 4326;
    /// The EPSG code of projected coordinates.
    pub const PROJECTED: u16 = 3072;
    /// A coordinate system that is described, not named.
    pub const OWN: u16 = 32767;
    /// The EPSG code of a projection without its datum.
    pub const PROJECTION: u16 = 3074;
    /// How a projection works.
    pub const METHOD: u16 = 3075;
    /// Transverse Mercator.
    pub const TRANSVERSE_MERCATOR: u16 = 1;
    /// The unit of projected coordinates.
    pub const LINEAR_UNIT: u16 = 3076;
    /// Metres.
    pub const METRE: u16 = 9001;
    /// The longitude and the latitude (degrees) of the middle, its coordinates, and the scale there.
    pub const MIDDLE: [u16; 5] = [3080, 3081, 3082, 3083, 3092];
    /// The EPSG code of heights.
    pub const VERTICAL: u16 = 4096;
    /// The unit of heights.
    pub const VERTICAL_UNIT: u16 = 4099;
}

/// The names of the texts in a PNG that tell heights (m).
pub mod png_text {
    /// That of black.
    pub const LOW: &str = "low";
    /// That of white.
    pub const HIGH: &str = "high";
}
