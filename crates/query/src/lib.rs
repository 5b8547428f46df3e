//! SQL over layers of features: queries of an internal database, or of a PostGIS server.
//!
//! Input: layers, GeoPackages in place, or the address of a server; then statements with named parameters. Output: a
//! [`QueryAnswer`] for each statement, with rows of [`Cell`]s in a fixed order. Sources are never written to, and a
//! statement reads only the tables that were added.
//!
//! The functions are a subset of PostGIS: see [`FUNCTIONS`]. Spatial joins use an index in any notation: the statement
//! is rewritten so that SQLite finds rows by the boxes of their geometries.
#![cfg(feature = "data")]

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

pub use cell::{Cell, QueryAnswer};
pub use database::{Database, names_table, rename_tables, table_words};
pub use functions::{FUNCTIONS, SpatialFunction};
pub use row_table::RowTable;
