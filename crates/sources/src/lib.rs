//! Sources of scripts: data files, lists and PostGIS servers, and read-only SQL over them.
//!
//! Input: the calls of `source` and the queries of a run, through the contract [`SourceProvider`]. Output: layers of
//! features in metres around the origin of the run, and rows in a fixed order. Sources are never written to, and a
//! statement reads only the tables that were added.
//!
//! - [`DataSources`] is the provider, which a program adds to its registry.
//! - [`sql`] queries layers in an embedded database, in a subset of PostGIS's dialect.
//! - [`sql::postgis`] queries PostGIS servers.

#[cfg(feature = "data")]
pub mod sql;
mod store;

pub use store::{DataSources, SourceSurvey, SourceWindow, SurveyedSource, WindowBox};

#[cfg(doc)]
use burgeon_kit::SourceProvider;
