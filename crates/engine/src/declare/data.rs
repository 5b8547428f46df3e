//! Data of a run: its sources, and objects that loaders make of files.

use std::any::Any;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::path::Path;
use std::sync::{Arc, Mutex, OnceLock};

use super::file_access::{FileAccess, find_all};
use super::session::Session;
use crate::queries::{ChainView, NamedModule, RowSource, SqlQuery};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, ErrorKind, Result};
use burgeon_base::locks::LockRecovery;
use burgeon_kit::{
    FeatureSource, LoadRequest, LoadServices, LoadedObject, Loader, ModuleTable, QueryRows, Registry,
    SourceQuery, SourceRequest, SourceStore, Table, Value,
};
use burgeon_packages::Package;

/// Data of a run.
///
/// All virtual machines load it in the same order, so the results do not depend on the machine that loads first. Each
/// file is read once.
pub(crate) struct Data {
    store: Option<Arc<dyn SourceStore>>,
    /// Objects loaded from files, by type, files and fields.
    objects: Mutex<BTreeMap<String, Result<LoadedObject>>>,
    /// Memory budget of all reading in the run.
    budget: OnceLock<Arc<Budget>>,
}

impl Data {
    /// Creates the data of a run with the sources of `registry`.
    pub(super) fn new(registry: &Registry) -> Self {
        let store = registry.sources().map(|sources| sources.open());
        Self { store, objects: Mutex::default(), budget: OnceLock::new() }
    }

    fn store(&self) -> Result<&dyn SourceStore> {
        self.store.as_deref().ok_or_else(|| {
            Error::unavailable("this program has no sources of data")
                .help("add them to its registry: registry.set_sources(...)")
        })
    }

    fn budget(&self, session: &Session) -> &Arc<Budget> {
        self.budget.get_or_init(|| {
            let stop = Arc::clone(&session.stop);
            Budget::new(session.options.limits.memory, move || stop.check())
        })
    }

    /// Calls `act` with a request of a file of the package `asker`, or of the script.
    fn request<T>(
        &self,
        session: &Session,
        asker: Option<&Package>,
        act: impl FnOnce(&SourceRequest<'_>) -> T,
    ) -> T {
        act(&SourceRequest {
            resources: &FileAccess { session, asker },
            package: asker.map(|asker| asker.manifest.name.as_str()),
            budget: self.budget(session),
            databases: &session.options.inputs.databases,
            time: session.options.limits.time,
            is_strict: session.options.strict,
        })
    }

    /// Loads the features of `source(text, options)`, called in a file of the package `asker`, or of the script.
    pub(crate) fn load(
        &self,
        session: &Session,
        asker: Option<&Package>,
        text: &str,
        options: Option<&Table>,
    ) -> Result<Arc<dyn FeatureSource>> {
        let store = self.store()?;
        self.request(session, asker, |request| store.load(request, text, options))
    }

    /// Checks the options of a list of the script. If `keeps` is set, adds the list as a table.
    pub(crate) fn list(&self, features: &Value, options: &Table, keeps: bool) -> Result<()> {
        self.store()?.list(features, options, keeps)
    }

    /// Returns the lists that the script made into tables, by the names of the tables.
    pub(crate) fn lists(&self) -> Vec<(String, Arc<dyn FeatureSource>)> {
        self.store.as_ref().map(|store| store.lists()).unwrap_or_default()
    }

    /// Returns copies of the values that exports need, such as the projection of the run.
    pub(crate) fn results(&self) -> Vec<Box<dyn Any + Send + Sync>> {
        self.store.as_ref().map(|store| store.results()).unwrap_or_default()
    }

    /// Loads the object of type `kind` that `loader` makes of the files `names`; equal calls return the same
    /// object. The caller is a file of the package `asker`, or of the script.
    pub(crate) fn object(
        &self,
        session: &Session,
        asker: Option<&Package>,
        (kind, loader): (&str, &Loader),
        names: &[String],
        fields: &Table,
    ) -> Result<LoadedObject> {
        let Some(name) = names.first().filter(|_| names.iter().all(|name| !name.is_empty())) else {
            return Err(Error::argument(format!("{kind} needs a file name"))
                .help(format!("write {}", loader.example)));
        };
        let alone = if names.len() == 1 { session.package_file(loader.what, name, asker) } else { None };
        let (files, asker) = match alone.transpose()? {
            // A replacement file names further files of its own package.
            Some(located) => (vec![(located.name.to_string(), located.path)], Some(located.package)),
            None => {
                let files = names.iter().map(|name| find_all(session, asker, loader, name));
                (files.collect::<Result<Vec<_>>>()?.concat(), asker)
            }
        };
        for (_, path) in &files {
            self.seek_companions(session, path);
        }
        let (own, path) = &files[0];
        let mut objects = self.objects.lock().recover();
        let key = format!("{kind} {files:?} {:?} {fields:?}", asker.map(|asker| &asker.manifest.name));
        let unknown = match objects.entry(key) {
            Entry::Occupied(known) => return known.get().clone(),
            Entry::Vacant(unknown) => unknown,
        };
        let mut loaded = None;
        self.with_services(&mut |services| {
            let budget = self.budget(session);
            let before = budget.used_bytes();
            let mut file = LoadRequest {
                name: own,
                path,
                files: &files,
                budget,
                triangles: session.options.limits.triangles,
                services,
                resources: &FileAccess { session, asker },
            };
            let object = (loader.load)(&mut file, fields);
            budget.settle(before, object.as_ref().map_or(0, |object| object.memory));
            loaded = Some(object);
        });
        session.stop.check()?;
        let loaded =
            loaded.unwrap_or_else(|| Err(Error::internal("a store of sources provides no services")));
        unknown.insert(loaded).clone()
    }

    /// Calls `act` with the values that loaders share with sources.
    fn with_services(&self, act: &mut dyn FnMut(&mut dyn LoadServices)) {
        match &self.store {
            Some(store) => store.with_services(act),
            None => act(&mut ()),
        }
    }

    /// Records the files that are read with the one at `path`, also those that may be added later.
    fn seek_companions(&self, session: &Session, path: &Path) {
        let companions = self.store.as_ref().map(|store| store.companions(path)).unwrap_or_default();
        for companion in companions {
            session.seek(&companion, companion.exists());
        }
    }
}

/// Sources of a run and modules of its chains, as tables.
pub(super) struct ModuleRows<'a> {
    pub(super) session: &'a Session,
    pub(super) view: &'a ChainView,
    /// Modules that the query may name.
    pub(super) modules: &'a [NamedModule],
}

