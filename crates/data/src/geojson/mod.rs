//! Reads GeoJSON: a document, or a sequence of them.
//!
//! Source: RFC 7946; the `crs` member is that of the GeoJSON of 2008, which programs still write. Sequences: RFC 8142,
//! and documents one to a line. Each feature is read by itself, so that what is wrong with one is said of that one.

mod document;
mod geometry;
mod reader;
mod stream;
#[cfg(test)]
mod tests;

#[cfg(feature = "data")]
pub(super) use geometry::geometry_of;
pub(super) use reader::{LARGEST, read};
pub(super) use stream::{WINDOW, stream};
