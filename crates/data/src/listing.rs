//! Listing of a data file's content, human-readable or machine-readable.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::Path;
use std::sync::Arc;

use glam::DVec3;
use serde_json::{Value, json};

use crate::features::table::FeatureTable;
use crate::source::Source;
use crate::source_options::SourceOptions;
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::{escaped, number, shown};
use burgeon_kit::Attribute;
use burgeon_spatial::GeometryKind;

/// Number of example texts shown for an attribute.
const EXAMPLES: usize = 3;

/// Content of a data file.
#[derive(Debug)]
pub struct Listing {
    /// File name as given.
    pub file: String,
    /// Name of the format, such as `GeoPackage`.
    pub format: &'static str,
    /// Layers in file order.
    pub layers: Vec<LayerListing>,
}

/// Content of a layer.
#[derive(Debug)]
pub struct LayerListing {
    /// Name.
    pub name: String,
    /// Coordinate system, such as `EPSG:3067`, or the reason why it is unknown.
    pub crs: Result<String>,
    /// Number of records with a geometry.
    pub records: usize,
    /// Number of features of each type; each part of a geometry is one feature.
    pub kinds: BTreeMap<GeometryKind, usize>,
    /// Number of features without a geometry.
    pub empty: usize,
    /// Number of features that cannot be read, and the reason for the first of them.
    pub refused: Option<(usize, String)>,
    /// West, south, east and north in the layer's units; `None` without features.
    pub extent: Option<[f64; 4]>,
    /// Attributes, in file order.
    pub attributes: Vec<AttributeListing>,
}

/// Description of an attribute.
#[derive(Debug, Default)]
pub struct AttributeListing {
    /// Name.
    pub name: String,
    /// Types of its values: `boolean`, `number`, `text`, `table`.
    pub types: BTreeSet<&'static str>,
    /// Number of features with this attribute.
    pub count: usize,
    /// Number of features without a geometry that have this attribute.
    pub unplaced: usize,
    /// Minimum and maximum number.
    pub range: Option<[f64; 2]>,
    /// First distinct texts.
    pub examples: Vec<String>,
}

impl Listing {
    /// Reads all layers of the file at `path`, within a budget.
    ///
    /// ```
    /// use burgeon_data::{GeometryKind, Listing};
    /// use std::sync::Arc;
    ///
    /// let folder = tempfile::tempdir()?;
    /// let path = folder.path().join("trees.csv");
    /// std::fs::write(&path, "kind,longitude,latitude\noak,24.9,60.2\nelm,24.9,60.3\n")?;
    /// let listing = Listing::read(&path, &Arc::default())?;
    /// let layer = &listing.layers[0];
    /// assert_eq!((layer.records, layer.kinds[&GeometryKind::Point]), (2, 2));
    /// assert_eq!(layer.attributes[0].examples, ["oak", "elm"]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn read(path: &Path, budget: &Arc<Budget>) -> Result<Self> {
        let name = path.display().to_string();
        let wanted = SourceOptions { budget: Arc::clone(budget), ..SourceOptions::default() };
        let before = budget.used_bytes();
        let open = || Source::open_within(path, &name, &wanted).map_err(|error| missing_file(path, error));
        let source = open()?;
        let format = source.format();
        let mut layers = Vec::new();
        match source {
            Source::GeoJson(table) => layers.push(LayerListing::of(*table)?),
            Source::GeoPackage(package) => {
                for layer in package.layers() {
                    let Source::GeoPackage(package) = open()? else { continue };
                    layers.push(LayerListing::of(package.read(layer, &wanted)?)?);
                    budget.settle(before, 0);
                }
            }
            Source::FlatGeobuf(file) => layers.push(LayerListing::of(file.read(&wanted)?)?),
            Source::Layered(file) => {
                for layer in file.layers() {
                    layers.push(LayerListing::of(file.read(layer, &wanted)?)?);
                    budget.settle(before, 0);
                }
            }
            Source::Osm(file) => {
                for layer in file.layers() {
                    let wanted = SourceOptions { layer: Some(layer.to_owned()), ..wanted.clone() };
                    let layer = LayerListing::of(file.read(&wanted)?)?;
                    // Only layers with content in the extract are listed.
                    if layer.records > 0 || layer.refused.is_some() {
                        layers.push(layer);
                    }
                    budget.settle(before, 0);
                }
            }
        }
        budget.settle(before, 0);
        Ok(Self { file: name, format, layers })
    }

    /// Returns the listing as machine-readable JSON.
    pub fn to_json(&self) -> Value {
        let layers: Vec<Value> = self.layers.iter().map(LayerListing::to_json).collect();
        json!({ "file": self.file, "format": self.format, "layers": layers })
    }

    /// Returns the listing as human-readable text.
    pub fn text(&self) -> String {
        let mut text = format!("{}: {}\n", escaped(&self.file), self.format);
        if self.layers.is_empty() {
            text += "  no layers of features\n";
        }
        for layer in &self.layers {
            layer.write(&mut text);
        }
        text
    }
}

