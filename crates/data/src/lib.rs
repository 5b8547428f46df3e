//! Data files: layers of features with geometry and attributes, from GeoJSON and GeoPackage, and measured
//! [`elevation`].
//!
//! Comes in: a file. Goes out: a [`Listing`] of what it holds, or a [`Layer`] in metres around an origin, ready to
//! be modelled. Coordinates are projected here, once: everything behind works in metres. It never panics on
//! what a file holds, and never changes a file.

mod cache;
pub mod elevation;
#[cfg_attr(not(feature = "data"), path = "absent.rs")]
mod formats;
mod frame;
mod geojson;
mod heights;
mod layer;
mod listing;
pub mod output;
mod table;

use std::fmt;
use std::io::{Read, Seek};
use std::path::Path;
use std::sync::Arc;

pub use burgeon_spatial::{Geometry, GeometryKind};
pub use cache::Cache;
pub use formats::GeoPackage;
#[cfg(feature = "data")]
pub use formats::TableShape;
pub use formats::output::{check_geopackage, write_geopackage};
pub use frame::{Crs, Passage, ReferenceFrame};
pub use layer::Layer;
pub use listing::nearest_file;
pub use listing::{AttributeListing, LayerListing, Listing};
pub use table::{Attribute, Feature, FeatureTable};

use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::text::{listed, shown};

/// The extensions of data files.
pub const EXTENSIONS: [&str; 8] =
    ["geojson", "json", "gpkg", "geojsons", "geojsonl", "geojsonseq", "ndjson", "jsonl"];

/// The extensions of files that hold one GeoJSON document after another.
const SEQUENCES: [&str; 5] = ["geojsons", "geojsonl", "geojsonseq", "ndjson", "jsonl"];

/// What is wanted of a data file.
#[derive(Clone, Default)]
pub struct SourceOptions {
    /// The layer; the only one if `None`.
    pub layer: Option<String>,
    /// An SQL condition that features meet.
    pub condition: Option<String>,
    /// The most features to read.
    pub limit: Option<usize>,
    /// The attribute that tells features apart.
    pub id: Option<String>,
    /// Reads only geometries of this kind.
    pub kind: Option<GeometryKind>,
    /// The EPSG code that holds in place of the file's.
    pub crs: Option<u32>,
    /// What reading may take.
    pub budget: Arc<Budget>,
}

impl fmt::Debug for SourceOptions {
    /// All that decides what is read.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { layer, condition, limit, id, kind, crs, budget: _ } = self;
        write!(f, "{layer:?} {condition:?} {limit:?} {id:?} {kind:?} {crs:?}")
    }
}

/// An open data file.
pub enum Source {
    /// A GeoJSON file, all of it.
    GeoJson(Box<FeatureTable>),
    /// A GeoPackage, a database of layers.
    GeoPackage(GeoPackage),
}

impl Source {
    /// Opens the file at `path`, which messages call `name`. Its content tells what it is.
    ///
    /// Fails if it cannot be read, or is neither GeoJSON nor a GeoPackage.
    pub fn open(path: &Path, name: &str) -> Result<Self> {
        Self::open_within(path, name, &SourceOptions::default())
    }

    /// The same, if it takes no more than the budget that is `wanted`.
    pub fn open_within(path: &Path, name: &str, wanted: &SourceOptions) -> Result<Self> {
        let cannot = |error: std::io::Error| match error.kind() {
            std::io::ErrorKind::NotFound => {
                Error::not_found("data file", name, [], format!("there is no data file {name}"))
                    .help("check the path")
            }
            std::io::ErrorKind::IsADirectory => {
                Error::file(path, format!("{name} is a folder")).help("name a .geojson or .gpkg file in it")
            }
            _ => Error::file(path, format!("cannot read {name}: {error}"))
                .help("name a .geojson or .gpkg file"),
        };
        let (mut file, meta) = burgeon_base::files::open(path).map_err(cannot)?;
        let mut head = Vec::new();
        (&mut file).take(16).read_to_end(&mut head).map_err(cannot)?;
        if head.starts_with(b"SQLite format 3") {
            return Ok(Self::GeoPackage(GeoPackage::open(path, name, wanted)?));
        }
        if meta.len() > geojson::LARGEST {
            return Err(Error::limit(
                Limit::Size,
                format!("{name} is larger than {} MB", geojson::LARGEST / 1_000_000),
            )
            .help("convert it to a GeoPackage, of which a part can be read"));
        }
        wanted.budget.check()?;
        let _held = wanted.budget.hold(usize::try_from(meta.len()).unwrap_or(usize::MAX))?;
        let mut bytes = Vec::with_capacity(usize::try_from(meta.len()).unwrap_or(0));
        file.rewind().and_then(|()| file.take(meta.len()).read_to_end(&mut bytes)).map_err(cannot)?;
        let read = geojson::read(&bytes, path, name, wanted);
        Ok(Self::GeoJson(Box::new(read.map_err(|error| error.about(name))?)))
    }

