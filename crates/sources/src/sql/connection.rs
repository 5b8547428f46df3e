//! Connections to the internal database: the data that they see, and the operations that are permitted.
//!
//! Each connection reads the same pages in memory, and the attached files; none can write. SQLite asks an authorizer
//! before it runs a statement: only reading, and calling functions of a list are allowed.

use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;
use std::panic::AssertUnwindSafe;
use std::sync::Arc;

use rusqlite::config::DbConfig;
use rusqlite::hooks::{AuthAction, AuthContext, Authorization};
use rusqlite::limits::Limit;
use rusqlite::{Connection, OpenFlags, Statement};

use crate::sql::errors::{self, TableError};
use crate::sql::functions::{self, ConnectionState, Indexes};
use crate::sql::rewrite::MadeTable;
use crate::sql::statement_text::quote_name;
use crate::sql::tables;
use burgeon_base::error::Result;
use burgeon_base::locks::LockRecovery;
use burgeon_data::PackageState;
use burgeon_spatial::ReferenceFrame;

/// Maximum length of a string or blob (bytes).
const LONGEST: i32 = 200_000_000;

/// Maximum number of files that are attached; others are copied.
pub(crate) const MOST_FILES: usize = 8;

/// Maximum size (KiB) of a connection's page cache. `PAGES_SHARE` divides the memory limit to give the size for small
/// limits.
const PAGES: i64 = 32_768;
const PAGES_SHARE: usize = 32;

/// Maximum number of materialized subqueries that a connection keeps.
const MOST_KEPT: usize = 16;

/// Number of prepared statements that a connection keeps.
const STATEMENTS: usize = 64;

/// Number of SQLite steps between two checks of the budget.
const STEPS: i32 = 1000;

/// A connection and the state of its functions.
pub(crate) struct DatabaseLink {
    /// SQLite connection.
    pub connection: Connection,
    /// State of its functions.
    pub state: Arc<ConnectionState>,
    /// Generation of the tables that the connection sees.
    pub generation: usize,
    /// Current setting of SQLite's automatic indexes, if known.
    makes_indexes: Cell<Option<bool>>,
    files: Vec<AttachedFile>,
    /// Materialized subqueries without parameters.
    kept: RefCell<BTreeSet<String>>,
}

/// A file that is read directly: its schema name in statements, and its state.
#[derive(Clone)]
pub(crate) struct AttachedFile {
    /// Schema name, such as `file1`.
    pub schema: String,
    /// State of the file that all connections see.
    pub state: Arc<PackageState>,
}

/// A view in statements for a table of a file.
#[derive(Debug, Clone)]
pub(crate) struct TableView {
    /// Name of the view.
    pub name: String,
    /// Schema of the file.
    pub schema: String,
    /// Table of the file.
    pub table: String,
}

/// Opens the in-memory database that all connections share.
pub(crate) fn open_memory(address: &str, write: bool) -> rusqlite::Result<Connection> {
    let access = if write {
        OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_CREATE
    } else {
        // A connection creates its views in its own temporary database, which stays writable.
        OpenFlags::SQLITE_OPEN_READ_ONLY
    };
    Connection::open_with_flags(
        address,
        access | OpenFlags::SQLITE_OPEN_NO_MUTEX | OpenFlags::SQLITE_OPEN_URI,
    )
}

