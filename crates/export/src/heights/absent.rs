//! What stands in the place of PNGs and GeoTIFFs of heights where a program is built without the feature `data`.

use std::io;

use super::super::Out;
use super::HeightMap;
use burgeon_base::error::{Error, Result};

/// Fails: neither is there.
pub(super) fn check() -> Result<()> {
    Err(Error::left_out("data formats", "data"))
}

pub(super) fn write_png(_map: &HeightMap, _out: &mut Out) -> io::Result<()> {
    check().map_err(io::Error::other)
}

pub(super) fn write_tiff(map: &HeightMap, out: &mut Out) -> io::Result<()> {
    write_png(map, out)
}
