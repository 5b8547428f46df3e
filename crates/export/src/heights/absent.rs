//! Stubs for writing heights as PNG and GeoTIFF, for builds without the feature `data`.

use std::io;

use super::super::Out;
use super::height_map::HeightMap;
use burgeon_base::error::{Error, Result};

/// Fails, because neither format is available.
pub(super) fn check() -> Result<()> {
    Err(Error::left_out("data formats", "data"))
}

pub(super) fn write_png(_map: &HeightMap, _out: &mut Out) -> io::Result<()> {
    check().map_err(io::Error::other)
}

pub(super) fn write_tiff(map: &HeightMap, out: &mut Out) -> io::Result<()> {
    write_png(map, out)
}
