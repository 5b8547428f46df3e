//! Geometry values: points, lines, polygons, multi-geometries and collections, with the operations of OGC
//! Simple Features.
//!
//! Input: points, well-known text or well-known binary. Output: a [`Geometry`], its measurements, its
//! relations to other geometries, and the results of operations. This crate never reads a file, draws a
//! random number or reads a module, and no operation panics on any geometry.
//!
//! Operations are horizontal. Their accuracy does not depend on the distance from the origin, because each
//! operation works relative to a local origin. Points keep their heights; a new point has the height of the
//! nearest point on the lines and borders of its sources.
//!
//! Coordinate reference systems are in [`crs`]: a [`ReferenceFrame`] places the metres of a run on Earth.
#![recursion_limit = "256"]

mod buffer;
pub mod crs;
mod edges;
mod fragments;
mod geometry;
#[cfg(test)]
mod geos;
pub mod height_files;
mod kind;
mod lines;
mod measure;
mod nearest;
mod overlay;
mod parts;
mod plane;
#[cfg(test)]
mod properties;
mod reach;
mod records;
mod relation;
mod scripting;
mod simplification;
mod skeleton;
mod topology;
mod validity;
mod ways;
mod within;
pub mod wkb;
pub mod wkt;

pub use buffer::{BufferCap, BufferJoin, BufferOptions};
pub use burgeon_geometry::Rings;
pub use burgeon_kit::Attribute;
pub use crs::{Crs, Passage, ReferenceFrame, WorldPlace};
pub use geometry::{FARTHEST, Geometry};
pub use kind::GeometryKind;
pub use overlay::union_all;
pub use reach::{BoundingBox, near_selection, representative_point};
pub use records::{Record, RecordTable};
pub use relation::Relation;
pub use scripting::{
    GeometryInput, GeometryList, GeometryObject, Lines, Path, PolygonArgument, constructors, rings,
};
pub use topology::PreparedGeometry;

/// Maximum nesting depth of collections.
pub const DEEPEST: usize = 32;
