//! SQL queries of scripts, and their rows.
//!
//! Input: an SQL text with the values of its parameters, and a [`RowSource`] that runs it. Output: [`QueryRows`](burgeon_kit::QueryRows),
//! which are cached, and the assignment of columns to the parameters of a module. A query that names modules
//! reads a state of the chains, a [`ChainView`]. This folder runs no Lua and depends on no database.

mod cache;
mod chains;
mod fit;
mod sql_query;

pub(crate) use cache::{AskedRows, RowCache};
pub(crate) use chains::ChainView;
pub(crate) use chains::NamedModule;
pub(crate) use fit::{fit, listed};
pub use sql_query::{RowSource, SqlQuery};
