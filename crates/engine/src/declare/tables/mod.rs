//! Tables for SQL queries: the loaded sources, in a database that the first query creates.
//!
//! Input: the sources of a run as they are loaded, and queries. Output: rows. Sources are read-only.

#[cfg(feature = "data")]
mod database;
mod sources;

#[cfg(feature = "data")]
pub(super) use database::ModuleRows;
pub(crate) use sources::ListTable;
pub(super) use sources::{SourceTable, SourceTables, TableContent};
