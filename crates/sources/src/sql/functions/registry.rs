//! The functions that statements may call, and their registration with a connection.

use std::sync::Arc;

use rusqlite::Connection;
use rusqlite::functions::{Context, FunctionFlags, SqlFnOutput};

use super::spatial_function::SpatialFunction;
use super::state::ConnectionState;
use super::table::FUNCTIONS;
use super::{aggregates, call, groups, index_functions, lists, numbers, operators, spatial_function, texts};

/// Functions of SQLite that statements may call: deterministic functions without access to files or settings.
const ALLOWED: [&str; 86] = [
    "->",
    "->>",
    "acos",
    "acosh",
    "asin",
    "asinh",
    "atan",
    "atan2",
    "atanh",
    "avg",
    "cbrt",
    "ceil",
    "ceiling",
    "char",
    "coalesce",
    "cos",
    "cosh",
    "cot",
    "count",
    "cume_dist",
    "degrees",
    "dense_rank",
    "exp",
    "first_value",
    "floor",
    "format",
    "glob",
    "group_concat",
    "hex",
    "if",
    "ifnull",
    "iif",
    "instr",
    "json",
    "json_array",
    "json_array_length",
    "json_each",
    "json_extract",
    "json_group_array",
    "json_group_object",
    "json_object",
    "json_type",
    "json_valid",
    "lag",
    "last_value",
    "lead",
    "like",
    "likelihood",
    "likely",
    "ln",
    "log",
    "log10",
    "log2",
    "max",
    "min",
    "nth_value",
    "ntile",
    "nullif",
    "octet_length",
    "percent_rank",
    "pi",
    "pow",
    "power",
    "printf",
    "quote",
    "radians",
    "rank",
    "rarray",
    "replace",
    "round",
    "row_number",
    "sin",
    "sinh",
    "sqrt",
    "string_agg",
    "subtype",
    "sum",
    "tan",
    "tanh",
    "total",
    "trunc",
    "typeof",
    "unicode",
    "unlikely",
    "greatest",
    "least",
];

/// Index functions of rewritten statements.
const OWN: [&str; 3] = ["burgeon_near", "burgeon_nearest", "burgeon_nearest_one"];

/// Returns the function with a name, ignoring case.
pub(crate) fn find(name: &str) -> Option<&'static SpatialFunction> {
    FUNCTIONS.iter().find(|function| function.name.eq_ignore_ascii_case(name))
}

/// Reports whether statements may call a function.
pub(crate) fn is_allowed(name: &str) -> bool {
    find(name).is_some()
        || ALLOWED.iter().chain(&OWN).any(|known| known.eq_ignore_ascii_case(name))
        || aggregates::NAMES.iter().chain(&groups::NAMES).any(|known| known.eq_ignore_ascii_case(name))
        || texts::names().chain(operators::names()).any(|known| known.eq_ignore_ascii_case(name))
        || lists::NAMES.iter().any(|(_, own)| own.eq_ignore_ascii_case(name))
}

/// Returns the names of all functions that statements may call.
pub(crate) fn names() -> impl Iterator<Item = &'static str> {
    let own = groups::NAMES.into_iter().chain(texts::names()).chain(operators::names());
    let own = own.filter(|name| !name.starts_with("burgeon_"));
    let all = FUNCTIONS.iter().map(|function| function.name).chain(aggregates::NAMES).chain(ALLOWED);
    all.chain(own).chain(lists::NAMES.iter().map(|(name, _)| *name)).chain(["ST_ClusterDBSCAN"])
}

/// A connection to which functions are added, and the state that they share.
pub(super) struct FunctionRegistrar<'a> {
    connection: &'a Connection,
    state: &'a Arc<ConnectionState>,
}

