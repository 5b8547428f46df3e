//! Heights as text and as raw floats.

use std::io::{self, Write};

use super::super::Out;
use super::height_map::{HeightMap, narrow};

/// Marker of a missing height in an ASCII grid.
const MISSING: &str = "-9999";

pub(super) fn write_ascii(map: &HeightMap, out: &mut Out) -> io::Result<()> {
    let corner = map.projected_corner();
    writeln!(out, "ncols {}\nnrows {}", map.columns, map.rows)?;
    writeln!(out, "xllcorner {}\nyllcorner {}\ncellsize {}", corner.x, corner.y, map.step)?;
    writeln!(out, "NODATA_value {MISSING}")?;
    for row in map.heights.chunks_exact(map.columns) {
        for (column, height) in row.iter().enumerate() {
            let space = if column > 0 { " " } else { "" };
            if height.is_nan() {
                write!(out, "{space}{MISSING}")?;
            } else {
                write!(out, "{space}{}", narrow(*height))?;
            }
        }
        writeln!(out)?;
    }
    Ok(())
}

pub(super) fn write_raw32(map: &HeightMap, out: &mut Out) -> io::Result<()> {
    map.heights.iter().try_for_each(|height| out.write_all(&narrow(*height).to_le_bytes()))
}

pub(super) fn write_raw64(map: &HeightMap, out: &mut Out) -> io::Result<()> {
    map.heights.iter().try_for_each(|height| out.write_all(&height.to_le_bytes()))
}
