//! Geometries of features that become tables only where the script looks into them.
//!
//! Most are just handed on to a constructor, for which making a table of every point and reading it again would be
//! most of the work. Until then a geometry is an empty frozen table with the number of its feature under a key that no
//! script has. A script could tell the difference with the functions that look at a table as it is, such as `pairs`;
//! where one of them is named anywhere, the tables are made at once.

use std::ffi::c_void;
use std::rc::Rc;
use std::sync::Arc;

use mlua::{Function, LightUserData, Lua, MetaMethod, Table, UserData, UserDataRef, Value as LuaValue};

use super::source::Maker;
use crate::objects::Shape;
use crate::script::library::Library;
use crate::sources::Layer;

/// Its address is the key of the feature's number.
static NUMBER: u8 = 0;
/// The field of the metatable that holds the layer.
const LAYER: &str = "__layer";

/// The functions with which a script sees a table as it is.
const PEEKING: [&str; 6] = ["pairs", "next", "rawget", "getmetatable", "clone", "foreach"];

/// Whether a script could tell a table that is made later from one that is there.
pub(crate) fn peeks(text: &str) -> bool {
    let apart = |letter: Option<char>| letter.is_none_or(|it| !it.is_alphanumeric() && it != '_');
    PEEKING.iter().any(|name| {
        text.match_indices(name).any(|(at, _)| {
            apart(text[..at].chars().next_back()) && apart(text[at + name.len()..].chars().next())
        })
    })
}

/// A layer as Lua holds it.
struct Held(Arc<Layer>);

impl UserData for Held {}

/// What makes tables of geometries, kept by the machine.
struct Kept(Rc<Maker>);

/// Marks a machine whose script could see the difference.
pub(crate) struct Eager(pub Arc<crate::script::Session>);

fn key() -> LuaValue {
    LuaValue::LightUserData(LightUserData((&raw const NUMBER).cast_mut().cast::<c_void>()))
}

/// What the geometries of `layer` have in common; `None` where they have to be tables from the beginning.
pub(super) fn metatable(lua: &Lua, layer: &Arc<Layer>) -> mlua::Result<Option<Table>> {
    if lua.app_data_ref::<Eager>().is_none_or(|eager| eager.0.peeks()) {
        return Ok(None);
    }
    if lua.app_data_ref::<Kept>().is_none() {
        lua.set_app_data(Kept(Rc::new(Maker::new(lua)?)));
    }
    let metatable = lua.create_table()?;
    metatable.raw_set(LAYER, lua.create_userdata(Held(Arc::clone(layer)))?)?;
    let (index, iter): (Function, Function) = lua.named_registry_value::<Table>(LAZY).and_then(|known| {
        Ok((known.raw_get(MetaMethod::Index.name())?, known.raw_get(MetaMethod::Iter.name())?))
    })?;
    metatable.raw_set(MetaMethod::Index.name(), index)?;
    metatable.raw_set(MetaMethod::Iter.name(), iter)?;
    metatable.set_readonly(true);
    Ok(Some(metatable))
}

/// The registry's name for the functions of such metatables.
const LAZY: &str = "burgeon lazy geometry";

/// Makes the functions that all such metatables share, which remember nothing that rules could see.
pub(crate) fn install(lua: &Lua, library: &Library) -> mlua::Result<()> {
    let index = lua.create_function(|lua, (table, name): (Table, LuaValue)| {
        let LuaValue::String(name) = name else { return Ok(LuaValue::Nil) };
        field(lua, &table, &name.to_string_lossy())
    })?;
    let iter = lua.create_function(|lua, table: Table| {
        let whole = lua.create_table()?;
        for name in ["kind", "rings", "points"] {
            whole.raw_set(name, field(lua, &table, name)?)?;
        }
        whole.set_readonly(true);
        let next: Function = lua.globals().get("next")?;
        Ok((next, whole))
    })?;
    for function in [&index, &iter] {
        library.stateless.borrow_mut().insert(function.to_pointer() as usize);
    }
    let functions = lua.create_table()?;
    functions.raw_set(MetaMethod::Index.name(), index)?;
    functions.raw_set(MetaMethod::Iter.name(), iter)?;
    lua.set_named_registry_value(LAZY, functions)
}

/// A geometry that is not yet a table of points.
pub(super) fn geometry(lua: &Lua, metatable: &Table, index: usize) -> mlua::Result<Table> {
    let table = lua.create_table_with_capacity(0, 1)?;
    table.raw_set(key(), index)?;
    table.set_metatable(Some(metatable.clone()))?;
    table.set_readonly(true);
    Ok(table)
}

/// The geometry that a table with this metatable stands for.
pub(crate) fn shape_of(table: &Table, metatable: &Table) -> Option<Shape> {
    let layer: UserDataRef<Held> = metatable.raw_get(LAYER).ok()?;
    Shape::new(&layer.0, table.raw_get(key()).ok()?)
}

/// A field of a geometry, kept once it has been made.
fn field(lua: &Lua, table: &Table, name: &str) -> mlua::Result<LuaValue> {
    match table.raw_get(name)? {
        LuaValue::Nil => {}
        known => return Ok(known),
    }
    let Some(shape) = table.metatable().and_then(|metatable| shape_of(table, &metatable)) else {
        return Ok(LuaValue::Nil);
    };
    match name {
        "kind" => lua.create_string(shape.geometry().kind().name()).map(LuaValue::String),
        "rings" | "points" => {
            let maker = lua.app_data_ref::<Kept>().map(|kept| Rc::clone(&kept.0));
            let Some(maker) = maker else { return Ok(LuaValue::Nil) };
            let made: LuaValue = maker.shape(lua, shape.geometry())?.raw_get(name)?;
            table.set_readonly(false);
            let kept = table.raw_set(name, &made);
            table.set_readonly(true);
            kept.map(|()| made)
        }
        _ => Ok(LuaValue::Nil),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_whole_names_of_functions_count() {
        assert!(peeks("for k in pairs(t) do") && peeks("table.clone(x)") && peeks("next"));
        assert!(!peeks("for k in ipairs(t) do") && !peeks("next_door = 1") && !peeks("f.geometry"));
    }
}
