//! Queries of a run's sources and modules.

use std::borrow::Cow;
use std::sync::{Arc, Mutex};

use rustc_hash::FxHashMap;

use super::cells::{cell, value};
use super::data_store::LoadedSources;
use super::tables::{SourceTables, TableContent};
use crate::sql::{Cell, Database, rename_tables};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::locks::LockRecovery;
use burgeon_base::text::grouped;
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_kit::{ModuleTable, QueryRows, SourceQuery, SourceRequest};
use burgeon_spatial::ReferenceFrame;

/// Database with its tables.
pub(super) struct SourceDatabase {
    database: Arc<Database>,
    /// Number of loaded sources that have been added.
    added: usize,
    /// Set if the database has the projection of the run.
    is_framed: bool,
    /// State of the chains for which each table of modules was made, by the name of the table.
    modules: FxHashMap<String, u64>,
}

/// Words of a query that refer to a table of another name, each with that name.
type RenamedTables<'a> = Vec<(&'a str, Cow<'a, str>)>;

impl SourceTables {
    /// Returns the database with all loaded sources, whose coordinates have the projection `frame`.
    fn database(&mut self, frame: Option<&ReferenceFrame>, budget: &Arc<Budget>) -> Result<Arc<Database>> {
        // The first file sets the projection; a database made before that is rebuilt.
        let known = self.database.take().filter(|known| known.is_framed == frame.is_some());
        let mut known = match known {
            Some(known) => known,
            None => SourceDatabase {
                database: Arc::new(Database::new(frame.cloned())?),
                added: 0,
                is_framed: frame.is_some(),
                modules: FxHashMap::default(),
            },
        };
        for table in &self.loaded[known.added..] {
            match &table.content {
                TableContent::Layer(layer) => known.database.add_layer(&table.name, layer, budget)?,
                TableContent::GeoPackage { path, shown, layer } => {
                    known.database.add_geopackage(&table.name, path, shown, layer, budget)?;
                }
                #[cfg(feature = "postgis")]
                TableContent::Server(_) => {}
                TableContent::List(list) => {
                    let origin = frame.map_or([0.0; 2], |frame| frame.origin);
                    let layer = list.to_layer(&table.name, format!("list {}", known.added + 1), origin);
                    known.database.add_layer(&table.name, &layer, budget)?;
                }
            }
            known.added += 1;
        }
        let database = Arc::clone(&known.database);
        self.database = Some(known);
        Ok(database)
    }

    /// Returns the database with all loaded sources and with the modules that a query names, and the renamed tables.
    ///
    /// A source hides modules of the same name.
    fn database_with<'a>(
        &mut self,
        request: &SourceRequest<'_>,
        modules: &[&'a dyn ModuleTable],
        frame: Option<&ReferenceFrame>,
    ) -> Result<(Arc<Database>, RenamedTables<'a>)> {
        let database = self.database(frame, request.budget)?;
        let mut renamed = Vec::new();
        let Some(known) = &mut self.database else { return Ok((database, renamed)) };
        for module in modules {
            let (word, name) = (module.word(), module.name());
            if let Some(source) = self.loaded.iter().find(|table| table.name.eq_ignore_ascii_case(word)) {
                warn_hidden(request, word, &source.name);
                continue;
            }
            if known.modules.get(name) != Some(&module.state()) {
                database.set_rows(name, &module_rows(*module), request.budget)?;
                known.modules.insert(name.to_owned(), module.state());
            }
            // The database interprets the part of a name before a point as a schema.
            if word != name || word.contains('.') {
                renamed.push((word, name.into()));
            }
        }
        Ok((database, renamed))
    }
}

/// Returns modules as rows with one column per parameter. Lists, and objects other than geometries, are NULL.
fn module_rows(module: &dyn ModuleTable) -> QueryRows<Cell> {
    let mut cells = Vec::new();
    module.values(&mut |value| cells.push(cell(module.name(), &value).unwrap_or(Cell::Null)));
    let names: Vec<Arc<str>> = module.columns().iter().map(|name| name.as_str().into()).collect();
    QueryRows::new(names, cells)
}

/// Warns that a query reads the source `source` and not the modules, because both have the same name.
fn warn_hidden(request: &SourceRequest<'_>, module: &str, source: &str) {
    let text = format!("{module} in a query is the source {source}, not the modules {module}");
    let help = format!("give one of them another name: source(file, {{ table = \"{source}_data\" }})");
    request.resources.warn(Warning::new(WarningKind::Doubtful, text).help(help));
}

/// Returns the error for a query that joins modules with a server table.
#[cfg(feature = "postgis")]
fn server_join_error(modules: &[&dyn ModuleTable]) -> Error {
    let names = modules.iter().map(|module| module.word()).collect::<Vec<_>>().join(" and ");
    Error::argument(format!("a query cannot join the modules {names} with a table of a server")).help(
        "query the server first, and give the modules its rows: query(\"select ... from houses\", House)",
    )
}

/// Returns the rows of a query over sources and modules.
pub(super) fn rows(
    store: &Mutex<LoadedSources>,
    request: &SourceRequest<'_>,
    query: &SourceQuery<'_>,
) -> Result<QueryRows> {
    let (database, renamed) = {
        let mut known = store.lock().recover();
        let LoadedSources { frame, tables, .. } = &mut *known;
        tables.database_with(request, query.modules, frame.as_ref())?
    };
    let statement = match renamed.is_empty() {
        true => Cow::Borrowed(query.statement),
        false => rename_tables(query.statement, &renamed)?.into(),
    };
    let cells = query.values.iter().map(|(name, value)| Ok((*name, cell(name, value)?)));
    let cells: Vec<(&str, Cell)> = cells.collect::<Result<_>>()?;
    #[cfg(feature = "postgis")]
    let (server, frame) = {
        let known = store.lock().recover();
        (known.tables.named_server(&statement), known.frame.clone())
    };
    #[cfg(feature = "postgis")]
    let answer = match server {
        Some(_) if !query.modules.is_empty() => return Err(server_join_error(query.modules)),
        Some(server) => server.query(&statement, &cells, frame.as_ref(), request.budget)?,
        None => database.query(&statement, &cells, request.budget)?,
    };
    #[cfg(not(feature = "postgis"))]
    let answer = database.query(&statement, &cells, request.budget)?;
    if answer.len() > query.most {
        let (rows, most) = (grouped(answer.len()), grouped(query.most));
        return Err(Error::limit(Limit::Modules, format!("the query gives {rows} rows, of at most {most}"))
            .help("ask for fewer: where ..., or limit 1000; or raise the limit: --module-limit N"));
    }
    Ok(answer.map(value))
}
