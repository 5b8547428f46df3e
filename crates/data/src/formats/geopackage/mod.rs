//! Reader of GeoPackages, read-only, through SQLite.
//!
//! Input: a file. Output: a [`FeatureTable`](crate::FeatureTable) of a layer. Nothing is written, and no code in the
//! file is executed.
//!
//! Source: OGC 12-128r18, GeoPackage Encoding Standard.

mod database;
mod recovery;
#[cfg(test)]
mod shared;
mod state;
#[cfg(test)]
mod tests;

pub use database::{GeoPackage, TableShape};
pub(super) use database::{guard, quoted, refused, watched};
pub use state::PackageState;
