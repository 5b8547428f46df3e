//! Reader of ESRI ASCII grids (`.asc`): a header of names and numbers, then heights as text.

use super::{RasterHeader, SampleGrid, check_size, count, narrow};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};

/// Remedy for a text that is not a grid.
const REMEDY: &str = "a grid begins with ncols, nrows, xllcorner, yllcorner and cellsize; convert the file: \
                      gdal_translate -of AAIGrid IN OUT.asc";

/// Maximum number of surplus heights that are counted.
const SURPLUS: usize = 1_000_000;

/// Header of a grid.
#[derive(Default)]
struct Header {
    columns: Option<f64>,
    rows: Option<f64>,
    /// Coordinates of the south-west corner; true if they refer to the centre of the sample there.
    x: Option<(f64, bool)>,
    y: Option<(f64, bool)>,
    /// Steps to the east and to the north.
    step: [Option<f64>; 2],
    missing: Option<f64>,
}

impl Header {
    /// Stores a value; returns `None` if the header name is unknown.
    fn set(&mut self, name: &str, value: f64) -> Option<()> {
        match name {
            "ncols" => self.columns = Some(value),
            "nrows" => self.rows = Some(value),
            "xllcorner" => self.x = Some((value, false)),
            "xllcenter" => self.x = Some((value, true)),
            "yllcorner" => self.y = Some((value, false)),
            "yllcenter" => self.y = Some((value, true)),
            "cellsize" => self.step = [Some(value); 2],
            "dx" => self.step[0] = Some(value),
            "dy" => self.step[1] = Some(value),
            "nodata_value" => self.missing = Some(value),
            _ => return None,
        }
        Some(())
    }
}

/// Reads a grid called `name`.
///
/// Fails if the header is incomplete, if a height is not a number, and if there are fewer heights than declared.
/// Surplus heights are at the end of the result.
pub(crate) fn read<'a>(bytes: &'a [u8], name: &'a str) -> Result<RasterHeader<'a>> {
    let text = std::str::from_utf8(bytes).map_err(|_| {
        Error::data(format!("{name} is not an ASCII grid: it contains bytes that are not text")).help(REMEDY)
    })?;
    let mut header = Header::default();
    let mut lines = text.lines().enumerate().peekable();
    while let Some((number, line)) = lines.peek() {
        let mut words = line.split_whitespace();
        let first = words.next().unwrap_or_default();
        if first.starts_with(|letter: char| letter.is_ascii_digit() || "+-.".contains(letter))
            || first.eq_ignore_ascii_case("nan")
        {
            break;
        }
        if !first.is_empty() {
            let value = words.next().and_then(|word| word.parse().ok());
            let known = value.and_then(|value| header.set(&first.to_ascii_lowercase(), value));
            if known.is_none() {
                let line = shorten(line);
                return Err(Error::data(format!(
                    "{name} has {line:?} in line {}, in its header",
                    number + 1
                ))
                .help(REMEDY));
            }
        }
        lines.next();
    }
    let lacks = |what: &str| Error::data(format!("{name} has no {what} in its header")).help(REMEDY);
    let columns = whole(name, "ncols", header.columns.ok_or_else(|| lacks("ncols"))?)?;
    let rows = whole(name, "nrows", header.rows.ok_or_else(|| lacks("nrows"))?)?;
    check_size(name, columns, rows)?;
    let grid = match (header.x, header.y, header.step) {
        (Some((x, x_centre)), Some((y, y_centre)), [Some(dx), Some(dy)]) => {
            let half = |is_centre: bool, step: f64| if is_centre { 0.0 } else { step / 2.0 };
            let north = y + half(y_centre, dy) + dy * count(rows - 1);
            Some(SampleGrid { first: [x + half(x_centre, dx), north], step: [dx, dy] })
        }
        (_, _, [None, _] | [_, None]) => return Err(lacks("cellsize")),
        // The options may contain the position.
        _ => None,
    };
    let (expected, length, missing) = (columns * rows, bytes.len(), header.missing);
    let heights = move |budget: &Budget| heights(lines, name, (expected, length), missing, budget);
    Ok(RasterHeader {
        columns,
        rows,
        grid,
        crs: Ok(None),
        is_told: false,
        has_unit: false,
        heights: Box::new(heights),
    })
}

/// Reads the heights in `lines`, numbered from 0, of a file with `expected` heights and `length` bytes.
fn heights<'a>(
    lines: impl Iterator<Item = (usize, &'a str)>,
    name: &str,
    (expected, length): (usize, usize),
    missing: Option<f64>,
    budget: &Budget,
) -> Result<Vec<f32>> {
    let mut heights = Vec::new();
    // A few surplus heights are counted; if the header is that of another file, not all heights are read.
    let most = expected + SURPLUS;
    for (number, line) in lines {
        for word in line.split_whitespace() {
            budget.tick()?;
            let value: f64 = word.parse().map_err(|_| {
                let word = shorten(word);
                Error::data(format!("{name} has {word:?} in line {}, which is not a height", number + 1))
                    .help("write heights with a decimal point, such as 12.5")
            })?;
            heights.push(if Some(value) == missing { f32::NAN } else { narrow(value) });
        }
        if heights.len() > most {
            break;
        }
    }
    match heights.len() {
        found if found < expected => Err(Error::data(format!(
            "{name} is cut short: it has {found} of {expected} heights ({length} bytes)"
        ))
        .help("download it again")),
        _ => Ok(heights),
    }
}

/// Converts a number of columns or rows.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the range is checked")]
fn whole(name: &str, what: &str, value: f64) -> Result<usize> {
    if value.fract() == 0.0 && (0.0..1e15).contains(&value) {
        return Ok(value as usize);
    }
    Err(Error::data(format!("{name} has an invalid number of heights: {what} {value}")).help(REMEDY))
}

/// Returns the beginning of a text that may be long.
fn shorten(text: &str) -> String {
    text.chars().take(30).collect()
}

#[cfg(test)]
mod tests {
    use crate::elevation::Raster;
    use crate::heights::HeightOptions;
    use burgeon_base::budget::Budget;

    fn read(text: &str) -> Raster {
        Raster::read(text.as_bytes(), "a.asc", &HeightOptions::default(), &Budget::default()).unwrap()
    }

    #[test]
    fn corners_and_centres_give_the_same_grid() {
        let corner = read("ncols 3\nNROWS 2\nxllcorner 10\nyllcorner 20\ncellsize 2\n1 2 3\n4 5 6\n");
        let centre = read("ncols 3\nnrows 2\nxllcenter 11\nyllcenter 21\ndx 2\ndy 2\n1 2 3 4 5\n6");
        assert_eq!((corner.grid, corner.heights.clone()), (centre.grid, centre.heights));
        assert_eq!((corner.grid.first, corner.bounds()), ([11.0, 23.0], [10.0, 20.0, 16.0, 24.0]));
        assert_eq!(corner.heights, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    }

    #[test]
    fn surplus_numbers_are_left_out_and_counted() {
        let read = read("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 4\n5 6 7\n");
        assert_eq!((read.surplus, read.heights), (3, vec![1.0, 2.0, 3.0, 4.0]));
    }

    #[test]
    fn what_marks_missing_heights_is_filled() {
        let read = read(
            "ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -9999\n5 5 5\n5 -9999 5\n5 nan 5\n",
        );
        assert_eq!((read.filled, read.heights), (2, vec![5.0; 9]));
    }
}
