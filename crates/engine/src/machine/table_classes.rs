//! Table classes of the standard library, such as vectors: their tables keep their operators as parameters.

use mlua::{Function, Lua, LuaString, MultiValue, Table as LuaTable, Value as LuaValue};
use rustc_hash::FxHashMap;

use burgeon_kit::{Parameter, Table, TableKey, Value, Vector};

use super::convert::to_lua;

/// Table classes of a virtual machine, by name.
#[derive(Default)]
struct TableClasses {
    by_name: FxHashMap<String, TableClass>,
    vectors: Option<VectorClass>,
}

/// Class of vectors, which many calls have as arguments.
struct VectorClass {
    /// Address of the metatable, which the class keeps alive.
    metatable: usize,
    fields: [LuaString; 3],
}

struct TableClass {
    metatable: LuaTable,
    /// Constructor from the values of the fields, which is faster than setting the fields one by one. A
    /// custom standard library can omit it.
    make: Option<Function>,
    /// Fields that every table of the class has, in order.
    fields: Vec<String>,
}

/// Declares a class. `make` returns a table of the class for the values of its `fields`, in order.
pub(super) fn declare_class(
    lua: &Lua,
    name: String,
    metatable: LuaTable,
    make: Option<Function>,
    fields: Vec<String>,
) -> mlua::Result<()> {
    metatable.raw_set("__class", name.as_str())?;
    let mut classes = lua.remove_app_data::<TableClasses>().unwrap_or_default();
    if let ("vec", [x, y, z]) = (name.as_str(), fields.as_slice()) {
        let fields = [lua.create_string(x)?, lua.create_string(y)?, lua.create_string(z)?];
        classes.vectors = Some(VectorClass { metatable: metatable.to_pointer() as usize, fields });
    }
    classes.by_name.insert(name, TableClass { metatable, make, fields });
    lua.set_app_data(classes);
    Ok(())
}

/// Returns the Lua table if its class has exactly these fields. Nested tables are frozen if `freeze` is set.
pub(super) fn made_of_class(lua: &Lua, table: &Table, freeze: bool) -> mlua::Result<Option<LuaTable>> {
    let Some(class) = &table.class else { return Ok(None) };
    let Some(make) = lua.app_data_ref::<TableClasses>().and_then(|classes| {
        let class = classes.by_name.get(&**class)?;
        let names = table.entries.iter().map(|(key, _)| match key {
            TableKey::Name(name) => Some(&**name),
            TableKey::Index(_) => None,
        });
        names.eq(class.fields.iter().map(|name| Some(&**name))).then(|| class.make.clone())?
    }) else {
        return Ok(None);
    };
    let values = table.entries.iter().map(|(_, value)| to_lua(lua, value, freeze));
    make.call(values.collect::<mlua::Result<MultiValue>>()?).map(Some)
}

/// Returns the value of a table that is a vector of numbers.
pub(super) fn vector_of(lua: &Lua, table: &LuaTable) -> Option<Value> {
    let metatable = table.metatable()?.to_pointer() as usize;
    let classes = lua.app_data_ref::<TableClasses>()?;
    let vectors = classes.vectors.as_ref().filter(|known| known.metatable == metatable)?;
    let part = |place: usize| match table.raw_get(&vectors.fields[place]) {
        Ok(LuaValue::Number(part)) => Some(part),
        #[allow(clippy::cast_precision_loss, reason = "Luau's own numbers are f64")]
        Ok(LuaValue::Integer(part)) => Some(part as f64),
        _ => None,
    };
    Some(Vector::from([part(0)?, part(1)?, part(2)?]).into_value())
}

/// Returns the metatable of a class.
pub(super) fn metatable_of(lua: &Lua, class: &str) -> Option<LuaTable> {
    lua.app_data_ref::<TableClasses>()?.by_name.get(class).map(|class| class.metatable.clone())
}
