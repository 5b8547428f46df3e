//! SQLite database of a GeoPackage.

use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::time::Duration;

use super::state::{PackageState, broken};
use crate::formats::blob::{envelope, read_blob};
use crate::{Attribute, Crs, FeatureTable, SourceOptions};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::shown;
use rusqlite::config::DbConfig;
use rusqlite::hooks::{AuthAction, Authorization};
use rusqlite::limits::Limit;
use rusqlite::types::ValueRef;
use rusqlite::{Connection, OptionalExtension};

/// Maximum length of a text or blob (bytes).
const LONGEST: i32 = 200_000_000;

/// Page cache of a connection (KiB).
const PAGES: i64 = 256;

/// Interval of checks for cancelling a query.
const PERIOD: Duration = Duration::from_millis(20);

/// Time for a query to end after it was cancelled.
const GRACE: Duration = Duration::from_millis(500);

/// Open GeoPackage.
pub struct GeoPackage {
    connection: Connection,
    state: Arc<PackageState>,
    name: String,
    layers: Vec<LayerDescription>,
}

/// Runs `work` with a connection in a separate thread, and returns its result.
///
/// SQLite checks for an interrupt only between the steps of a query, and one step may take long: a sort, or a function
/// over long texts. When the budget is exceeded, the query is interrupted. If it does not end soon, it is abandoned,
/// and ends after its current step.
pub(in crate::formats) fn watched<T: Send + 'static>(
    connection: Connection,
    budget: &Arc<Budget>,
    work: impl FnOnce(Connection) -> Result<T> + Send + 'static,
) -> Result<T> {
    let interrupt = connection.get_interrupt_handle();
    let (done, result) = sync_channel(1);
    let begun = std::thread::Builder::new().name("sqlite".into()).spawn(move || {
        // The receiver may already be gone.
        let _ = done.send(work(connection));
    });
    begun.map_err(|error| Error::system(format!("cannot start a thread: {error}")))?;
    loop {
        match result.recv_timeout(PERIOD) {
            // The error of an interrupted query does not contain the reason.
            Ok(done) => return done.map_err(|error| budget.check().err().unwrap_or(error)),
            Err(RecvTimeoutError::Disconnected) => {
                return Err(Error::internal("the database gave no answer"));
            }
            Err(RecvTimeoutError::Timeout) => {
                if let Err(over) = budget.check() {
                    interrupt.interrupt();
                    // Its result would only report the interrupt.
                    let _ = result.recv_timeout(GRACE);
                    return Err(over);
                }
            }
        }
    }
}

/// Description of a layer from the package's own tables.
struct LayerDescription {
    table: String,
    column: String,
    crs: Result<Crs>,
}

impl GeoPackage {
    pub(crate) fn open(path: &Path, name: &str, wanted: &SourceOptions) -> Result<Self> {
        let state = PackageState::open(path, name, &wanted.budget)?;
        let (owned, budget) = (name.to_owned(), Arc::clone(&wanted.budget));
        watched(state.connect()?, &wanted.budget, move |connection| {
            Self::with(connection, state, owned, &budget)
        })
    }

    fn with(
        mut connection: Connection,
        state: Arc<PackageState>,
        name: String,
        budget: &Arc<Budget>,
    ) -> Result<Self> {
        let error = |error: rusqlite::Error| broken(&name, &error);
        // Rows are read once, in order, so a small page cache suffices.
        connection.pragma_update(None, "cache_size", -PAGES).map_err(error)?;
        guard(&mut connection, budget).map_err(error)?;
        let layers = match described(&connection) {
            Ok(layers) => layers,
            Err(rusqlite::Error::SqliteFailure(_, Some(text))) if text.starts_with("no such table") => {
                // A GeoPackage without features, such as one of tables or images, needs no geometry columns.
                if !text.contains("gpkg_geometry_columns") {
                    return Err(Error::data(format!("{name} is an SQLite database, but no GeoPackage"))
                        .help("a GeoPackage has the tables gpkg_contents and gpkg_geometry_columns"));
                }
                Vec::new()
            }
            Err(error) => return Err(broken(&name, &error)),
        };
        Ok(Self { connection, state, name, layers })
    }

    pub(crate) fn layers(&self) -> Vec<String> {
        self.layers.iter().map(|layer| layer.table.clone()).collect()
    }

