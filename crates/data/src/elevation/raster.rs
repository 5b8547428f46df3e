//! A raster of heights in the coordinates of its file.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use super::{fill, format};
use crate::Crs;
use crate::heights::{HeightOptions, RasterHeader, SampleGrid, count};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::text::number;
use burgeon_base::warning::{Warning, WarningKind};

/// The largest file (bytes).
const LARGEST: u64 = 2_000_000_000;
/// No height on a planet is as far (m) from its zero.
const HIGHEST: f32 = 100_000.0;
/// Finite numbers from here on mark that there is no data, as -3.4e38 does in files of ESRI's.
const MARK: f32 = 1e30;
/// The least distance (m) of samples whose coordinates are metres.
const FINEST: f64 = 1e-3;

/// Heights in rows from the north, without holes.
#[derive(Debug, Clone)]
pub struct Raster {
    /// What it is called in messages.
    pub name: String,
    /// The number of samples from west to east.
    pub columns: usize,
    /// The number of samples from north to south.
    pub rows: usize,
    /// The heights (m), row by row, each from the west.
    pub heights: Vec<f32>,
    /// Where the samples lie.
    pub grid: SampleGrid,
    /// Its coordinate system; without one, its coordinates are metres of the run.
    pub crs: Option<Crs>,
    /// How many heights were missing and were filled from the rims of their holes.
    pub filled: usize,
    /// How many more heights the file has than its header says; they are left out.
    pub surplus: usize,
}

impl Raster {
    /// Reads the file at `path`, which messages call `name`. Its content and its extension tell the format.
    ///
    /// Fails if it cannot be read, is in no known format, is cut short or too large, or has no heights; if it does not
    /// tell where it lies and `wanted` does not either, which is known before any heights are read; and if reading takes
    /// more than the `budget`.
    pub fn open(path: &Path, name: &str, wanted: &HeightOptions, budget: &Budget) -> Result<Self> {
        let cannot = |error: std::io::Error| Error::file(path, format!("cannot read {name}: {error}"));
        let meta = path.metadata().map_err(cannot)?;
        if meta.is_dir() {
            return Err(Error::file(path, format!("{name} is a folder")).help("name a file of heights in it"));
        }
        if !meta.is_file() {
            return Err(Error::file(path, format!("{name} is not a file")).help("name a file of heights"));
        }
        if meta.len() > LARGEST {
            let most = LARGEST / 1_000_000;
            return Err(Error::limit(Limit::Size, format!("{name} is larger than {most} MB"))
                .help("cut out a part of it"));
        }
        let _held = budget.hold(usize::try_from(meta.len()).unwrap_or(usize::MAX))?;
        let mut bytes = Vec::new();
        // It may grow while it is read.
        File::open(path).and_then(|file| file.take(meta.len()).read_to_end(&mut bytes)).map_err(cannot)?;
        Self::read(&bytes, name, wanted, budget)
    }

    /// Reads `bytes`, the content of a file called `name`. Fails as [`Raster::open`] does.
    pub fn read(bytes: &[u8], name: &str, wanted: &HeightOptions, budget: &Budget) -> Result<Self> {
        let RasterHeader { columns, rows, grid, crs, heights } = format::read(bytes, name, wanted)?;
        let crs = match wanted.crs {
            Some(code) => Some(Crs::epsg(code).map_err(|error| {
                Error::not_found("coordinate system", code, [], format!("elevation: {}", error.message()))
                    .help("name the right one: elevation(file, { crs = 4326 })")
            })?),
            None => crs?,
        };
        let grid = match wanted.bounds {
            Some(bounds) => Some(SampleGrid::between(check_bounds(bounds)?, columns, rows)),
            None => grid,
        };
        let grid = grid.ok_or_else(|| {
            Error::data(format!("{name} does not tell where it lies")).help(
                "name its edges: elevation(file, { bounds = { west, south, east, north } }), in metres of the run, \
                 or in the coordinate system crs",
            )
        })?;
        check_grid(name, &grid, columns, rows, crs.as_ref())?;
        budget.check()?;
        budget.take(columns * rows * size_of::<f32>())?;
        let mut heights = heights(budget)?;
        let surplus = heights.len().saturating_sub(columns * rows);
        heights.truncate(columns * rows);
        check_heights(name, columns, &mut heights)?;
        let filled = fill::fill(columns, rows, &mut heights, budget)?;
        Ok(Self { name: name.to_owned(), columns, rows, heights, grid, crs, filled, surplus })
    }

