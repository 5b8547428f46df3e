//! Data files: layers of features with geometry and attributes, from GeoJSON, GeoPackage, FlatGeobuf, shapefiles, CSV,
//! GML, CityGML, CityJSON, KML, GPX and OpenStreetMap, and measured [`elevation`].
//!
//! Input: a file. Output: a [`Listing`] of its content, or a [`Layer`] in metres relative to an origin, ready for
//! modelling. Coordinates are projected once, here; all later stages use metres. The crate never panics because of a
//! file's content, and never changes a file.

mod cache;
mod codepages;
mod companions;
mod content;
pub mod elevation;
mod features;
mod foreign;
#[cfg_attr(not(feature = "data"), path = "absent.rs")]
mod formats;
mod frame;
mod geojson;
mod heights;
mod layer;
mod layer_choice;
mod layered_file;
mod listing;
mod pieces;
mod script_features;
mod source;
mod source_options;
mod tags;

use std::path::Path;

pub use burgeon_kit::Attribute;
pub use burgeon_spatial::{Geometry, GeometryKind};
pub use cache::Cache;
pub use companions::companions;
pub use features::{Feature, FeatureId, FeatureTable};
pub use formats::{FlatGeobuf, GeoPackage, OsmFile};
#[cfg(feature = "data")]
pub use formats::{PackageState, TableShape};
pub use layer::Layer;
pub use layered_file::LayeredFile;
pub use listing::nearest_file;
pub use listing::{AttributeListing, LayerListing, Listing};
pub use pieces::{FrameExtent, each_piece};
pub use script_features::Features;
pub use source::Source;
pub use source_options::{RecordChoice, SourceOptions};
pub use tags::{TagFilter, TagTest};

/// Extensions of data files.
pub const EXTENSIONS: [&str; 23] = [
    "geojson",
    "json",
    "gpkg",
    "pbf",
    "fgb",
    "gml",
    "xml",
    "geojsons",
    "geojsonl",
    "geojsonseq",
    "ndjson",
    "jsonl",
    "shp",
    "csv",
    "tsv",
    "kml",
    "kmz",
    "gpx",
    "osm",
    "zip",
    "gz",
    "citygml",
    "cityjsonl",
];

/// Extensions of files that contain a sequence of GeoJSON documents.
const SEQUENCES: [&str; 5] = ["geojsons", "geojsonl", "geojsonseq", "ndjson", "jsonl"];

/// Splits `FILE:LAYER`; the layer begins after the first colon that follows a data file's extension.
///
/// ```
/// use burgeon_data::split_name;
///
/// assert_eq!(split_name("town.gpkg:houses"), ("town.gpkg", Some("houses")));
/// assert_eq!(split_name("folder/town.osm.pbf"), ("folder/town.osm.pbf", None));
/// ```
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
        assert_eq!(split_name("a/town.osm.pbf:roads"), ("a/town.osm.pbf", Some("roads")));
        assert_eq!(split_name("a.gpkg:"), ("a.gpkg", Some("")));
    }
}
