//! A raster of heights in the coordinates of its file.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use super::missing::{UndeclaredMarks, take_out};
use super::{fill, format, mosaic};
use crate::Crs;
use crate::heights::{HeightOptions, RasterHeader, SampleGrid, count};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::text::{grouped, number};
use burgeon_base::warning::{Warning, WarningKind};

/// The largest file (bytes).
const LARGEST: u64 = 2_000_000_000;
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
    /// Heights that mark missing ones, though the file does not say so. They are among those that were filled.
    pub marks: UndeclaredMarks,
    /// The parts that have heights, if it was joined of several files that leave gaps: the first column and row, and those behind
    /// the last.
    pub parts: Vec<[usize; 4]>,
    /// The greatest difference (m) where files have different heights for one place.
    pub seam: f32,
}

impl Raster {
    /// Reads the file at `path`, which messages call `name`. Its content and its extension tell the format.
    ///
    /// Fails if it cannot be read, is in no known format, is cut short or too large, or has no heights; if it does not
    /// tell where it lies and `wanted` does not either, which is known before any heights are read; and if reading takes
    /// more than the `budget`.
    pub fn open(path: &Path, name: &str, wanted: &HeightOptions, budget: &Budget) -> Result<Self> {
        with_bytes(path, name, budget, |bytes| Self::read(bytes, name, wanted, budget))
    }

    /// Reads `bytes`, the content of a file called `name`. Fails as [`Raster::open`] does.
    pub fn read(bytes: &[u8], name: &str, wanted: &HeightOptions, budget: &Budget) -> Result<Self> {
        let mut raster = Self::read_unfilled(bytes, name, wanted, budget)?;
        raster.fill(budget)?;
        Ok(raster)
    }

    /// Reads several files as one ground; each has a name for messages, and a path. Fails as [`Raster::open`] does, and if their
    /// samples do not lie on one grid.
    ///
    /// Where files overlap, and on the borders that they share, a height that one of them lacks comes from another one.
    pub fn open_all(files: &[(String, PathBuf)], wanted: &HeightOptions, budget: &Budget) -> Result<Self> {
        if let [(name, path)] = files {
            return Self::open(path, name, wanted, budget);
        }
        if wanted.bounds.is_some() {
            return Err(Error::argument("elevation: bounds are those of one file, not of several")
                .help("leave bounds out, and name files that tell where they lie"));
        }
        let tiles = files.iter().map(|(name, path)| {
            with_bytes(path, name, budget, |bytes| Self::read_unfilled(bytes, name, wanted, budget))
        });
        let mut raster = mosaic::join(tiles.collect::<Result<_>>()?, budget)?;
        raster.fill(budget)?;
        Ok(raster)
    }

    /// Fills its holes.
    fn fill(&mut self, budget: &Budget) -> Result<()> {
        self.filled = mosaic::count_missing(self);
        mosaic::extend(self);
        fill::fill(self.columns, self.rows, &mut self.heights, budget)?;
        Ok(())
    }