    pub(crate) fn read(self, layer: &str, wanted: &SourceOptions) -> Result<FeatureTable> {
        let Self { connection, state, name, layers } = self;
        let (layer, wanted) = (layer.to_owned(), wanted.clone());
        let budget = Arc::clone(&wanted.budget);
        watched(connection, &budget, move |connection| {
            let read = Self { connection, state: Arc::clone(&state), name, layers }.table(&layer, &wanted);
            // An error may be caused by reading two different states.
            state.check()?;
            read
        })
    }

    fn table(mut self, layer: &str, wanted: &SourceOptions) -> Result<FeatureTable> {
        let name = self.name.clone();
        let error = |error: rusqlite::Error| broken(&name, &error);
        let Some(position) = self.layers.iter().position(|known| known.table == layer) else {
            return Err(Error::not_found("layer", layer, [], format!("{name} has no layer called {layer}")));
        };
        let described = self.layers.swap_remove(position);
        let label = format!("{name}:{}", shown(layer));
        let mut table = FeatureTable::new(layer, &label, described.crs, wanted);
        let crs = wanted.crs.map_or_else(|| table.crs.clone(), Crs::epsg);
        let near = burgeon_spatial::wkb::NEAR / crs.map_or(1.0, |crs| crs.metres());
        let columns = LayerColumns::read(&self.connection, layer, &described.column).map_err(error)?;
        table.names = columns.names.clone();
        let id = match &wanted.id {
            Some(id) => Some(table.column(id)?),
            None => table.names.iter().position(|name| name.eq_ignore_ascii_case("id")),
        };
        let sql = columns.select(layer, &described.column, wanted);
        let mut statement =
            self.connection.prepare(&sql).map_err(|error| refused(&table.shown, wanted, &error))?;
        let mut rows = statement.query([]).map_err(|error| refused(&table.shown, wanted, &error))?;
        let mut count: usize = 0;
        while let Some(row) = rows.next().map_err(|error| refused(&table.shown, wanted, &error))? {
            count += 1;
            let key = row.get_ref(0).ok().and_then(id_text).unwrap_or_else(|| count.to_string());
            let id = id.and_then(|id| id_text(row.get_ref(id + 2).ok()?)).unwrap_or_else(|| key.clone());
            let wrong = |why: &str| {
                Error::data(format!("the geometry of feature {} of {label} {why}", shown(&id)))
                    .help("points, lines, polygons, curves, surfaces and collections of these are read")
            };
            let parts = match row.get_ref(1).map_err(error)? {
                ValueRef::Null => Vec::new(),
                ValueRef::Blob(blob) => match read_blob(blob, near, &wanted.budget) {
                    Ok(parts) => parts,
                    Err(why) => {
                        // The error may be an exceeded time limit instead of an invalid geometry.
                        wanted.budget.check()?;
                        let error = wrong(&why);
                        table.refuse_at(id, error, envelope(blob))?;
                        continue;
                    }
                },
                _ => {
                    let error = wrong("is no geometry of a GeoPackage");
                    table.refuse(id, error)?;
                    continue;
                }
            };
            let mut attributes = Vec::new();
            for index in 0..columns.names.len() {
                let value = match row.get_ref(index + 2).map_err(error)? {
                    ValueRef::Integer(value) if columns.booleans[index] => Attribute::Boolean(value != 0),
                    #[allow(clippy::cast_precision_loss, reason = "Lua's own numbers are f64")]
                    ValueRef::Integer(value) => Attribute::Number(value as f64),
                    ValueRef::Real(value) => Attribute::Number(value),
                    ValueRef::Text(text) => table.text(&String::from_utf8_lossy(text)),
                    ValueRef::Null | ValueRef::Blob(_) => continue,
                };
                attributes.push((index, value));
            }
            table.push(&id, parts, attributes)?;
            if table.is_full() {
                break;
            }
        }
        Ok(table)
    }
}

