//! What rules made that has a geometry, as layers for other programs.

use std::sync::Arc;

use burgeon_data::Attribute;
use burgeon_data::output::{Record, RecordTable};
use burgeon_kit::{Object, Value};
use burgeon_rewriting::{END, FIRST_SYMBOL, Symbol};
use burgeon_spatial::{Geometry, GeometryObject};
use rustc_hash::{FxHashMap, FxHashSet};

use super::DerivedSystem;
use super::records::{Columns, attribute};
use crate::declare::Session;

/// What a run of a `session` gave that has a geometry, in the order in which it is found: the lists that the script made
/// tables of, the layers of the objects of all `systems`, and the modules of their final chains, a table for each symbol.
///
/// A list of the script stands for the layers of objects that are called so. A record of a symbol is a module. Its geometry
/// is the first parameter that has one; its other parameters are its attributes, later geometries as well-known text. Its id
/// is that of the feature that its chain came from. An id that is taken has a number behind it.
pub fn layers(session: &Session, systems: &[Arc<DerivedSystem>]) -> Vec<RecordTable> {
    let mut layers = LayerTables::default();
    for list in session.data.lists() {
        layers.list(list);
    }
    let lists: FxHashSet<String> = layers.by_name.keys().cloned().collect();
    for system in systems {
        for object in &system.objects {
            layers.object(&**object, &lists);
        }
        layers.chains(system);
    }
    let tables = layers.tables.into_iter();
    tables.map(|LayerTable { columns, table, .. }| RecordTable { columns: columns.0, ..table }).collect()
}

/// Tables that are being filled.
#[derive(Default)]
struct LayerTables {
    tables: Vec<LayerTable>,
    by_name: FxHashMap<String, usize>,
}

/// A table, and the ids that are taken in it.
#[derive(Default)]
struct LayerTable {
    columns: Columns,
    table: RecordTable,
    taken: FxHashSet<String>,
}

impl LayerTable {
    fn add(&mut self, id: String, geometry: Option<Geometry>, mut values: Vec<(usize, Attribute)>) {
        values.sort_by_key(|(column, _)| *column);
        self.table.records.push(Record { id: apart(id, &mut self.taken), geometry, values });
    }
}

impl LayerTables {
    fn named(&mut self, name: &str) -> &mut LayerTable {
        let index = *self.by_name.entry(name.to_owned()).or_insert_with(|| {
            let table = RecordTable { name: name.to_owned(), ..RecordTable::default() };
            self.tables.push(LayerTable { table, ..LayerTable::default() });
            self.tables.len() - 1
        });
        &mut self.tables[index]
    }

    /// Adds a list that the script made a table of.
    fn list(&mut self, list: RecordTable) {
        let layer = self.named(&list.name);
        let numbers: Vec<usize> = list.columns.iter().map(|name| layer.columns.number(name)).collect();
        for Record { id, geometry, values } in list.records {
            let values = values.into_iter().map(|(column, value)| (numbers[column], value));
            layer.add(id, geometry, values.collect());
        }
    }

    /// Adds the layers of an object that are not called as one of the `lists`.
    fn object(&mut self, object: &dyn Object, lists: &FxHashSet<String>) {
        for (name, features) in object.layers() {
            if lists.contains(name) {
                continue;
            }
            // A layer without features is one, too.
            self.named(name);
            for (number, feature) in (1..).zip(&features) {
                let Value::Table(feature) = feature else { continue };
                let layer = self.named(name);
                let id = match feature.get("id") {
                    Some(Value::Text(id)) => id.to_string(),
                    _ => number.to_string(),
                };
                let geometry = feature.get("geometry").and_then(geometry_of).cloned();
                let values = layer.columns.values(feature);
                layer.add(id, geometry, values);
            }
        }
    }

    fn chains(&mut self, system: &DerivedSystem) {
        let arities = system.symbols.arities();
        let (mut param, mut chain) = (0, 0);
        for symbol in &system.chain.symbols {
            let arity = usize::from(arities[usize::from(*symbol)]);
            let stored = &system.chain.params[param..param + arity];
            param += arity;
            chain += usize::from(*symbol == END);
            // Geometries are no numbers, so most modules are passed over at once.
            if *symbol >= FIRST_SYMBOL && stored.iter().any(|stored| stored.is_nan()) {
                let values: Vec<Value> = stored.iter().map(|stored| system.values.unpack(*stored)).collect();
                self.module(system, *symbol, chain, &values);
            }
        }
    }

    fn module(&mut self, system: &DerivedSystem, symbol: Symbol, chain: usize, values: &[Value]) {
        let Some(place) = values.iter().position(|value| geometry_of(value).is_some()) else { return };
        let signature = system.symbols.signature(symbol);
        let layer = self.named(system.symbols.shown(symbol));
        let feature = system.features.get(chain).cloned().flatten();
        let own = values.iter().zip(&signature.parameters).enumerate().filter(|(number, _)| *number != place);
        let mut attributes = Vec::new();
        for (_, (value, name)) in own {
            // The same symbol may have other parameters in another place.
            let column = layer.columns.number(name);
            let text = |value: &Value| geometry_of(value).map(|it| Attribute::Text(it.to_wkt().into()));
            attributes.extend(attribute(value).or_else(|| text(value)).map(|value| (column, value)));
        }
        let id = feature.unwrap_or_else(|| (chain + 1).to_string());
        layer.add(id, geometry_of(&values[place]).cloned(), attributes);
    }
}

/// The geometry that a value is, if it is one.
fn geometry_of(value: &Value) -> Option<&Geometry> {
    let Value::Object(object) = value else { return None };
    GeometryObject::of(&**object)
}

/// `id`, or with a number behind it if it is taken.
fn apart(id: String, taken: &mut FxHashSet<String>) -> String {
    let mut free = id.clone();
    let mut count = 1;
    while !taken.insert(free.clone()) {
        count += 1;
        free = format!("{id}.{count}");
    }
    free
}
