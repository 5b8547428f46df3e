//! Names and numbers in files of heights, shared by readers and writers.

/// GeoTIFF keys and their values.
pub mod tiff_key {
    /// Key of the type of coordinates: projected or geographic.
    pub const MODEL: u16 = 1024;
    /// Projected coordinates.
    pub const IS_PROJECTED: u16 = 1;
    /// Key of the type of samples: area or point.
    pub const RASTER: u16 = 1025;
    /// Samples are areas.
    pub const AREA: u16 = 1;
    /// Samples are points.
    pub const POINT: u16 = 2;
    /// EPSG code of geographic coordinates.
    pub const GEOGRAPHIC: u16 = 2048;
    /// Longitude and latitude of WGS 84.
    pub const WGS_84: u16 = 4326;
    /// EPSG code of projected coordinates.
    pub const PROJECTED: u16 = 3072;
    /// User-defined coordinate system.
    pub const OWN: u16 = 32767;
    /// EPSG code of a projection without its datum.
    pub const PROJECTION: u16 = 3074;
    /// Projection method.
    pub const METHOD: u16 = 3075;
    /// Transverse Mercator.
    pub const TRANSVERSE_MERCATOR: u16 = 1;
    /// Unit of projected coordinates.
    pub const LINEAR_UNIT: u16 = 3076;
    /// Metres.
    pub const METRE: u16 = 9001;
    /// Longitude and latitude of the centre (degrees), its projected coordinates, and the scale there.
    pub const MIDDLE: [u16; 5] = [3080, 3081, 3082, 3083, 3092];
    /// EPSG code of vertical coordinates.
    pub const VERTICAL: u16 = 4096;
    /// Unit of heights.
    pub const VERTICAL_UNIT: u16 = 4099;
}

/// Names of PNG text chunks that contain heights (m).
pub mod png_text {
    /// Height of black.
    pub const LOW: &str = "low";
    /// Height of white.
    pub const HIGH: &str = "high";
}