/// Restricts a connection to reading within the budget.
pub(in crate::formats) fn guard(connection: &mut Connection, budget: &Arc<Budget>) -> rusqlite::Result<()> {
    connection.set_db_config(DbConfig::SQLITE_DBCONFIG_DEFENSIVE, true)?;
    connection.set_db_config(DbConfig::SQLITE_DBCONFIG_TRUSTED_SCHEMA, false)?;
    // A misspelt name in quotes is an error, not a text.
    connection.set_db_config(DbConfig::SQLITE_DBCONFIG_DQS_DML, false)?;
    let memory = i32::try_from(budget.memory()).unwrap_or(i32::MAX);
    for (limit, most) in [
        (Limit::SQLITE_LIMIT_LENGTH, LONGEST.min(memory)),
        (Limit::SQLITE_LIMIT_SQL_LENGTH, 1_000_000),
        (Limit::SQLITE_LIMIT_LIKE_PATTERN_LENGTH, 1000),
        (Limit::SQLITE_LIMIT_ATTACHED, 0),
        (Limit::SQLITE_LIMIT_WORKER_THREADS, 0),
    ] {
        connection.set_limit(limit, most)?;
    }
    // Temporary data stays in memory, where it counts towards the limit.
    connection.pragma_update(None, "temp_store", "MEMORY")?;
    limit_heap(budget.memory());
    let clock = Arc::clone(budget);
    connection.progress_handler(1000, Some(move || clock.check().is_err()))?;
    connection.authorizer(Some(|context: rusqlite::hooks::AuthContext<'_>| match context.action {
        AuthAction::Select | AuthAction::Read { .. } | AuthAction::Recursive => Authorization::Allow,
        AuthAction::Function { function_name } if function_name != "load_extension" => Authorization::Allow,
        // Returns the columns of a table and changes nothing.
        AuthAction::Pragma { pragma_name: "table_info", .. } => Authorization::Allow,
        _ => Authorization::Deny,
    }))
}

/// Limits the memory (bytes) that SQLite uses in this process, excluding the data that is read.
fn limit_heap(memory: usize) {
    let most = i64::try_from(memory).unwrap_or(i64::MAX);
    #[allow(unsafe_code, reason = "rusqlite has no way to set this")]
    // SAFETY: the call sets a number that SQLite protects with its own lock.
    unsafe {
        rusqlite::ffi::sqlite3_hard_heap_limit64(most);
    }
}

/// Properties of a layer's table that are known without reading its features.
#[derive(Debug)]
pub struct TableShape {
    /// Integer primary key column; `None` for a view.
    pub key: Option<String>,
    /// Geometry column.
    pub geometry: String,
    /// Names of all columns, with their declared types.
    pub columns: Vec<(String, String)>,
    /// Number of rows.
    pub rows: usize,
    /// Coordinate system, or the reason why it is unknown.
    pub crs: Result<Crs>,
}

impl GeoPackage {
    /// Returns the properties of the layer `layer` in the file at `path`, called `name` in messages.
    pub fn shape(path: &Path, name: &str, layer: &str, budget: &Arc<Budget>) -> Result<TableShape> {
        let wanted = SourceOptions { budget: Arc::clone(budget), ..SourceOptions::default() };
        let mut package = Self::open(path, name, &wanted)?;
        let layer = crate::source::choose(name, &package.layers(), Some(layer))?;
        let position = package.layers.iter().position(|known| known.table == layer).unwrap_or_default();
        let LayerDescription { column, crs, .. } = package.layers.swap_remove(position);
        let name = name.to_owned();
        watched(package.connection, budget, move |connection| {
            let read = || -> rusqlite::Result<TableShape> {
                let mut shape = TableShape { key: None, geometry: column, columns: Vec::new(), rows: 0, crs };
                let mut statement = connection.prepare(&format!("PRAGMA table_info({})", quoted(&layer)))?;
                let mut rows = statement.query([])?;
                while let Some(row) = rows.next()? {
                    let (name, kind, key): (String, String, i64) = (row.get(1)?, row.get(2)?, row.get(5)?);
                    if key == 1 && kind.eq_ignore_ascii_case("integer") {
                        shape.key = Some(name.clone());
                    }
                    // Names are case-insensitive.
                    if name.eq_ignore_ascii_case(&shape.geometry) {
                        shape.geometry.clone_from(&name);
                    }
                    shape.columns.push((name, kind));
                }
                let count: i64 =
                    connection.query_row(&format!("SELECT count(*) FROM {}", quoted(&layer)), [], |row| {
                        row.get(0)
                    })?;
                shape.rows = usize::try_from(count).unwrap_or(0);
                Ok(shape)
            };
            read().map_err(|error| broken(&name, &error))
        })
    }
}

/// Returns the feature layers in file order.
fn described(connection: &Connection) -> rusqlite::Result<Vec<LayerDescription>> {
    let mut statement = connection.prepare(
        "SELECT c.table_name, g.column_name, g.srs_id FROM gpkg_contents c \
         JOIN gpkg_geometry_columns g ON g.table_name = c.table_name \
         WHERE c.data_type = 'features' ORDER BY c.rowid",
    )?;
    let mut rows = statement.query([])?;
    let mut layers = Vec::new();
    while let Some(row) = rows.next()? {
        layers.push(LayerDescription {
            table: row.get(0)?,
            column: row.get(1)?,
            crs: system(connection, row.get(2)?)?,
        });
    }
    Ok(layers)
}

