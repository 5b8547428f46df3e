//! The tables that scripts ask: the sources that they have loaded, in a database that is made once somebody asks.

use std::path::PathBuf;
use std::sync::Arc;

use super::session::Session;
use crate::questions::{Question, RowSource, Rows};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::text::grouped;
use burgeon_data::{Layer, ReferenceFrame};
use burgeon_kit::{GeometryObject, Value};
use burgeon_query::{Cell, Database};

/// A source as a table.
pub(super) struct SourceTable {
    /// What statements call it.
    pub name: String,
    pub content: TableContent,
}

/// What a table holds.
pub(super) enum TableContent {
    /// The features as they were read.
    Layer(Arc<Layer>),
    /// A layer of a GeoPackage, as it is in the file.
    GeoPackage { path: PathBuf, shown: String, layer: String },
}

/// The tables of a run, in the order in which they were loaded.
#[derive(Default)]
pub(super) struct SourceTables {
    loaded: Vec<SourceTable>,
    database: Option<Arc<Database>>,
    /// How many are in the database.
    added: usize,
}

impl SourceTables {
    /// Adds what a source is; the same once more changes nothing.
    pub(super) fn add(&mut self, table: SourceTable) {
        self.loaded.push(table);
    }

    /// The database with all that is loaded, whose coordinates are those of `frame`.
    fn database(&mut self, frame: Option<&ReferenceFrame>, budget: &Arc<Budget>) -> Result<Arc<Database>> {
        // The first source decides on a projection, so what was asked before has none.
        let known = self.database.take().filter(|_| self.added > 0 || frame.is_none());
        let database = match known {
            Some(database) => database,
            None => Arc::new(Database::new(frame.cloned())?),
        };
        for table in &self.loaded[self.added..] {
            match &table.content {
                TableContent::Layer(layer) => database.add_layer(&table.name, layer, budget)?,
                TableContent::GeoPackage { path, shown, layer } => {
                    database.add_geopackage(&table.name, path, shown, layer, budget)?;
                }
            }
            self.added += 1;
        }
        self.database = Some(Arc::clone(&database));
        Ok(database)
    }
}

impl RowSource for Session {
    fn rows(&self, question: &Question, most: usize) -> Result<Rows> {
        let (database, budget) = self.data.with_tables(self, |tables, frame, budget| {
            Ok((tables.database(frame, budget)?, Arc::clone(budget)))
        })?;
        let values = question.values()?;
        let cells: Vec<(&str, Cell)> =
            values.iter().map(|(name, value)| Ok((*name, cell(name, value)?))).collect::<Result<_>>()?;
        let answer = database.query(question.sql(), &cells, &budget)?;
        if answer.rows.len() > most {
            let text =
                format!("the query gives {} rows, of at most {}", grouped(answer.rows.len()), grouped(most));
            return Err(Error::limit(Limit::Modules, text)
                .help("ask for fewer: where ..., or limit 1000; or raise the limit: --module-limit N"));
        }
        Ok(Rows {
            names: answer.names.iter().map(|name| name.as_str().into()).collect(),
            values: answer.rows.iter().flatten().map(value).collect(),
        })
    }
}

/// A value of a script as the database takes it.
fn cell(name: &str, value: &Value) -> Result<Cell> {
    Ok(match value {
        Value::Nil => Cell::Null,
        Value::Boolean(value) => Cell::Boolean(*value),
        Value::Number(value) => Cell::Number(*value),
        Value::Text(text) => Cell::Text(Arc::clone(text)),
        Value::Object(object) => match GeometryObject::of(&**object) {
            Some(geometry) => Cell::Geometry(Arc::new(geometry.clone())),
            None => return Err(no_value(name, value)),
        },
        Value::Table(_) => return Err(no_value(name, value)),
    })
}

/// The error for a value that no statement takes.
fn no_value(name: &str, value: &Value) -> Error {
    Error::argument(format!("${name} of the query cannot be {}", value.describe()))
        .help("values are numbers, strings, booleans and geometries")
}

/// What the database gives as a value of a script.
fn value(cell: &Cell) -> Value {
    match cell {
        Cell::Null => Value::Nil,
        Cell::Boolean(value) => Value::Boolean(*value),
        Cell::Number(value) => Value::Number(*value),
        Cell::Text(text) => Value::Text(Arc::clone(text)),
        Cell::Geometry(geometry) => Value::Object(Arc::new(GeometryObject::shared(Arc::clone(geometry)))),
    }
}
