//! Reader of raw squares of little-endian floats, of 4 bytes (`.r32`, `.f32`) or 8 bytes (`.r64`, `.f64`).

use super::{RasterHeader, check_size, narrow};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};

/// Reads a square of floats of `SIZE` bytes. Fails if it is not square.
pub(crate) fn read<'a, const SIZE: usize>(bytes: &'a [u8], name: &str) -> Result<RasterHeader<'a>> {
    let side = (bytes.len() / SIZE).isqrt();
    if side * side * SIZE != bytes.len() {
        let next = side + 1;
        return Err(Error::data(format!(
            "{name} is not square: it has {} of the {} bytes of {next} x {next} floats",
            bytes.len(),
            next * next * SIZE
        ))
        .help("it is cut short, or not a square of floats; a GeoTIFF can have any shape"));
    }
    check_size(name, side, side)?;
    let height = |part: &[u8]| {
        let mut wide = [0; 8];
        wide[..SIZE].copy_from_slice(part);
        if SIZE == 4 {
            f32::from_le_bytes([wide[0], wide[1], wide[2], wide[3]])
        } else {
            narrow(f64::from_le_bytes(wide))
        }
    };
    let heights = move |_: &Budget| Ok(bytes.chunks_exact(SIZE).map(height).collect());
    Ok(RasterHeader {
        columns: side,
        rows: side,
        grid: None,
        crs: Ok(None),
        is_told: false,
        has_unit: true,
        heights: Box::new(heights),
    })
}
