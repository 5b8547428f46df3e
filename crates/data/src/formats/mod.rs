//! What takes other programs' code to read: databases, packed bytes, XML, coordinate systems, and heights that are packed.
//!
//! A program that is built without the feature `data` has `absent` in its place, which says so.

mod blob;
pub(crate) mod condition;
mod epsg;
mod flatgeobuf;
mod geopackage;
pub(crate) mod geotiff;
mod gml;
mod meaning;
mod osm;
pub(crate) mod output;
mod packed;
pub(crate) mod png;
pub(crate) mod projection;
pub(crate) mod zipped;

pub use flatgeobuf::FlatGeobuf;
pub use geopackage::{GeoPackage, PackageState, TableShape};
pub use gml::GmlFile;
pub use osm::OsmFile;