    /// Its outer edges: west, south, east and north. A sample stands for the area half a step around it.
    pub fn bounds(&self) -> [f64; 4] {
        let SampleGrid { first, step } = self.grid;
        let (west, north) = (first[0] - step[0] / 2.0, first[1] + step[1] / 2.0);
        [west, north - step[1] * count(self.rows), west + step[0] * count(self.columns), north]
    }

    /// What people should know of how it was read.
    pub fn warnings(&self) -> Vec<Warning> {
        let Self { name, columns, rows, surplus, .. } = self;
        let what = if *surplus == 1 { "number" } else { "numbers" };
        let text =
            format!("{name} has {surplus} {what} more than the {columns} x {rows} heights of its header");
        let warning =
            Warning::new(WarningKind::Data, text).help("they are left out; correct ncols and nrows");
        if *surplus > 0 { vec![warning] } else { Vec::new() }
    }

    /// That heights were missing, if any were.
    pub fn filled_warning(&self) -> Option<Warning> {
        let Self { name, columns, rows, filled, .. } = self;
        let all = columns * rows;
        let text = format!("{name}: filled {filled} of {all} heights, which are missing, from around them");
        let remedy = "say that this is right, { fill = true }, or fill them in the file";
        (*filled > 0).then(|| Warning::new(WarningKind::Data, text).help(remedy))
    }

    /// Its lowest and its highest height (m).
    pub fn range(&self) -> [f32; 2] {
        let low = self.heights.iter().copied().fold(f32::INFINITY, f32::min);
        [low, self.heights.iter().copied().fold(f32::NEG_INFINITY, f32::max)]
    }
}

/// Refuses bounds that enclose nothing.
fn check_bounds(bounds: [f64; 4]) -> Result<[f64; 4]> {
    let [west, south, east, north] = bounds;
    if bounds.iter().all(|edge| edge.is_finite()) && west < east && south < north {
        return Ok(bounds);
    }
    Err(Error::argument(format!(
        "elevation: bounds = {{ {west}, {south}, {east}, {north} }} enclose nothing"
    ))
    .help("write { west, south, east, north }, with west below east and south below north"))
}

/// Refuses coordinates that cannot be.
fn check_grid(name: &str, grid: &SampleGrid, columns: usize, rows: usize, crs: Option<&Crs>) -> Result<()> {
    let [x, y] = grid.first;
    let [dx, dy] = grid.step;
    let last = [x + dx * count(columns - 1), y - dy * count(rows - 1)];
    if [x, y, dx, dy, last[0], last[1]].iter().any(|value| !value.is_finite()) || dx <= 0.0 || dy <= 0.0 {
        return Err(Error::data(format!(
            "{name} lies at {}, {} with steps of {}, {}, which is nowhere",
            number(x),
            number(y),
            number(dx),
            number(dy)
        ))
        .help("name its edges: elevation(file, { bounds = { west, south, east, north } })"));
    }
    if crs.is_some_and(Crs::is_geographic) {
        // A pole may be half a step away.
        if y > 90.0 + dy || last[1] < -90.0 - dy || x < -360.0 - dx || last[0] > 540.0 + dx {
            let (x, y) = (number(x), number(y));
            return Err(Error::data(format!("{name} lies at {x}, {y}, which is no longitude and latitude"))
                .help("name the coordinate system of the file: elevation(file, { crs = 3067 })"));
        }
    } else if dx < FINEST || dy < FINEST {
        return Err(Error::data(format!("{name} has steps of {dx} x {dy} m, less than a millimetre"))
            .help("if these are degrees, say so: elevation(file, { crs = 4326 })"));
    }
    Ok(())
}

/// Refuses heights that cannot be, and takes what marks missing ones for missing.
fn check_heights(name: &str, columns: usize, heights: &mut [f32]) -> Result<()> {
    let mut known = false;
    for (index, height) in heights.iter_mut().enumerate() {
        if height.is_finite() && height.abs() >= MARK {
            *height = f32::NAN;
        }
        // A comparison with what is no number fails.
        if height.abs() > HIGHEST {
            let (row, column) = (index / columns + 1, index % columns + 1);
            let what = match height.is_finite() {
                true => format!("a height of {height} m"),
                false => "an infinite height".to_owned(),
            };
            return Err(Error::data(format!("{name} has {what} in row {row}, column {column}"))
                .help("if it marks missing data, say so in the file: gdal_translate -a_nodata VALUE"));
        }
        known |= !height.is_nan();
    }
    if known {
        return Ok(());
    }
    Err(Error::data(format!("{name} has no data: all its heights are missing"))
        .help("get another part, or look at it in a viewer of maps"))
}
