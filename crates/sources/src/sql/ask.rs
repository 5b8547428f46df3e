//! Runs statements in SQLite, and fetches their rows.

use std::sync::Arc;

use rusqlite::types::{ToSqlOutput, Value, ValueRef};
use rusqlite::{CachedStatement, ToSql};

use crate::sql::blob;
use crate::sql::cell::{Cell, integer, push_row, sort_rows};
use crate::sql::connection::DatabaseLink;
use crate::sql::errors;
use crate::sql::place;
use crate::sql::prepared_statement::{AnswerColumn, PreparedStatement, StatementShape};
use crate::sql::rewrite::SqlType;
use burgeon_base::budget::{Budget, BudgetCharge};
use burgeon_base::error::{Error, Result as BurgeonResult};
use burgeon_kit::QueryRows;
use burgeon_spatial::ReferenceFrame;

/// The reason for a failed query.
pub(crate) enum QueryFailure {
    /// Error of Burgeon.
    Told(Error),
    /// Error of SQLite.
    Sqlite(rusqlite::Error),
}

impl From<rusqlite::Error> for QueryFailure {
    fn from(error: rusqlite::Error) -> Self {
        Self::Sqlite(error)
    }
}

impl From<Error> for QueryFailure {
    fn from(error: Error) -> Self {
        Self::Told(error)
    }
}

/// Prepares the rewritten statement, or the original one if SQLite refuses the rewritten one.
fn prepare<'a>(
    link: &'a DatabaseLink,
    prepared: &PreparedStatement,
    explained: bool,
) -> Result<(CachedStatement<'a>, bool), QueryFailure> {
    let prefix = if explained { "EXPLAIN QUERY PLAN " } else { "" };
    let Some(rewritten) = &prepared.rewritten else {
        link.set_automatic_index(true)?;
        return Ok((link.connection.prepare_cached(&format!("{prefix}{}", prepared.original))?, false));
    };
    link.set_automatic_index(!rewritten.indexed)?;
    match link.connection.prepare_cached(&format!("{prefix}{}", rewritten.sql)) {
        Ok(statement) => Ok((statement, true)),
        // The original statement gives a better error message.
        Err(error) => match link.connection.prepare_cached(&format!("{prefix}{}", prepared.original)) {
            Ok(statement) => Ok((statement, false)),
            Err(own) => Err(QueryFailure::Sqlite(if errors::is_syntax(&own) && !errors::is_syntax(&error) {
                error
            } else {
                own
            })),
        },
    }
}

/// Returns the columns and parameters of a statement.
fn shape(
    statement: &CachedStatement<'_>,
    prepared: &PreparedStatement,
    as_rewritten: bool,
) -> StatementShape {
    let mut kinds: Vec<AnswerColumn> = statement
        .columns()
        .map(|column| match column.decl_type() {
            Some(kind) if kind.eq_ignore_ascii_case("boolean") => AnswerColumn::Boolean,
            _ => AnswerColumn::Plain,
        })
        .collect();
    let mut names: Vec<Arc<str>> = statement.column_names().map(Arc::from).collect();
    if let Some(known) = prepared.rewritten.as_ref().filter(|_| as_rewritten) {
        if let Some(columns) = known.columns.as_ref().filter(|columns| columns.len() == kinds.len()) {
            for (kind, (_, known)) in kinds.iter_mut().zip(columns) {
                match known {
                    SqlType::Boolean => *kind = AnswerColumn::Boolean,
                    SqlType::List => *kind = AnswerColumn::List,
                    _ => {}
                }
            }
        }
        if known.names.len() == names.len() {
            for (name, known) in names.iter_mut().zip(&known.names) {
                if let Some(known) = known {
                    *name = known.as_str().into();
                }
            }
        }
    }
    let parameters = 1..=statement.parameter_count();
    StatementShape {
        names: names.into(),
        kinds,
        parameters: parameters.map(|index| statement.parameter_name(index).map(str::to_owned)).collect(),
    }
}

/// Returns the rows of a statement.
pub(crate) fn rows(
    link: &DatabaseLink,
    prepared: &PreparedStatement,
    parameters: &[(&str, Cell)],
    frame: Option<&ReferenceFrame>,
    budget: &Arc<Budget>,
) -> Result<QueryRows<Cell>, QueryFailure> {
    let made = || prepared.rewritten.iter().flat_map(|rewritten| &rewritten.made);
    for table in made() {
        link.make(table, |statement| -> Result<(), QueryFailure> {
            for index in 1..=statement.parameter_count() {
                let name = statement.parameter_name(index).map(str::to_owned);
                let cell = errors::parameter(&prepared.original, name.as_deref(), parameters)?;
                statement.raw_bind_parameter(index, Bound { cell, frame })?;
            }
            Ok(())
        })?;
    }
    let answer = all_rows(link, prepared, parameters, frame, budget);
    made().try_for_each(|table| link.forget(table))?;
    answer
}

