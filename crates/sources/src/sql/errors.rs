//! Errors of statements: the position of the error, and the available names.

use std::borrow::Cow;

use rusqlite::ffi::ErrorCode;

use crate::sql::cell::Cell;
use crate::sql::functions;
use crate::sql::rewrite::{self, Catalogue};
use crate::sql::statement_text::describe_position;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::text::{listed, shown};

/// Maximum length of a statement (bytes).
pub(crate) const LONGEST_STATEMENT: usize = 200_000;

/// Creates the error for a failure of Burgeon's own use of SQLite.
pub(crate) fn internal(error: &rusqlite::Error) -> Error {
    Error::internal(format!("the database of the run: {error}"))
}

/// An error while reading tables: of Burgeon or of SQLite.
pub(crate) enum TableError {
    /// Error of Burgeon.
    Told(Error),
    /// Error of SQLite.
    Sqlite(rusqlite::Error),
}

impl From<Error> for TableError {
    fn from(error: Error) -> Self {
        Self::Told(error)
    }
}

impl From<rusqlite::Error> for TableError {
    fn from(error: rusqlite::Error) -> Self {
        Self::Sqlite(error)
    }
}

/// Returns the error of Burgeon, or converts an error of SQLite with `tell`.
pub(crate) fn or_sqlite(error: TableError, tell: impl FnOnce(&rusqlite::Error) -> Error) -> Error {
    match error {
        TableError::Told(error) => error,
        TableError::Sqlite(error) => tell(&error),
    }
}

/// Fails if a statement is empty or too long, or if there are several statements.
pub(crate) fn check_length(sql: &str) -> Result<()> {
    if sql.len() > LONGEST_STATEMENT {
        return Err(Error::limit(
            Limit::Size,
            format!("a statement has {} bytes; it may have {LONGEST_STATEMENT}", sql.len()),
        )
        .help("hand values over as parameters: $name"));
    }
    if sql.trim().is_empty() {
        return Err(Error::syntax("the statement is empty").help("write query(\"SELECT ... FROM ...\")"));
    }
    match rewrite::second_statement(sql) {
        Some(place) => Err(Error::syntax(format!(
            "SQL, {}: there is more than one statement",
            describe_position(sql, place)
        ))
        .help("ask one question at a time; values are handed over as parameters: $name")),
        None => Ok(()),
    }
}

/// Returns true if SQLite could not parse a statement.
pub(crate) fn is_syntax(error: &rusqlite::Error) -> bool {
    let text = words(error);
    text.contains("syntax error")
        || text.starts_with("unrecognized token")
        || text.starts_with("incomplete input")
}

/// Returns SQLite's message.
fn words(error: &rusqlite::Error) -> Cow<'_, str> {
    match error {
        rusqlite::Error::SqliteFailure(_, Some(text)) => text.into(),
        rusqlite::Error::SqlInputError { msg, .. } => msg.into(),
        other => other.to_string().into(),
    }
}

/// Converts SQLite's error in the statement `sql`.
pub(crate) fn statement_error(error: &rusqlite::Error, sql: &str, catalogue: &Catalogue) -> Error {
    let text = words(error);
    let code = error.sqlite_error_code();
    if code == Some(ErrorCode::AuthorizationForStatementDenied) || text.starts_with(NOT_ALLOWED) {
        return refusal(&text, sql);
    }
    let named = |prefix: &str| text.strip_prefix(prefix).map(|rest| rest.trim().trim_matches('"'));
    let offset = match error {
        rusqlite::Error::SqlInputError { offset, sql: asked, .. } if asked.ends_with(sql) => {
            usize::try_from(*offset).ok().and_then(|offset| offset.checked_sub(asked.len() - sql.len()))
        }
        _ => None,
    };
    if let Some(name) = named("no such table: ") {
        let known = || catalogue.values().map(|table| table.name.as_str());
        let what = format!("{}no table called {}", place(sql, offset, name), shown(name));
        let error = Error::not_found("table", name, known(), what);
        if catalogue.is_empty() {
            return error.help("there are none: a table is what source(file) has read, or a module");
        }
        return error.help(format!(
            "there are {}; a table is what source(file) has read, or a module",
            listed(known())
        ));
    }
    if let Some(name) = named("no such column: ") {
        let own = name.rsplit('.').next().unwrap_or(name);
        let mut known: Vec<&str> = Vec::new();
        for table in catalogue.values().filter(|table| mentions(sql, &table.name)) {
            known.extend(table.columns.iter().map(String::as_str));
        }
        let mut seen = rustc_hash::FxHashSet::default();
        known.retain(|name| seen.insert(*name));
        let what = format!("{}no column called {}", place(sql, offset, own), shown(name));
        return Error::not_found("column", own, known.iter().copied(), what)
            .help(format!("there are {}; texts stand in single quotes", listed(known.iter().copied())));
    }
    if let Some(name) = named("no such function: ") {
        let what = format!("{}no function called {}", place(sql, offset, name), shown(name));
        return Error::not_found("function", name, functions::names(), what)
            .help("the book's page on SQL lists what there is");
    }
    if text.starts_with("wrong number of arguments to function") {
        let name = text.split_whitespace().last().unwrap_or_default().trim_end_matches("()");
        let takes = functions::find(name)
            .map_or_else(String::new, |function| format!("it takes {}{}", function.name, function.takes));
        let error = Error::argument(format!("{}{text}", place(sql, offset, name)));
        return if takes.is_empty() { error } else { error.help(takes) };
    }
    let at_end = text == "incomplete input";
    // Messages of functions start with the function's name.
    let function = text.split_once(": ").filter(|(name, _)| functions::find(name).is_some());
    let what = match function {
        Some((name, _)) => format!("{}{text}", place(sql, offset, name)),
        None => {
            let offset = if at_end { Some(sql.trim_end().len()) } else { offset };
            format!(
                "SQL{}: {text}",
                offset.map_or_else(String::new, |offset| format!(", {}", describe_position(sql, offset)))
            )
        }
    };
    if text == "Recursion limit" || text.starts_with("Expression tree is too large") {
        return Error::argument(what).help("write shorter sums, and fewer brackets within one another");
    }
    match code {
        Some(ErrorCode::OutOfMemory) => Error::limit(Limit::Memory, what)
            .help("ask for less, or raise the limit: --memory-limit MEGABYTES"),
        Some(ErrorCode::TooBig) => {
            Error::limit(Limit::Size, what).help("ask for shorter texts and smaller geometries")
        }
        Some(ErrorCode::DatabaseCorrupt | ErrorCode::NotADatabase | ErrorCode::SystemIoFailure) => {
            Error::data(what).help("a file is damaged or cut short; get it again")
        }
        Some(ErrorCode::OperationInterrupted) => Error::cancellation(what),
        _ if is_syntax(error) => {
            Error::syntax(what).help("write SQL as SQLite takes it: SELECT ... FROM ... WHERE ...")
        }
        _ => Error::argument(what)
            .help("check the statement; the book's page on SQL tells what functions take"),
    }
}

