//! Errors of unreachable servers, and of statements that a server refuses.

use std::borrow::Cow;
use std::time::Duration;

use tokio_postgres::error::{ErrorPosition, SqlState};

use super::ServerAddress;
use crate::sql::errors::place;
use crate::sql::functions;
use crate::sql::rewrite::{Catalogue, find_word};
use burgeon_base::error::{Error, Limit};
use burgeon_base::text::{listed, shown};

/// Returns true if the connection is lost, so that the statement is not the cause.
pub(super) fn is_lost(error: &tokio_postgres::Error) -> bool {
    let ended = [SqlState::ADMIN_SHUTDOWN, SqlState::CRASH_SHUTDOWN, SqlState::CANNOT_CONNECT_NOW];
    error.is_closed()
        || error.code().map_or(error.as_db_error().is_none() && has_io(error), |code| ended.contains(code))
}

fn has_io(error: &tokio_postgres::Error) -> bool {
    use std::error::Error as _;
    error.source().is_some_and(|source| source.is::<std::io::Error>())
}

/// Creates the error for a server that cannot be reached.
pub(super) fn unreachable(address: &ServerAddress, error: &tokio_postgres::Error) -> Error {
    let why = cause(error);
    let failed = Error::unavailable(format!("the database {address} cannot be reached: {why}"));
    if why.contains("certificate") {
        return failed.help(
            "name the file with the certificate of its authority, sslrootcert=FILE, or encrypt without verification, sslmode=require",
        );
    }
    if why.contains("does not support TLS") {
        return failed.help("let the server encrypt, or ask it not to: sslmode=prefer");
    }
    failed.help("start the server, or check the address that --database names")
}

/// Creates the error for a server that accepts a connection or a query but does not answer in time.
pub(super) fn late(address: &ServerAddress, most: Duration, option: &str) -> Error {
    Error::unavailable(format!("the database {address} has not answered for {} s", most.as_secs_f64()))
        .help(format!("check the server, or wait longer: {address}?{option}=SECONDS behind --database"))
}

/// Returns the innermost cause.
fn cause(error: &tokio_postgres::Error) -> String {
    use std::error::Error as _;
    match (error.as_db_error(), error.source()) {
        (Some(told), _) => shown(told.message()).into_owned(),
        (None, Some(source)) => shown(&source.to_string()).into_owned(),
        (None, None) => error.to_string(),
    }
}

/// Converts the server's error in the statement `sql`, which was sent as `asked`.
pub(super) fn server_error(
    address: &ServerAddress,
    error: &tokio_postgres::Error,
    (sql, asked): (&str, &str),
    catalogue: &Catalogue,
) -> Error {
    if is_lost(error) {
        return Error::unavailable(format!("the database {address} went away: {}", cause(error)))
            .help("start the server, and run again");
    }
    let Some(told) = error.as_db_error() else {
        return Error::data(format!("the database {address}: {}", cause(error)))
            .help("ask for columns that are numbers, texts, true or false, or geometries");
    };
    let message = told.message();
    // The server reports a position in the sent statement, so the word at this position is searched in the original.
    let word = match told.position() {
        Some(ErrorPosition::Original(position)) => {
            let begin = usize::try_from(*position).unwrap_or(0).saturating_sub(1);
            let rest: String = asked.chars().skip(begin).collect();
            rest.chars().take_while(|letter| letter.is_alphanumeric() || *letter == '_').collect()
        }
        _ => String::new(),
    };
    let place = |name: &str| match name.is_empty() {
        true => Cow::Borrowed("SQL: "),
        false => place(sql, None, name),
    };
    let quoted = || message.split('"').nth(1);
    let code = told.code();
    if *code == SqlState::UNDEFINED_TABLE {
        let name = quoted().unwrap_or(&word);
        let known: Vec<&str> =
            catalogue.values().filter(|table| !table.is_alias).map(|table| table.name.as_str()).collect();
        let what = format!("{}no table called {}", place(name), shown(name));
        return Error::not_found("table", name, known.iter().copied(), what)
            .help(format!("the database has {}", listed(known.iter().copied())));
    }
    if *code == SqlState::UNDEFINED_COLUMN {
        let name = quoted().unwrap_or(&word);
        let used = catalogue.values().filter(|table| find_word(sql, &table.name).is_some());
        let known: Vec<&str> = used.flat_map(|table| table.columns.iter().map(String::as_str)).collect();
        let what = format!("{}no column called {}", place(name), shown(name));
        return Error::not_found("column", name, known.iter().copied(), what)
            .help(format!("there are {}; texts stand in single quotes", listed(known.iter().copied())));
    }
    if *code == SqlState::UNDEFINED_FUNCTION && message.starts_with("function ") {
        let name = message["function ".len()..].split('(').next().unwrap_or_default();
        let what = format!("{}{}", place(name), shown(message));
        return Error::not_found("function", name, functions::names(), what)
            .help("check what it is given; PostGIS tells numbers from whole numbers and texts");
    }
    let what = format!("{}{}", place(&word), shown(message));
    if *code == SqlState::QUERY_CANCELED {
        return Error::limit(Limit::Time, what)
            .help("ask for less, or raise the limit: --time-limit SECONDS");
    }
    if *code == SqlState::READ_ONLY_SQL_TRANSACTION || *code == SqlState::INSUFFICIENT_PRIVILEGE {
        return Error::scope(what).help("questions may only read what the user of the database may see");
    }
    match *code == SqlState::SYNTAX_ERROR {
        true => Error::syntax(what).help("write SQL as PostgreSQL takes it: SELECT ... FROM ... WHERE ..."),
        false => Error::argument(what).help(told.hint().map_or("check the statement".into(), shown)),
    }
}