    /// Reads `bytes`, and leaves its holes (NaN).
    fn read_unfilled(bytes: &[u8], name: &str, wanted: &HeightOptions, budget: &Budget) -> Result<Self> {
        let RasterHeader { columns, rows, grid, crs, is_told, heights } = format::read(bytes, name, wanted)?;
        let crs = match wanted.crs {
            Some(code) => Some(Crs::epsg(code).map_err(|error| {
                Error::not_found("coordinate system", code, [], format!("elevation: {}", error.message()))
                    .help("name the right one: elevation(file, { crs = 4326 })")
            })?),
            None if wanted.anywhere => None,
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
        let marks = take_out(name, columns, &mut heights, crs.is_some(), is_told)?;
        Ok(Self { surplus, marks, ..Self::new(name, [columns, rows], heights, grid, crs) })
    }

    /// A raster without holes, of `heights` that lie on `grid`.
    pub fn new(
        name: &str,
        [columns, rows]: [usize; 2],
        heights: Vec<f32>,
        grid: SampleGrid,
        crs: Option<Crs>,
    ) -> Self {
        let marks = UndeclaredMarks::default();
        let name = name.to_owned();
        Self {
            name,
            columns,
            rows,
            heights,
            grid,
            crs,
            filled: 0,
            surplus: 0,
            marks,
            parts: Vec::new(),
            seam: 0.0,
        }
    }

    /// Its outer edges: west, south, east and north. A sample stands for the area half a step around it.
    pub fn bounds(&self) -> [f64; 4] {
        let SampleGrid { first, step } = self.grid;
        let (west, north) = (first[0] - step[0] / 2.0, first[1] + step[1] / 2.0);
        [west, north - step[1] * count(self.rows), west + step[0] * count(self.columns), north]
    }

    /// The warnings about how it was read.
    pub fn warnings(&self) -> Vec<Warning> {
        let Self { name, columns, rows, surplus, seam, .. } = self;
        let warning = |text: String, help: &str| Warning::new(WarningKind::Data, text).help(help);
        let what = if *surplus == 1 { "number" } else { "numbers" };
        let surplus = (*surplus > 0).then(|| {
            let text =
                format!("{name} has {surplus} {what} more than the {columns} x {rows} heights of its header");
            warning(text, "they are left out; correct ncols and nrows")
        });
        let seam = (*seam > 0.0).then(|| {
            let text = format!("{name}: files differ by up to {seam} m in the heights that they share");
            warning(text, "the means are used; get all files from one edition of one survey")
        });
        surplus.into_iter().chain(seam).collect()
    }

    /// The warnings about heights that were missing, if any were.
    pub fn missing_warnings(&self) -> Vec<Warning> {
        let Self { name, columns, rows, filled, marks, .. } = self;
        let warning = |text: String, help: &str| Warning::new(WarningKind::Data, text).help(help);
        let all = columns * rows;
        let filled = (*filled > 0).then(|| {
            let text =
                format!("{name}: filled {filled} of {all} heights, which are missing, from around them");
            warning(text, "say that this is right, { fill = true }, or fill them in the file")
        });
        let marks = (marks.count > 0).then(|| {
            let (count, values) = (grouped(marks.count), marks.shown());
            let (heights, counts) =
                if marks.count == 1 { ("height is", "counts") } else { ("heights are", "count") };
            let text = format!(
                "{name}: {count} {heights} {values} and {counts} as missing, though the file does not declare it"
            );
            warning(text, "declare the mark in the file: gdal_translate -a_nodata VALUE IN OUT.tif")
        });
        filled.into_iter().chain(marks).collect()
    }

    /// Whether it has heights at a column and a row, counted from the centre of the first sample: it has none outside of its samples'
    /// areas, nor in gaps between the files that it was joined of. A place `margin` (samples) outside counts as inside.
    pub(super) fn covers(&self, column: f64, row: f64, margin: f64) -> bool {
        let covers = |[left, top, right, bottom]: [usize; 4]| {
            let margin = 0.5 + margin;
            column >= count(left) - margin
                && row >= count(top) - margin
                && column <= count(right) - 1.0 + margin
                && row <= count(bottom) - 1.0 + margin
        };
        match &*self.parts {
            [] => covers([0, 0, self.columns, self.rows]),
            parts => parts.iter().copied().any(covers),
        }
    }

    /// Its lowest and its highest height (m).
    pub fn range(&self) -> [f32; 2] {
        let low = self.heights.iter().copied().fold(f32::INFINITY, f32::min);
        [low, self.heights.iter().copied().fold(f32::NEG_INFINITY, f32::max)]
    }
}

/// Has `read` read the content of the file at `path`.
fn with_bytes<T>(
    path: &Path,
    name: &str,
    budget: &Budget,
    read: impl FnOnce(&[u8]) -> Result<T>,
) -> Result<T> {
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
    read(&bytes)
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
