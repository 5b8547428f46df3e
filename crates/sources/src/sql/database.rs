//! The internal database: the tables of a run, and queries of them.

use std::borrow::Cow;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, OnceLock, RwLock};

use rusqlite::Connection;
use rustc_hash::FxHashMap;

use crate::sql::ask;
use crate::sql::cell::Cell;
use crate::sql::connection::{AttachedFile, DatabaseLink, MOST_FILES, TableView, open_memory};
use crate::sql::errors;
use crate::sql::functions::Indexes;
use crate::sql::prepared_statement::PreparedStatement;
use crate::sql::rewrite::{self, Catalogue, Dialect, TableInfo};
use crate::sql::row_table;
use crate::sql::statement_text::quote_name;
use crate::sql::tables::{self, FileLayer};
use burgeon_base::WorkWithin;
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_base::locks::LockRecovery;
use burgeon_base::text::shown;
use burgeon_data::Layer;
use burgeon_kit::QueryRows;
use burgeon_spatial::ReferenceFrame;

/// Maximum number of rewritten statements that are kept.
const STATEMENTS: usize = 500;

/// Number of the next in-memory database, which is unique in the process.
static MEMORIES: AtomicUsize = AtomicUsize::new(0);

/// Tables of features, queried in SQL.
///
/// Several threads may query at the same time. In statements, coordinates are in the run's projection; parameters and
/// results are in metres relative to the run's origin.
///
/// ```
/// use std::sync::Arc;
/// use burgeon_base::Budget;
/// use burgeon_sources::sql::{Cell, Database};
///
/// let database = Database::new(None)?;
/// let sql = "SELECT ST_Area(ST_Buffer(ST_MakePoint(0, 0), $r)) > 3 AS large, $r * 2 AS width";
/// let answer = database.query(sql, &[("r", Cell::Number(1.0))], &Arc::new(Budget::default()))?;
/// assert_eq!(answer.names.iter().map(AsRef::as_ref).collect::<Vec<&str>>(), ["large", "width"]);
/// assert_eq!(answer.values, [Cell::Boolean(true), Cell::Number(2.0)]);
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
pub struct Database {
    address: String,
    frame: Option<ReferenceFrame>,
    tables: RwLock<TableSet>,
    indexes: Arc<Indexes>,
    /// Lock for building an index, so that it is built only once.
    building: Mutex<()>,
    idle: Mutex<Vec<DatabaseLink>>,
    /// Prepared statements by their SQL.
    statements: Mutex<FxHashMap<Arc<str>, Arc<PreparedStatement>>>,
    /// Connection that keeps the memory alive, and writes to it.
    writer: Mutex<Connection>,
}

/// The tables of the database.
#[derive(Default)]
struct TableSet {
    catalogue: Catalogue,
    files: Vec<AttachedFile>,
    views: Vec<TableView>,
    /// Origin of each table, which distinguishes a table that is added twice from another table of the same name.
    origins: FxHashMap<String, Cow<'static, str>>,
    /// Memory (bytes) of each table of rows.
    memory: FxHashMap<String, usize>,
    /// Number of changes so far.
    generation: usize,
}

/// Origin of tables of rows.
const ROWS: &str = "rows";

/// Reports whether a statement names a table.
pub fn names_table(sql: &str, table: &str) -> bool {
    rewrite::find_word(sql, table).is_some()
}

/// Lists the words of a statement that may be names of tables, as they are written.
pub fn table_words(sql: &str) -> Vec<String> {
    rewrite::table_words(sql)
}

