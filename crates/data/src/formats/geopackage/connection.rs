//! Connections to SQLite that only read, and that end when the budget is exceeded.

use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::time::Duration;

use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use rusqlite::config::DbConfig;
use rusqlite::hooks::{AuthAction, Authorization};
use rusqlite::limits::Limit;
use rusqlite::{Connection, OpenFlags};

/// Maximum length of a text or blob (bytes).
const LONGEST: i32 = 200_000_000;

/// Interval of checks for cancelling a query.
const PERIOD: Duration = Duration::from_millis(20);

/// Time for a query to end after it was cancelled.
const GRACE: Duration = Duration::from_millis(500);

/// Opens the database at `path` for reading, with URI `options`. Never waits for locks.
pub(super) fn connect(path: &Path, options: &str) -> rusqlite::Result<Connection> {
    let flags =
        OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_NO_MUTEX | OpenFlags::SQLITE_OPEN_URI;
    let connection = Connection::open_with_flags(address(path, options), flags)?;
    connection.busy_timeout(Duration::ZERO)?;
    Ok(connection)
}

/// Returns the URI of the database at `path` with `options`.
pub(super) fn address(path: &Path, options: &str) -> String {
    let mut address = "file:".to_owned();
    for byte in path.as_os_str().as_encoded_bytes() {
        match byte {
            b'/' | b'.' | b'-' | b'_' | b'0'..=b'9' | b'a'..=b'z' | b'A'..=b'Z' => {
                address.push(char::from(*byte))
            }
            byte => address.push_str(&format!("%{byte:02x}")),
        }
    }
    // Without the name of a file system, SQLite would also search in memory, where the main database of a connection
    // is.
    format!("{address}?{options}&vfs={}", if cfg!(windows) { "win32" } else { "unix" })
}

/// Begins a read transaction, which sees one state until it ends.
pub(super) fn begin(connection: &Connection) -> rusqlite::Result<()> {
    connection.execute_batch("BEGIN")?;
    pin(connection, "main")
}

/// Reads from `schema`, so that the transaction of a connection sees its state from now on.
pub(super) fn pin(connection: &Connection, schema: &str) -> rusqlite::Result<()> {
    connection.query_row(&format!("PRAGMA {schema}.schema_version"), [], |_| Ok(()))
}

/// Runs `work` with a connection in a separate thread, and returns its result.
///
/// SQLite checks for an interrupt only between the steps of a query, and one step may take long: a sort, or a function
/// over long texts. When the budget is exceeded, the query is interrupted. If it does not end soon, it is abandoned,
/// and ends after its current step.
pub(in crate::formats) fn run_watched<T: Send + 'static>(
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

/// Returns a name in quotes.
pub(in crate::formats) fn quote(name: &str) -> String {
    format!("\"{}\"", name.replace('"', "\"\""))
}
