//! Layers of a server.

use std::borrow::Cow;
use std::sync::Arc;

use rustc_hash::FxHashMap;

use super::Server;
use super::connection::{ServerAnswer, ServerFailure};
use crate::sql::cell::Cell;
use crate::sql::place::Move;
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::{listed, shown};
use burgeon_data::{Attribute, FeatureTable, LayerListing, Listing, SourceOptions};
use burgeon_spatial::Crs;

impl Server {
    /// Reads the selected part of a layer in the order of its keys, as [`Source::read`](burgeon_data::Source::read)
    /// does. Later statements see only this part of its table.
    ///
    /// Fails if there is no such table, or if the table has no geometries.
    pub fn read(&self, wanted: &SourceOptions) -> Result<FeatureTable> {
        self.table(wanted)?.finish(wanted)
    }

    /// Lists the layers, as [`Listing::read`] lists the layers of a file.
    pub fn listing(&self, budget: &Arc<Budget>) -> Result<Listing> {
        let before = budget.used_bytes();
        let tables = self.server_tables(budget)?.catalogue.values();
        let mut layers = Vec::new();
        let mut wanted = SourceOptions { budget: Arc::clone(budget), ..SourceOptions::default() };
        for table in tables.filter(|table| !table.geometries.is_empty() && !table.is_alias) {
            wanted.layer = Some(table.name.clone());
            layers.push(LayerListing::of(self.table(&wanted)?)?);
            budget.settle(before, 0);
        }
        Ok(Listing { file: self.address().to_string(), format: "PostGIS", layers })
    }

    /// Reads the selected part of a layer, which may be empty.
    fn table(&self, wanted: &SourceOptions) -> Result<FeatureTable> {
        let budget = &wanted.budget;
        let known = self.server_tables(budget)?;
        let with: Vec<&str> = known
            .catalogue
            .values()
            .filter(|table| !table.geometries.is_empty() && !table.is_alias)
            .map(|table| table.name.as_str())
            .collect();
        let layer = match (&wanted.layer, with.as_slice()) {
            (Some(layer), _) => layer.as_str(),
            (None, [only]) => only,
            (None, _) => {
                return Err(Error::argument(format!("{} has several layers", self.address()))
                    .help(format!("name one behind a colon; it has {}", listed(with.iter().copied()))));
            }
        };
        let found =
            known.catalogue.get(&layer.to_ascii_lowercase()).filter(|table| !table.geometries.is_empty());
        let Some(table) = found else {
            let what = format!("{} has no layer called {}", self.address(), shown(layer));
            return Err(Error::not_found("layer", layer, with.iter().copied(), what)
                .help(format!("it has {}", listed(with.iter().copied()))));
        };
        let label = format!("{}:{}", self.address(), shown(layer));
        let geometry = &table.geometries[0];
        let quoted = |name: &str| format!("\"{}\"", name.replace('"', "\"\""));
        let key = table.key.as_deref();
        let own: Vec<String> = table
            .columns
            .iter()
            .filter(|name| *name != geometry && Some(name.as_str()) != key)
            .cloned()
            .collect();
        let mut sql = format!(
            "SELECT {}, {}",
            key.map_or(Cow::Borrowed("NULL"), |key| quoted(key).into()),
            quoted(geometry)
        );
        let foreign = known.foreign.get(&layer.to_ascii_lowercase());
        for name in &own {
            let foreign = foreign.is_some_and(|columns| columns.contains(name));
            sql += &format!(", {}{}", quoted(name), if foreign { "::text" } else { "" });
        }
        let place = match &table.place {
            // The unqualified name may refer to another table by now.
            Some((schema, name)) => format!("{}.{}", quoted(schema), quoted(name)),
            None => quoted(&table.name),
        };
        let mut rows = format!(" FROM {place}");
        if let Some(condition) = &wanted.condition {
            // The line break ends a comment in the condition.
            rows += &format!(" WHERE (\n{condition}\n)");
        }
        let limited = match (wanted.limit, wanted.kind, wanted.within) {
            (Some(limit), None, None) => Some(limit),
            _ => None,
        };
        if let Some(key) = key {
            sql = format!("{sql}{rows} ORDER BY {}", quoted(key));
        } else {
            sql += &rows;
        }
        if let Some(limit) = limited {
            sql += &format!(" LIMIT {limit}");
        }
        crate::sql::rewrite::check(&sql, &known.catalogue).map_err(|error| error.about(&label))?;
        let none = |_: &str| Err(Error::argument("a layer's condition has no parameters"));
        let answer = self.run_statement(&sql, 0, &none, &Move::identity(), budget).map_err(|failure| {
            let error = match failure {
                ServerFailure::Told(error) => error,
                ServerFailure::Server(error, asked) => {
                    super::errors::server_error(self.address(), &error, (&asked, &asked), &known.catalogue)
                }
            };
            budget.check().err().unwrap_or(error).about(&label)
        })?;
        let srid = known.systems.get(&table.name.to_ascii_lowercase()).copied().unwrap_or(0);
        let crs = match srid {
            0 => Err(Error::data("the layer has no coordinate system")
                .help("name its EPSG code: source(address, { crs = 3067 })")),
            srid => Crs::epsg(srid),
        };
        let features = features(&answer, FeatureTable::of_layer(layer, &label, crs, own, wanted), wanted)?;
        let ordered = key.map_or_else(String::new, |key| format!(" ORDER BY {}", quoted(key)));
        let part = limited.map_or_else(String::new, |limit| format!("{ordered} LIMIT {limit}"));
        let all = wanted.condition.is_none() && limited.is_none();
        self.see(&table.name, (!all).then(|| format!("SELECT *{rows}{part}")));
        Ok(features)
    }
}

