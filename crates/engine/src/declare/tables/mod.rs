//! The tables that scripts ask: the sources that they have loaded, in a database that is made once somebody asks.
//!
//! Input: the sources of a run, as they are loaded, and questions. Output: rows. Nobody writes into a source.

#[cfg(feature = "data")]
mod database;
mod sources;

#[cfg(feature = "data")]
pub(super) use database::ModuleRows;
pub(crate) use sources::ListTable;
pub(super) use sources::{SourceTable, SourceTables, TableContent};
