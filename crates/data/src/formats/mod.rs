//! Readers and writers that need external crates: databases, compressed data, XML, and compressed heights.
//!
//! A program built without the feature `data` contains `absent` instead, which returns errors.

mod blob;
#[cfg(test)]
mod box_tests;
mod city;
pub(crate) mod condition;
mod csv;
mod flatgeobuf;
mod geopackage;
pub(crate) mod geotiff;
mod gml;
mod gpx;
mod kml;
mod opening;
mod osm;
mod packed;
pub(crate) mod png;
mod shapefile;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod text_tests;
mod typing;
mod unpack;
mod xml;
pub(crate) mod zipped;

pub use flatgeobuf::FlatGeobuf;
pub use geopackage::{GeoPackage, PackageState, TableShape};
pub(crate) use opening::{open_layers, unpack_file};
pub use osm::OsmFile;
