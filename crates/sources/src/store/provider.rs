//! Provider of all sources of this crate.

use std::path::Path;
use std::sync::Arc;

use super::data_store::DataStore;
use burgeon_data::{Cache, nearest_file, split_name};
use burgeon_kit::{SourceProvider, SourceStore};

/// Data files, lists and servers, with SQL over them.
///
/// ```
/// use burgeon_kit::{Registry, SourceProvider};
/// use burgeon_sources::DataSources;
/// use std::sync::Arc;
///
/// let mut registry = Registry::default();
/// registry.set_sources(Arc::new(DataSources::default()));
/// assert_eq!(DataSources::default().file_name("town.gpkg:houses"), "town.gpkg");
/// ```
#[derive(Debug, Default)]
pub struct DataSources {
    /// Layers that earlier runs have read.
    cache: Option<Arc<Cache>>,
}

impl SourceProvider for DataSources {
    fn open(&self) -> Arc<dyn SourceStore> {
        Arc::new(DataStore::new(self.cache.clone()))
    }

    fn with_cache(&self) -> Arc<dyn SourceProvider> {
        Arc::new(Self { cache: Some(self.cache.clone().unwrap_or_default()) })
    }

    fn file_name<'a>(&self, text: &'a str) -> &'a str {
        split_name(text).0
    }

    fn nearest_file(&self, folder: &Path, wanted: &str) -> Option<String> {
        nearest_file(folder, wanted)
    }

    #[cfg(feature = "data")]
    fn table_words(&self, sql: &str) -> Vec<String> {
        crate::sql::table_words(sql)
    }

    #[cfg(not(feature = "data"))]
    fn table_words(&self, _: &str) -> Vec<String> {
        Vec::new()
    }
}
