//! Reader of zipped SRTM tiles.

use std::io::{Cursor, Read};

use super::packed::{DEFLATED, can_hold, cannot_hold};
use crate::heights::hgt::{height, place, size};
use crate::heights::{HeightOptions, RasterHeader};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};

/// Reads the only tile in a zip file; other files are not unpacked.
///
/// Fails if the zip file is damaged, or contains no tile or several tiles, and in the same cases as
/// [`read`](crate::heights::hgt::read).
pub(crate) fn read<'a>(bytes: &'a [u8], name: &'a str, wanted: &HeightOptions) -> Result<RasterHeader<'a>> {
    let damaged = move || {
        Error::data(format!("{name} cannot be unpacked"))
            .help("the file is damaged or cut short; download it again")
    };
    let mut archive = zip::ZipArchive::new(Cursor::new(bytes)).map_err(|_| damaged())?;
    let is_tile = |entry: &&str| entry.to_ascii_lowercase().ends_with(".hgt");
    let mut tiles = archive.file_names().filter(is_tile).map(str::to_owned).collect::<Vec<_>>().into_iter();
    let tile = match (tiles.next(), tiles.len()) {
        (Some(tile), 0) => tile,
        (None, _) => {
            return Err(Error::data(format!("{name} contains no .hgt file"))
                .help("unpack it, and specify the height file itself"));
        }
        (Some(_), more) => {
            return Err(Error::data(format!("{name} contains {} .hgt files", more + 1))
                .help("unpack it, and specify one of them"));
        }
    };
    let shown = format!("{tile} in {name}");
    let unpacked = archive.by_name(&tile).map_err(|_| damaged())?.size();
    let unpacked = usize::try_from(unpacked).unwrap_or(usize::MAX);
    if unpacked == 0 {
        return Err(Error::data(format!("{shown} is empty")).help("download it again"));
    }
    let [columns, rows] = size(unpacked, &shown, wanted)?;
    if !can_hold(bytes.len(), DEFLATED, unpacked) {
        return Err(cannot_hold(name, bytes.len(), columns, rows));
    }
    let (grid, crs) = place(&shown, wanted, [columns, rows])?;
    let heights = move |budget: &Budget| {
        let mut entry = archive.by_name(&tile).map_err(|_| damaged())?;
        let mut heights = Vec::new();
        let mut row = vec![0; columns * 2];
        for _ in 0..rows {
            budget.tick()?;
            entry.read_exact(&mut row).map_err(|_| damaged())?;
            heights.extend(row.chunks_exact(2).map(height));
        }
        // The declared size of an entry may be wrong.
        match entry.read(&mut [0]) {
            Ok(0) => Ok(heights),
            _ => Err(damaged()),
        }
    };
    Ok(RasterHeader { columns, rows, grid, crs, is_told: false, has_unit: true, heights: Box::new(heights) })
}