impl FunctionRegistrar<'_> {
    /// Registers a deterministic function of `count` arguments, or of any number if `count` is -1.
    pub(super) fn register<T: SqlFnOutput>(
        &self,
        name: &str,
        count: i32,
        run: impl Fn(&Context<'_>, &ConnectionState) -> rusqlite::Result<T> + Send + 'static,
    ) -> rusqlite::Result<()> {
        let flags = FunctionFlags::SQLITE_UTF8 | FunctionFlags::SQLITE_DETERMINISTIC;
        let state = Arc::clone(self.state);
        self.connection.create_scalar_function(name, count, flags, move |context| run(context, &state))
    }
}

/// Registers all functions with a connection.
pub(crate) fn register(connection: &Connection, state: &Arc<ConnectionState>) -> rusqlite::Result<()> {
    let registrar = FunctionRegistrar { connection, state };
    for function in FUNCTIONS {
        for count in function.least..=function.most {
            registrar.register(function.name, i32::from(count), |context, state| {
                spatial_function::run(function, context, state)
            })?;
        }
    }
    index_functions::register(&registrar)?;
    aggregates::register(connection, state)?;
    groups::register(connection, state)?;
    lists::register(&registrar)?;
    numbers::register(connection)?;
    operators::register(connection)?;
    texts::register(connection)?;
    for (name, greater) in [("greatest", true), ("least", false)] {
        registrar.register(name, -1, move |context, _| call::extreme(context, greater))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_function_is_named_once_and_says_what_it_does() {
        let mut names: Vec<String> = names().map(str::to_ascii_lowercase).collect();
        // ST_Collect and ST_Union exist both for two geometries and as aggregates.
        let before = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(before - names.len(), aggregates::NAMES.len());
        for function in FUNCTIONS {
            assert!(function.least <= function.most && !function.doc.is_empty(), "{}", function.name);
            assert!(function.takes.starts_with('(') && function.takes.ends_with(')'), "{}", function.name);
        }
    }

    #[test]
    fn every_function_that_may_be_called_is_there() {
        let connection = Connection::open_in_memory().unwrap();
        numbers::register(&connection).unwrap();
        operators::register(&connection).unwrap();
        texts::register(&connection).unwrap();
        let mut statement =
            connection.prepare("SELECT DISTINCT lower(name) FROM pragma_function_list").unwrap();
        let there: rusqlite::Result<Vec<String>> =
            statement.query_map([], |row| row.get(0)).unwrap().collect();
        let there = there.unwrap();
        // The list has keywords, and functions registered elsewhere.
        let others = ["greatest", "least", "rarray", "if", "json_each", "->", "->>"];
        let lacking: Vec<_> = ALLOWED
            .iter()
            .filter(|name| !there.contains(&(**name).to_owned()) && !others.contains(name))
            .collect();
        assert!(lacking.is_empty(), "{lacking:?}");
        let found = |sql: &str| connection.query_row(sql, [], |row| row.get::<_, Option<f64>>(0)).unwrap();
        assert_eq!(
            found("SELECT degrees(pi()) + ceil(1.2) + floor(-0.5) + power(2, 3) + mod(7, 4)"),
            Some(192.0)
        );
        // As in PostgreSQL, the result of ceil is not an integer in a division.
        assert_eq!(found("SELECT 7 / ceil(2) + log(100) + log(2, 8)"), Some(8.5));
        assert_eq!([found("SELECT ln(NULL)"), found("SELECT mod(NULL, 0)")], [None; 2]);
        for sql in
            ["SELECT sqrt(-1)", "SELECT mod(1, 0)", "SELECT ln(0)", "SELECT upper(3)", "SELECT abs('x')"]
        {
            let failed = connection.query_row(sql, [], |row| row.get::<_, Option<f64>>(0));
            assert!(failed.is_err(), "{sql}");
        }
    }

    #[test]
    fn the_books_page_has_every_function() {
        let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/book/src/sql.md");
        let page = std::fs::read_to_string(page).unwrap();
        for SpatialFunction { name, takes, gives, doc, .. } in FUNCTIONS {
            let row = format!("| `{name}{takes}` | {gives} | {doc} |");
            assert!(page.contains(&row), "the page lacks: {row}");
        }
    }
}
