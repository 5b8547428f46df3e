//! Measured heights of the ground, to be asked for by place.

use std::fmt;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use burgeon_base::error::{Error, Result};
use burgeon_data::elevation::{HeightOptions, Raster, Relief};
use burgeon_kit::{Expectation, LoadRequest, LoadedObject, Loader, fields, methods, object};
use burgeon_kit::{Parameter, Table, Value, Vector};
use burgeon_terrain::HeightSource;

/// The one encoding of heights as colours that is known.
const TERRAIN_RGB: &str = "terrain-rgb";

/// What `elevation(file, options)` takes besides the file.
#[fields("elevation")]
pub struct ElevationOptions {
    /// The EPSG code of the coordinates, in place of the file's.
    pub crs: Option<u32>,
    /// The height (m) of black in a 16-bit PNG.
    pub low: Option<f64>,
    /// The height (m) of white in a 16-bit PNG.
    pub high: Option<f64>,
    /// The outer edges of the samples, `{ west, south, east, north }`, in `crs`, or in metres without one.
    pub bounds: Option<Vec<f64>>,
    /// How colours of a PNG are heights: `"terrain-rgb"`.
    pub encoding: Option<String>,
    /// Whether heights that are missing are filled in from around them without a word.
    pub fill: bool,
}

impl ElevationOptions {
    /// What is wanted of the file. Fails if the bounds are not four numbers, or the encoding is not known.
    pub fn wanted(self) -> Result<HeightOptions> {
        let bounds = self.bounds.map(|edges| {
            <[f64; 4]>::try_from(edges).map_err(|edges| {
                Error::argument(format!("elevation: bounds has {} numbers, not 4", edges.len()))
                    .help("write { west, south, east, north }")
            })
        });
        if let Some(encoding) = self.encoding.as_deref().filter(|encoding| *encoding != TERRAIN_RGB) {
            return Err(Error::argument(format!("elevation: there is no encoding {encoding:?}"))
                .help(format!("write encoding = {TERRAIN_RGB:?}, or leave it out")));
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

/// Measured heights of the ground, from a file, or from several that lie beside one another.
///
/// It never changes, and copies share it.
#[object("elevation", options = ElevationOptions, loader = LOADER)]
pub struct Elevation {
    relief: Arc<Relief>,
}

#[methods("elevation")]
impl Elevation {
    /// The height of the ground (m) at a place; fails outside of the file's bounds.
    pub fn height(&self, place: Vector) -> Result<f64> {
        self.height_at(place.0.truncate()).ok_or_else(|| self.outside(place.0))
    }

    /// The lowest corner of the box around it (m).
    pub fn low(&self) -> DVec3 {
        self.relief.low()
    }

    /// The highest corner of the box around it (m).
    pub fn high(&self) -> DVec3 {
        self.relief.high()
    }

    /// The distance of neighbouring samples (m).
    pub fn step(&self) -> f64 {
        self.relief.step()
    }
}

impl Elevation {
    /// The heights of `relief`.
    pub fn new(relief: Arc<Relief>) -> Self {
        Self { relief }
    }

    /// The height of the ground (m) at `place` (m); `None` outside of the file's bounds.
    pub fn height_at(&self, place: DVec2) -> Option<f64> {
        self.relief.height(place)
    }

    /// What it asks.
    pub fn relief(&self) -> &Relief {
        &self.relief
    }

    fn outside(&self, place: DVec3) -> Error {
        let (low, high) = (self.relief.low(), self.relief.high());
        Error::argument(format!(
            "elevation: {:.1}, {:.1} lies outside of {}, which reaches from {:.1}, {:.1} to {:.1}, {:.1}",
            place.x,
            place.y,
            self.relief.raster().name,
            low.x,
            low.y,
            high.x,
            high.y
        ))
        .help("ask within its bounds, or use a file that reaches farther")
        .of_data()
    }
}

const LOADER: Loader = Loader {
    what: "file of heights",
    example: "elevation(\"N43E007.hgt\")",
    example_with_fields: "elevation(\"N43E007.hgt\", { crs = 4326 })",
    several: &["hgt", "tif", "tiff", "asc", "zip"],
    load,
};

/// Reads the heights of files, as the options of the script want them.
fn load(file: &mut LoadRequest<'_>, options: &Table) -> Result<LoadedObject> {
    let options = ElevationOptions::from_table(options)?;
    let fill = options.fill;
    let wanted = options.wanted()?;
    let raster = match file.resources.cache() {
        Some(cache) => cache.raster(file.files, &wanted, file.budget),
        None => Raster::open_all(file.files, &wanted, file.budget).map(Arc::new),
    };
    let raster = raster?;
    // A raster that is kept from an earlier run was not read for this one, and takes its room all the same.
    let memory = raster.heights.len() * size_of::<f32>();
    let mut warnings = raster.warnings();
    if !fill {
        warnings.extend(raster.missing_warnings());
    }
    let object = Arc::new(Elevation::new(Arc::new(Relief::new(raster, file.frame)?)));
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
        let what = "an elevation, made once before: elevation(\"N43E007.hgt\")";
        object(value, what).map(|elevation: Arc<Self>| (*elevation).clone())
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
