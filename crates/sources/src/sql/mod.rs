//! SQL over layers of features, in an embedded database.
//!
//! Input: layers and GeoPackages in place; then statements with named parameters. Output: [`QueryRows`](burgeon_kit::QueryRows) for each
//! statement, with rows of [`Cell`]s in a fixed order.
//!
//! The functions are a subset of PostGIS: see [`FUNCTIONS`]. Spatial joins use an index in any notation: the statement
//! is rewritten so that SQLite finds rows by the boxes of their geometries.

mod ask;
mod blob;
mod cell;
mod connection;
mod database;
mod errors;
mod functions;
mod index;
mod place;
mod plane;
#[cfg(feature = "postgis")]
pub mod postgis;
mod prepared_statement;
mod rewrite;
mod row_table;
mod statement_text;
mod tables;
#[cfg(test)]
mod tests;

pub use cell::Cell;
pub use database::{Database, names_table, rename_tables, table_words};
pub use functions::{FUNCTIONS, SpatialFunction};
