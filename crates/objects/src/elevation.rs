//! Measured ground heights, queried by position.

use std::fmt;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use burgeon_base::error::{Error, Result};
use burgeon_data::Cache;
use burgeon_data::elevation::{HeightOptions, Raster, Relief};
use burgeon_kit::{Expectation, LoadRequest, LoadedObject, Loader, fields, methods, object};
use burgeon_kit::{Parameter, Table, Value, Vector};
use burgeon_spatial::ReferenceFrame;
use burgeon_terrain::HeightSource;

/// Name of the only supported encoding of heights as colours.
const TERRAIN_RGB: &str = "terrain-rgb";

/// Options of `elevation(file, options)`.
#[fields("elevation")]
pub struct ElevationOptions {
    /// EPSG code of the coordinates, instead of the file's.
    pub crs: Option<u32>,
    /// Height (m) of black in a 16-bit PNG.
    pub low: Option<f64>,
    /// Height (m) of white in a 16-bit PNG.
    pub high: Option<f64>,
    /// Outer edges of the samples, `{ west, south, east, north }`, in `crs`, or in metres if `crs` is omitted.
    pub bounds: Option<Vec<f64>>,
    /// Encoding of heights as colours of a PNG: `"terrain-rgb"`.
    pub encoding: Option<String>,
    /// Fill missing heights from neighbouring heights without a warning.
    pub fill: bool,
}

impl ElevationOptions {
    /// Converts the options for reading the file. Fails if the bounds are not four numbers, or the encoding is unknown.
    pub fn wanted(self) -> Result<HeightOptions> {
        let bounds = self.bounds.map(|edges| {
            <[f64; 4]>::try_from(edges).map_err(|edges| {
                Error::argument(format!("elevation: bounds has {} numbers, not 4", edges.len()))
                    .help("write { west, south, east, north }")
            })
        });
        if let Some(encoding) = self.encoding.as_deref().filter(|encoding| *encoding != TERRAIN_RGB) {
            return Err(Error::argument(format!("elevation: unknown encoding {encoding:?}"))
                .help(format!("write encoding = {TERRAIN_RGB:?}, or omit it")));
        }
        Ok(HeightOptions {
            crs: self.crs,
            low: self.low,
            high: self.high,
            bounds: bounds.transpose()?,
            terrain_rgb: self.encoding.is_some(),
            anywhere: false,
        })
    }
}

/// Measured ground heights, from one file or from several adjacent files.
///
/// An elevation is immutable; copies share it.
#[object("elevation", options = ElevationOptions, loader = LOADER)]
pub struct Elevation {
    relief: Arc<Relief>,
}

#[methods("elevation")]
impl Elevation {
    /// Returns the ground height (m) at a position. Fails outside the file's bounds.
    pub fn height(&self, place: Vector) -> Result<f64> {
        self.height_at(place.0.truncate()).ok_or_else(|| self.outside_error(place.0))
    }

    /// Returns the minimum corner of the bounding box (m).
    pub fn low(&self) -> DVec3 {
        self.relief.low()
    }

    /// Returns the maximum corner of the bounding box (m).
    pub fn high(&self) -> DVec3 {
        self.relief.high()
    }

    /// Returns the distance (m) between neighbouring samples.
    pub fn step(&self) -> f64 {
        self.relief.step()
    }
}

impl Elevation {
    /// Creates an elevation with the heights of `relief`.
    pub fn new(relief: Arc<Relief>) -> Self {
        Self { relief }
    }

    /// Returns the ground height (m) at `place` (m), or `None` outside the file's bounds.
    ///
    /// ```
    /// use burgeon_data::elevation::{Raster, Relief, SampleGrid};
    /// use burgeon_objects::Elevation;
    /// use glam::DVec2;
    /// use std::sync::Arc;
    ///
    /// let grid = SampleGrid { first: [0.0, 10.0], step: [10.0, 10.0] };
    /// let raster = Raster::new("slope", [2, 2], vec![1.0, 3.0, 1.0, 3.0], grid, None);
    /// let elevation = Elevation::new(Arc::new(Relief::new(Arc::new(raster), &mut None)?));
    /// assert_eq!(elevation.height_at(DVec2::new(10.0, 0.0)), Some(3.0));
    /// assert_eq!(elevation.height_at(DVec2::new(500.0, 0.0)), None);
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn height_at(&self, place: DVec2) -> Option<f64> {
        self.relief.height(place)
    }

    /// Returns the heights that this elevation queries.
    pub fn relief(&self) -> &Relief {
        &self.relief
    }

    fn outside_error(&self, place: DVec3) -> Error {
        let (low, high) = (self.relief.low(), self.relief.high());
        Error::argument(format!(
            "elevation: {:.1}, {:.1} is outside {}, which extends from {:.1}, {:.1} to {:.1}, {:.1}",
            place.x,
            place.y,
            self.relief.raster().name,
            low.x,
            low.y,
            high.x,
            high.y
        ))
        .help("use a position within its bounds, or a larger file")
        .of_data()
    }
}

const LOADER: Loader = Loader {
    what: "height file",
    example: "elevation(\"N43E007.hgt\")",
    example_with_fields: "elevation(\"N43E007.hgt\", { crs = 4326 })",
    several: &["hgt", "tif", "tiff", "asc", "zip"],
    load,
};

/// Reads the heights of files with the options of the script.
fn load(file: &mut LoadRequest<'_>, options: &Table) -> Result<LoadedObject> {
    let options = ElevationOptions::from_table(options)?;
    let fill = options.fill;
    let wanted = options.wanted()?;
    let raster = match file.service::<Option<Arc<Cache>>>().cloned().flatten() {
        Some(cache) => cache.raster(file.files, &wanted, file.budget),
        None => Raster::open_all(file.files, &wanted, file.budget).map(Arc::new),
    };
    let raster = raster?;
    // A raster cached by an earlier run was not read in this run, but still counts against the memory budget.
    let memory = raster.heights.len() * size_of::<f32>();
    let mut warnings = raster.warnings();
    if !fill {
        warnings.extend(raster.missing_warnings());
    }
    let mut own_frame = None;
    let frame = file.service::<Option<ReferenceFrame>>().unwrap_or(&mut own_frame);
    let object = Arc::new(Elevation::new(Arc::new(Relief::new(raster, frame)?)));
    Ok(LoadedObject { object, memory, warnings })
}

impl HeightSource for Elevation {
    fn ground(&self, place: DVec2, smooth: bool) -> Option<(f64, f64)> {
        self.relief.ground(place, smooth)
    }

    fn freedom(&self, place: DVec2) -> f64 {
        self.relief.between(place)
    }

    fn step(&self) -> f64 {
        self.relief.step()
    }

    fn samples(&self, low: DVec2, high: DVec2) -> Vec<DVec2> {
        self.relief.samples(low, high)
    }
}

impl Parameter for Elevation {
    fn luau() -> String {
        "Elevation".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let what = "an elevation, created once before: elevation(\"N43E007.hgt\")";
        object(value, what).map(Arc::unwrap_or_clone)
    }

    fn into_value(self) -> Value {
        Value::Object(Arc::new(self))
    }
}

impl fmt::Debug for Elevation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "elevation of {}", self.relief.raster().name)
    }
}
