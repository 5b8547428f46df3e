//! Reader of SRTM tiles (`.hgt`): a square degree of big-endian 16-bit heights, named after its south-west corner.

use super::{HeightOptions, RasterHeader, SampleGrid, check_size, count};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_spatial::Crs;

/// Marker of an unknown height.
const MISSING: i16 = -32768;
/// Numbers of heights of the published tiles, from west to east and from north to south: three arc seconds, one, two by
/// one in the north, and half.
const SIZES: [[usize; 2]; 4] = [[1201, 1201], [3601, 3601], [1801, 3601], [7201, 7201]];

/// Reads a tile called `name`. Its first and last samples are on whole degrees.
///
/// Fails if neither its name nor `wanted` contains its position, and if its size is not that of a tile; with `bounds`
/// in `wanted`, any square size is allowed.
pub(crate) fn read<'a>(bytes: &'a [u8], name: &str, wanted: &HeightOptions) -> Result<RasterHeader<'a>> {
    let [columns, rows] = size(bytes.len(), name, wanted)?;
    let (grid, crs) = place(name, wanted, [columns, rows])?;
    let heights = move |_: &Budget| Ok(bytes.chunks_exact(2).map(height).collect());
    Ok(RasterHeader { columns, rows, grid, crs, is_told: false, has_unit: true, heights: Box::new(heights) })
}

/// Returns the height (m) in two bytes.
pub(crate) fn height(pair: &[u8]) -> f32 {
    match i16::from_be_bytes([pair[0], pair[1]]) {
        MISSING => f32::NAN,
        height => f32::from(height),
    }
}

/// Returns the columns and rows of a file of heights with this number of bytes.
pub(crate) fn size(bytes: usize, name: &str, wanted: &HeightOptions) -> Result<[usize; 2]> {
    if let Some(size) = SIZES.into_iter().find(|[columns, rows]| columns * rows * 2 == bytes) {
        return Ok(size);
    }
    let side = (bytes / 2).isqrt();
    if side.checked_mul(side * 2) != Some(bytes) {
        return Err(not_square(bytes, name));
    }
    check_size(name, side, side)?;
    if wanted.bounds.is_none() {
        return Err(Error::data(format!(
            "{name} has {side} x {side} heights, which is not the size of a one-degree tile"
        ))
        .help("tiles have 1201 x 1201 or 3601 x 3601 heights; if it is a part of a tile, specify its bounds and crs"));
    }
    Ok([side, side])
}

/// Returns the position and the coordinate system of a tile, whose samples extend from degree to degree.
pub(crate) fn place(
    name: &str,
    wanted: &HeightOptions,
    [columns, rows]: [usize; 2],
) -> Result<(Option<SampleGrid>, Result<Option<Crs>>)> {
    let corner = corner(name);
    if corner.is_none() && wanted.bounds.is_none() {
        return Err(Error::data(format!("{name} does not contain its location")).help(
            "name it after its south-west corner, such as N43E007.hgt, or specify its bounds and crs",
        ));
    }
    let step = [columns, rows].map(|side| 1.0 / count(side - 1));
    Ok((corner.map(|[x, y]| SampleGrid { first: [x, y + 1.0], step }), Crs::epsg(4326).map(Some)))
}

fn not_square(bytes: usize, name: &str) -> Error {
    let size = |[columns, rows]: &[usize; 2]| columns * rows * 2;
    match SIZES[..2].iter().find(|sides| size(sides) > bytes) {
        Some(sides) => Error::data(format!(
            "{name} is not square: it has {bytes} of the {} bytes of {} x {} heights",
            size(sides),
            sides[0],
            sides[1]
        ))
        .help("it is cut short; download it again"),
        None => Error::data(format!("{name} is not square: it has {bytes} bytes of 16-bit heights"))
            .help("download it again: a tile has 3601 x 3601 heights"),
    }
}

/// Returns the south-west corner (degrees) in a name such as `N43E007.hgt`.
fn corner(name: &str) -> Option<[f64; 2]> {
    let angle = |text: &[u8], signs: [u8; 2], most: f64| {
        let (sign, digits) = text.split_first()?;
        let value: f64 = std::str::from_utf8(digits).ok()?.parse().ok()?;
        let is_number = digits.iter().all(u8::is_ascii_digit) && value <= most;
        let sign = signs.iter().position(|known| known.eq_ignore_ascii_case(sign))?;
        is_number.then_some(if sign == 0 { value } else { -value })
    };
    name.as_bytes().windows(7).rev().find_map(|part| {
        let latitude = angle(&part[..3], *b"NS", 90.0)?;
        Some([angle(&part[3..], *b"EW", 180.0)?, latitude])
    })
}
