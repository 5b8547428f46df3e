//! Layers with geometry for other programs: lists, layers of objects, and modules.

use std::borrow::Cow;
use std::sync::Arc;

use burgeon_kit::{Attribute, FeatureSource, Object, Value};
use burgeon_rewriting::{END, FIRST_SYMBOL, Symbol};
use burgeon_spatial::{Geometry, GeometryObject, Record, RecordTable};
use rustc_hash::{FxHashMap, FxHashSet};

use super::DerivedSystem;
use super::records::{Columns, attribute};
use crate::declare::Session;

/// Returns the results of a run that have geometry, in this order: lists that the script made into tables,
/// layers of the objects of all `systems`, and modules of their final chains, one table per symbol.
///
/// A list of the script replaces object layers of the same name. A record of a symbol's table is a module.
/// Its geometry is the first geometry parameter. The other parameters are attributes; further geometries are
/// stored as well-known text. The id is the id of the chain's feature. A repeated id gets a number as suffix.
pub fn layers(session: &Session, systems: &[Arc<DerivedSystem>]) -> Vec<RecordTable> {
    let mut layers = LayerTables::default();
    for (name, list) in session.data.lists() {
        layers.list(&name, &list);
    }
    let lists = layers.tables.len();
    for system in systems {
        for object in &system.objects {
            layers.object(&**object, lists);
        }
        layers.chains(system);
    }
    let tables = layers.tables.into_iter();
    tables.map(|LayerTable { columns, table, .. }| RecordTable { columns: columns.0, ..table }).collect()
}

/// Tables under construction.
#[derive(Default)]
struct LayerTables {
    tables: Vec<LayerTable>,
    by_name: FxHashMap<String, usize>,
}

/// A table under construction, and the ids used in it.
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
        let index = self.by_name.get(name).copied().unwrap_or_else(|| {
            let table = RecordTable { name: name.to_owned(), ..RecordTable::default() };
            self.tables.push(LayerTable { table, ..LayerTable::default() });
            self.by_name.insert(name.to_owned(), self.tables.len() - 1);
            self.tables.len() - 1
        });
        &mut self.tables[index]
    }

    /// Adds a list that the script made into a table.
    fn list(&mut self, name: &str, list: &Arc<dyn FeatureSource>) {
        let layer = self.named(name);
        let numbers: Vec<usize> =
            list.attribute_names().iter().map(|name| layer.columns.number(name)).collect();
        for feature in 0..list.count() {
            let geometry = list.feature_geometry(feature, None);
            let geometry = geometry.and_then(|object| GeometryObject::of(&*object).cloned());
            let values = list.attributes(feature).iter();
            let values = values.map(|(column, value)| (numbers[*column], value.clone()));
            layer.add(list.id(feature).to_owned(), geometry, values.collect());
        }
    }

    /// Adds the layers of an object, except layers with the name of one of the first `lists` tables.
    fn object(&mut self, object: &dyn Object, lists: usize) {
        for (name, features) in object.layers() {
            if self.by_name.get(name).is_some_and(|table| *table < lists) {
                continue;
            }
            // A layer without features becomes an empty table.
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
            // A geometry is stored as NaN, so a module without a NaN parameter is skipped.
            if *symbol >= FIRST_SYMBOL && stored.iter().any(|stored| stored.is_nan()) {
                let values: Vec<Value> = stored.iter().map(|stored| system.values.unpack(*stored)).collect();
                self.module(system, *symbol, chain, &values);
            }
        }
    }

    fn module(&mut self, system: &DerivedSystem, symbol: Symbol, chain: usize, values: &[Value]) {
        let Some(place) = values.iter().position(|value| geometry_of(value).is_some()) else { return };
        let signature = system.symbols.signature(symbol);
        let layer = self.named(system.symbols.display_name(symbol));
        let feature = system.features.get(chain).and_then(Option::as_deref);
        let own = values.iter().zip(&signature.parameters).enumerate().filter(|(number, _)| *number != place);
        let mut attributes = Vec::new();
        for (_, (value, name)) in own {
            // The same symbol name can have other parameters in another system.
            let column = layer.columns.number(name);
            let text = |value: &Value| geometry_of(value).map(|it| Attribute::Text(it.to_wkt().into()));
            attributes.extend(attribute(value).or_else(|| text(value)).map(|value| (column, value)));
        }
        let id = feature.map_or_else(|| (chain + 1).to_string(), str::to_owned);
        layer.add(id, geometry_of(&values[place]).cloned(), attributes);
    }
}

/// Returns the geometry in `value`, if it is a geometry object.
fn geometry_of(value: &Value) -> Option<&Geometry> {
    let Value::Object(object) = value else { return None };
    GeometryObject::of(&**object)
}

/// Returns `id`, with a number as suffix if it is already in `taken`.
fn apart(id: String, taken: &mut FxHashSet<String>) -> String {
    let mut free = Cow::Borrowed(&*id);
    let mut count = 1;
    while taken.contains(&*free) {
        count += 1;
        free = Cow::Owned(format!("{id}.{count}"));
    }
    let free = free.into_owned();
    taken.insert(free.clone());
    free
}
