//! Methods of objects that are not the drawn one, such as environments and features.

use std::cell::OnceCell;
use std::rc::Rc;
use std::sync::Arc;

use mlua::{Lua, MultiValue, Table, Value as LuaValue, Variadic};

use super::convert::{to_argument, to_lua};
use super::current::WorkState;
use super::library::Library;
use super::table_classes::{metatable_of, vector_of};
use super::types::ObjectHandle;
use burgeon_base::error::Error;
use burgeon_base::locks::LockRecovery;
use burgeon_base::warning::take_deferred;
use burgeon_kit::{Call, Environment, IntoParts, Object, ObjectContent, Parameter, PartMaker, Value, Vector};

/// Number of entries from which the conversion of a result pauses garbage collection.
const LONG: usize = 256;

/// Object, application whose guard makes the call (if any), and arguments.
type ObjectCall = (LuaValue, Option<usize>, MultiValue);

/// Object, application whose guard makes the call (if any), and coordinates of the place (m) that is the only argument.
type PlaceCall = (LuaValue, Option<usize>, f64, f64, f64);

/// Adds the functions that make methods to `host`.
pub(super) fn add_object_methods(
    lua: &Lua,
    host: &Table,
    current: &Rc<WorkState>,
    library: &Rc<Library>,
) -> mlua::Result<()> {
    let (owner, state) = (Rc::clone(library), Rc::clone(current));
    let method = move |number, name| ObjectMethod {
        number,
        name,
        state: Rc::clone(&state),
        library: Rc::clone(&owner),
    };
    let made = method.clone();
    host.set(
        "object_method",
        lua.create_function(move |lua, (number, name): (usize, String)| {
            let method = made(number, name);
            lua.create_function(move |lua, (object, guard, arguments): ObjectCall| {
                method.call(lua, &object, guard, || values(lua, &arguments))
            })
        })?,
    )?;
    host.set(
        "place_method",
        lua.create_function(move |lua, (number, name): (usize, String)| {
            let method = method(number, name);
            lua.create_function(move |lua, (object, guard, x, y, z): PlaceCall| {
                method.call(lua, &object, guard, || Ok(vec![Vector::from([x, y, z]).into_value()]))
            })
        })?,
    )?;
    let (owner, state) = (Rc::clone(library), Rc::clone(current));
    host.set(
        "parts_method",
        lua.create_function(move |lua, (name, arguments): (String, Variadic<LuaValue>)| {
            let (library, state) = (Rc::clone(&owner), Rc::clone(&state));
            let method = ObjectMethod { number: usize::MAX, name, state, library };
            let given = values(lua, arguments.iter())?;
            let division = OnceCell::new();
            lua.create_function(move |lua, object: LuaValue| {
                method.store_parts(lua, &object, &given, &division)
            })
        })?,
    )?;
    host.set("vector_class", lua.create_function(|lua, ()| Ok(metatable_of(lua, "vec")))?)
}

/// Method of an object that is not the drawn one.
struct ObjectMethod {
    /// Number among the methods of its type.
    number: usize,
    /// Name of the type and of the method.
    name: String,
    state: Rc<WorkState>,
    library: Rc<Library>,
}

impl ObjectMethod {
    /// Calls the method with `arguments`. `guard` is the application whose guard calls it, if one does.
    fn call(
        &self,
        lua: &Lua,
        object: &LuaValue,
        guard: Option<usize>,
        arguments: impl FnOnce() -> mlua::Result<Vec<Value>>,
    ) -> mlua::Result<LuaValue> {
        let answer = self.answer(object, guard, arguments)?;
        // The complete result stays alive, so a collection would free nothing of it.
        let is_long = matches!(&answer, Value::Table(table) if table.entries.len() > LONG);
        let pauses = is_long && lua.gc_is_running();
        if pauses {
            lua.gc_stop();
        }
        let made = to_lua(lua, &answer, false);
        if pauses {
            lua.gc_restart();
        }
        made
    }

    /// Divides an object, and stores the parts as parameters of modules. Returns a buffer with the handle and the number of the
    /// entry of each (4 bytes).
    fn store_parts(
        &self,
        lua: &Lua,
        object: &LuaValue,
        arguments: &[Value],
        division: &OnceCell<Option<PartMaker>>,
    ) -> mlua::Result<mlua::Buffer> {
        let parts = match self.division_of(object, arguments, division)? {
            Some((object, division)) => {
                take_deferred();
                let parts = division(&*object).map_err(mlua::Error::external)?;
                self.report_deferred()?;
                parts
            }
            // Arguments that cannot be prepared are refused, with the reason.
            None => {
                self.answer(object, None, || Ok(arguments.to_vec()))?;
                Vec::new()
            }
        };
        let (entries, objects): (Vec<u32>, Vec<Arc<dyn Object>>) = parts.into_iter().unzip();
        let handles = self.state.session.values.store_objects(objects);
        let words = handles.into_iter().zip(entries);
        let bytes: Vec<u8> =
            words.flat_map(|(handle, entry)| [handle, entry]).flat_map(u32::to_le_bytes).collect();
        lua.create_buffer(bytes)
    }

