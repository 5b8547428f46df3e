//! SQL conditions on features of files that are not databases: their attributes become rows of a table in memory.
//! GeoPackages evaluate conditions themselves.

use rusqlite::types::Value;
use rusqlite::{Connection, params_from_iter};

use super::geopackage::{guard, query_error, quote, run_watched};
use crate::features::feature::Feature;
use crate::features::table::FeatureTable;
use crate::source_options::SourceOptions;
use burgeon_base::error::{Error, Result};
use burgeon_kit::Attribute;

/// Returns the indices of the features that satisfy `condition`, in their order.
///
/// The columns are the attributes and `id`. Fails like a condition on a GeoPackage: if the condition is invalid, or
/// does anything but read.
pub(crate) fn find_matches(
    table: &FeatureTable,
    condition: &str,
    wanted: &SourceOptions,
) -> Result<Vec<usize>> {
    let fail = |error: rusqlite::Error| query_error(&table.shown, wanted, &error);
    let connection = Connection::open_in_memory().map_err(fail)?;
    let columns = columns(table, condition);
    let names: String = columns.iter().map(|(name, _)| format!(", {}", quote(name))).collect();
    // The column for the index of a feature has a name that no attribute has.
    let key = "burgeon feature";
    connection
        .execute_batch(&format!("CREATE TABLE features({} INTEGER PRIMARY KEY{names}); BEGIN", quote(key)))
        .map_err(fail)?;
    let places = ", ?".repeat(columns.len());
    let mut insert = connection.prepare(&format!("INSERT INTO features VALUES (?{places})")).map_err(fail)?;
    for (number, feature) in table.features.iter().enumerate() {
        let values: Vec<Value> = columns.iter().map(|(_, column)| value(feature, *column)).collect();
        wanted.budget.take(32 + 16 * values.len())?;
        wanted.budget.tick()?;
        let number = Value::Integer(i64::try_from(number).unwrap_or(i64::MAX));
        insert.execute(params_from_iter(std::iter::once(number).chain(values))).map_err(fail)?;
    }
    drop(insert);
    connection.execute_batch("COMMIT").map_err(fail)?;
    // The line break ends a comment in the condition.
    let sql = format!("SELECT {0} FROM features WHERE (\n{condition}\n) ORDER BY {0}", quote(key));
    let (shown, asked) = (table.shown.clone(), wanted.clone());
    run_watched(connection, &wanted.budget, move |mut connection| {
        let fail = |error: rusqlite::Error| query_error(&shown, &asked, &error);
        guard(&mut connection, &asked.budget).map_err(fail)?;
        let mut statement = connection.prepare(&sql).map_err(fail)?;
        let numbers = statement.query_map([], |row| row.get::<_, i64>(0)).map_err(fail)?;
        let numbers: rusqlite::Result<Vec<i64>> = numbers.collect();
        numbers
            .map_err(fail)?
            .into_iter()
            .map(|number| usize::try_from(number).map_err(|_| Error::internal("a row has no number")))
            .collect()
    })
}

/// Returns the attributes that a condition may name, with their indices, and the id. Names are case-insensitive; of
/// equal names, the first one counts.
fn columns(table: &FeatureTable, condition: &str) -> Vec<(String, Option<usize>)> {
    let condition = condition.to_lowercase();
    let mut columns: Vec<(String, Option<usize>)> = Vec::new();
    let attributes = table.names.iter().enumerate().map(|(number, name)| (name.as_str(), Some(number)));
    for (name, number) in attributes.chain([("id", None)]) {
        let lower = name.to_lowercase();
        let is_new = !columns.iter().any(|(known, _)| known.to_lowercase() == lower);
        if is_new && !name.contains('\0') && condition.contains(&lower.replace('"', "\"\"")) {
            columns.push((name.to_owned(), number));
        }
    }
    // Maximum number of columns used.
    columns.truncate(1000);
    columns
}

fn value(feature: &Feature, column: Option<usize>) -> Value {
    let Some(column) = column else { return Value::Text(feature.id.to_string()) };
    let found = feature.attributes.iter().find(|(number, _)| *number == column);
    match found.map(|(_, value)| value) {
        None => Value::Null,
        Some(Attribute::Boolean(value)) => Value::Integer(i64::from(*value)),
        #[allow(clippy::cast_possible_truncation, reason = "the range is checked")]
        Some(Attribute::Number(number)) if number.fract() == 0.0 && number.abs() < 9e15 => {
            Value::Integer(*number as i64)
        }
        Some(Attribute::Number(number)) => Value::Real(*number),
        Some(Attribute::Text(text)) => Value::Text(text.to_string()),
        Some(Attribute::Nested(value)) => Value::Text(value.to_string()),
    }
}