/// Returns the coordinate system with a package's own number.
fn system(connection: &Connection, number: i64) -> rusqlite::Result<Result<Crs>> {
    let found: Option<(Option<String>, Option<String>, Option<i64>)> = connection
        .query_row(
            "SELECT srs_name, organization, organization_coordsys_id FROM gpkg_spatial_ref_sys WHERE srs_id = ?1",
            [number],
            |row| Ok((row.get(0)?, row.get(1)?, row.get(2)?)),
        )
        .optional()?;
    let remedy = "name its EPSG code: source(file, { crs = 3067 })";
    Ok(match found {
        _ if number == 0 || number == -1 => {
            Err(Error::data("the layer has no coordinate system").help(remedy))
        }
        Some((_, Some(organization), Some(code))) if organization.eq_ignore_ascii_case("epsg") => {
            Crs::epsg(u32::try_from(code).unwrap_or(0))
        }
        Some((name, ..)) => {
            let name = name.unwrap_or_default();
            Err(Error::data(format!("the layer's coordinate system \"{}\" is none of EPSG's", shown(&name)))
                .help(remedy))
        }
        None => {
            Err(Error::data(format!("the layer's coordinate system {number} is not described in the file"))
                .help(remedy))
        }
    })
}

/// Columns of a layer, with the key separate and without the geometry.
struct LayerColumns {
    names: Vec<String>,
    booleans: Vec<bool>,
    key: Option<String>,
}

impl LayerColumns {
    fn read(connection: &Connection, layer: &str, geometry: &str) -> rusqlite::Result<Self> {
        let mut columns = Self { names: Vec::new(), booleans: Vec::new(), key: None };
        let mut statement = connection.prepare(&format!("PRAGMA table_info({})", quoted(layer)))?;
        let mut rows = statement.query([])?;
        while let Some(row) = rows.next()? {
            let (name, kind, key): (String, String, i64) = (row.get(1)?, row.get(2)?, row.get(5)?);
            if key == 1 && columns.key.is_none() {
                columns.key = Some(name);
            } else if !name.eq_ignore_ascii_case(geometry) {
                columns.names.push(name);
                columns.booleans.push(kind.eq_ignore_ascii_case("boolean"));
            }
        }
        Ok(columns)
    }

    fn select(&self, layer: &str, geometry: &str, wanted: &SourceOptions) -> String {
        let key = self.key.as_deref().map_or_else(|| "NULL".to_owned(), quoted);
        let mut sql = format!("SELECT {key}, {}", quoted(geometry));
        for name in &self.names {
            sql += &format!(", {}", quoted(name));
        }
        sql += &format!(" FROM {}", quoted(layer));
        if let Some(condition) = &wanted.condition {
            // The line break ends a comment in the condition.
            sql += &format!(" WHERE (\n{condition}\n)");
        }
        if self.key.is_some() {
            sql += &format!(" ORDER BY {key}");
        }
        sql
    }
}

pub(in crate::formats) fn quoted(name: &str) -> String {
    format!("\"{}\"", name.replace('"', "\"\""))
}

fn id_text(value: ValueRef<'_>) -> Option<String> {
    match value {
        ValueRef::Integer(value) => Some(value.to_string()),
        ValueRef::Real(value) => Some(value.to_string()),
        ValueRef::Text(text) if !text.is_empty() => Some(String::from_utf8_lossy(text).into_owned()),
        _ => None,
    }
}

/// Returns the message text of an SQLite error.
pub(super) fn words(error: &rusqlite::Error) -> String {
    match error {
        rusqlite::Error::SqliteFailure(_, Some(text)) => text.clone(),
        rusqlite::Error::SqlInputError { msg, .. } => msg.clone(),
        rusqlite::Error::MultipleStatement => "it holds more than one statement".to_owned(),
        other => other.to_string(),
    }
}

/// Returns the error of a query; it refers to the condition, if there is one.
pub(in crate::formats) fn refused(shown: &str, wanted: &SourceOptions, error: &rusqlite::Error) -> Error {
    let text = words(error);
    match &wanted.condition {
        Some(condition) if !text.contains("malformed") => {
            let condition: String = condition.chars().take(200).collect();
            Error::argument(format!("where {condition:?} of {shown}: {text}"))
                .help("write an SQL condition on the layer's columns, such as where = \"height > 10\"")
        }
        _ => broken(shown, error),
    }
}