/// Suggests the file with the most similar name if there is none at `path`.
fn missing_file(path: &Path, error: Error) -> Error {
    let wanted = path.file_name().map(|name| name.to_string_lossy().into_owned());
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    match (wanted, path.exists()) {
        (Some(wanted), false) => match nearest_file(folder, &wanted) {
            Some(near) => Error::not_found("data file", wanted, [near.as_str()], error.message()),
            None => error,
        },
        _ => error,
    }
}

/// Returns the data file in `folder` whose name is most similar to `wanted`.
///
/// ```
/// use burgeon_data::nearest_file;
///
/// let folder = tempfile::tempdir()?;
/// for name in ["houses.gpkg", "house.lua"] {
///     std::fs::write(folder.path().join(name), "")?;
/// }
/// assert_eq!(nearest_file(folder.path(), "huoses.gpkg").as_deref(), Some("houses.gpkg"));
/// # Ok::<(), std::io::Error>(())
/// ```
pub fn nearest_file(folder: &Path, wanted: &str) -> Option<String> {
    let entries = std::fs::read_dir(folder).ok()?;
    let mut names: Vec<String> =
        entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok()).collect();
    names.sort();
    let data = names.iter().filter(|name| {
        let extension = Path::new(name).extension().map(|found| found.to_ascii_lowercase());
        super::EXTENSIONS.iter().any(|known| extension.as_deref() == Some(known.as_ref()))
    });
    burgeon_base::error::nearest(wanted, data.map(String::as_str)).map(str::to_owned)
}

impl LayerListing {
    /// Returns the content of a table, without features with coordinates that are not finite, which every run skips.
    pub fn of(mut table: FeatureTable) -> Result<Self> {
        table.refuse_endless()?;
        let mut kinds = BTreeMap::new();
        let mut attributes: Vec<AttributeListing> = table
            .names
            .into_iter()
            .map(|name| AttributeListing { name, ..AttributeListing::default() })
            .collect();
        for (attribute, count) in attributes.iter_mut().zip(&table.unplaced) {
            attribute.unplaced = *count;
        }
        let mut extent: Option<[f64; 4]> = None;
        for feature in &table.features {
            *kinds.entry(feature.geometry.kind()).or_insert(0) += 1;
            for (index, value) in feature.attributes.iter() {
                attributes[*index].add(value);
            }
            for DVec3 { x, y, .. } in feature.geometry.points() {
                let [west, south, east, north] = extent.get_or_insert([*x, *y, *x, *y]);
                (*west, *south, *east, *north) = (west.min(*x), south.min(*y), east.max(*x), north.max(*y));
            }
        }
        Ok(Self {
            name: table.layer,
            crs: table.crs.as_ref().map(burgeon_spatial::Crs::name).map_err(Clone::clone),
            records: table.records,
            kinds,
            empty: table.empty,
            refused: table
                .refused
                .first()
                .map(|(_, error)| (table.refused.len(), error.message().to_owned())),
            extent,
            attributes,
        })
    }

    fn to_json(&self) -> Value {
        let kinds: serde_json::Map<String, Value> =
            self.kinds.iter().map(|(kind, count)| (kind.name().to_owned(), (*count).into())).collect();
        let attributes: Vec<Value> = self.attributes.iter().map(AttributeListing::to_json).collect();
        let mut object = json!({
            "name": self.name,
            "crs": self.crs.as_ref().ok(),
            "kinds": kinds,
            "records": self.records,
            "features": self.kinds.values().sum::<usize>(),
            "empty": self.empty,
            "refused": self.refused.as_ref().map_or(0, |(count, _)| *count),
            "extent": self.extent,
            "attributes": attributes,
        });
        if let Err(error) = &self.crs {
            object["problem"] = error.message().into();
        }
        if let Some((_, why)) = &self.refused {
            object["refusal"] = why.as_str().into();
        }
        object
    }

