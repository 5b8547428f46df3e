//! Sources: data that scripts load and query.
//!
//! Input: the calls of `source` and the SQL queries of a run. Output: [`FeatureSource`]s and [`QueryRows`]. This folder is
//! a contract only: a program adds a [`SourceProvider`] to its registry, and the provider knows files, databases and SQL.

mod attribute;
mod feature_source;
mod provider;
mod query_rows;
mod store;

pub use attribute::Attribute;
pub use feature_source::FeatureSource;
pub use provider::SourceProvider;
pub use query_rows::QueryRows;
pub use store::{ModuleTable, SourceQuery, SourceRequest, SourceStore};