impl DatabaseLink {
    /// Opens a connection that reads `files`, with the `views` as names for their tables.
    pub(crate) fn open(
        address: &str,
        files: &[AttachedFile],
        views: &[TableView],
        indexes: &Arc<Indexes>,
        frame: Option<&ReferenceFrame>,
        generation: usize,
        memory: usize,
    ) -> rusqlite::Result<Self> {
        let mut connection = open_memory(address, false)?;
        connection.pragma_update(None, "temp_store", "MEMORY")?;
        let pages = i64::try_from(memory / 1024 / PAGES_SHARE).unwrap_or(PAGES).clamp(256, PAGES);
        connection.pragma_update(None, "cache_size", -pages)?;
        connection.pragma_update(None, "case_sensitive_like", true)?;
        for AttachedFile { schema, state } in files {
            connection.execute(&format!("ATTACH ?1 AS {schema}"), [state.address()])?;
        }
        for TableView { name, schema, table } in views {
            let (name, table) = (quote_name(name), quote_name(table));
            connection
                .execute_batch(&format!("CREATE TEMP VIEW {name} AS SELECT * FROM {schema}.{table}"))?;
        }
        let state = Arc::new(ConnectionState::new(indexes, frame));
        functions::register(&connection, &state)?;
        rusqlite::vtab::array::load_module(&connection)?;
        lock(&mut connection, &state)?;
        connection.set_prepared_statement_cache_capacity(STATEMENTS);
        Ok(Self {
            connection,
            state,
            generation,
            makes_indexes: Cell::new(None),
            files: files.to_vec(),
            kept: RefCell::default(),
        })
    }

    /// Enables or disables SQLite's automatic indexes for a statement: they only slow down lookups by key.
    pub(crate) fn set_automatic_index(&self, on: bool) -> rusqlite::Result<()> {
        if self.makes_indexes.get() == Some(on) {
            return Ok(());
        }
        let done = self.run_trusted(|connection| connection.pragma_update(None, "automatic_index", on));
        self.makes_indexes.set(done.is_ok().then_some(on));
        done
    }

    /// Runs `work` with operations that scripts' statements may not perform.
    fn run_trusted<T>(&self, work: impl FnOnce(&Connection) -> T) -> T {
        *self.state.trusted.lock().recover() = true;
        let done = work(&self.connection);
        *self.state.trusted.lock().recover() = false;
        done
    }

