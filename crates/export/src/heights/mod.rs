//! Height maps: grids of heights in files that GIS programs and game engines read.
//!
//! The table [`HEIGHT_FORMATS`] lists the formats.

mod formats;
mod height_map;
#[cfg_attr(not(feature = "data"), path = "absent.rs")]
mod packed;
mod plain;
mod write;

pub use formats::{HEIGHT_FORMATS, HeightFormat};
pub use height_map::HeightMap;
pub use write::write;
