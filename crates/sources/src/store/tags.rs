//! Tag filters in scripts: `{ building = true, height = "*" }`, or a list of such tables.

use std::fmt;
use std::sync::Arc;

use burgeon_base::error::{Error, Result};
use burgeon_data::{TagFilter, TagTest};
use burgeon_kit::{Table, TableKey, Value};

/// Parses the option `tags` of `source`.
pub(super) fn filter(value: &Value) -> Result<TagFilter> {
    let Value::Table(table) = value else {
        return Err(wrong(format!("tags must be a table, not {}", value.describe())));
    };
    let tables = table.list();
    if tables.is_empty() {
        return Ok(TagFilter { alternatives: vec![tests(table)?] });
    }
    if tables.len() < table.entries.len() {
        return Err(wrong("tags is a list of tables and has keys too"));
    }
    let alternatives = tables.into_iter().map(|table| match table {
        Value::Table(table) => tests(table),
        other => Err(wrong(format!("a list of tags must have tables, not {}", other.describe()))),
    });
    Ok(TagFilter { alternatives: alternatives.collect::<Result<_>>()? })
}

/// Parses the test of each key.
fn tests(table: &Table) -> Result<Vec<(Arc<str>, TagTest)>> {
    if table.entries.is_empty() {
        return Err(wrong("tags is empty, which chooses nothing"));
    }
    let test = |(key, value): &(TableKey, Value)| {
        let TableKey::Name(key) = key else {
            return Err(wrong("tags has values without keys"));
        };
        Ok((Arc::clone(key), test(key, value)?))
    };
    table.entries.iter().map(test).collect()
}

fn test(key: &str, value: &Value) -> Result<TagTest> {
    let text = |value: &Value| match value {
        Value::Text(text) => Ok(Arc::clone(text)),
        // Tag values can be numbers, such as lanes = 2.
        Value::Number(number) if number.is_finite() => Ok(Arc::from(number.to_string())),
        other => Err(wrong(format!("tags: {key} is {}", other.describe()))),
    };
    Ok(match value {
        Value::Boolean(true) => TagTest::Set,
        Value::Boolean(false) => TagTest::Unset,
        Value::Text(any) if **any == *"*" => TagTest::Any,
        Value::Table(list) if !list.entries.is_empty() && list.list().len() == list.entries.len() => {
            TagTest::OneOf(list.list().into_iter().map(text).collect::<Result<_>>()?)
        }
        Value::Table(_) => return Err(wrong(format!("tags: {key} is a table that is no list of texts"))),
        value => TagTest::OneOf(vec![text(value)?]),
    })
}

fn wrong(message: impl fmt::Display) -> Error {
    Error::argument(format!("source: {message}")).help(
        "write { tags = { building = true, [\"roof:shape\"] = { \"gabled\", \"hipped\" } } }: true for any value but no, \
         \"*\" for any, false for none, a text, or a list of strings; a list of such tables for one or another",
    )
}
