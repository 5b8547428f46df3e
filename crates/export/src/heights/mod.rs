//! Height maps: grids of heights in files that GIS programs and game engines read.
//!
//! | extension | content |
//! | --- | --- |
//! | `.png` | 16-bit grey from the lowest to the highest height; the text entries `low` and `high` store the range (m)
//! |
//! | `.asc` | an ESRI ASCII grid |
//! | `.tif` | a GeoTIFF of 32-bit floats, with its coordinate system |
//! | `.r32`, `.f32`, `.r64`, `.f64` | a square of raw little-endian floats, row by row |

mod height_map;
#[cfg_attr(not(feature = "data"), path = "absent.rs")]
mod packed;
mod write;

pub use height_map::HeightMap;
pub use write::{check_name, write};