/// Converts the rows to features, without those whose geometry cannot be read.
fn features(answer: &ServerAnswer, mut table: FeatureTable, wanted: &SourceOptions) -> Result<FeatureTable> {
    let id = match &wanted.id {
        Some(id) => Some(table.names.iter().position(|name| name == id).ok_or_else(|| {
            let names = || table.names.iter().map(String::as_str);
            let what = format!("{} has no attribute called {}", table.shown, shown(id));
            Error::not_found("attribute", id, names(), what).help(format!("it has {}", listed(names())))
        })?),
        None => table.names.iter().position(|name| name.eq_ignore_ascii_case("id")),
    };
    let text = |cell: &Cell| match cell {
        Cell::Null => None,
        Cell::Text(text) if text.is_empty() => None,
        Cell::Text(text) => Some(text.to_string()),
        other => Some(other.to_string()),
    };
    let wrong = answer.faults.iter().filter(|fault| fault.column == 1);
    let wrong: FxHashMap<usize, &str> = wrong.map(|fault| (fault.row, fault.why.as_str())).collect();
    for (row, number) in answer.rows.iter().zip(1usize..) {
        let key = text(&row[0]).unwrap_or_else(|| number.to_string());
        let id = id.and_then(|id| text(&row[id + 2])).unwrap_or(key);
        if let Some(why) = wrong.get(&(number - 1)) {
            let text = format!("the geometry of feature {} of {} {why}", shown(&id), table.shown);
            table.refuse(
                id,
                Error::data(text).help("repair it in the database, or leave it out: where = \"...\""),
            )?;
            continue;
        }
        let parts = match &row[1] {
            Cell::Geometry(geometry) => geometry.parts(),
            _ => Vec::new(),
        };
        let attributes = row[2..].iter().enumerate().filter_map(|(index, cell)| {
            let value = match cell {
                Cell::Boolean(value) => Attribute::Boolean(*value),
                Cell::Number(value) => Attribute::Number(*value),
                Cell::Text(text) => Attribute::Text(Arc::clone(text)),
                Cell::Null | Cell::Geometry(_) | Cell::List(_) => return None,
            };
            Some((index, value))
        });
        table.push(&id, parts, attributes.collect())?;
    }
    Ok(table)
}