    /// `GeoJSON` or `GeoPackage`.
    pub fn format(&self) -> &'static str {
        match self {
            Self::GeoJson(_) => "GeoJSON",
            Self::GeoPackage(_) => "GeoPackage",
        }
    }

    /// The names of its layers.
    pub fn layers(&self) -> Vec<String> {
        match self {
            Self::GeoJson(table) => vec![table.layer.clone()],
            Self::GeoPackage(package) => package.layers(),
        }
    }

    /// Reads what is `wanted`, in the order of the file.
    pub fn read(self, name: &str, wanted: &SourceOptions) -> Result<FeatureTable> {
        let layer = choose(name, &self.layers(), wanted.layer.as_deref())?;
        let table = match self {
            Self::GeoPackage(package) => package.read(&layer, wanted)?,
            Self::GeoJson(_) if wanted.condition.is_some() => {
                return Err(Error::argument(format!("{name} is GeoJSON, which takes no where"))
                    .help("where is for GeoPackages; take what you need out of source(...).features in Lua: source(chosen)"));
            }
            Self::GeoJson(mut table) => {
                table.identify(wanted.id.as_deref())?;
                *table
            }
        };
        table.finished(wanted)
    }
}

/// The layer of `name` that is meant.
fn choose(name: &str, layers: &[String], wanted: Option<&str>) -> Result<String> {
    let list = listed(layers.iter().map(String::as_str));
    match (wanted, layers) {
        (_, []) => Err(Error::data(format!("{name} has no layers of features"))
            .help("it holds no features table; was it written as a GeoPackage of features?")),
        (None, [only]) => Ok(only.clone()),
        (None, _) => Err(Error::argument(format!("{name} has several layers"))
            .help(format!("name one behind a colon: \"{name}:{}\"; it has {list}", shown(&layers[0])))),
        (Some(wanted), _) if layers.iter().any(|layer| layer == wanted) => Ok(wanted.to_owned()),
        (Some(wanted), _) => {
            let message = format!("{name} has no layer called {}", shown(wanted));
            Err(Error::not_found("layer", wanted, layers.iter().map(String::as_str), message)
                .help(format!("it has {list}")))
        }
    }
}

/// Parts `FILE:LAYER`; the layer is whatever follows the first colon behind a data file's extension.
pub fn split_name(text: &str) -> (&str, Option<&str>) {
    let lower = text.to_ascii_lowercase();
    let colons = text.match_indices(':').map(|(colon, _)| colon);
    let mut ends = colons.filter(|colon| {
        let file = Path::new(&lower[..*colon]);
        file.extension().is_some_and(|found| EXTENSIONS.iter().any(|known| found == *known))
    });
    match ends.next() {
        Some(colon) => (&text[..colon], Some(&text[colon + 1..])),
        None => (text, None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_layer_stands_behind_the_extension() {
        assert_eq!(split_name("a.gpkg:b:c"), ("a.gpkg", Some("b:c")));
        assert_eq!(split_name("odd:name.GeoJSON"), ("odd:name.GeoJSON", None));
        assert_eq!(split_name("folder/a.gpkg"), ("folder/a.gpkg", None));
        assert_eq!(split_name("a.gpkg:"), ("a.gpkg", Some("")));
    }
}
