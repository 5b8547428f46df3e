//! Sources of a run: layers of files, lists of the script, and tables of servers.
//!
//! Input: the calls of `source` and the queries of a run. Output: layers, and rows of their tables. Each file is read once
//! in a run, and once in several runs whose provider has a cache.

#[cfg(feature = "data")]
mod cells;
mod data_store;
#[cfg(feature = "data")]
mod database;
mod files;
mod lists;
mod options;
mod provider;
mod servers;
mod survey;
mod tables;
mod tags;

pub use provider::DataSources;
pub use survey::{SourceSurvey, SourceWindow, SurveyedSource, WindowBox};
