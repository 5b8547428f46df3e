//! SQL over layers of features: questions that are put to a database within the program, or to a PostGIS server.
//!
//! Comes in: layers, GeoPackages as they are, the address of a server; then statements with named parameters. Goes out:
//! a [`QueryAnswer`] for each, rows of [`Cell`]s in one order. It never writes into a source, and no statement reaches anything
//! but the tables that it was given.
//!
//! Functions are those of PostGIS, as far as [`FUNCTIONS`] goes. Spatial joins use an index however they are written:
//! the statement is rewritten so that SQLite looks rows up by the boxes of their geometries.
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
mod rewrite;
mod row_table;
mod tables;
#[cfg(test)]
mod tests;

pub use cell::{Cell, QueryAnswer};
pub use database::{Database, names_table, rename_tables, table_words};
pub use functions::{FUNCTIONS, SpatialFunction};
pub use row_table::RowTable;