    fn write(&self, text: &mut String) {
        let crs = match &self.crs {
            Ok(crs) => crs,
            Err(error) => error.message(),
        };
        let kinds: Vec<String> = self
            .kinds
            .iter()
            .map(|(kind, count)| format!("{count} {}{}", kind.name(), if *count == 1 { "" } else { "s" }))
            .collect();
        let kinds = if kinds.is_empty() { "no features".into() } else { Cow::Owned(kinds.join(", ")) };
        let features: usize = self.kinds.values().sum();
        let parts =
            if features == self.records { String::new() } else { format!(" in {} records", self.records) };
        let empty = if self.empty > 0 { format!(", {} without geometry", self.empty) } else { String::new() };
        // Writing into a string cannot fail.
        let _ = writeln!(text, "  {}: {kinds}{parts}{empty}; {}", shown(&self.name), escaped(crs));
        if let Some((count, why)) = &self.refused {
            let _ = writeln!(text, "    {count} skipped, e.g.: {}", escaped(why));
        }
        if let Some([west, south, east, north]) = self.extent {
            let [west, south, east, north] = [west, south, east, north].map(number);
            let _ = writeln!(text, "    from {west}, {south} to {east}, {north}");
        }
        let names: Vec<_> = self.attributes.iter().map(|known| shown(&known.name)).collect();
        let width = names.iter().map(|name| name.chars().count()).max().unwrap_or(0);
        for (name, known) in names.iter().zip(&self.attributes) {
            let _ = writeln!(text, "    {name:width$}  {}", known.text());
        }
    }
}

impl AttributeListing {
    fn add(&mut self, value: &Attribute) {
        self.types.insert(value.kind());
        self.count += 1;
        match value {
            Attribute::Number(number) => {
                let [low, high] = self.range.get_or_insert([*number; 2]);
                (*low, *high) = (low.min(*number), high.max(*number));
            }
            Attribute::Text(text) => {
                if self.examples.len() < EXAMPLES && !self.examples.iter().any(|known| **known == **text) {
                    self.examples.push(text.to_string());
                }
            }
            Attribute::Boolean(_) | Attribute::Nested(_) => {}
        }
    }

    fn to_json(&self) -> Value {
        json!({
            "name": self.name,
            "types": self.types,
            "count": self.count,
            "range": self.range,
            "examples": self.examples,
        })
    }

    fn text(&self) -> Cow<'static, str> {
        if self.count == 0 {
            return match self.unplaced {
                0 => "never set".into(),
                1 => "set in 1 feature without geometry".into(),
                count => format!("set in {count} features without geometry").into(),
            };
        }
        let types: Vec<&str> = self.types.iter().copied().collect();
        let mut text = format!("{} of {}", types.join(" or "), self.count);
        if let Some([low, high]) = self.range {
            let _ = write!(text, ", {low} to {high}");
        }
        if !self.examples.is_empty() {
            let shown: Vec<String> = self
                .examples
                .iter()
                .map(|example| format!("{:?}", example.chars().take(30).collect::<String>()))
                .collect();
            let _ = write!(text, ", such as {}", shown.join(", "));
        }
        text.into()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Geometry, Layer};
    use super::*;
    use burgeon_spatial::Crs;

    #[test]
    fn a_listing_leaves_out_the_places_that_every_run_leaves_out() {
        let table = || {
            let mut table = FeatureTable::new("a", "a", Crs::epsg(3067), &SourceOptions::default());
            for x in [1.0, f64::NAN, 2.0, f64::INFINITY] {
                table.push("1", vec![Geometry::point(DVec3::new(x, 5.0, 0.0))], Vec::new()).unwrap();
            }
            table.refuse("2".to_owned(), Error::data("odd")).unwrap();
            table
        };
        let layer = Layer::new(table(), &mut None).unwrap();
        let listing = LayerListing::of(table()).unwrap();
        assert_eq!((listing.refused.map(|(count, _)| count), layer.refused.len()), (Some(3), 3));
        assert_eq!((listing.records, listing.extent), (2, Some([1.0, 5.0, 2.0, 5.0])));
    }
}
