//! What is read through other programs' code: GeoPackages, coordinate systems, and heights that are packed.
//!
//! A program that is built without the feature `data` has `absent` in its place, which says so.

mod blob;
mod geopackage;
pub(crate) mod geotiff;
mod meaning;
pub(crate) mod output;
mod packed;
pub(crate) mod png;
pub(crate) mod projection;
pub(crate) mod zipped;

pub use geopackage::{GeoPackage, TableShape};
