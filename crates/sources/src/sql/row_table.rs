//! Tables whose rows are in the program's memory, and change between queries.

use std::sync::Arc;

use rusqlite::Connection;
use rusqlite::types::Value;

use crate::sql::blob;
use crate::sql::cell::{Cell, integer};
use crate::sql::errors;
use crate::sql::place;
use crate::sql::rewrite::{SqlType, TableInfo};
use crate::sql::statement_text::quote_name;
use crate::sql::tables::{free, write};
use burgeon_base::budget::Budget;
use burgeon_base::error::Result;
use burgeon_kit::QueryRows;
use burgeon_spatial::ReferenceFrame;

/// Writes rows as a table called `name`, without additional columns.
pub(crate) fn write_rows(
    name: &str,
    table: &QueryRows<Cell>,
    writer: &Connection,
    frame: Option<&ReferenceFrame>,
    budget: &Arc<Budget>,
) -> Result<TableInfo> {
    let mut names: Vec<String> = Vec::new();
    for column in table.names.iter() {
        names.push(free(column, &names));
    }
    let kinds: Vec<&'static str> = (0..table.names.len()).map(|column| column_type(table, column)).collect();
    let mut declared: Vec<String> =
        names.iter().zip(&kinds).map(|(name, kind)| format!("{} {kind}", quote_name(name))).collect();
    if declared.is_empty() {
        // SQLite requires at least one column.
        declared.push("\"present\" BOOLEAN".to_owned());
        names.push("present".to_owned());
    }
    let mut rows = table.iter();
    let next = || {
        let Some(row) = rows.next() else { return Ok(None) };
        // SQLite doubles the memory of the database when it grows, so rows are counted twice.
        budget.take(row.iter().map(Cell::weight).sum())?;
        let values = row.iter().map(|cell| value(cell, frame)).collect::<Vec<_>>();
        Ok(Some(values))
    };
    let count = write(writer, name, &declared, budget, next)
        .map_err(|error| errors::or_sqlite(error, |error| errors::internal(error).about(name)))?;
    // The row number is not a column, so that `SELECT *` returns only the columns of the rows.
    let key = ["rowid", "oid", "_rowid_"]
        .into_iter()
        .find(|key| !names.iter().any(|name| name.eq_ignore_ascii_case(key)));
    let geometries = names.iter().zip(&kinds).filter(|(_, kind)| **kind == GEOMETRY);
    Ok(TableInfo {
        name: name.to_owned(),
        key: key.map(str::to_owned),
        geometries: geometries.map(|(name, _)| name.clone()).collect(),
        kinds: kinds.iter().map(|kind| SqlType::from_declaration(kind)).collect(),
        columns: names,
        rows: count,
        ..TableInfo::default()
    })
}

/// Returns the declared type of a column: the common type of its values.
fn column_type(table: &QueryRows<Cell>, column: usize) -> &'static str {
    let mut known = None;
    for cell in table.iter().map(|row| &row[column]) {
        let kind = match cell {
            Cell::Null | Cell::List(_) => continue,
            Cell::Boolean(_) => "BOOLEAN",
            Cell::Number(number) if integer(*number).is_some() => "INTEGER",
            Cell::Number(_) => "REAL",
            Cell::Text(_) => "TEXT",
            Cell::Geometry(_) => GEOMETRY,
        };
        known = Some(match known {
            None => kind,
            Some(known) if known == kind => kind,
            Some("INTEGER" | "REAL") if matches!(kind, "INTEGER" | "REAL") => "REAL",
            // Columns with values of different types keep each value unchanged.
            Some(_) => return "BLOB",
        });
    }
    known.unwrap_or("BLOB")
}

/// Declared type of a column with geometries.
const GEOMETRY: &str = "GEOMETRY";

/// Converts a cell to a value that SQLite stores.
fn value(cell: &Cell, frame: Option<&ReferenceFrame>) -> Value {
    match cell {
        Cell::Null | Cell::List(_) => Value::Null,
        Cell::Boolean(value) => Value::Integer(i64::from(*value)),
        Cell::Number(number) => integer(*number).map_or(Value::Real(*number), Value::Integer),
        Cell::Text(text) => Value::Text(text.to_string()),
        Cell::Geometry(geometry) => Value::Blob(blob::write(&place::leave(geometry, frame))),
    }
}