/// Start of SQLite's message about a function that may not be called.
const NOT_ALLOWED: &str = "not authorized to use function: ";

/// Start of SQLite's message about a column that may not be read.
const NOT_READ: &str = "access to ";

fn refusal(text: &str, sql: &str) -> Error {
    if let Some(column) = text.strip_prefix(NOT_READ).and_then(|rest| rest.strip_suffix(" is prohibited")) {
        let table = column.rsplit_once('.').map_or(column, |(table, _)| table);
        let table = table.rsplit('.').next().unwrap_or(table);
        return Error::scope(format!(
            "{}the table {} may not be read",
            place(sql, None, table),
            shown(table)
        ))
        .help("a table is what source(file) has read, or a module");
    }
    if let Some(name) = text.strip_prefix(NOT_ALLOWED) {
        return Error::scope(format!("{}the function {} may not be called", place(sql, None, name), shown(name)))
            .help("questions give the same each time, and reach nothing but tables; the book's page on SQL lists what there is");
    }
    only_reading()
}

/// Creates the error for a statement that does not return rows.
pub(crate) fn only_reading() -> Error {
    Error::scope("SQL: a question may only read: SELECT, WITH and VALUES are allowed")
        .help("layers are written with exports, not with SQL")
}

/// Describes the position of a name in a statement, if known, as the start of a message.
pub(crate) fn place(sql: &str, offset: Option<usize>, name: &str) -> Cow<'static, str> {
    match offset.or_else(|| rewrite::find_word(sql, name)) {
        Some(offset) => format!("SQL, {}: ", describe_position(sql, offset)).into(),
        None => "SQL: ".into(),
    }
}

fn mentions(sql: &str, table: &str) -> bool {
    rewrite::find_word(sql, table).is_some()
}

/// Returns the value of a parameter that is named `name` in SQLite.
pub(crate) fn parameter<'a>(sql: &str, name: Option<&str>, given: &'a [(&str, Cell)]) -> Result<&'a Cell> {
    let Some(own) = name.and_then(|name| name.strip_prefix('$')) else {
        let shown = name.unwrap_or("?");
        return Err(Error::argument(format!(
            "SQL: the parameter {shown} has no name that a value could be found by"
        ))
        .help("write $name"));
    };
    if let Some((_, cell)) = given.iter().find(|(known, _)| *known == own) {
        return Ok(cell);
    }
    let offset = rewrite::find_word(sql, &format!("${own}"));
    let known: Vec<&str> = given.iter().map(|(name, _)| *name).collect();
    let place = offset.map_or_else(String::new, |offset| format!(", {}", describe_position(sql, offset)));
    let message = format!("SQL{place}: ${} has no value", shown(own));
    let help = match known.is_empty() {
        true => format!("hand one over: query(sql, {{ {} = ... }})", shown(own)),
        false => format!("there are values for {}", listed(known.iter().copied())),
    };
    Err(Error::not_found("parameter", own, known.iter().copied(), message).help(help))
}
