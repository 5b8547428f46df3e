//! Reader of GeoPackages, read-only, through SQLite.
//!
//! Input: a file. Output: a [`FeatureTable`](crate::FeatureTable) of a layer. Nothing is written, and no code in the
//! file is executed.
//!
//! Source: OGC 12-128r18, GeoPackage Encoding Standard.

mod connection;
mod database;
mod errors;
mod recovery;
#[cfg(test)]
mod shared_tests;
mod stamp;
mod state;
#[cfg(test)]
mod tests;

pub(super) use connection::{guard, quote, run_watched};
pub use database::{GeoPackage, TableShape};
pub(super) use errors::query_error;
pub use state::PackageState;
