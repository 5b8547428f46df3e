//! Loaded sources of a run.

use std::any::{Any, TypeId};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use super::files::read;
use super::lists::ScriptList;
use super::options::parse_options;
use super::provider::SourceReading;
use super::tables::{SourceTable, SourceTables, TableContent};
use burgeon_base::error::{Error, Result};
use burgeon_base::locks::LockRecovery;
use burgeon_data::{Cache, Layer, SourceOptions, companions};
use burgeon_kit::{
    FeatureSource, LoadServices, QueryRows, SourceQuery, SourceRequest, SourceStore, Table, Value,
};
use burgeon_spatial::ReferenceFrame;

/// Loaded sources of a run, behind a lock.
///
/// All virtual machines call `source` in the same order, so the results do not depend on the machine that loads first.
pub(super) struct DataStore(Mutex<LoadedSources>);

/// Loaded sources of a run.
#[derive(Default)]
pub(super) struct LoadedSources {
    /// Projection and origin, set by the first source.
    pub(super) frame: Option<ReferenceFrame>,
    pub(super) cache: Option<Arc<Cache>>,
    pub(super) reading: SourceReading,
    loaded: BTreeMap<String, Result<Arc<Layer>>>,
    pub(super) tables: SourceTables,
}

impl DataStore {
    /// Creates an empty store that reads layers through `cache`, and the part of them that `reading` selects.
    pub(super) fn new(cache: Option<Arc<Cache>>, reading: SourceReading) -> Self {
        let frame = match &reading {
            SourceReading::Window(window) => window.frame.clone(),
            _ => None,
        };
        Self(Mutex::new(LoadedSources { cache, reading, frame, ..LoadedSources::default() }))
    }
}

impl SourceStore for DataStore {
    fn load(
        &self,
        request: &SourceRequest<'_>,
        text: &str,
        options: Option<&Table>,
    ) -> Result<Arc<dyn FeatureSource>> {
        let (mut wanted, table) = options.map_or_else(|| Ok(Default::default()), parse_options)?;
        let mut known = self.0.lock().recover();
        let key = format!("{:?} {text:?} {wanted:?} {table:?}", request.package);
        if let Some(loaded) = known.loaded.get(&key) {
            return Ok(loaded.clone()?);
        }
        wanted.budget = Arc::clone(request.budget);
        let before = request.budget.used_bytes();
        let loaded = read(request, (text, &key), wanted, &mut known, table.as_deref());
        request.resources.check()?;
        let kept = loaded.as_ref().map_or(0, |layer| layer.size());
        request.budget.settle(before, kept);
        known.loaded.insert(key, loaded.clone());
        Ok(loaded?)
    }

    fn list(&self, features: &Value, options: &Table, keeps: bool) -> Result<()> {
        let (
            SourceOptions {
                layer: None,
                condition: None,
                tags: None,
                within: None,
                limit: None,
                id: None,
                kind: None,
                crs: None,
                records: None,
                budget: _,
            },
            Some(name),
        ) = parse_options(options)?
        else {
            return Err(Error::argument("a list of features takes no option but table")
                .help("choose among them in Lua: where, limit and the like are for files"));
        };
        if keeps {
            let list = ScriptList::new(features)?;
            self.0.lock().recover().tables.add(SourceTable { name, content: TableContent::List(list) });
        }
        Ok(())
    }

    fn lists(&self) -> Vec<(String, Arc<dyn FeatureSource>)> {
        self.0.lock().recover().tables.lists()
    }

    #[cfg(feature = "data")]
    fn rows(&self, request: &SourceRequest<'_>, query: &SourceQuery<'_>) -> Result<QueryRows> {
        super::database::rows(&self.0, request, query)
    }

    #[cfg(not(feature = "data"))]
    fn rows(&self, _: &SourceRequest<'_>, _: &SourceQuery<'_>) -> Result<QueryRows> {
        Err(Error::unavailable("this program was built without database support")
            .help("build it with the feature data"))
    }

    fn with_services(&self, act: &mut dyn FnMut(&mut dyn LoadServices)) {
        act(&mut *self.0.lock().recover());
    }

    fn results(&self) -> Vec<Box<dyn Any + Send + Sync>> {
        let frame = self.0.lock().recover().frame.clone();
        frame.into_iter().map(|frame| Box::new(frame) as _).collect()
    }

    fn companions(&self, path: &Path) -> Vec<PathBuf> {
        companions(path)
    }
}

impl LoadServices for LoadedSources {
    fn service(&mut self, of: TypeId) -> Option<&mut dyn Any> {
        if of == self.frame.type_id() {
            Some(&mut self.frame)
        } else if of == self.cache.type_id() {
            Some(&mut self.cache)
        } else {
            None
        }
    }
}