    /// Materializes a subquery as a table with a spatial index for each of its geometries, unless the table is kept.
    /// `bind` binds its parameters.
    pub(crate) fn make<E: From<rusqlite::Error> + From<burgeon_base::error::Error>>(
        &self,
        made: &MadeTable,
        bind: impl FnOnce(&mut Statement<'_>) -> std::result::Result<(), E>,
    ) -> std::result::Result<(), E> {
        let info = &made.info;
        if self.kept.borrow().contains(&info.name) {
            return Ok(());
        }
        if self.kept.borrow().len() >= MOST_KEPT {
            let kept = std::mem::take(&mut *self.kept.borrow_mut());
            kept.iter().try_for_each(|name| self.unmake(name))?;
        }
        self.unmake(&info.name)?;
        let columns: Vec<String> = info.columns.iter().skip(1).map(|name| quote_name(name)).collect();
        let (name, key) = (quote_name(&info.name), quote_name(info.key.as_deref().unwrap_or_default()));
        let columns = columns.join(", ");
        self.run_trusted(|connection| -> std::result::Result<(), E> {
            connection
                .execute_batch(&format!("CREATE TEMP TABLE {name} ({key} INTEGER PRIMARY KEY, {columns})"))?;
            let sql = format!("INSERT INTO temp.{name} ({columns}) {}", made.sql);
            let mut statement = connection.prepare(&sql)?;
            let constant = statement.parameter_count() == 0;
            bind(&mut statement)?;
            statement.raw_execute()?;
            drop(statement);
            if constant {
                self.kept.borrow_mut().insert(info.name.clone());
            }
            Ok(())
        })?;
        let budget = self.state.budget();
        for column in &info.geometries {
            budget.check()?;
            // The memory of the index is freed with the statement, so it is not charged.
            let built = tables::index(&self.connection, info, column, false, &Arc::default());
            let built = built.map_err(|error| match error {
                TableError::Told(error) => E::from(error),
                TableError::Sqlite(error) => E::from(error),
            })?;
            let name = format!("{}.{column}", info.name);
            self.state.own_indexes.lock().recover().insert(name, Arc::new(built));
        }
        Ok(())
    }

    /// Drops a materialized subquery, unless it has no parameters and is kept.
    pub(crate) fn forget(&self, made: &MadeTable) -> rusqlite::Result<()> {
        if self.kept.borrow().contains(&made.info.name) { Ok(()) } else { self.unmake(&made.info.name) }
    }

    fn unmake(&self, name: &str) -> rusqlite::Result<()> {
        let prefix = format!("{name}.");
        self.state.own_indexes.lock().recover().retain(|index, _| !index.starts_with(&prefix));
        self.run_trusted(|connection| {
            connection.execute_batch(&format!("DROP TABLE IF EXISTS temp.{}", quote_name(name)))
        })
    }

    /// Starts reading the files that are read in place, each in its recorded state. Fails if a file has changed.
    pub(crate) fn pin(&self) -> Result<()> {
        if !self.files.iter().any(|file| file.state.is_locked()) {
            return Ok(());
        }
        self.run_trusted(|connection| {
            connection.execute_batch("BEGIN").map_err(|error| errors::internal(&error))?;
            let pinned = self.files.iter().try_for_each(|file| file.state.pin(connection, &file.schema));
            pinned.inspect_err(|_| drop(connection.execute_batch("COMMIT")))
        })
    }

    /// Stops reading the files, so that the tables in memory can be written again. Fails if a file has changed in the
    /// meantime.
    pub(crate) fn unpin(&self) -> Result<()> {
        if !self.connection.is_autocommit() {
            let ended = self.run_trusted(|connection| connection.execute_batch("COMMIT"));
            ended.map_err(|error| errors::internal(&error))?;
        }
        self.files.iter().try_for_each(|file| file.state.check())
    }
}

/// Restricts a connection to reading.
fn lock(connection: &mut Connection, state: &Arc<ConnectionState>) -> rusqlite::Result<()> {
    connection.set_db_config(DbConfig::SQLITE_DBCONFIG_DEFENSIVE, true)?;
    connection.set_db_config(DbConfig::SQLITE_DBCONFIG_TRUSTED_SCHEMA, false)?;
    // A misspelt name in double quotes is an error, and not a string.
    connection.set_db_config(DbConfig::SQLITE_DBCONFIG_DQS_DML, false)?;
    #[allow(clippy::cast_possible_wrap, clippy::cast_possible_truncation, reason = "a constant")]
    for (limit, most) in [
        (Limit::SQLITE_LIMIT_LENGTH, LONGEST),
        (Limit::SQLITE_LIMIT_SQL_LENGTH, 4 * errors::LONGEST_STATEMENT as i32),
        (Limit::SQLITE_LIMIT_LIKE_PATTERN_LENGTH, 1000),
        (Limit::SQLITE_LIMIT_EXPR_DEPTH, 200),
        (Limit::SQLITE_LIMIT_ATTACHED, 0),
        (Limit::SQLITE_LIMIT_WORKER_THREADS, 0),
    ] {
        connection.set_limit(limit, most)?;
    }
    let clock = Arc::clone(state);
    let over = AssertUnwindSafe(move || clock.budget().check().is_err());
    connection.progress_handler(STEPS, Some(move || (over.0)()))?;
    let trust = AssertUnwindSafe(Arc::clone(state));
    connection.authorizer(Some(move |context: AuthContext<'_>| {
        let trusted = || *trust.0.trusted.lock().recover();
        match context.action {
            // SQLite's own tables expose its pages and files.
            AuthAction::Read { table_name, .. }
                if !trusted()
                    && (table_name.starts_with("sqlite_") || table_name.eq_ignore_ascii_case("dbstat")) =>
            {
                Authorization::Deny
            }
            AuthAction::Select | AuthAction::Read { .. } | AuthAction::Recursive => Authorization::Allow,
            AuthAction::Function { function_name } if functions::is_allowed(function_name) => {
                Authorization::Allow
            }
            AuthAction::Pragma { pragma_name: "automatic_index" | "schema_version", .. }
            | AuthAction::Transaction { .. }
            | AuthAction::CreateTempTable { .. }
            | AuthAction::DropTempTable { .. }
            | AuthAction::Insert { .. }
            | AuthAction::Update { .. }
            | AuthAction::Delete { .. }
                if trusted() =>
            {
                Authorization::Allow
            }
            _ => Authorization::Deny,
        }
    }))
}