impl ModuleRows<'_> {
    /// Adds suggestions to an error about a missing table: modules of this name in several packages, or a
    /// module with a similar name.
    fn explain(&self, error: Error, question: &SqlQuery) -> Error {
        let ErrorKind::NotFound { what: "table", name, suggestion: None } = error.kind() else {
            return error;
        };
        match self.view.find(name, question.scope()) {
            Err(found) => match found.kind() {
                ErrorKind::NotFound { suggestion: Some(near), .. } => {
                    Error::not_found("table", name, [near.as_str()], error.message())
                }
                ErrorKind::NotFound { .. } => error,
                _ => found,
            },
            Ok(_) => error,
        }
    }
}

impl RowSource for ModuleRows<'_> {
    fn rows(&self, question: &SqlQuery, most: usize) -> Result<QueryRows> {
        let data = &self.session.data;
        let tables: Vec<ChainTable<'_>> =
            self.modules.iter().map(|module| ChainTable::new(self.session, self.view, module)).collect();
        let modules: Vec<&dyn ModuleTable> = tables.iter().map(|table| table as _).collect();
        let (statement, values) = (question.statement(), question.values()?);
        let query = SourceQuery { statement: &statement, values: &values, modules: &modules, most };
        let store = data.store()?;
        let rows = data.request(self.session, None, |request| store.rows(request, &query));
        rows.map_err(|error| self.explain(error, question))
    }
}

/// Modules of one symbol, as a table.
struct ChainTable<'a> {
    session: &'a Session,
    view: &'a ChainView,
    module: &'a NamedModule,
    name: String,
}

impl<'a> ChainTable<'a> {
    fn new(session: &'a Session, view: &'a ChainView, module: &'a NamedModule) -> Self {
        let name = view.symbols().qualified_name(module.symbol).into_owned();
        Self { session, view, module, name }
    }
}

impl ModuleTable for ChainTable<'_> {
    fn word(&self) -> &str {
        &self.module.word
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn columns(&self) -> &[String] {
        &self.view.symbols().signature(self.module.symbol).parameters
    }

    fn state(&self) -> u64 {
        self.view.number()
    }

    fn values(&self, visit: &mut dyn FnMut(Value)) {
        let modules = self.view.modules(self.module.symbol);
        if self.columns().is_empty() {
            modules.for_each(|_| visit(Value::Boolean(true)));
        } else {
            modules.flatten().for_each(|stored| visit(self.session.values.unpack(*stored)));
        }
    }
}
