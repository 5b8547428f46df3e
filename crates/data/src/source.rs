//! Data files of any format.

use std::borrow::Cow;
use std::io::Read;
use std::path::Path;

use super::content::{Content, DataFile};
use super::features::table::FeatureTable;
use super::formats::condition;
use super::formats::{FlatGeobuf, GeoPackage, OsmFile, open_layers, unpack_file};
use super::layer_choice::choose_layer;
use super::layered_file::LayeredFile;
use super::source_options::SourceOptions;
use super::{foreign, geojson};
use burgeon_base::error::{Error, Result};

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
    "specify a .geojson, .gpkg, .fgb, .shp, .csv, .gml, .kml, .gpx, .city.json or .osm.pbf file";

/// Number of first bytes used to detect the format.
const HEAD: u64 = 4096;

impl Source {
    /// Opens the file at `path`, called `name` in messages. The format is detected from the content.
    ///
    /// Fails if the file cannot be read, or has an unknown format.
    ///
    /// ```
    /// use burgeon_data::{Source, SourceOptions};
    ///
    /// let folder = tempfile::tempdir()?;
    /// let path = folder.path().join("lake.geojson");
    /// let lake = r#"{ "type": "Polygon", "coordinates": [[[27, 60], [27.1, 60], [27, 60.1], [27, 60]]] }"#;
    /// std::fs::write(&path, lake)?;
    /// let table = Source::open(&path, "lake.geojson")?.read("lake.geojson", &SourceOptions::default())?;
    /// assert_eq!((table.features.len(), table.crs?.name()), (1, "EPSG:4326".to_owned()));
    /// assert!(Source::open(&folder.path().join("sea.geojson"), "sea.geojson").is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn open(path: &Path, name: &str) -> Result<Self> {
        Self::open_within(path, name, &SourceOptions::default())
    }

    /// Opens the file like [`Self::open`], within the budget in `wanted`.
    pub fn open_within(path: &Path, name: &str, wanted: &SourceOptions) -> Result<Self> {
        let cannot = |error: std::io::Error| match error.kind() {
            std::io::ErrorKind::NotFound => {
                Error::not_found("data file", name, [], format!("data file not found: {name}"))
                    .help("check the path")
            }
            std::io::ErrorKind::IsADirectory => foreign::folder(path, name).unwrap_or_else(|| {
                Error::file(path, format!("{name} is a folder")).help(format!("{NAME_ONE} in the folder"))
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
        match unpack_file(file, &head, wanted)? {
            Ok(layers) => Ok(Self::Layered(layers)),
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
            return Err(Error::data(format!("{} is empty", file.name)).help("download the file again"));
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
            return Ok(Self::Osm(OsmFile::open(file, head, wanted)?));
        }
        foreign::refuse_beginning(head, &file.name)?;
        let file = match open_layers(file, head, wanted)? {
            Ok(layers) => return Ok(Self::Layered(layers)),
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
    pub fn layers(&self) -> Vec<&str> {
        match self {
            Self::GeoJson(table) => vec![table.layer.as_str()],
            Self::GeoPackage(package) => package.layers(),
            Self::FlatGeobuf(file) => file.layers(),
            Self::Layered(file) => file.layers(),
            Self::Osm(file) => file.layers(),
        }
    }

    /// Reads the features that `wanted` selects, in file order.
    ///
    /// ```
    /// use burgeon_data::{Source, SourceOptions};
    ///
    /// let folder = tempfile::tempdir()?;
    /// let path = folder.path().join("trees.csv");
    /// std::fs::write(&path, "id,kind,longitude,latitude\n7,oak,24.9,60.2\n8,elm,24.9,60.3\n")?;
    /// let (condition, id) = (Some("kind = 'elm'".to_owned()), Some("id".to_owned()));
    /// let source = Source::open(&path, "trees.csv")?;
    /// assert_eq!((source.format(), source.layers()), ("CSV", vec!["trees"]));
    /// let elms = source.read("trees.csv", &SourceOptions { condition, id, ..SourceOptions::default() })?;
    /// assert_eq!((elms.features.len(), elms.features[0].id.as_str()), (1, "8"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn read(self, name: &str, wanted: &SourceOptions) -> Result<FeatureTable> {
        if wanted.tags.is_some() && !matches!(self, Self::Osm(_)) {
            return Err(Error::argument(format!("{name} is {}, so tags are not allowed", self.format()))
                .help("tags are only for OpenStreetMap extracts (.osm.pbf and .osm); remove them"));
        }
        let (asked, asks_itself) = (wanted, self.asks_conditions());
        let wanted = if asks_itself { Cow::Borrowed(asked) } else { asked.without_condition() };
        let wanted = &*wanted;
        let mut table = match self {
            Self::Osm(file) => file.read(wanted)?,
            Self::GeoPackage(package) => {
                let layer = choose_layer(name, &package.layers(), wanted.layer.as_deref())?;
                package.read(&layer, wanted)?
            }
            Self::FlatGeobuf(file) => {
                choose_layer(name, &file.layers(), wanted.layer.as_deref())?;
                file.read(wanted)?
            }
            Self::Layered(file) => {
                let layer = choose_layer(name, &file.layers(), wanted.layer.as_deref())?;
                file.read(&layer, wanted)?
            }
            Self::GeoJson(table) => {
                choose_layer(name, &[table.layer.as_str()], wanted.layer.as_deref())?;
                *table
            }
        };
        if !asks_itself {
            table.identify(wanted.id.as_deref())?;
            if let Some(condition) = &asked.condition {
                let kept = condition::find_matches(&table, condition, asked)?;
                table.keep(&kept, asked.limit);
            }
        }
        table.finish(asked)
    }
}
