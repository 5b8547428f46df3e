//! What rules made that has a geometry, as layers for other programs.

use std::sync::Arc;

use burgeon_data::Attribute;
use burgeon_data::Geometry;
use burgeon_data::output::{Record, RecordTable};
use burgeon_kit::rules::{END, FIRST_SYMBOL, Symbol};
use burgeon_kit::{GeometryObject, Value};
use rustc_hash::{FxHashMap, FxHashSet};

use super::DerivedSystem;
use super::records::attribute;

/// The modules of the final chains of all `systems` that have a geometry: a table for each symbol, in the order in which
/// they are found.
///
/// A record is a module. Its geometry is the first parameter that has one; its other parameters are its attributes, later
/// geometries as well-known text. Its id is that of the feature that its chain came from, with a number behind it where
/// that is taken.
pub fn layers(systems: &[Arc<DerivedSystem>]) -> Vec<RecordTable> {
    let mut layers = LayerTables::default();
    for system in systems {
        layers.add(system);
    }
    layers.tables.into_iter().map(|(_, table, _)| table).collect()
}

/// Tables that are being filled: each with its symbol's parameters, and the ids that are taken.
#[derive(Default)]
struct LayerTables {
    tables: Vec<(Vec<String>, RecordTable, FxHashSet<String>)>,
    by_name: FxHashMap<String, usize>,
}

impl LayerTables {
    fn add(&mut self, system: &DerivedSystem) {
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
        let index = *self.by_name.entry(signature.name.clone()).or_insert_with(|| {
            let table = RecordTable { name: signature.name.clone(), ..RecordTable::default() };
            self.tables.push((Vec::new(), table, FxHashSet::default()));
            self.tables.len() - 1
        });
        let (names, table, taken) = &mut self.tables[index];
        let feature = system.features.get(chain).cloned().flatten();
        let own = values.iter().zip(&signature.parameters).enumerate().filter(|(number, _)| *number != place);
        let mut attributes = Vec::new();
        for (_, (value, name)) in own {
            // The same symbol may have other parameters in another place.
            let column = names.iter().position(|known| known == name).unwrap_or_else(|| {
                names.push(name.clone());
                names.len() - 1
            });
            let text = |value: &Value| geometry_of(value).map(|it| Attribute::Text(it.to_wkt().into()));
            attributes.extend(attribute(value).or_else(|| text(value)).map(|value| (column, value)));
        }
        attributes.sort_by_key(|(column, _)| *column);
        table.columns.clone_from(names);
        let id = feature.unwrap_or_else(|| (chain + 1).to_string());
        table.records.push(Record {
            id: apart(id, taken),
            geometry: geometry_of(&values[place]).cloned(),
            values: attributes,
        });
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
