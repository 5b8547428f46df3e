//! Provider of all sources of this crate.

use std::path::Path;
use std::sync::Arc;

use super::data_store::DataStore;
use super::survey::{SourceSurvey, SourceWindow};
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
#[derive(Clone, Default)]
pub struct DataSources {
    /// Layers that earlier runs have read.
    cache: Option<Arc<Cache>>,
    reading: SourceReading,
}

/// Part of the sources that runs read.
#[derive(Clone, Default)]
pub(super) enum SourceReading {
    #[default]
    Whole,
    Survey(Arc<SourceSurvey>),
    Window(Arc<SourceWindow>),
}

impl DataSources {
    /// Creates a provider whose runs record their sources in `survey` and read no features.
    pub fn surveyed(survey: &Arc<SourceSurvey>) -> Self {
        Self { cache: None, reading: SourceReading::Survey(Arc::clone(survey)) }
    }

    /// Creates a provider with the cache of this one, if it has one, whose runs read the features in the boxes of `window`.
    #[must_use]
    pub fn windowed(&self, window: &Arc<SourceWindow>) -> Self {
        Self { cache: self.cache.clone(), reading: SourceReading::Window(Arc::clone(window)) }
    }

    /// Creates a provider that reuses unchanged data of earlier runs.
    pub fn cached() -> Self {
        Self { cache: Some(Arc::default()), reading: SourceReading::Whole }
    }
}

impl SourceProvider for DataSources {
    fn open(&self) -> Arc<dyn SourceStore> {
        let Self { cache, reading } = self.clone();
        Arc::new(DataStore::new(cache, reading))
    }

    fn with_cache(&self) -> Arc<dyn SourceProvider> {
        let mut cached = self.clone();
        cached.cache.get_or_insert_default();
        Arc::new(cached)
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
