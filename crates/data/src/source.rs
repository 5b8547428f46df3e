//! Data files of any format, and options for reading them.

use std::fmt;
use std::io::Read;
use std::path::Path;
use std::sync::Arc;

use super::content::{Content, DataFile, LayeredFile};
use super::formats::condition;
use super::formats::{FlatGeobuf, GeoPackage, OsmFile, layered, unpacked};
use super::tags::TagFilter;
use super::{FeatureTable, GeometryKind, foreign, geojson};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::{listed, shown};

/// Options for reading a data file.
#[derive(Clone, Default)]
pub struct SourceOptions {
    /// Name of the layer; the only layer if `None`.
    pub layer: Option<String>,
    /// SQL condition on features.
    pub condition: Option<String>,
    /// Filter of OpenStreetMap tags.
    pub tags: Option<TagFilter>,
    /// West, south, east and north of a box that features must touch, in the coordinates of the file. A feature on the
    /// boundary touches the box; one around the box whose bounding box alone intersects the box does not.
    pub within: Option<[f64; 4]>,
    /// Maximum number of features to read.
    pub limit: Option<usize>,
    /// Name of the id attribute.
    pub id: Option<String>,
    /// Type of the geometries to read.
    pub kind: Option<GeometryKind>,
    /// EPSG code that overrides the file's coordinate system.
    pub crs: Option<u32>,
    /// Limits on the resources for reading.
    pub budget: Arc<Budget>,
}

impl fmt::Debug for SourceOptions {
    /// Writes all options that affect the content that is read.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { layer, condition, tags, within, limit, id, kind, crs, budget: _ } = self;
        write!(f, "{layer:?} {condition:?} {tags:?} {within:?} {limit:?} {id:?} {kind:?} {crs:?}")
    }
}

impl SourceOptions {
    /// Returns the options for a file that does not evaluate conditions itself. The condition and the limit are then
    /// applied after reading.
    fn without_condition(&self) -> Self {
        match &self.condition {
            Some(_) => Self { condition: None, limit: None, ..self.clone() },
            None => self.clone(),
        }
    }
}

/// Open data file.
pub enum Source {
    /// GeoJSON file, completely read.
    GeoJson(Box<FeatureTable>),
    /// GeoPackage, a database of layers.
    GeoPackage(GeoPackage),
    /// FlatGeobuf, one layer.
    FlatGeobuf(Box<FlatGeobuf>),
    /// File of another format, whose layers are read individually.
    Layered(Box<dyn LayeredFile>),
    /// OpenStreetMap extract, with layers selected by tags.
    Osm(OsmFile),
}

/// Remedy for a file that is not a data file.
const NAME_ONE: &str =
    "name a .geojson, .gpkg, .fgb, .shp, .csv, .gml, .kml, .gpx, .city.json or .osm.pbf file";

/// Supported formats.
pub(crate) const FORMATS: &str = "data files are GeoJSON, GeoPackage, FlatGeobuf, Shapefile, CSV, GML, CityGML, CityJSON, KML, GPX, \
                                  .osm and .osm.pbf";

/// Number of first bytes used to detect the format.
const HEAD: u64 = 4096;

impl Source {
    /// Opens the file at `path`, called `name` in messages. The format is detected from the content.
    ///
    /// Fails if the file cannot be read, or has an unknown format.
    pub fn open(path: &Path, name: &str) -> Result<Self> {
        Self::open_within(path, name, &SourceOptions::default())
    }

    /// Opens the file like [`Self::open`], within the budget in `wanted`.
    pub fn open_within(path: &Path, name: &str, wanted: &SourceOptions) -> Result<Self> {
        let cannot = |error: std::io::Error| match error.kind() {
            std::io::ErrorKind::NotFound => {
                Error::not_found("data file", name, [], format!("there is no data file {name}"))
                    .help("check the path")
            }
            std::io::ErrorKind::IsADirectory => foreign::folder(path, name).unwrap_or_else(|| {
                Error::file(path, format!("{name} is a folder")).help(format!("{NAME_ONE} in it"))
            }),
            _ => Error::file(path, format!("cannot read {name}: {error}")).help(NAME_ONE),
        };
        if path.metadata().is_ok_and(|meta| burgeon_base::files::is_locked(&meta)) {
            // A database connection of this process reads the file, and would lose its lock if another handle were
            // closed.
            return Ok(Self::GeoPackage(GeoPackage::open(path, name, wanted)?));
        }
        let (file, _) = burgeon_base::files::open(path).map_err(cannot)?;
        let file = DataFile::new(file, path, name);
        let head = file.content.head(HEAD).map_err(cannot)?;
        wanted.budget.check()?;
        match unpacked(file, &head, wanted)? {
            Ok(source) => Ok(source),
            Err(file) => {
                let head = file.content.head(HEAD).map_err(cannot)?;
                Self::of_content(file, &head, wanted, cannot)
            }
        }
    }

    /// Opens an uncompressed file that begins with `head`.
    fn of_content(
        file: DataFile,
        head: &[u8],
        wanted: &SourceOptions,
        cannot: impl Fn(std::io::Error) -> Error,
    ) -> Result<Self> {
        if head.is_empty() {
            return Err(Error::data(format!("{} is empty", file.name)).help("get the file again"));
        }
        if head.starts_with(b"SQLite format 3") {
            let (open, path, name) = file.on_disk("GeoPackage")?;
            drop(open);
            return Ok(Self::GeoPackage(GeoPackage::open(&path, &name, wanted)?));
        }
        if FlatGeobuf::is_one(head) {
            let (file, path, name) = file.on_disk("FlatGeobuf")?;
            return Ok(Self::FlatGeobuf(Box::new(FlatGeobuf::open(file, &path, &name, wanted)?)));
        }
        if OsmFile::is_one(head) {
            return Ok(Self::Osm(OsmFile::open(file, wanted)?));
        }
        foreign::refuse_beginning(head, &file.name)?;
        let file = match layered(file, head, wanted)? {
            Ok(source) => return Ok(source),
            Err(file) => file,
        };
        if !matches!(head.trim_ascii_start().first(), Some(b'{' | b'[' | 0x1e | 0xef)) {
            foreign::refuse_extension(&file.path, &file.name)?;
        }
        Self::geojson(&file, &wanted.without_condition(), cannot)
    }

