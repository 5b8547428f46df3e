//! Geometries in scripts: constructors and fields.

use std::cell::RefCell;
use std::rc::Rc;

use mlua::{AnyUserData, Function, Lua, MultiValue, Table, Value as LuaValue};

use super::ObjectHandle;
use crate::machine::convert::{to_lua, to_value};
use crate::machine::{Machine, native, write_column};
use burgeon_base::warning::take_deferred;
use burgeon_kit::{Constructor, Kind, Value};
use burgeon_spatial::{Geometry, GeometryObject};

/// Registry name of the prelude's function for lists of points.
pub(crate) const POINTS: &str = "burgeon points";

/// Gives scripts the functions that create values of `kind`.
pub(in crate::machine) fn install_functions(
    machine: &Machine,
    kind: &Kind,
    globals: &Table,
) -> mlua::Result<()> {
    for Constructor { name, make } in kind.functions.iter().copied() {
        let library = Rc::clone(&machine.library);
        let function = machine.lua().create_function(move |lua, given: MultiValue| {
            let mut values: Vec<Value> = given
                .iter()
                .map(|value| to_value(value, false).map_err(mlua::Error::external))
                .collect::<mlua::Result<_>>()?;
            // Trailing nil arguments count as omitted.
            while values.last() == Some(&Value::Nil) {
                values.pop();
            }
            take_deferred();
            let made = make(&values).map_err(mlua::Error::external)?;
            for warning in take_deferred() {
                library.machine().map_err(mlua::Error::external)?.warn_of_values(warning);
            }
            to_lua(lua, &made, false)
        })?;
        globals.raw_set(name, function)?;
    }
    Ok(())
}

/// Buffers for passing lists of points to Lua.
struct PointColumn {
    make: Function,
    numbers: RefCell<Vec<f64>>,
    column: RefCell<mlua::Buffer>,
}

impl PointColumn {
    fn new(lua: &Lua) -> mlua::Result<Self> {
        let make: Function = lua.named_registry_value(POINTS)?;
        native(lua, &make)?;
        let column = RefCell::new(lua.create_buffer(vec![0; 8192])?);
        Ok(Self { make, numbers: RefCell::default(), column })
    }

    /// Returns lists of points. They pass through a buffer, because Lua creates many small tables much faster
    /// than Rust.
    #[allow(clippy::cast_precision_loss, reason = "counts below 2^53")]
    fn lists(&self, lua: &Lua, geometry: &Geometry) -> mlua::Result<Table> {
        let lists = geometry.lists();
        let mut numbers = self.numbers.borrow_mut();
        numbers.clear();
        numbers.extend(lists.iter().map(|list| list.len() as f64));
        numbers.extend(lists.iter().flat_map(|list| list.iter()).flat_map(|point| point.to_array()));
        let mut column = self.column.borrow_mut();
        if column.len() < numbers.len() * 8 {
            *column = lua.create_buffer(vec![0; numbers.len() * 16])?;
        }
        write_column(column.clone(), &numbers).map_err(mlua::Error::external)?;
        self.make.call((&*column, lists.len()))
    }
}

/// Returns the field `name` of an object that is a geometry. Tables are cached in the object.
pub(super) fn geometry_field(lua: &Lua, this: &AnyUserData, name: &str) -> mlua::Result<Option<LuaValue>> {
    let handle = this.borrow::<ObjectHandle>()?;
    let Some(geometry) = GeometryObject::of(&*handle.0) else { return Ok(None) };
    match (name, geometry) {
        ("kind", _) => {
            return Ok(Some(LuaValue::String(lua.create_string(geometry.kind().name())?)));
        }
        ("rings", Geometry::Polygon(_)) => {}
        ("points", Geometry::Line(_) | Geometry::Point(_) | Geometry::MultiPoint(_)) => {}
        ("rings" | "points", _) => return Ok(Some(LuaValue::Nil)),
        _ => return Ok(None),
    }
    if let LuaValue::Table(kept) = this.user_value::<LuaValue>()? {
        return Ok(Some(LuaValue::Table(kept)));
    }
    if lua.app_data_ref::<PointColumn>().is_none() {
        lua.set_app_data(PointColumn::new(lua)?);
    }
    let Some(column) = lua.app_data_ref::<PointColumn>() else { return Ok(None) };
    let made = column.lists(lua, geometry)?;
    let made: Table = if name == "points" { made.raw_get(1)? } else { made };
    this.set_user_value(&made)?;
    Ok(Some(LuaValue::Table(made)))
}
