//! Reader of OpenStreetMap extracts: `.osm.pbf`, and `.osm`, the XML equivalent.
//!
//! Input: a file. Output: a [`FeatureTable`](crate::FeatureTable) of a layer selected by tags. Nodes become points,
//! ways become lines or polygons, and multipolygon relations become polygons. Features that cannot be built because
//! parts are missing in the extract are refused with the reason.
//!
//! The reader is our own: blocks are decompressed within bounds and in parallel, and only the requested data is kept.
//!
//! Source: OpenStreetMap wiki, "PBF Format", and "Relation:multipolygon".

mod blobs;
mod block;
mod choosing;
mod layers;
mod meaning;
mod places;
mod reader;
mod rings;
mod shapes;
#[cfg(test)]
mod tests;
mod wire;
mod xml;

pub use reader::OsmFile;
