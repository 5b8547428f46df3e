//! Raster of heights in the coordinates of its file.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use super::missing::{UndeclaredMarks, take_out};
use super::{fill, format, mosaic};
use crate::formats::crs_of_text;
use crate::heights::{HeightOptions, RasterHeader, SampleGrid, count};
use crate::{Crs, companions};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::text::{grouped, number};
use burgeon_base::warning::{Warning, WarningKind};

/// Maximum file size (bytes).
const LARGEST: u64 = 2_000_000_000;
/// Minimum sample distance (m) for coordinates in metres.
const FINEST: f64 = 1e-3;

/// Heights without holes, in rows from north to south.
#[derive(Debug, Clone)]
pub struct Raster {
    /// Name in messages.
    pub name: String,
    /// Number of samples from west to east.
    pub columns: usize,
    /// Number of samples from north to south.
    pub rows: usize,
    /// Heights (m), row by row, each from west to east.
    pub heights: Vec<f32>,
    /// Positions of the samples.
    pub grid: SampleGrid,
    /// Coordinate system; without one, the coordinates are metres of the run.
    pub crs: Option<Crs>,
    /// Number of missing heights that were filled from the boundaries of their holes.
    pub filled: usize,
    /// Number of heights beyond the number in the header; they are ignored.
    pub surplus: usize,
    /// Heights treated as markers of missing values although the file does not declare them. They are included in
    /// `filled`.
    pub marks: UndeclaredMarks,
    /// Parts with heights, if the raster was joined from several files with gaps: first column and row, end column and
    /// row.
    pub parts: Vec<[usize; 4]>,
    /// Maximum difference (m) between files at the same position.
    pub seam: f32,
}

impl Raster {
    /// Reads the file at `path`, called `name` in messages. The format is detected from the content and the extension.
    ///
    /// Fails if the file cannot be read, has an unknown format, is truncated or too large, or has no heights. Fails,
    /// before any heights are read, if neither the file nor `wanted` contains its position. Fails if reading exceeds
    /// the `budget`.
    pub fn open(path: &Path, name: &str, wanted: &HeightOptions, budget: &Budget) -> Result<Self> {
        let mut raster = Self::open_unfilled(path, name, wanted, budget)?;
        raster.fill(budget)?;
        Ok(raster)
    }

    /// Reads `bytes`, the content of a file called `name`. Fails like [`Raster::open`].
    pub fn read(bytes: &[u8], name: &str, wanted: &HeightOptions, budget: &Budget) -> Result<Self> {
        let mut raster = Self::read_unfilled(bytes, name, wanted, None, budget)?;
        raster.fill(budget)?;
        Ok(raster)
    }

    /// Reads several files as one terrain; each has a name for messages and a path. Fails like [`Raster::open`], and if
    /// the samples are not on one grid.
    ///
    /// In overlaps and on shared borders, a height missing in one file is taken from another file.
    pub fn open_all(files: &[(String, PathBuf)], wanted: &HeightOptions, budget: &Budget) -> Result<Self> {
        if let [(name, path)] = files {
            return Self::open(path, name, wanted, budget);
        }
        if wanted.bounds.is_some() {
            return Err(Error::argument("elevation: bounds are those of one file, not of several")
                .help("leave bounds out, and name files that tell where they lie"));
        }
        let tiles = files.iter().map(|(name, path)| Self::open_unfilled(path, name, wanted, budget));
        let mut raster = mosaic::join(tiles.collect::<Result<_>>()?, budget)?;
        raster.fill(budget)?;
        Ok(raster)
    }

    /// Fills the holes.
    fn fill(&mut self, budget: &Budget) -> Result<()> {
        self.filled = mosaic::count_missing(self);
        mosaic::extend(self);
        fill::fill(self.columns, self.rows, &mut self.heights, budget)?;
        Ok(())
    }

    /// Reads a file without filling holes.
    fn open_unfilled(path: &Path, name: &str, wanted: &HeightOptions, budget: &Budget) -> Result<Self> {
        let prj = companions::coordinate_system(path);
        with_bytes(path, name, budget, |bytes| {
            Self::read_unfilled(bytes, name, wanted, prj.as_deref(), budget)
        })
    }

    /// Reads `bytes` without filling holes (NaN). `prj` is the text of the `.prj` file next to the file.
    fn read_unfilled(
        bytes: &[u8],
        name: &str,
        wanted: &HeightOptions,
        prj: Option<&str>,
        budget: &Budget,
    ) -> Result<Self> {
        let RasterHeader { columns, rows, grid, crs, is_told, heights } = format::read(bytes, name, wanted)?;
        let crs = match wanted.crs {
            Some(code) => Some(Crs::epsg(code).map_err(|error| {
                Error::not_found("coordinate system", code, [], format!("elevation: {}", error.message()))
                    .help("name the right one: elevation(file, { crs = 4326 })")
            })?),
            None if wanted.anywhere => None,
            None => match (crs?, prj) {
                (None, Some(text)) => {
                    let remedy = "name its EPSG code: elevation(file, { crs = 3067 })";
                    Some(crs_of_text(
                        text,
                        &Path::new(name).with_extension("prj").display().to_string(),
                        remedy,
                    )?)
                }
                (crs, _) => crs,
            },
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

    /// Creates a raster without holes from `heights` on `grid`.
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

    /// Returns the outer edges: west, south, east and north. A sample represents the area up to half a step around it.
    pub fn bounds(&self) -> [f64; 4] {
        let SampleGrid { first, step } = self.grid;
        let (west, north) = (first[0] - step[0] / 2.0, first[1] + step[1] / 2.0);
        [west, north - step[1] * count(self.rows), west + step[0] * count(self.columns), north]
    }

    /// Returns the warnings about reading the raster.
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
        let shift = self.crs.as_ref().and_then(|crs| crs.shift_note(name));
        let shift = shift.map(|[text, help]| warning(text, &help));
        surplus.into_iter().chain(seam).chain(shift).collect()
    }

    /// Returns the warnings about missing heights, if any.
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

    /// Returns true if the raster has heights at a column and a row, counted from the centre of the first sample. The
    /// areas outside the samples and the gaps between joined files have no heights. Positions up to `margin` (samples)
    /// outside also count.
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

    /// Returns the lowest and the highest height (m).
    pub fn range(&self) -> [f32; 2] {
        let low = self.heights.iter().copied().fold(f32::INFINITY, f32::min);
        [low, self.heights.iter().copied().fold(f32::NEG_INFINITY, f32::max)]
    }
}

/// Calls `read` with the content of the file at `path`.
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
    // The file may grow while it is read.
    File::open(path).and_then(|file| file.take(meta.len()).read_to_end(&mut bytes)).map_err(cannot)?;
    read(&bytes)
}

/// Fails if bounds enclose no area.
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

/// Fails if coordinates are impossible.
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