/// Renames the tables of a statement. Each pair is a name as written, with its schema if given, and the new name of the
/// table. Fails if the statement cannot be parsed.
pub fn rename_tables(sql: &str, names: &[(&str, Cow<'_, str>)]) -> Result<String> {
    rewrite::rename_tables(sql, names)
}

impl std::fmt::Debug for Database {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Database({})", self.tables().join(", "))
    }
}

impl Database {
    /// Creates a database without tables, with coordinates in `frame`'s projection.
    pub fn new(frame: Option<ReferenceFrame>) -> Result<Self> {
        let address = format!("file:/burgeon-{}?vfs=memdb", MEMORIES.fetch_add(1, Ordering::Relaxed));
        let writer = open_memory(&address, true).map_err(|error| errors::internal(&error))?;
        // An in-memory database without any writes has no pages, so read-only connections could not open it.
        let begin = "PRAGMA page_size = 4096; PRAGMA journal_mode = OFF; PRAGMA application_id = 1;";
        writer.execute_batch(begin).map_err(|error| errors::internal(&error))?;
        Ok(Self {
            address,
            frame,
            tables: RwLock::default(),
            indexes: Arc::default(),
            building: Mutex::new(()),
            idle: Mutex::default(),
            statements: Mutex::default(),
            writer: Mutex::new(writer),
        })
    }

    /// Returns the names of the tables, in alphabetical order.
    pub fn tables(&self) -> Vec<String> {
        let tables = self.tables.read().recover();
        tables.catalogue.values().map(|table| table.name.clone()).collect()
    }

    /// Adds the features of a layer as the table `name`: their `id`, their attributes, and their geometry as `geom`.
    ///
    /// Fails if another table has this name, or if the memory limit is exceeded.
    pub fn add_layer(&self, name: &str, layer: &Layer, budget: &Budget) -> Result<()> {
        let origin = format!("{} {:?} {}", layer.shown, layer.origin, layer.features.len());
        let mut tables = self.tables.write().recover();
        if tables.is_there(name, &origin)? {
            return Ok(());
        }
        let writer = self.writer.lock().recover();
        let info = tables::write_layer(&writer, name, layer, budget)?;
        tables.add(info, origin.into());
        Ok(())
    }

    /// Adds the layer `layer` of the GeoPackage at `path`, named `shown_name` in messages, as the table `name`. The
    /// file is read in place if its coordinates are those of the database, and copied otherwise.
    ///
    /// Fails if another table has this name, if the file cannot be read, or if it has no such layer.
    pub fn add_geopackage(
        &self,
        name: &str,
        path: &Path,
        shown_name: &str,
        layer: &str,
        budget: &Arc<Budget>,
    ) -> Result<()> {
        let origin = format!("{}:{layer}", path.display());
        let mut tables = self.tables.write().recover();
        if tables.is_there(name, &origin)? {
            return Ok(());
        }
        let found = FileLayer::find(path, shown_name, layer, budget)?;
        let known = tables.files.iter().position(|file| file.state.is_same(&found.state));
        let fits = found.stays(self.frame.as_ref())? && (known.is_some() || tables.files.len() < MOST_FILES);
        if !fits {
            let writer = self.writer.lock().recover();
            let info = found.copy(&writer, name, self.frame.as_ref(), budget)?;
            tables.add(info, origin.into());
            return Ok(());
        }
        let index = known.unwrap_or(tables.files.len());
        if known.is_none() {
            let schema = format!("file{}", index + 1);
            tables.files.push(AttachedFile { schema, state: found.state });
        }
        // Another file may have a table of the same name.
        let alone = tables.files.len() == 1 && name == layer;
        if !alone {
            let schema = tables.files[index].schema.clone();
            tables.views.push(TableView { name: name.to_owned(), schema, table: layer.to_owned() });
        }
        let info = TableInfo { name: name.to_owned(), ..found.info };
        tables.add(info, origin.into());
        Ok(())
    }

    /// Adds rows, whose geometries are in the run's metres, as a table called `name`, and replaces the rows of the same name. No statement may be running.
    ///
    /// Fails if a source has this name, or if the memory limit is exceeded.
    pub fn set_rows(&self, name: &str, rows: &QueryRows<Cell>, budget: &Arc<Budget>) -> Result<()> {
        let mut tables = self.tables.write().recover();
        tables.remove_rows(name, &self.writer.lock().recover(), budget)?;
        tables.is_there(name, ROWS)?;
        let before = budget.used_bytes();
        let info =
            row_table::write_rows(name, rows, &self.writer.lock().recover(), self.frame.as_ref(), budget)?;
        tables.memory.insert(info.name.to_ascii_lowercase(), budget.used_bytes().saturating_sub(before));
        let prefix = format!("{}.", info.name);
        self.indexes.write().recover().retain(|index, _| !index.starts_with(&prefix));
        tables.add(info, ROWS.into());
        Ok(())
    }

    /// Returns the rows of a statement, with `parameters` in place of the names after `$`.
    ///
    /// If the statement does not specify an order, the rows are sorted by `fid`, `id` or `ogc_fid` if there is such a
    /// column, and then by all columns. Fails if the statement does anything but read.
    pub fn query(
        &self,
        sql: &str,
        parameters: &[(&str, Cell)],
        budget: &Arc<Budget>,
    ) -> Result<QueryRows<Cell>> {
        self.run_statement(sql, budget, |link, prepared| {
            ask::rows(link, prepared, parameters, self.frame.as_ref(), budget)
        })
    }

    /// Returns the rows of the original statement, without rewriting, however slow it is.
    #[cfg(test)]
    pub(crate) fn query_plainly(
        &self,
        sql: &str,
        parameters: &[(&str, Cell)],
        budget: &Arc<Budget>,
    ) -> Result<QueryRows<Cell>> {
        self.run_statement(sql, budget, |link, _| {
            let prepared = PreparedStatement {
                original: sql.into(),
                generation: link.generation,
                rewritten: None,
                shape: OnceLock::new(),
            };
            ask::rows(link, &prepared, parameters, self.frame.as_ref(), budget)
        })
    }

    /// Returns SQLite's query plan of the rewritten statement, one line per step.
    pub fn plan(&self, sql: &str, budget: &Arc<Budget>) -> Result<String> {
        self.run_statement(sql, budget, ask::plan)
    }

    fn run_statement<T>(
        &self,
        sql: &str,
        budget: &Arc<Budget>,
        work: impl FnOnce(&DatabaseLink, &PreparedStatement) -> std::result::Result<T, ask::QueryFailure>,
    ) -> Result<T> {
        budget.check()?;
        let link = self.link(budget.memory())?;
        link.state.give(budget);
        link.pin()?;
        let prepared = self.prepare(sql, &link, budget)?;
        link.state.take_unreadable();
        let within = WorkWithin::begin(budget);
        let done = work(&link, &prepared);
        drop(within);
        link.unpin()?;
        let result = done.map_err(|failure| {
            // The error of an interrupted statement does not contain the cause.
            budget.check().err().unwrap_or_else(|| self.error(sql, failure, &link))
        });
        // An interrupted set operation has returned null for its geometries.
        let result = result.and_then(|done| budget.check().map(|()| done));
        link.state.give(&Arc::default());
        let mut idle = self.idle.lock().recover();
        idle.push(link);
        result
    }

    fn error(&self, sql: &str, failure: ask::QueryFailure, link: &DatabaseLink) -> Error {
        let tables = self.tables.read().recover();
        let error = match failure {
            ask::QueryFailure::Told(error) => error,
            ask::QueryFailure::Sqlite(error) => errors::statement_error(&error, sql, &tables.catalogue),
        };
        let row = link.state.take_unreadable().and_then(|bytes| {
            let asked = tables.catalogue.values().filter(|table| names_table(sql, &table.name));
            asked.into_iter().find_map(|table| tables::row_of(&link.connection, table, &bytes))
        });
        match row {
            Some(row) => error.noting(&row),
            None => error,
        }
    }

    /// Returns a connection that sees all tables, with a page cache that is a fraction of `memory` (bytes).
    fn link(&self, memory: usize) -> Result<DatabaseLink> {
        let tables = self.tables.read().recover();
        let mut idle = self.idle.lock().recover();
        while let Some(link) = idle.pop() {
            if link.generation == tables.generation {
                return Ok(link);
            }
        }
        drop(idle);
        let TableSet { files, views, generation, .. } = &*tables;
        let frame = self.frame.as_ref();
        DatabaseLink::open(&self.address, files, views, &self.indexes, frame, *generation, memory)
            .map_err(|error| errors::internal(&error))
    }

    /// Returns the prepared statement, and builds all indexes that it needs.
    fn prepare(
        &self,
        sql: &str,
        link: &DatabaseLink,
        budget: &Arc<Budget>,
    ) -> Result<Arc<PreparedStatement>> {
        let generation = link.generation;
        let statements = self.statements.lock().recover();
        if let Some(known) = statements.get(sql).filter(|known| known.generation == generation) {
            return Ok(Arc::clone(known));
        }
        drop(statements);
        errors::check_length(sql)?;
        let tables = self.tables.read().recover();
        let catalogue = &tables.catalogue;
        let rewritten = rewrite::rewrite(sql, catalogue, &rewrite::ChosenRows::new(), Dialect::Sqlite)?;
        for (name, nearest) in rewritten.iter().flat_map(|rewritten| &rewritten.indexes) {
            self.index(name, *nearest, link, catalogue, budget)?;
        }
        drop(tables);
        let (original, shape): (Arc<str>, _) = (sql.into(), OnceLock::new());
        let prepared = PreparedStatement { original: Arc::clone(&original), generation, rewritten, shape };
        let prepared = Arc::new(prepared);
        let mut statements = self.statements.lock().recover();
        if statements.len() >= STATEMENTS {
            statements.clear();
        }
        statements.insert(original, Arc::clone(&prepared));
        Ok(prepared)
    }

    /// Builds the index of a table's column, unless it exists.
    fn index(
        &self,
        name: &str,
        nearest: bool,
        link: &DatabaseLink,
        catalogue: &Catalogue,
        budget: &Arc<Budget>,
    ) -> Result<()> {
        let _alone = self.building.lock().recover();
        let there = self.indexes.read().recover();
        if there.get(name).is_some_and(|index| index.has_lines() || !nearest) {
            return Ok(());
        }
        drop(there);
        let found = catalogue.values().find_map(|table| {
            let column = name.strip_prefix(&table.name)?.strip_prefix('.')?;
            Some((table, table.geometries.iter().find(|known| *known == column)?))
        });
        let (table, column) =
            found.ok_or_else(|| Error::internal(format!("no index can be made for {name}")))?;
        let built = tables::index(&link.connection, table, column, nearest, budget).map_err(|error| {
            errors::or_sqlite(error, |error| errors::statement_error(error, "", catalogue))
        })?;
        let mut indexes = self.indexes.write().recover();
        indexes.insert(name.to_owned(), Arc::new(built));
        Ok(())
    }
}

impl TableSet {
    /// Returns true if the table already exists. Fails if another table has this name.
    fn is_there(&self, name: &str, origin: &str) -> Result<bool> {
        let reserved = ["sqlite_", "burgeon_", "gpkg_", "rtree_"];
        let key = name.to_ascii_lowercase();
        if name.is_empty() || name.len() > 200 || reserved.iter().any(|prefix| key.starts_with(prefix)) {
            return Err(Error::argument(format!("a table cannot be called {:?}", shown(name)))
                .help("name it otherwise: source(file, { table = \"houses\" })"));
        }
        match self.origins.get(&key) {
            None => Ok(false),
            Some(known) if known == origin => Ok(true),
            Some(_) => Err(Error::argument(format!("there are two tables called {}", shown(name)))
                .help("name one of them otherwise: source(file, { table = \"houses\" })")),
        }
    }

    /// Removes a table of rows, if it exists.
    fn remove_rows(&mut self, name: &str, writer: &Connection, budget: &Budget) -> Result<()> {
        let key = name.to_ascii_lowercase();
        if self.origins.get(&key).is_none_or(|origin| origin != ROWS) {
            return Ok(());
        }
        let removed = self.catalogue.remove(&key);
        let known = removed.as_ref().map_or(name, |table| &table.name);
        self.origins.remove(&key);
        self.generation += 1;
        budget.give(self.memory.remove(&key).unwrap_or_default());
        writer
            .execute_batch(&format!("DROP TABLE IF EXISTS {}", quote_name(known)))
            .map_err(|error| errors::internal(&error))
    }

    fn add(&mut self, info: TableInfo, origin: Cow<'static, str>) {
        let key = info.name.to_ascii_lowercase();
        self.origins.insert(key.clone(), origin);
        self.catalogue.insert(key, info);
        self.generation += 1;
    }
}
