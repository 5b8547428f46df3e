//! Reader of GeoJSON: a document, or a sequence of documents.
//!
//! Source: RFC 7946; the `crs` member is from the 2008 GeoJSON format, which programs still write. Sequences: RFC 8142,
//! and one document per line. Each feature is parsed separately, so an error refers to that feature.

mod document;
mod geometry;
mod parser;
mod reader;
mod stream;
#[cfg(test)]
mod tests;

#[cfg(feature = "data")]
pub(super) use geometry::geometry_of;
pub(super) use reader::{LARGEST, read};
pub(super) use stream::{WINDOW, stream};
