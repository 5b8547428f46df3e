//! SRTM tiles (`.hgt`): a square of big-endian 16-bit heights of a degree, named after its corner; zipped or not.

use std::io::{Cursor, Read};

use super::super::Crs;
use super::raster::{Found, Grid, count};
use super::{MOST, Wanted};
use crate::error::{Error, Result};

/// What stands for a height that is not known.
const MISSING: i16 = -32768;
/// How many heights a side of the published tiles has: of three seconds, and of one.
const SIDES: [usize; 2] = [1201, 3601];

/// Reads a tile called `name`. Its samples lie on the degrees, the first and the last included.
///
/// Fails if it is not square, and if neither its name nor `wanted` tells where it lies.
pub(super) fn read(bytes: &[u8], name: &str, wanted: &Wanted) -> Result<Found> {
    let side = (bytes.len() / 2).isqrt();
    if side * side * 2 != bytes.len() {
        return Err(not_square(bytes.len(), name));
    }
    Found::check_size(name, side, side)?;
    let corner = corner(name);
    if corner.is_none() && wanted.bounds.is_none() {
        return Err(Error::new(format!("{name} does not tell where it lies"))
            .help("name it after its south-west corner, such as N43E007.hgt, or give its bounds and crs"));
    }
    let step = 1.0 / count(side - 1);
    let grid = corner.map(|[x, y]| Grid { first: [x, y + 1.0], step: [step; 2] });
    let heights = bytes.chunks_exact(2).map(|pair| match i16::from_be_bytes([pair[0], pair[1]]) {
        MISSING => f32::NAN,
        height => f32::from(height),
    });
    Ok(Found { columns: side, rows: side, heights: heights.collect(), grid, crs: Crs::epsg(4326).map(Some) })
}

/// Reads the one tile in a zip, and unpacks nothing else.
///
/// Fails if it is damaged, holds no tile or several, or if the tile is larger than any may be.
pub(super) fn unzip(bytes: &[u8], name: &str, wanted: &Wanted) -> Result<Found> {
    let damaged = || {
        Error::new(format!("{name} cannot be unpacked"))
            .help("the file is damaged or cut short; get it again")
    };
    let mut archive = zip::ZipArchive::new(Cursor::new(bytes)).map_err(|_| damaged())?;
    let is_tile = |entry: &&str| entry.to_ascii_lowercase().ends_with(".hgt");
    let mut tiles = archive.file_names().filter(is_tile).map(str::to_owned).collect::<Vec<_>>().into_iter();
    let tile = match (tiles.next(), tiles.len()) {
        (Some(tile), 0) => tile,
        (None, _) => {
            return Err(Error::new(format!("{name} holds no .hgt file"))
                .help("unpack it, and name the file of heights itself"));
        }
        (Some(_), more) => {
            return Err(Error::new(format!("{name} holds {} .hgt files", more + 1))
                .help("unpack it, and name the one that is meant"));
        }
    };
    let entry = archive.by_name(&tile).map_err(|_| damaged())?;
    let limit = MOST as u64 * 2;
    let mut content = Vec::new();
    // What an entry says of its size need not be true.
    let mut size = entry.size();
    if size <= limit {
        entry.take(limit + 1).read_to_end(&mut content).map_err(|_| damaged())?;
        size = content.len() as u64;
    }
    if size > limit {
        return Err(Error::new(format!("{tile} in {name} is larger than {} MB", limit / 1_000_000))
            .help("get it again: a tile has 3601 x 3601 heights"));
    }
    let shown = format!("{tile} in {name}");
    if content.is_empty() {
        return Err(Error::new(format!("{shown} is empty")).help("get it again"));
    }
    read(&content, &shown, wanted)
}

fn not_square(bytes: usize, name: &str) -> Error {
    let size = |side: &usize| side * side * 2;
    match SIDES.iter().find(|side| size(side) > bytes) {
        Some(side) => Error::new(format!(
            "{name} is not square: it has {bytes} of the {} bytes of {side} x {side} heights",
            size(side)
        ))
        .help("it is cut short; get it again"),
        None => Error::new(format!("{name} is not square: it has {bytes} bytes of 16-bit heights"))
            .help("get it again: a tile has 3601 x 3601 heights"),
    }
}

/// The south-west corner (degrees) in a name such as `N43E007.hgt`.
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