    /// Reads a complete GeoJSON file.
    fn geojson(
        file: &DataFile,
        wanted: &SourceOptions,
        cannot: impl Fn(std::io::Error) -> Error,
    ) -> Result<Self> {
        let DataFile { content, path, name } = file;
        let size = content.size().map_err(&cannot)?;
        file.check_size(size, geojson::LARGEST)?;
        if size > 4 * geojson::WINDOW as u64 {
            let text = content.reader().map_err(&cannot)?.take(size);
            let read = geojson::stream(text, path, name, wanted, geojson::WINDOW);
            if let Some(table) = read.map_err(|error| error.about(name))? {
                return Ok(Self::GeoJson(Box::new(table)));
            }
        }
        let bytes = file.bytes(geojson::LARGEST, &wanted.budget)?;
        let read = geojson::read(&bytes, path, name, wanted);
        if let Content::File(_) = content {
            wanted.budget.give(bytes.len());
        }
        Ok(Self::GeoJson(Box::new(read.map_err(|error| error.about(name))?)))
    }

    /// Returns the name of the format.
    pub fn format(&self) -> &'static str {
        match self {
            Self::GeoJson(_) => "GeoJSON",
            Self::GeoPackage(_) => "GeoPackage",
            Self::FlatGeobuf(_) => "FlatGeobuf",
            Self::Layered(file) => file.format(),
            Self::Osm(_) => "OpenStreetMap",
        }
    }

    /// Returns true if the format evaluates conditions and identifies features itself, as databases do.
    fn asks_conditions(&self) -> bool {
        match self {
            Self::GeoPackage(_) => true,
            Self::GeoJson(_) | Self::FlatGeobuf(_) | Self::Layered(_) | Self::Osm(_) => false,
        }
    }

    /// Returns the names of the layers.
    pub fn layers(&self) -> Vec<String> {
        match self {
            Self::GeoJson(table) => vec![table.layer.clone()],
            Self::GeoPackage(package) => package.layers(),
            Self::FlatGeobuf(file) => file.layers(),
            Self::Layered(file) => file.layers(),
            Self::Osm(file) => file.layers(),
        }
    }

    /// Reads the features that `wanted` selects, in file order.
    pub fn read(self, name: &str, wanted: &SourceOptions) -> Result<FeatureTable> {
        if wanted.tags.is_some() && !matches!(self, Self::Osm(_)) {
            return Err(Error::argument(format!("{name} is {}, which takes no tags", self.format()))
                .help("tags are for extracts of OpenStreetMap, .osm.pbf and .osm; leave them out"));
        }
        let (asked, asks_itself) = (wanted, self.asks_conditions());
        let wanted = if asks_itself { asked.clone() } else { asked.without_condition() };
        let wanted = &wanted;
        let mut table = match self {
            Self::Osm(file) => file.read(wanted)?,
            Self::GeoPackage(package) => {
                let layer = choose(name, &package.layers(), wanted.layer.as_deref())?;
                package.read(&layer, wanted)?
            }
            Self::FlatGeobuf(file) => {
                choose(name, &file.layers(), wanted.layer.as_deref())?;
                file.read(wanted)?
            }
            Self::Layered(file) => {
                let layer = choose(name, &file.layers(), wanted.layer.as_deref())?;
                file.read(&layer, wanted)?
            }
            Self::GeoJson(table) => {
                choose(name, std::slice::from_ref(&table.layer), wanted.layer.as_deref())?;
                *table
            }
        };
        if !asks_itself {
            table.identify(wanted.id.as_deref())?;
            if let Some(condition) = &asked.condition {
                let kept = condition::meeting(&table, condition, asked)?;
                table.keep(&kept, asked.limit);
            }
        }
        table.finished(asked)
    }
}

/// Returns the error for a table without features.
pub(super) fn nothing(table: &FeatureTable, wanted: &SourceOptions) -> Error {
    let what = &table.shown;
    if wanted.limit == Some(0) {
        return Error::argument(format!("limit = 0 leaves no feature of {what}")).help("leave limit out");
    }
    if let Some(condition) = &wanted.condition {
        return Error::data(format!("no feature of {what} meets where {condition}"))
            .help("burgeon sources FILE lists attributes and their values");
    }
    if let (Some([west, south, east, north]), true) = (wanted.within, table.has_seen()) {
        let place = format!("{{ {west}, {south}, {east}, {north} }}");
        return Error::data(format!("no feature of {what} touches within = {place}"))
            .help("it is { west, south, east, north } in the coordinates of the file, which burgeon sources FILE lists");
    }
    if wanted.tags.is_some() {
        return Error::data(format!("no feature of {what} has such tags"))
            .help("look up how mappers tag it: https://wiki.openstreetmap.org/wiki/Map_features");
    }
    if table.empty > 0 {
        return Error::data(format!("{what} has no features with a geometry"));
    }
    Error::data(format!("{what} has no features"))
}

/// Returns the requested layer of the file `name`, or its only layer.
pub(crate) fn choose(name: &str, layers: &[String], wanted: Option<&str>) -> Result<String> {
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