/// Returns the rows of a statement whose temporary tables already exist.
fn all_rows(
    link: &DatabaseLink,
    prepared: &PreparedStatement,
    parameters: &[(&str, Cell)],
    frame: Option<&ReferenceFrame>,
    budget: &Arc<Budget>,
) -> Result<QueryRows<Cell>, QueryFailure> {
    let (mut statement, as_rewritten) = prepare(link, prepared, false)?;
    if statement.column_count() == 0 {
        return Err(QueryFailure::Told(errors::only_reading()));
    }
    let shape = prepared.shape.get_or_init(|| shape(&statement, prepared, as_rewritten));
    for (index, name) in (1..).zip(&shape.parameters) {
        let cell = errors::parameter(&prepared.original, name.as_deref(), parameters)?;
        statement.raw_bind_parameter(index, Bound { cell, frame })?;
    }
    let mut answer = QueryRows::new(Arc::clone(&shape.names), []);
    answer.charge = BudgetCharge::new(budget);
    let mut rows = statement.raw_query();
    while let Some(row) = rows.next()? {
        let cell = |(index, kind): (usize, &AnswerColumn)| {
            cell(row.get_ref(index)?, *kind, frame, link, budget)
                .map_err(|error| QueryFailure::Told(error.noting(&format!("column {}", answer.names[index]))))
        };
        let row = shape.kinds.iter().enumerate().map(cell).collect::<Result<Vec<Cell>, QueryFailure>>()?;
        push_row(&mut answer, row)?;
    }
    let known = prepared.rewritten.as_ref().filter(|_| as_rewritten);
    if !known.is_some_and(|rewritten| rewritten.ordered) {
        sort_rows(&mut answer);
    }
    Ok(answer)
}

/// Returns SQLite's query plan of a statement.
pub(crate) fn plan(link: &DatabaseLink, prepared: &PreparedStatement) -> Result<String, QueryFailure> {
    for table in prepared.rewritten.iter().flat_map(|rewritten| &rewritten.made) {
        link.make(table, |_| Ok::<(), QueryFailure>(()))?;
    }
    let (mut statement, _) = prepare(link, prepared, true)?;
    let mut rows = statement.raw_query();
    let mut lines: Vec<String> = Vec::new();
    while let Some(row) = rows.next()? {
        lines.push(row.get(3)?);
    }
    Ok(lines.join("\n"))
}

/// A parameter to bind.
struct Bound<'a> {
    cell: &'a Cell,
    frame: Option<&'a ReferenceFrame>,
}

impl ToSql for Bound<'_> {
    fn to_sql(&self) -> rusqlite::Result<ToSqlOutput<'_>> {
        Ok(match self.cell {
            Cell::Null => ToSqlOutput::Owned(Value::Null),
            Cell::Boolean(value) => ToSqlOutput::Owned(Value::Integer(i64::from(*value))),
            Cell::Number(number) => {
                ToSqlOutput::Owned(integer(*number).map_or(Value::Real(*number), Value::Integer))
            }
            Cell::Text(text) => ToSqlOutput::Borrowed(ValueRef::Text(text.as_bytes())),
            Cell::List(_) => {
                return Err(rusqlite::Error::ToSqlConversionFailure("a list is no parameter".into()));
            }
            Cell::Geometry(geometry) => {
                ToSqlOutput::Owned(Value::Blob(blob::write(&place::leave(geometry, self.frame))))
            }
        })
    }
}

/// Converts a value from SQLite to a cell.
fn cell(
    value: ValueRef<'_>,
    kind: AnswerColumn,
    frame: Option<&ReferenceFrame>,
    link: &DatabaseLink,
    budget: &Budget,
) -> BurgeonResult<Cell> {
    Ok(match value {
        ValueRef::Null => Cell::Null,
        ValueRef::Integer(value) if kind == AnswerColumn::Boolean => Cell::Boolean(value != 0),
        #[allow(clippy::cast_precision_loss, reason = "Lua's own numbers are f64")]
        ValueRef::Integer(value) => Cell::Number(value as f64),
        ValueRef::Real(value) => Cell::Number(value),
        ValueRef::Text(text) if kind == AnswerColumn::List => list(text)?,
        ValueRef::Text(text) => Cell::Text(String::from_utf8_lossy(text).into()),
        ValueRef::Blob(bytes) => {
            let geometry = blob::read(bytes, budget).map_err(|why| {
                link.state.keep_unreadable(bytes);
                Error::data(format!("a geometry {why}"))
                    .help("bytes are taken as geometries; take hex(...) of others")
            })?;
            match (blob::foreign(bytes), frame) {
                (Some(code), Some(frame)) => {
                    Cell::Geometry(Arc::new(place::enter_from(geometry, code, frame)?))
                }
                _ => Cell::Geometry(Arc::new(place::enter(geometry, frame))),
            }
        }
    })
}

/// Converts a list from JSON, as SQLite stores it.
fn list(text: &[u8]) -> BurgeonResult<Cell> {
    let values: Vec<serde_json::Value> = serde_json::from_slice(text)
        .map_err(|error| Error::internal(format!("a list is no JSON: {error}")))?;
    let cell = |value: serde_json::Value| match value {
        serde_json::Value::Bool(value) => Cell::Boolean(value),
        serde_json::Value::Number(number) => number.as_f64().map_or(Cell::Null, Cell::Number),
        serde_json::Value::String(text) => Cell::Text(text.into()),
        _ => Cell::Null,
    };
    Ok(Cell::List(values.into_iter().map(cell).collect()))
}
