//! Geometries as values: points, lines, polygons, their multi forms and collections, with the operations of OGC Simple
//! Features.
//!
//! Comes in: points, well-known text or well-known binary. Goes out: a [`Geometry`], what is measured on it, whether it
//! meets another, and what is made of it. It never reads a file, draws a random number or looks at a module, and no
//! operation panics, whatever the geometry.
//!
//! What is measured and made is so in the plane, as seen from above, far from the origin as exactly as near to it: each
//! operation moves what it works on to an origin of its own. Heights go along: a point that an operation makes has the
//! height of the nearest place on the lines and borders that it comes from.
#![recursion_limit = "256"]

mod buffer;
mod edges;
mod fragments;
mod geometry;
#[cfg(test)]
mod geos;
mod kind;
mod lines;
mod measure;
mod nearest;
mod overlay;
mod parts;
mod plane;
#[cfg(test)]
mod properties;
mod relation;
mod skeleton;
mod topology;
mod validity;
mod ways;
mod within;
pub mod wkb;
pub mod wkt;

pub use buffer::{BufferCap, BufferJoin, BufferOptions};
pub use geometry::{FARTHEST, Geometry};
pub use kind::GeometryKind;
pub use overlay::union_all;
pub use relation::Relation;
pub use topology::PreparedGeometry;

/// The deepest that geometries may be nested in collections.
pub const DEEPEST: usize = 32;
