//! Database of a run, and its queries.

use std::borrow::Cow;
use std::sync::Arc;

use rustc_hash::FxHashMap;

use super::{SourceTables, TableContent};
use crate::declare::Session;
use crate::questions::{ChainView, NamedModule, Question, RowSource, Rows};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, ErrorKind, Limit, Result};
use burgeon_base::text::grouped;
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_data::{Layer, ReferenceFrame};
use burgeon_kit::{Table, TableKey, Value};
use burgeon_query::{Cell, Database, RowTable};
use burgeon_rewriting::Symbol;
use burgeon_spatial::GeometryObject;

/// Database with its tables.
pub(super) struct SourceDatabase {
    database: Arc<Database>,
    /// Number of loaded sources that have been added.
    added: usize,
    /// Set if the database has the projection of the run.
    is_framed: bool,
    /// State of the chains for which the table of each module was made.
    modules: FxHashMap<Symbol, u64>,
}

/// Words of a query that refer to a table of another name, each with that name.
type RenamedTables<'a> = Vec<(&'a str, Cow<'a, str>)>;

impl SourceTables {
    /// Returns the database with all loaded sources, whose coordinates have the projection `frame`.
    fn database(&mut self, frame: Option<&ReferenceFrame>, budget: &Arc<Budget>) -> Result<Arc<Database>> {
        // The first file sets the projection; a database made before that is rebuilt.
        let known = self.database.take().filter(|known| known.is_framed == frame.is_some());
        let mut known = match known {
            Some(known) => known,
            None => SourceDatabase {
                database: Arc::new(Database::new(frame.cloned())?),
                added: 0,
                is_framed: frame.is_some(),
                modules: FxHashMap::default(),
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

    /// Returns the database with all loaded sources and with the modules that a query may name, and the
    /// renamed tables.
    ///
    /// A source hides modules of the same name.
    fn database_with<'a>(
        &mut self,
        rows: &'a ModuleRows<'_>,
        frame: Option<&ReferenceFrame>,
        budget: &Arc<Budget>,
    ) -> Result<(Arc<Database>, RenamedTables<'a>)> {
        let database = self.database(frame, budget)?;
        let mut renamed = Vec::new();
        let Some(known) = &mut self.database else { return Ok((database, renamed)) };
        for NamedModule { word, symbol } in rows.modules {
            if let Some(source) = self.loaded.iter().find(|table| table.name.eq_ignore_ascii_case(word)) {
                rows.warn_hidden(word, &source.name);
                continue;
            }
            let name = rows.view.symbols().qualified_name(*symbol);
            if known.modules.get(symbol) != Some(&rows.view.number()) {
                database.set_rows(&rows.table(*symbol), budget)?;
                known.modules.insert(*symbol, rows.view.number());
            }
            // The database interprets the part of a name before a point as a schema.
            if *word != name || word.contains('.') {
                renamed.push((word.as_str(), name));
            }
        }
        Ok((database, renamed))
    }
}

impl ModuleRows<'_> {
    /// Returns the modules with a symbol as a table with one column per parameter. Lists, and objects other
    /// than geometries, are NULL.
    fn table(&self, symbol: Symbol) -> RowTable {
        let signature = self.view.symbols().signature(symbol);
        let values = &self.session.values;
        let cell = |stored: &f64| cell(&signature.name, &values.unpack(*stored)).unwrap_or(Cell::Null);
        let cells = match signature.parameters.len() {
            0 => self.view.modules(symbol).map(|_| Cell::Boolean(true)).collect(),
            _ => self.view.modules(symbol).flatten().map(cell).collect(),
        };
        let name = self.view.symbols().qualified_name(symbol).into_owned();
        RowTable { name, columns: signature.parameters.clone(), cells }
    }

    /// Adds suggestions to an error about a missing table: modules of this name in several packages, or a
    /// module with a similar name.
    fn explain(&self, error: Error, question: &Question) -> Error {
        let ErrorKind::NotFound { what: "table", name, suggestion: None } = error.kind() else {
            return error;
        };
        match self.view.find(name, question.scope()) {
            Err(found) => match found.kind() {
                ErrorKind::NotFound { suggestion: Some(near), .. } => {
                    Error::not_found("table", name, [near.as_str()], error.message())
                }
                ErrorKind::NotFound { .. } => error,
                _ => found,
            },
            Ok(_) => error,
        }
    }

    /// Returns the error for a query that joins modules with a server table.
    #[cfg(feature = "postgis")]
    fn server_join_error(&self) -> Error {
        let names = self.modules.iter().map(|module| module.word.as_str());
        let names = names.collect::<Vec<_>>().join(" and ");
        Error::argument(format!("a query cannot join the modules {names} with a table of a server")).help(
            "query the server first, and give the modules its rows: query(\"select ... from houses\", House)",
        )
    }

    /// Warns that a query reads the source `source` and not the modules, because both have the same name.
    fn warn_hidden(&self, module: &str, source: &str) {
        let text = format!("{module} in a query is the source {source}, not the modules {module}");
        let help = format!("give one of them another name: source(file, {{ table = \"{source}_data\" }})");
        self.session.warn(Warning::new(WarningKind::Doubtful, text).help(help));
    }
}

/// Sources of a run and modules of its chains, as tables.
pub(in crate::declare) struct ModuleRows<'a> {
    pub session: &'a Session,
    pub view: &'a ChainView,
    /// Modules that the query may name.
    pub modules: &'a [NamedModule],
}

impl RowSource for ModuleRows<'_> {
    fn rows(&self, question: &Question, most: usize) -> Result<Rows> {
        let (database, renamed, budget) =
            self.session.data.with_tables(self.session, |tables, frame, budget| {
                let (database, renamed) = tables.database_with(self, frame, budget)?;
                Ok((database, renamed, Arc::clone(budget)))
            })?;
        let mut statement = question.statement();
        if !renamed.is_empty() {
            statement = burgeon_query::rename_tables(&statement, &renamed)?.into();
        }
        let values = question.values()?;
        let cells: Vec<(&str, Cell)> =
            values.iter().map(|(name, value)| Ok((*name, cell(name, value)?))).collect::<Result<_>>()?;
        #[cfg(feature = "postgis")]
        let (server, frame) = self.session.data.with_tables(self.session, |tables, frame, _| {
            Ok((tables.asked_server(&statement), frame.cloned()))
        })?;
        #[cfg(feature = "postgis")]
        let answer = match server {
            Some(_) if !self.modules.is_empty() => return Err(self.server_join_error()),
            Some(server) => server.query(&statement, &cells, frame.as_ref(), &budget)?,
            None => {
                database.query(&statement, &cells, &budget).map_err(|error| self.explain(error, question))?
            }
        };
        #[cfg(not(feature = "postgis"))]
        let answer =
            database.query(&statement, &cells, &budget).map_err(|error| self.explain(error, question))?;
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

/// Converts a script value to a query parameter.
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

/// Returns the error for a value that cannot be a query parameter.
fn no_value(name: &str, value: &Value) -> Error {
    Error::argument(format!("${name} of the query cannot be {}", value.describe()))
        .help("values are numbers, strings, booleans and geometries")
}

/// Converts a query result to a script value.
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
