//! Features that become complete tables only when the script reads their fields.
//!
//! Scripts read few attributes. A feature's table is therefore empty and frozen at first; it contains only
//! the number of the feature, under a key that scripts cannot use. Functions that inspect raw tables, such as
//! `pairs`, would reveal the difference. If any script file names such a function, complete tables are
//! created immediately.

use std::ffi::c_void;
use std::sync::Arc;

use mlua::{
    Function, LightUserData, Lua, MetaMethod, Table, UserData, UserDataFields, UserDataRef, Value as LuaValue,
};

use rustc_hash::FxHashMap;

use super::source::nested;
use crate::machine::library::Library;
use crate::machine::native;
use crate::machine::types::ObjectHandle;
use burgeon_kit::{Attribute, FeatureSource, Object, Prefetch, Table as ValueTable, TableKey, Value};

/// Addresses that serve as table keys for the numbers below, unknown to scripts. Unlike strings, they need no
/// allocation for each lookup.
static KEYS: [u8; 2] = [0; 2];
/// Key of the feature's number, in the feature's table.
const NUMBER: usize = 0;
/// Key of the layer, in the metatable.
const LAYER: usize = 1;

/// Layer as a Lua value, with attribute indices by name.
struct LayerHandle {
    layer: Arc<dyn FeatureSource>,
    /// Prefetch of the ground plans of its polygons, if there is one.
    prefetch: Option<Arc<dyn Prefetch>>,
    names: FxHashMap<String, usize>,
}

impl UserData for LayerHandle {
    fn add_fields<F: UserDataFields<Self>>(fields: &mut F) {
        fields.add_meta_field(MetaMethod::Type, "layer");
    }
}

/// Marks a machine whose script can inspect raw tables.
pub(crate) struct EagerMark(pub Arc<crate::declare::Session>);

fn key(what: usize) -> LuaValue {
    LuaValue::LightUserData(LightUserData((&raw const KEYS[what]).cast_mut().cast::<c_void>()))
}

/// Registry name of the prelude's function for such features.
pub(crate) const UNREAD: &str = "burgeon unread";

/// Shared data of the features of a layer.
pub(super) struct LazyLayer {
    /// Returns the feature with a number.
    make: Function,
}

/// Returns the shared data of the features of `layer`; `None` if they must be complete tables from the
/// beginning.
pub(super) fn unread(
    lua: &Lua,
    layer: &Arc<dyn FeatureSource>,
    prefetch: Option<&Arc<dyn Prefetch>>,
) -> mlua::Result<Option<LazyLayer>> {
    if lua.app_data_ref::<EagerMark>().is_none_or(|eager| eager.0.inspects_tables()) {
        return Ok(None);
    }
    let names = (0..).zip(layer.attribute_names()).map(|(index, name)| (name.clone(), index)).collect();
    let held =
        lua.create_userdata(LayerHandle { layer: Arc::clone(layer), prefetch: prefetch.cloned(), names })?;
    let functions: Table = lua.named_registry_value(LAZY)?;
    let metatable = lua.create_table()?;
    metatable.raw_set(key(LAYER), &held)?;
    for event in [MetaMethod::Index, MetaMethod::Iter] {
        let function: Function = functions.raw_get(event.name())?;
        metatable.raw_set(event.name(), function)?;
    }
    metatable.set_readonly(true);
    let unread: Function = lua.named_registry_value(UNREAD)?;
    native(lua, &unread)?;
    Ok(Some(LazyLayer { make: unread.call((key(NUMBER), metatable))? }))
}

/// Registry name of the functions of such metatables.
const LAZY: &str = "burgeon lazy";

/// Creates the functions that all such metatables share. They are stateless for rules.
pub(crate) fn install(lua: &Lua, library: &Library) -> mlua::Result<()> {
    let functions = lua.create_table()?;
    let named = |name: LuaValue| match name {
        LuaValue::String(name) => Some(name.to_string_lossy()),
        _ => None,
    };
    let index = lua.create_function(move |lua, (table, name): (Table, LuaValue)| match named(name) {
        Some(name) => of_feature(lua, &table, &name),
        None => Ok(LuaValue::Nil),
    })?;
    let iterate = lua.create_function(|lua, table: Table| {
        let held = held(&table);
        let mut names = vec!["id", "layer", "geometry"];
        if let Some(held) = &held {
            names.extend(held.layer.attribute_names().iter().map(String::as_str));
        }
        walk(lua, &names, |name| of_feature(lua, &table, name))
    })?;
    for (event, function) in [(MetaMethod::Index, index), (MetaMethod::Iter, iterate)] {
        library.stateless.borrow_mut().insert(function.to_pointer() as usize);
        functions.raw_set(event.name(), function)?;
    }
    lua.set_named_registry_value(LAZY, functions)
}

/// Returns the iterator function and a table of all fields, for a loop over a feature.
fn walk(
    lua: &Lua,
    names: &[&str],
    field: impl Fn(&str) -> mlua::Result<LuaValue>,
) -> mlua::Result<(Function, Table)> {
    let whole = lua.create_table()?;
    for name in names {
        whole.raw_set(*name, field(name)?)?;
    }
    whole.set_readonly(true);
    Ok((lua.globals().get("next")?, whole))
}

