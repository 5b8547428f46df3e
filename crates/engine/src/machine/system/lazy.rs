//! Features that become tables only where the script looks into them.
//!
//! Most attributes nobody asks for. Until then such a table is empty and frozen, with the number of its feature under a
//! key that no script has. A script could tell the difference with the functions that look at a table as it is, such as
//! `pairs`; where one of them is named anywhere, the tables are made at once.

use std::ffi::c_void;
use std::sync::Arc;

use mlua::{Function, LightUserData, Lua, MetaMethod, Table, UserData, UserDataRef, Value as LuaValue};

use rustc_hash::FxHashMap;

use super::source::nested;
use crate::machine::library::Library;
use crate::machine::native;
use crate::machine::types::ObjectHandle;
use burgeon_data::{Attribute, Layer};
use burgeon_kit::{Prefetch, Table as ValueTable, TableKey, Value};
use burgeon_spatial::GeometryObject;

/// What tables of features and their metatables know of themselves, under keys that no script has: addresses, which
/// take no text to be made of at each question.
static KEYS: [u8; 2] = [0; 2];
/// The feature's number.
const NUMBER: usize = 0;
/// In the metatable: the layer.
const LAYER: usize = 1;

/// A layer as Lua holds it, with its attributes by name.
struct LayerHandle {
    layer: Arc<Layer>,
    /// What makes plans of its polygons before they are asked for, if something does.
    prefetch: Option<Arc<dyn Prefetch>>,
    names: FxHashMap<String, usize>,
}

impl UserData for LayerHandle {}

/// Marks a machine whose script could see the difference.
pub(crate) struct EagerMark(pub Arc<crate::declare::Session>);

fn key(what: usize) -> LuaValue {
    LuaValue::LightUserData(LightUserData((&raw const KEYS[what]).cast_mut().cast::<c_void>()))
}

/// The registry's name for what the prelude knows of such features.
pub(crate) const UNREAD: &str = "burgeon unread";

/// What the features of a layer have in common.
pub(super) struct LazyLayer {
    /// Makes the feature with a number.
    make: Function,
}

/// What the features of `layer` have in common; `None` where they have to be tables from the beginning.
pub(super) fn unread(
    lua: &Lua,
    layer: &Arc<Layer>,
    prefetch: Option<&Arc<dyn Prefetch>>,
) -> mlua::Result<Option<LazyLayer>> {
    if lua.app_data_ref::<EagerMark>().is_none_or(|eager| eager.0.inspects_tables()) {
        return Ok(None);
    }
    let names = (0..).zip(&layer.names).map(|(index, name)| (name.clone(), index)).collect();
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

/// The registry's name for the functions of such metatables.
const LAZY: &str = "burgeon lazy";

/// Makes the functions that all such metatables share, which remember nothing that rules could see.
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
        let mut names = ["id", "layer", "geometry"].map(str::to_owned).to_vec();
        if let Some(held) = held(&table) {
            names.extend(held.layer.names.iter().cloned());
        }
        walk(lua, &names, |name| of_feature(lua, &table, name))
    })?;
    for (event, function) in [(MetaMethod::Index, index), (MetaMethod::Iter, iterate)] {
        library.stateless.borrow_mut().insert(function.to_pointer() as usize);
        functions.raw_set(event.name(), function)?;
    }
    lua.set_named_registry_value(LAZY, functions)
}

/// What a loop over a table needs, all of whose fields are made.
fn walk(
    lua: &Lua,
    names: &[String],
    field: impl Fn(&str) -> mlua::Result<LuaValue>,
) -> mlua::Result<(Function, Table)> {
    let whole = lua.create_table()?;
    for name in names {
        whole.raw_set(name.as_str(), field(name)?)?;
    }
    whole.set_readonly(true);
    Ok((lua.globals().get("next")?, whole))
}

impl LazyLayer {
    /// The feature with this number, from 0, whose table knows nothing but its geometry.
    pub(super) fn feature(&self, index: usize) -> mlua::Result<Table> {
        self.make.call(index)
    }
}

fn held(table: &Table) -> Option<UserDataRef<LayerHandle>> {
    table.metatable()?.raw_get(key(LAYER)).ok()
}

/// Whether this is what the features of a layer have in common.
pub(super) fn is_feature(metatable: &Table) -> bool {
    matches!(metatable.raw_get(key(LAYER)), Ok(LuaValue::UserData(_)))
}

/// What a table with this metatable knows of its feature, if it stands for one: its geometry and its other fields.
pub(crate) fn feature_of(
    table: &Table,
    metatable: &Table,
) -> Option<(GeometryObject, Vec<(TableKey, Value)>)> {
    let held: UserDataRef<LayerHandle> = metatable.raw_get(key(LAYER)).ok()?;
    let index: usize = table.raw_get(key(NUMBER)).ok()?;
    let feature = held.layer.features.get(index)?;
    let name = |name: &str| TableKey::Name(name.into());
    let own = feature.attributes.iter().map(|(index, value)| (&held.layer.names[*index], value));
    let own = own.filter(|(name, _)| !matches!(name.as_str(), "id" | "layer" | "geometry"));
    let mut fields: Vec<(TableKey, Value)> = own
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
    fields.push((name("id"), Value::Text(feature.id.as_str().into())));
    fields.push((name("layer"), Value::Text(held.layer.name.as_str().into())));
    Some((
        GeometryObject::of_feature(Arc::<Layer>::clone(&held.layer), index, held.prefetch.as_ref())?,
        fields,
    ))
}

/// A list or an object of GeoJSON; nulls are left out of objects, and are false in lists.
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

/// A field that has been kept, or the value that is made of it and kept.
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

/// A field of a feature.
fn of_feature(lua: &Lua, table: &Table, name: &str) -> mlua::Result<LuaValue> {
    let Some(held) = held(table) else { return Ok(LuaValue::Nil) };
    let index: usize = table.raw_get(key(NUMBER))?;
    let Some(feature) = held.layer.features.get(index) else { return Ok(LuaValue::Nil) };
    let text = |text: &str| lua.create_string(text).map(LuaValue::String);
    match name {
        "id" => return text(&feature.id),
        "layer" => return text(&held.layer.name),
        "geometry" => {
            return cached(table, name, || geometry(lua, &held.layer, index, held.prefetch.as_ref()));
        }
        _ => {}
    }
    let column = held.names.get(name);
    let found = column.and_then(|column| feature.attributes.iter().find(|(index, _)| index == column));
    match found.map(|(_, value)| value) {
        None => Ok(LuaValue::Nil),
        Some(Attribute::Boolean(value)) => Ok(LuaValue::Boolean(*value)),
        Some(Attribute::Number(value)) => Ok(LuaValue::Number(*value)),
        Some(Attribute::Text(value)) => text(value),
        Some(Attribute::Nested(json)) => cached(table, name, || nested(lua, json)),
    }
}

/// The geometry of a feature.
pub(super) fn geometry(
    lua: &Lua,
    layer: &Arc<Layer>,
    index: usize,
    prefetch: Option<&Arc<dyn Prefetch>>,
) -> mlua::Result<LuaValue> {
    let Some(geometry) = GeometryObject::of_feature(Arc::<Layer>::clone(layer), index, prefetch) else {
        return Ok(LuaValue::Nil);
    };
    lua.create_userdata(ObjectHandle(Arc::new(geometry))).map(LuaValue::UserData)
}