    /// Returns the object with its division by the method; `None` if it has none for these arguments.
    fn division_of<'a>(
        &self,
        object: &LuaValue,
        arguments: &[Value],
        division: &'a OnceCell<Option<PartMaker>>,
    ) -> mlua::Result<Option<(Arc<dyn Object>, &'a PartMaker)>> {
        let LuaValue::UserData(data) = object else { return Ok(None) };
        let object = Arc::clone(&data.borrow::<ObjectHandle>()?.0);
        let Some(divide) = object.capability::<dyn IntoParts>() else { return Ok(None) };
        let (_, own_name) = self.name.split_once(':').unwrap_or(("", &self.name));
        let prepared = division.get_or_init(|| divide.prepare_parts(own_name, arguments));
        Ok(prepared.as_ref().map(|division| (Arc::clone(&object), division)))
    }

    /// Reports the warnings of the call that has just ended.
    fn report_deferred(&self) -> mlua::Result<()> {
        for warning in take_deferred() {
            self.library.machine().map_err(mlua::Error::external)?.warn_of_values(warning);
        }
        Ok(())
    }

    /// Returns what the method answers.
    fn answer(
        &self,
        object: &LuaValue,
        guard: Option<usize>,
        arguments: impl FnOnce() -> mlua::Result<Vec<Value>>,
    ) -> mlua::Result<Value> {
        let (_, own_name) = self.name.split_once(':').unwrap_or(("", &self.name));
        let LuaValue::UserData(data) = object else {
            return Err(mlua::Error::external(
                Error::argument(format!("{} needs its object", self.name))
                    .help(format!("call it with a colon: object:{own_name}()")),
            ));
        };
        let handle = data.borrow::<ObjectHandle>()?;
        // A type that inherits from another type numbers its methods differently.
        let kind = handle.0.kind();
        let known = kind.methods.get(self.number).filter(|known| *known.name == *own_name);
        let Some(method) = known.or_else(|| kind.method(own_name)) else {
            return Err(mlua::Error::external(kind.unknown_method(own_name)));
        };
        let environments = self.state.environments.borrow();
        let environment = environments.as_ref().and_then(|all| {
            let systems = self.library.systems.try_borrow().ok()?;
            all.state_of(&systems.get(self.state.system.get()?)?.environments, &handle.0)
        });
        match &method.call {
            Call::Read(read) => {
                let given = arguments()?;
                take_deferred();
                let answer = match environment {
                    Some(environment) => read(&**environment.read().recover(), &given),
                    None => read(&*handle.0, &given),
                };
                let answer = answer.map_err(mlua::Error::external)?;
                self.report_deferred()?;
                let place = guard.and_then(|guard| self.state.noted_place(guard));
                if let Some(place) = place.filter(|_| kind.has_capability::<dyn ObjectContent>()) {
                    let given: Vec<String> = given.iter().map(Value::to_string).collect();
                    let this = &handle.0;
                    let text = format!("{this}:{}({}): {answer}", method.name, given.join(", "));
                    self.state.session.rows.note_answer(place, text);
                }
                Ok(answer)
            }
            Call::Write { values: write, .. } if kind.has_capability::<dyn Environment>() => {
                let Some(environment) = environment else {
                    return Err(mlua::Error::external(no_environment(&self.name)));
                };
                let given = arguments()?;
                let mut state = environment.write().recover();
                write(&mut **state, &given).map_err(mlua::Error::external)
            }
            Call::Write { .. } | Call::Script { .. } => Err(mlua::Error::external(Error::scope(format!(
                "{} is a write method, so only interpretation rules can call it",
                self.name
            )))),
        }
    }
}

/// Returns the error for a change of an environment that the system does not have.
fn no_environment(name: &str) -> Error {
    Error::scope(format!("{name} changes an environment that this system does not have"))
        .help("give it to the system: lsystem({ object = turtle(), environment = { light } })")
}

pub(super) fn values<'a>(
    lua: &Lua,
    arguments: impl IntoIterator<Item = &'a LuaValue>,
) -> mlua::Result<Vec<Value>> {
    let value = |value: &LuaValue| match value {
        LuaValue::Table(table) => match vector_of(lua, table) {
            Some(vector) => Ok(vector),
            None => to_argument(value),
        },
        value => to_argument(value),
    };
    arguments.into_iter().map(|given| value(given).map_err(mlua::Error::external)).collect()
}
