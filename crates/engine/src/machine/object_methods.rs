//! Methods of objects that are not the drawn one, such as environments and features.

use std::cell::{Cell, OnceCell};
use std::ops::Deref;
use std::rc::Rc;
use std::sync::Arc;

use mlua::{Either, Lua, MultiValue, Table, UserDataRef, Value as LuaValue, Variadic};

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
///
/// A borrowed object needs no reference of its own to the script's value, which would cost a tenth of the call.
type PlaceCall = (Either<UserDataRef<ObjectHandle>, LuaValue>, Option<usize>, f64, f64, f64);

/// Adds the functions that make methods to `host`.
pub(super) fn add_object_methods(
    lua: &Lua,
    host: &Table,
    current: &Rc<WorkState>,
    library: &Rc<Library>,
) -> mlua::Result<()> {
    let (owner, state) = (Rc::clone(library), Rc::clone(current));
    let method = move |number, name| ObjectMethod::new(number, name, Rc::clone(&state), Rc::clone(&owner));
    let made = method.clone();
    host.set(
        "object_method",
        lua.create_function(move |lua, (number, name): (usize, String)| {
            let method = made(number, name);
            lua.create_function(move |lua, (object, guard, arguments): ObjectCall| {
                method.call(lua, &*method.handle(&object)?, guard, || values(lua, &arguments))
            })
        })?,
    )?;
    host.set(
        "place_method",
        lua.create_function(move |lua, (number, name): (usize, String)| {
            let method = method(number, name);
            let place = Cell::default();
            lua.create_function(move |lua, (object, guard, x, y, z): PlaceCall| {
                let place = || Ok(PlaceArgument::new(&place, Vector::from([x, y, z])));
                match object {
                    Either::Left(handle) => method.call(lua, &handle, guard, place),
                    Either::Right(object) => method.call(lua, &*method.handle(&object)?, guard, place),
                }
            })
        })?,
    )?;
    let (owner, state) = (Rc::clone(library), Rc::clone(current));
    host.set(
        "parts_method",
        lua.create_function(move |lua, (name, arguments): (String, Variadic<LuaValue>)| {
            let (library, state) = (Rc::clone(&owner), Rc::clone(&state));
            let method = ObjectMethod::new(usize::MAX, name, state, library);
            let given = values(lua, arguments.iter())?;
            let division = OnceCell::new();
            lua.create_function(move |lua, object: LuaValue| {
                method.store_parts(lua, &object, &given, &division)
            })
        })?,
    )?;
    host.set("vector_class", lua.create_function(|lua, ()| Ok(metatable_of(lua, "vec")))?)
}

/// A place as the only argument of a call, in memory that the next call uses again.
struct PlaceArgument<'a> {
    arguments: Vec<Value>,
    memory: &'a Cell<Vec<Value>>,
}

impl<'a> PlaceArgument<'a> {
    fn new(memory: &'a Cell<Vec<Value>>, place: Vector) -> Self {
        let mut arguments = memory.take();
        match arguments.first_mut() {
            Some(value) => place.store_in(value),
            None => arguments.push(place.into_value()),
        }
        Self { arguments, memory }
    }
}

impl Deref for PlaceArgument<'_> {
    type Target = [Value];

    fn deref(&self) -> &[Value] {
        &self.arguments
    }
}

impl Drop for PlaceArgument<'_> {
    fn drop(&mut self) {
        self.memory.set(std::mem::take(&mut self.arguments));
    }
}

/// Method of an object that is not the drawn one.
struct ObjectMethod {
    /// Number among the methods of its type.
    number: usize,
    /// Name of the type and of the method.
    name: String,
    /// Place of the method's own name in `name`.
    own: usize,
    state: Rc<WorkState>,
    library: Rc<Library>,
}

impl ObjectMethod {
    fn new(number: usize, name: String, state: Rc<WorkState>, library: Rc<Library>) -> Self {
        let own = name.find(':').map_or(0, |colon| colon + 1);
        Self { number, name, own, state, library }
    }

    /// Returns the name of the method without the type.
    fn own_name(&self) -> &str {
        &self.name[self.own..]
    }

    /// Returns the handle of the object whose method a script calls.
    fn handle(&self, object: &LuaValue) -> mlua::Result<UserDataRef<ObjectHandle>> {
        match object {
            LuaValue::UserData(data) => data.borrow::<ObjectHandle>(),
            _ => Err(mlua::Error::external(
                Error::argument(format!("{} needs its object", self.name))
                    .help(format!("call it with a colon: object:{}()", self.own_name())),
            )),
        }
    }

    /// Calls the method with `arguments`. `guard` is the application whose guard calls it, if one does.
    fn call<A: Deref<Target = [Value]>>(
        &self,
        lua: &Lua,
        object: &ObjectHandle,
        guard: Option<usize>,
        arguments: impl FnOnce() -> mlua::Result<A>,
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
                self.answer(&*self.handle(object)?, None, || Ok(arguments.to_vec()))?;
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
        let prepared = division.get_or_init(|| divide.prepare_parts(self.own_name(), arguments));
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
    fn answer<A: Deref<Target = [Value]>>(
        &self,
        handle: &ObjectHandle,
        guard: Option<usize>,
        arguments: impl FnOnce() -> mlua::Result<A>,
    ) -> mlua::Result<Value> {
        let own_name = self.own_name();
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
