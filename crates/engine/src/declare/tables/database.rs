//! The database of a run, and what is asked of it.

use std::sync::Arc;

use super::{SourceTables, TableContent};
use crate::declare::Session;
use crate::questions::{Question, RowSource, Rows};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::text::grouped;
use burgeon_data::{Layer, ReferenceFrame};
use burgeon_kit::{GeometryObject, Table, TableKey, Value};
use burgeon_query::{Cell, Database};

/// The database with the tables that are in it.
pub(super) struct SourceDatabase {
    database: Arc<Database>,
    /// How many of the tables that are loaded are in it.
    added: usize,
    /// Whether it knows the run's projection.
    is_framed: bool,
}

impl SourceTables {
    /// The database with all that is loaded, whose coordinates are those of `frame`.
    fn database(&mut self, frame: Option<&ReferenceFrame>, budget: &Arc<Budget>) -> Result<Arc<Database>> {
        // The first file decides on the projection; what was made before is made anew.
        let known = self.database.take().filter(|known| known.is_framed == frame.is_some());
        let mut known = match known {
            Some(known) => known,
            None => SourceDatabase {
                database: Arc::new(Database::new(frame.cloned())?),
                added: 0,
                is_framed: frame.is_some(),
            },
        };
        for table in &self.loaded[known.added..] {
            match &table.content {
                TableContent::Layer(layer) => known.database.add_layer(&table.name, layer, budget)?,
                TableContent::GeoPackage { path, shown, layer } => {
                    known.database.add_geopackage(&table.name, path, shown, layer, budget)?;
                }
                #[cfg(feature = "postgis")]
                TableContent::Server(_) => {}
                TableContent::List(list) => {
                    let layer = Layer {
                        name: table.name.clone(),
                        shown: format!("list {}", known.added + 1),
                        crs: String::new(),
                        origin: frame.map_or([0.0; 2], |frame| frame.origin),
                        names: list.names.clone(),
                        features: list.features.clone(),
                        bounds: [[0.0; 3]; 2],
                        empty: 0,
                        collapsed: 0,
                        refused: Vec::new(),
                        notes: Vec::new(),
                        derived: 0,
                    };
                    known.database.add_layer(&table.name, &layer, budget)?;
                }
            }
            known.added += 1;
        }
        let database = Arc::clone(&known.database);
        self.database = Some(known);
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
        #[cfg(feature = "postgis")]
        let (server, frame) = self.data.with_tables(self, |tables, frame, _| {
            Ok((tables.asked_server(question.sql()), frame.cloned()))
        })?;
        #[cfg(feature = "postgis")]
        let answer = match server {
            Some(server) => server.query(question.sql(), &cells, frame.as_ref(), &budget)?,
            None => database.query(question.sql(), &cells, &budget)?,
        };
        #[cfg(not(feature = "postgis"))]
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
        Cell::List(cells) => {
            let entries = cells.iter().zip(1..).map(|(cell, number)| (TableKey::Index(number), value(cell)));
            Value::Table(Arc::new(Table { class: None, entries: entries.collect() }))
        }
    }
}
