//! Access to all sources that a program supports.

use std::fmt;
use std::path::Path;
use std::sync::Arc;

use super::SourceStore;

/// Sources that scripts can load, such as files and databases.
pub trait SourceProvider: Send + Sync {
    /// Creates the store of a run.
    fn open(&self) -> Arc<dyn SourceStore>;

    /// Returns a provider that reuses unchanged data of earlier runs.
    fn with_cache(&self) -> Arc<dyn SourceProvider>;

    /// Returns the part of an argument of `source` that names a file: `town.gpkg` of `town.gpkg:buildings`.
    fn file_name<'a>(&self, text: &'a str) -> &'a str;

    /// Returns the data file in `folder` whose name is most similar to `wanted`.
    fn nearest_file(&self, folder: &Path, wanted: &str) -> Option<String>;

    /// Returns the words of an SQL text that may name tables.
    fn table_words(&self, sql: &str) -> Vec<String>;
}

impl fmt::Debug for dyn SourceProvider {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("SourceProvider")
    }
}
