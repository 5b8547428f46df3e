//! Readers and writers that need external crates: databases, compressed data, XML, coordinate systems, and compressed
//! heights.
//!
//! A program built without the feature `data` contains `absent` instead, which returns errors.

mod blob;
#[cfg(test)]
mod box_tests;
mod city;
pub(crate) mod condition;
mod corrections;
mod csv;
mod epsg;
mod flatgeobuf;
mod geopackage;
pub(crate) mod geotiff;
mod gml;
mod gpx;
mod kml;
mod meaning;
mod opening;
mod osm;
pub(crate) mod output;
mod packed;
pub(crate) mod png;
pub(crate) mod projection;
mod shapefile;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod texts;
mod tiff_parts;
mod typing;
mod unpack;
mod xml;
pub(crate) mod zipped;

pub use flatgeobuf::FlatGeobuf;
pub use geopackage::{GeoPackage, PackageState, TableShape};
pub(crate) use opening::{layered, unpacked};
pub use osm::OsmFile;
pub(crate) use shapefile::crs_of_text;
