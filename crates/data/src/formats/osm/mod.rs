//! Reads extracts of OpenStreetMap, `.osm.pbf`, and `.osm`, the same as XML.
//!
//! Comes in: a file. Goes out: a [`FeatureTable`](crate::FeatureTable) of a layer that tags choose: nodes become points, ways lines
//! or polygons, multipolygon relations polygons. What cannot be built, as the extract lacks a part of it, is
//! refused with the reason.
//!
//! The reader is our own: blocks are unpacked within bounds and side by side, and only what is wanted is kept of them.
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
pub(in crate::formats) use xml::is_extract as is_xml;
