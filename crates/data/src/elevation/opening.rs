//! Reading of height files into rasters without holes.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use super::missing::take_out;
use super::raster::Raster;
use super::{fill, format, mosaic};
use crate::companions;
use crate::heights::marks::is_negative_mark;
use crate::heights::{HeightOptions, RasterHeader, SampleGrid, count, narrow};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::text::number;
use burgeon_spatial::Crs;
use burgeon_spatial::crs::{crs_of_text, height_unit};

/// Maximum file size (bytes).
const LARGEST: u64 = 2_000_000_000;
/// Minimum sample distance (m) for coordinates in metres.
const FINEST: f64 = 1e-3;

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
    ///
    /// ```
    /// use burgeon_base::Budget;
    /// use burgeon_data::elevation::{HeightOptions, Raster};
    ///
    /// let grid = "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\n1 2 3\n4 5 6\n";
    /// let wanted = HeightOptions { crs: Some(3067), ..HeightOptions::default() };
    /// let raster = Raster::read(grid.as_bytes(), "hill.asc", &wanted, &Budget::default())?;
    /// assert_eq!((raster.columns, raster.rows, raster.range()), (3, 2, [1.0, 6.0]));
    /// assert_eq!(raster.bounds(), [0.0, 0.0, 30.0, 20.0]);
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn read(bytes: &[u8], name: &str, wanted: &HeightOptions, budget: &Budget) -> Result<Self> {
        let mut raster = Self::read_unfilled(bytes, name, wanted, &|| Ok(None), budget)?;
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
            return Err(Error::argument("elevation: bounds can only be set for a single file")
                .help("remove bounds, and use files that contain their location"));
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
        with_bytes(path, name, budget, |bytes| {
            Self::read_unfilled(bytes, name, wanted, &|| companions::coordinate_system(path, name), budget)
        })
    }

    /// Reads `bytes` without filling holes (NaN). `prj` returns the text of the `.prj` file next to the file; it is called
    /// only if the file has no coordinate system.
    fn read_unfilled(
        bytes: &[u8],
        name: &str,
        wanted: &HeightOptions,
        prj: &dyn Fn() -> Result<Option<String>>,
        budget: &Budget,
    ) -> Result<Self> {
        let RasterHeader { columns, rows, grid, crs, is_told, has_unit, heights } =
            format::read(bytes, name, wanted)?;
        let beside =
            CompanionSystem { name: Path::new(name).with_extension("prj").display().to_string(), prj };
        let (crs, unit) = match wanted.crs {
            Some(code) => {
                let known = Crs::epsg(code).map_err(|error| {
                    let message = format!("elevation: {}", error.message());
                    Error::not_found("coordinate system", code, [], message)
                        .help("specify the correct one: elevation(file, { crs = 4326 })")
                })?;
                (Some(known), beside.unit_alone(&crs))
            }
            None if wanted.anywhere => (None, beside.unit_alone(&crs)),
            None => match crs? {
                Some(crs) => (Some(crs), None),
                None => beside.read()?,
            },
        };
        let grid = match wanted.bounds {
            Some(bounds) => Some(SampleGrid::between(check_bounds(bounds)?, columns, rows)),
            None => grid,
        };
        let grid = grid.ok_or_else(|| {
            Error::data(format!("{name} does not contain its location")).help(
                "specify its bounds: elevation(file, { bounds = { west, south, east, north } }), in metres of the run, or in the coordinate system crs",
            )
        })?;
        check_grid(name, &grid, columns, rows, crs.as_ref())?;
        budget.check()?;
        budget.take(columns * rows * size_of::<f32>())?;
        let mut heights = heights(budget)?;
        let surplus = heights.len().saturating_sub(columns * rows);
        heights.truncate(columns * rows);
        if let Some(unit) = unit.filter(|_| !has_unit) {
            heights.iter_mut().for_each(|height| *height = in_metres((*height).into(), unit));
        }
        let marks = take_out(name, columns, &mut heights, crs.is_some(), is_told)?;
        Ok(Self { surplus, marks, ..Self::new(name, [columns, rows], heights, grid, crs) })
    }
}

/// Coordinate system in the `.prj` file next to a file of heights.
struct CompanionSystem<'a> {
    /// Name of the file in messages.
    name: String,
    /// Function that returns its text, if there is one.
    prj: &'a dyn Fn() -> Result<Option<String>>,
}

impl CompanionSystem<'_> {
    /// Returns the coordinate system, and the length (m) of the unit of its heights, if the text has them.
    fn read(&self) -> Result<(Option<Crs>, Option<f64>)> {
        let Some(text) = (self.prj)()? else { return Ok((None, None)) };
        let crs = crs_of_text(&text, &self.name, "specify its EPSG code: elevation(file, { crs = 3067 })")?;
        Ok((Some(crs), self.unit_in(&text)?))
    }

    /// Returns the length (m) of the unit of heights if the coordinate system itself is not needed, unless the file of
    /// heights has one of its own.
    fn unit_alone(&self, own: &Result<Option<Crs>>) -> Option<f64> {
        let Ok(None) = own else { return None };
        self.unit_in(&(self.prj)().ok()??).ok()?
    }

    fn unit_in(&self, text: &str) -> Result<Option<f64>> {
        height_unit(
            text,
            &self.name,
            "convert the heights to metres, and write them into the file: gdal_translate",
        )
    }
}

/// Converts a height from a unit of this length (m); the minimum number if it is an undeclared marker of missing values.
fn in_metres(height: f64, unit: f64) -> f32 {
    if is_negative_mark(height) { f32::MIN } else { narrow(height * unit) }
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
        return Err(
            Error::file(path, format!("{name} is a folder")).help("specify a height file in the folder")
        );
    }
    if !meta.is_file() {
        return Err(Error::file(path, format!("{name} is not a file")).help("specify a height file"));
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
    Err(Error::argument(format!("elevation: bounds = {{ {west}, {south}, {east}, {north} }} are empty"))
        .help("write { west, south, east, north }, with west below east and south below north"))
}

/// Fails if coordinates are impossible.
fn check_grid(name: &str, grid: &SampleGrid, columns: usize, rows: usize, crs: Option<&Crs>) -> Result<()> {
    let [x, y] = grid.first;
    let [dx, dy] = grid.step;
    let last = [x + dx * count(columns - 1), y - dy * count(rows - 1)];
    if [x, y, dx, dy, last[0], last[1]].iter().any(|value| !value.is_finite()) || dx <= 0.0 || dy <= 0.0 {
        return Err(Error::data(format!(
            "{name} has an invalid location: {}, {} with steps of {}, {}",
            number(x),
            number(y),
            number(dx),
            number(dy)
        ))
        .help("specify its bounds: elevation(file, { bounds = { west, south, east, north } })"));
    }
    if crs.is_some_and(Crs::is_geographic) {
        // A pole may be half a step away.
        if y > 90.0 + dy || last[1] < -90.0 - dy || x < -360.0 - dx || last[0] > 540.0 + dx {
            let (x, y) = (number(x), number(y));
            return Err(Error::data(format!(
                "{name} is at {x}, {y}, which is not a valid longitude and latitude"
            ))
            .help("specify the coordinate system of the file: elevation(file, { crs = 3067 })"));
        }
    } else if dx < FINEST || dy < FINEST {
        return Err(Error::data(format!("{name} has steps of {dx} x {dy} m, less than a millimetre"))
            .help("if these are degrees, specify it: elevation(file, { crs = 4326 })"));
    }
    Ok(())
}
