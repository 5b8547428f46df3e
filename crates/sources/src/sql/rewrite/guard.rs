//! The names that a statement may use on a server: known tables, and functions of a list.

use std::borrow::Cow;
use std::ops::ControlFlow;

use sqlparser::ast::{Expr, FunctionArguments, ObjectName, Query, TableFactor};

use super::Catalogue;
use super::parse::{parse, with_stack};
use super::scope::declared_names;
use super::walk::{StatementPart, walk};
use crate::sql::errors::place;
use crate::sql::functions;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::{listed, shown};

/// Functions that may follow FROM.
const OF_ROWS: [&str; 6] =
    ["generate_series", "unnest", "st_dump", "st_dumppoints", "st_dumpsegments", "st_dumprings"];

/// Further functions of PostgreSQL.
const OTHERS: [&str; 18] = [
    "array_agg",
    "array_length",
    "bool_and",
    "bool_or",
    "btrim",
    "cardinality",
    "cbrt",
    "cot",
    "every",
    "initcap",
    "left",
    "lpad",
    "position",
    "regexp_replace",
    "right",
    "rpad",
    "split_part",
    "string_to_array",
];

/// Keywords that PostgreSQL evaluates like functions.
const NEVER_THE_SAME: [&str; 11] = [
    "current_catalog",
    "current_date",
    "current_role",
    "current_schema",
    "current_time",
    "current_timestamp",
    "current_user",
    "localtime",
    "localtimestamp",
    "session_user",
    "user",
];

/// Fails if a statement does not return rows, or names a forbidden table or function.
pub(crate) fn check(sql: &str, catalogue: &Catalogue) -> Result<()> {
    let checked = with_stack(|| {
        let tree = parse(sql).map_err(|error| {
            Error::syntax(parser_message(&error.message))
                .help("write SQL that both SQLite and PostgreSQL take: SELECT ... FROM ... WHERE ...")
        })?;
        check_query(&tree.query, sql, catalogue)
    });
    checked.unwrap_or_else(|| Err(Error::system("cannot start a thread")))
}

/// Reformats the parser's message, with the position first.
fn parser_message(message: &str) -> String {
    let message = message.trim_start_matches("sql parser error: ").replacen("Expected", "expected", 1);
    let Some((what, at)) = message.rsplit_once(" at Line: ") else {
        return format!("SQL: {}", shown(&message));
    };
    match at.split_once(", Column: ") {
        Some((line, column)) => format!("SQL, line {line}, column {column}: {}", shown(what)),
        None => format!("SQL: {}", shown(&message)),
    }
}

fn check_query(query: &Query, sql: &str, catalogue: &Catalogue) -> Result<()> {
    let guard = Guard { sql, catalogue, own: declared_names(query) };
    let mut result = Ok(());
    let _ = walk(query, |part| {
        result = guard.check(&part);
        if result.is_ok() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    result
}

struct Guard<'a> {
    sql: &'a str,
    catalogue: &'a Catalogue,
    /// Tables that the statement declares.
    own: Vec<String>,
}

impl Guard<'_> {
    fn place(&self, name: &str) -> Cow<'static, str> {
        place(self.sql, None, name)
    }

    fn never_the_same(&self, word: &str) -> Result<()> {
        let what = format!("{}{} may not be asked for", self.place(word), shown(word));
        Err(Error::scope(what).help("questions give the same each time, whoever asks"))
    }

    fn function(&self, name: &ObjectName) -> Result<()> {
        let written = name.to_string();
        let plain = written.trim_matches('"').to_ascii_lowercase();
        let of_list = |name: &str| OF_ROWS.contains(&name) || OTHERS.contains(&name);
        // Functions of geometries are harmless, except those that read rasters or networks.
        let spatial = plain.strip_prefix("st_").is_some_and(|rest| {
            rest.chars().all(|letter| letter.is_ascii_alphanumeric() || letter == '_')
                && !["fromgdalraster", "asgdalraster"].contains(&rest)
        });
        if functions::is_allowed(&plain) || of_list(&plain) || spatial {
            return Ok(());
        }
        let what = format!("{}the function {} may not be called", self.place(&plain), shown(&written));
        Err(Error::not_found("function", &plain, functions::names(), what).help(
            "questions give the same each time, and reach nothing but tables; the book's page on SQL lists what there is",
        ))
    }

    fn check(&self, part: &StatementPart<'_>) -> Result<()> {
        match part {
            StatementPart::Query(_) => Ok(()),
            StatementPart::Expression(expression) => self.expression(expression),
            StatementPart::TableFactor(factor) => self.table_factor(factor),
            StatementPart::Relation(name) => self.relation(name),
        }
    }

    fn expression(&self, expression: &Expr) -> Result<()> {
        if let Expr::Identifier(name) = expression
            && name.quote_style.is_none()
            && NEVER_THE_SAME.iter().any(|word| name.value.eq_ignore_ascii_case(word))
        {
            return self.never_the_same(&name.value);
        }
        let Expr::Function(function) = expression else { return Ok(()) };
        // Functions without parentheses, such as CURRENT_TIMESTAMP, are not deterministic.
        if matches!(function.args, FunctionArguments::None) {
            return self.never_the_same(&function.name.to_string());
        }
        self.function(&function.name)
    }

    fn table_factor(&self, factor: &TableFactor) -> Result<()> {
        match factor {
            TableFactor::Table { name, args: Some(_), .. } => self.function(name),
            TableFactor::Function { name, .. } => self.function(name),
            _ => Ok(()),
        }
    }

    fn relation(&self, name: &ObjectName) -> Result<()> {
        let written = name.to_string();
        let plain = written.replace('"', "").to_ascii_lowercase();
        let known = self.own.contains(&plain) || self.catalogue.contains_key(&plain);
        if known || functions::is_allowed(&plain) || OF_ROWS.contains(&plain.as_str()) {
            return Ok(());
        }
        let names: Vec<&str> = self
            .catalogue
            .values()
            .filter(|table| !table.is_alias)
            .map(|table| table.name.as_str())
            .collect();
        let what = format!("{}no table called {}", self.place(&plain), shown(&written));
        Err(Error::not_found("table", &plain, names.iter().copied(), what)
            .help(format!("the database has {}", listed(names.iter().copied()))))
    }
}
