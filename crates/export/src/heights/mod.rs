//! Height maps: a grid of heights as a file that programs for maps and games read.
//!
//! | extension | what is written |
//! | --- | --- |
//! | `.png` | grey of 16 bits from the lowest to the highest height, which its texts `low` and `high` tell (m) |
//! | `.asc` | an ESRI ASCII grid |
//! | `.tif` | a GeoTIFF of 32-bit floats, with its coordinate system |
//! | `.r32`, `.f32`, `.r64`, `.f64` | a square of raw little-endian floats, row by row |

mod height_map;
#[cfg_attr(not(feature = "data"), path = "absent.rs")]
mod packed;

pub use height_map::{HeightMap, check_name, write};