impl LazyLayer {
    /// Returns the feature with this number, from 0, whose table contains only the number.
    pub(super) fn feature(&self, index: usize) -> mlua::Result<Table> {
        self.make.call(index)
    }
}

fn held(table: &Table) -> Option<UserDataRef<LayerHandle>> {
    table.metatable()?.raw_get(key(LAYER)).ok()
}

/// Returns true if `metatable` belongs to the features of a layer.
pub(super) fn is_feature(metatable: &Table) -> bool {
    matches!(metatable.raw_get(key(LAYER)), Ok(LuaValue::UserData(_)))
}

/// Names and values of the fields of a feature.
type FeatureFields = Vec<(TableKey, Value)>;

/// Returns the geometry and the other fields of the feature of a lazy table; `None` for any other table.
pub(crate) fn feature_of(table: &Table, metatable: &Table) -> Option<(Arc<dyn Object>, FeatureFields)> {
    let held: UserDataRef<LayerHandle> = metatable.raw_get(key(LAYER)).ok()?;
    let index: usize = table.raw_get(key(NUMBER)).ok()?;
    let names = held.layer.attribute_names();
    let geometry = held.layer.feature_geometry(index, held.prefetch.as_ref())?;
    let name = |name: &str| TableKey::Name(name.into());
    let own = held.layer.attributes(index).iter().map(|(index, value)| (&names[*index], value));
    let own = own.filter(|(name, _)| !matches!(name.as_str(), "id" | "layer" | "geometry"));
    let mut fields: FeatureFields = own
        .map(|(key, value)| {
            let value = match value {
                Attribute::Boolean(value) => Value::Boolean(*value),
                Attribute::Number(value) => Value::Number(*value),
                Attribute::Text(text) => Value::Text(Arc::clone(text)),
                Attribute::Nested(json) => from_json(json),
            };
            (name(key), value)
        })
        .collect();
    fields.push((name("id"), Value::Text(held.layer.id(index).into())));
    fields.push((name("layer"), Value::Text(held.layer.name().into())));
    Some((geometry, fields))
}

/// Converts a GeoJSON value. Nulls are omitted from objects, and become false in lists.
fn from_json(json: &serde_json::Value) -> Value {
    use serde_json::Value as Json;
    let mut entries: Vec<(TableKey, Value)> = match json {
        Json::Null => return Value::Nil,
        Json::Bool(value) => return Value::Boolean(*value),
        Json::Number(number) => return Value::Number(number.as_f64().unwrap_or(f64::NAN)),
        Json::String(text) => return Value::Text(text.as_str().into()),
        Json::Array(items) => {
            let item = |item: &Json| if item.is_null() { Value::Boolean(false) } else { from_json(item) };
            (1..).map(TableKey::Index).zip(items.iter().map(item)).collect()
        }
        Json::Object(fields) => {
            let known = fields.iter().filter(|(_, value)| !value.is_null());
            known.map(|(name, value)| (TableKey::Name(name.as_str().into()), from_json(value))).collect()
        }
    };
    entries.sort_by(|a, b| a.0.cmp(&b.0));
    Value::Table(Arc::new(ValueTable { class: None, entries }))
}

/// Returns a cached field, or makes and caches its value.
fn cached(
    table: &Table,
    name: &str,
    make: impl FnOnce() -> mlua::Result<LuaValue>,
) -> mlua::Result<LuaValue> {
    match table.raw_get(name)? {
        LuaValue::Nil => {}
        known => return Ok(known),
    }
    let made = make()?;
    table.set_readonly(false);
    let done = table.raw_set(name, &made);
    table.set_readonly(true);
    done.map(|()| made)
}

/// Returns a field of a feature.
fn of_feature(lua: &Lua, table: &Table, name: &str) -> mlua::Result<LuaValue> {
    let Some(held) = held(table) else { return Ok(LuaValue::Nil) };
    let index: usize = table.raw_get(key(NUMBER))?;
    if index >= held.layer.count() {
        return Ok(LuaValue::Nil);
    }
    let text = |text: &str| lua.create_string(text).map(LuaValue::String);
    match name {
        "id" => return text(held.layer.id(index)),
        "layer" => return text(held.layer.name()),
        "geometry" => {
            return cached(table, name, || geometry(lua, &held.layer, index, held.prefetch.as_ref()));
        }
        _ => {}
    }
    let column = held.names.get(name);
    let found =
        column.and_then(|column| held.layer.attributes(index).iter().find(|(index, _)| index == column));
    match found.map(|(_, value)| value) {
        None => Ok(LuaValue::Nil),
        Some(Attribute::Boolean(value)) => Ok(LuaValue::Boolean(*value)),
        Some(Attribute::Number(value)) => Ok(LuaValue::Number(*value)),
        Some(Attribute::Text(value)) => text(value),
        Some(Attribute::Nested(json)) => cached(table, name, || nested(lua, json)),
    }
}

/// Returns the geometry of a feature.
pub(super) fn geometry(
    lua: &Lua,
    layer: &Arc<dyn FeatureSource>,
    index: usize,
    prefetch: Option<&Arc<dyn Prefetch>>,
) -> mlua::Result<LuaValue> {
    let Some(geometry) = layer.feature_geometry(index, prefetch) else { return Ok(LuaValue::Nil) };
    lua.create_userdata(ObjectHandle(geometry)).map(LuaValue::UserData)
}
