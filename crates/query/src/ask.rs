//! Puts a statement to SQLite, and takes the rows.

use std::sync::Arc;

use rusqlite::types::{ToSqlOutput, Value, ValueRef};
use rusqlite::{CachedStatement, ToSql};

use crate::blob;
use crate::cell::{Cell, QueryAnswer};
use crate::connection::DatabaseLink;
use crate::database::{PreparedStatement, StatementShape};
use crate::errors;
use crate::place;
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result as BurgeonResult};
use burgeon_data::ReferenceFrame;

/// Why there are no rows.
pub(crate) enum QueryFailure {
    /// For a reason of ours.
    Told(Error),
    /// For one of SQLite's.
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

/// The statement, as it was rewritten if SQLite takes it so.
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
        // What was written tells better where it is wrong.
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

/// The columns and parameters of a statement.
fn shape(
    statement: &CachedStatement<'_>,
    prepared: &PreparedStatement,
    as_rewritten: bool,
) -> StatementShape {
    let mut booleans: Vec<bool> = statement
        .columns()
        .map(|column| column.decl_type().is_some_and(|kind| kind.eq_ignore_ascii_case("boolean")))
        .collect();
    let known = prepared.rewritten.as_ref().filter(|_| as_rewritten);
    let told = known.map_or(&[][..], |rewritten| &rewritten.booleans);
    if told.len() == booleans.len() {
        booleans.iter_mut().zip(told).for_each(|(boolean, told)| *boolean |= told);
    }
    let parameters = 1..=statement.parameter_count();
    StatementShape {
        names: statement.column_names().map(str::to_owned).collect(),
        booleans,
        parameters: parameters.map(|index| statement.parameter_name(index).map(str::to_owned)).collect(),
    }
}

/// The rows of a statement.
pub(crate) fn rows(
    link: &DatabaseLink,
    prepared: &PreparedStatement,
    parameters: &[(&str, Cell)],
    frame: Option<&ReferenceFrame>,
    budget: &Arc<Budget>,
) -> Result<Arc<QueryAnswer>, QueryFailure> {
    let (mut statement, as_rewritten) = prepare(link, prepared, false)?;
    if statement.column_count() == 0 {
        return Err(QueryFailure::Told(errors::only_reading()));
    }
    let shape = prepared.shape.get_or_init(|| shape(&statement, prepared, as_rewritten));
    for (index, name) in (1..).zip(&shape.parameters) {
        let cell = errors::parameter(&prepared.original, name.as_deref(), parameters)?;
        statement.raw_bind_parameter(index, Bound { cell, frame })?;
    }
    let mut answer = QueryAnswer::new(Arc::clone(&shape.names), budget);
    let mut rows = statement.raw_query();
    while let Some(row) = rows.next()? {
        let cell = |(index, boolean): (usize, &bool)| {
            cell(row.get_ref(index)?, *boolean, frame, link, budget)
                .map_err(|error| QueryFailure::Told(error.noting(&format!("column {}", answer.names[index]))))
        };
        let row = shape.booleans.iter().enumerate().map(cell).collect::<Result<Vec<Cell>, QueryFailure>>()?;
        answer.push(row)?;
    }
    let known = prepared.rewritten.as_ref().filter(|_| as_rewritten);
    if !known.is_some_and(|rewritten| rewritten.ordered) {
        answer.sort();
    }
    Ok(Arc::new(answer))
}

/// What SQLite does for a statement.
pub(crate) fn plan(link: &DatabaseLink, prepared: &PreparedStatement) -> Result<String, QueryFailure> {
    let (mut statement, _) = prepare(link, prepared, true)?;
    let mut rows = statement.raw_query();
    let mut lines: Vec<String> = Vec::new();
    while let Some(row) = rows.next()? {
        lines.push(row.get(3)?);
    }
    Ok(lines.join("\n"))
}

/// A parameter on its way in.
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
                ToSqlOutput::Owned(whole(*number).map_or(Value::Real(*number), Value::Integer))
            }
            Cell::Text(text) => ToSqlOutput::Borrowed(ValueRef::Text(text.as_bytes())),
            Cell::Geometry(geometry) => {
                ToSqlOutput::Owned(Value::Blob(blob::write(&place::leave(geometry, self.frame))))
            }
        })
    }
}

/// A number without a fraction as such, so that it counts rows and divides as whole numbers do.
pub(crate) fn whole(number: f64) -> Option<i64> {
    #[allow(clippy::cast_possible_truncation, reason = "the range is checked")]
    (number.fract() == 0.0 && number.abs() <= 9_007_199_254_740_992.0).then_some(number as i64)
}

/// A value on its way out.
fn cell(
    value: ValueRef<'_>,
    boolean: bool,
    frame: Option<&ReferenceFrame>,
    link: &DatabaseLink,
    budget: &Budget,
) -> BurgeonResult<Cell> {
    Ok(match value {
        ValueRef::Null => Cell::Null,
        ValueRef::Integer(value) if boolean => Cell::Boolean(value != 0),
        #[allow(clippy::cast_precision_loss, reason = "Lua's own numbers are f64")]
        ValueRef::Integer(value) => Cell::Number(value as f64),
        ValueRef::Real(value) => Cell::Number(value),
        ValueRef::Text(text) => Cell::Text(String::from_utf8_lossy(text).into()),
        ValueRef::Blob(bytes) => {
            let geometry = blob::read(bytes, budget).map_err(|why| {
                link.state.keep_unreadable(bytes);
                Error::data(format!("a geometry {why}"))
                    .help("bytes are taken as geometries; take hex(...) of others")
            })?;
            Cell::Geometry(Arc::new(place::enter(geometry, frame)))
        }
    })
}
