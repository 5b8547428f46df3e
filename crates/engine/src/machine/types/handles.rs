//! Script values for objects and derived systems.

use std::sync::{Arc, RwLock};

use mlua::{
    AnyUserData, Function, Lua, LuaString, MetaMethod, Table, UserData, UserDataFields, UserDataMethods,
    Value as LuaValue,
};

use rustc_hash::FxHashMap;

use super::geometries::geometry_field;
use super::module_lists::{chain_number, module_list};
use crate::machine::convert::to_lua;
use crate::machine::messages::is_at_top_level;
use crate::machine::native::native;
use crate::machine::table_of;
use crate::results::DerivedSystem;
use burgeon_base::error::{Error, Result};
use burgeon_base::locks::LockRecovery;
use burgeon_base::text::panic_message;
use burgeon_kit::declare::as_ref;
use burgeon_kit::{Kind, Object, ScriptObject, are_equal};
use burgeon_language::DERIVED;
use burgeon_language::slips::remedy_of_system_method;
use burgeon_rewriting::FailedChains;

/// Objects of a system, one per chain: read during rewriting, changed during interpretation.
pub(crate) struct Objects {
    list: Vec<RwLock<Box<dyn Object>>>,
    /// Chains with faulty data; their objects draw nothing more.
    failed: Arc<FailedChains>,
}

impl Objects {
    /// Creates the objects of chains. If `forgiving` is set, faulty data skips a chain instead of ending the
    /// run.
    pub(crate) fn new(objects: Vec<Box<dyn Object>>, forgiving: bool) -> Self {
        let failed = Arc::new(FailedChains::new(objects.len(), forgiving));
        Self { list: objects.into_iter().map(RwLock::new).collect(), failed }
    }

    /// Returns the chains with faulty data.
    pub(crate) fn failed(&self) -> &Arc<FailedChains> {
        &self.failed
    }

    pub(crate) fn read<T>(&self, chain: usize, ask: impl FnOnce(&dyn Object) -> Result<T>) -> Result<T> {
        let object = self.list.get(chain).ok_or_else(no_object)?;
        guarded(|| ask(&**object.read().recover()))
    }

    pub(crate) fn write<T>(
        &self,
        chain: usize,
        change: impl FnOnce(&mut dyn Object) -> Result<T>,
    ) -> Result<T> {
        let object = self.list.get(chain).ok_or_else(no_object)?;
        guarded(|| change(&mut **object.write().recover()))
    }

    /// Returns the objects, each with the error of its chain.
    pub(crate) fn into_owned(self) -> Vec<(Box<dyn Object>, Option<Error>)> {
        let failed = self.failed;
        let objects = self.list.into_iter().enumerate();
        objects
            .map(|(chain, object)| (object.into_inner().recover(), failed.failure(chain).cloned()))
            .collect()
    }
}

/// Converts a panic to an error, so that a faulty object type outside of Burgeon affects only its own chain.
fn guarded<T>(act: impl FnOnce() -> Result<T>) -> Result<T> {
    std::panic::catch_unwind(std::panic::AssertUnwindSafe(act)).unwrap_or_else(|panic| {
        Err(Error::internal(format!("the object type panicked: {}", panic_message(&*panic)))
            .help("this is a bug in the type, not in the script; report it to its author")
            .of_data())
    })
}

fn no_object() -> Error {
    Error::script("the system has no object").help("set one: lsystem({ object = ... })")
}

/// Read-only script value for an object.
pub(crate) struct ObjectHandle(pub Arc<dyn Object>);

impl ObjectHandle {
    /// Returns the object that a script value is, if it is one.
    pub(crate) fn object_of(value: &LuaValue) -> Option<Arc<dyn Object>> {
        let LuaValue::UserData(data) = value else { return None };
        data.borrow::<Self>().ok().map(|handle| Arc::clone(&handle.0))
    }
}

impl UserData for ObjectHandle {
    fn add_fields<F: UserDataFields<Self>>(fields: &mut F) {
        fields.add_meta_field_with(MetaMethod::Index, index_function);
        fields.add_meta_field(MetaMethod::Type, "object");
    }

    fn add_methods<M: UserDataMethods<Self>>(methods: &mut M) {
        methods.add_meta_function(MetaMethod::Eq, |_, (one, two): (AnyUserData, AnyUserData)| {
            let (Ok(one), Ok(two)) = (one.borrow::<Self>(), two.borrow::<Self>()) else { return Ok(false) };
            Ok(are_equal(&one.0, &two.0))
        });
        methods.add_meta_method(
            MetaMethod::NewIndex,
            |_, this, (name, _): (LuaValue, LuaValue)| -> mlua::Result<()> {
                let (kind, name) = (&this.0.kind().name, name.to_string().unwrap_or_default());
                Err(mlua::Error::external(
                    Error::script(format!("{name} of a {kind} cannot be assigned"))
                        .help(format!("set fields in the constructor: {kind} {{ {name} = ... }}")),
                ))
            },
        );
        methods.add_meta_method(MetaMethod::ToString, |_, this, ()| Ok(this.0.to_string()));
    }
}

/// Registry name of the method tables of the objects that are read often.
const OFTEN_READ: &str = "burgeon objects read often";

/// Returns the function that reads a method or a field of an object. Methods of the objects that are read often are found
/// without a call into Rust.
fn index_function(lua: &Lua) -> mlua::Result<Function> {
    let often_read = lua.create_table()?;
    lua.set_named_registry_value(OFTEN_READ, &often_read)?;
    let others = lua.create_function(member)?;
    let chunk = lua.load(
        "local often_read, others = ...
        return function(object, name)
          local methods = often_read[object]
          local method = if methods then rawget(methods, name) else nil
          return if method ~= nil then method else others(object, name)
        end",
    );
    // Named as the prelude, because errors must not name its lines.
    let made: Function = chunk.set_name("=burgeon").call((often_read, others))?;
    native(lua, &made)?;
    Ok(made)
}

/// Declares that the methods of an object, or of each object of a list, are called often.
pub(in crate::machine) fn read_often(lua: &Lua, object: &LuaValue) -> mlua::Result<()> {
    if let LuaValue::Table(list) = object {
        return list.sequence_values::<LuaValue>().try_for_each(|object| read_often(lua, &object?));
    }
    let LuaValue::UserData(data) = object else { return Ok(()) };
    let Ok(handle) = data.borrow::<ObjectHandle>() else { return Ok(()) };
    let methods = method_table(lua, handle.0.kind())?;
    lua.named_registry_value::<Table>(OFTEN_READ)?.raw_set(data, methods)
}

/// Returns a method or a field of an object.
fn member(lua: &Lua, (this, name): (AnyUserData, LuaString)) -> mlua::Result<LuaValue> {
    let handle = this.borrow::<ObjectHandle>()?;
    let object = &*handle.0;
    match method_table(lua, object.kind())?.raw_get::<LuaValue>(&name)? {
        LuaValue::Nil => {}
        method => return Ok(method),
    }
    let name = name.to_string_lossy();
    if let Some(field) = geometry_field(lua, &this, &name)? {
        return Ok(field);
    }
    match as_ref::<ScriptObject>(object).and_then(|object| object.member(&name)) {
        Some(value) => to_lua(lua, &value, true),
        None => Err(mlua::Error::external(object.kind().unknown_method(&name))),
    }
}

/// Method tables by the address of their kind. The kind is kept alive, so its address stays unique.
#[derive(Default)]
struct MethodTables(FxHashMap<usize, (Arc<Kind>, Table)>);

/// Returns the methods of a type.
fn method_table(lua: &Lua, kind: &Arc<Kind>) -> mlua::Result<Table> {
    let place = Arc::as_ptr(kind) as usize;
    if let Some(known) = lua.app_data_ref::<MethodTables>()
        && let Some((_, table)) = known.0.get(&place)
    {
        return Ok(table.clone());
    }
    let table: Table = lua.named_registry_value(&methods_key(&kind.name))?;
    if lua.app_data_ref::<MethodTables>().is_none() {
        lua.set_app_data(MethodTables::default());
    }
    if let Some(mut known) = lua.app_data_mut::<MethodTables>() {
        known.0.insert(place, (Arc::clone(kind), table.clone()));
    }
    Ok(table)
}

/// Returns the registry name of the methods of an object type.
pub(crate) fn methods_key(kind: &str) -> String {
    format!("burgeon methods {kind}")
}

/// Script value that `derive` returns.
pub(crate) struct DerivedHandle(pub Arc<DerivedSystem>);

impl DerivedHandle {
    pub(crate) fn model(&self) -> Result<Arc<dyn Object>> {
        self.0.model()
    }
}

impl UserData for DerivedHandle {
    fn add_fields<F: UserDataFields<Self>>(fields: &mut F) {
        fields.add_meta_field(MetaMethod::Type, "derived");
    }

    fn add_methods<M: UserDataMethods<Self>>(methods: &mut M) {
        methods.add_meta_function(MetaMethod::Index, |lua, (this, name): (AnyUserData, String)| {
            this.borrow::<Self>()?.0.note_read_by_rule(|| !is_at_top_level(lua));
            if let LuaValue::Table(cached) = this.user_value::<LuaValue>()?
                && let value @ (LuaValue::Table(_) | LuaValue::Number(_) | LuaValue::Integer(_)) =
                    cached.raw_get::<LuaValue>(name.as_str())?
            {
                return Ok(value);
            }
            let value = this.borrow::<Self>()?.field(lua, &name)?;
            let cached = match this.user_value::<LuaValue>()? {
                LuaValue::Table(cached) => cached,
                _ => lua.create_table()?,
            };
            cached.raw_set(name, &value)?;
            this.set_user_value(cached)?;
            Ok(value)
        });
        methods.add_meta_method(MetaMethod::ToString, |_, this, ()| {
            Ok(format!("a derived system of {} modules", this.0.modules()))
        });
    }
}

impl DerivedHandle {
    fn field(&self, lua: &Lua, name: &str) -> mlua::Result<LuaValue> {
        let derived = &self.0;
        #[allow(clippy::cast_precision_loss, reason = "counts below 2^53")]
        let number = |count: usize| Ok(LuaValue::Number(count as f64));
        match name {
            "steps" => number(derived.steps),
            "time" => Ok(LuaValue::Number(derived.time)),
            "modules" => number(derived.modules()),
            "counts" => {
                let counts = lua.create_table()?;
                for (name, count) in derived.counts() {
                    counts.raw_set(name, count)?;
                }
                counts.set_readonly(true);
                Ok(LuaValue::Table(counts))
            }
            "chains" => {
                let lines = derived.read_chains();
                let table = lua.create_sequence_from(lines.lines())?;
                table.set_readonly(true);
                Ok(LuaValue::Table(table))
            }
            "chain" => {
                let derived = Arc::clone(derived);
                let list = move |lua: &Lua, (_, number): (LuaValue, LuaValue)| {
                    derived.note_read();
                    module_list(lua, &derived, chain_number(&number).map_err(mlua::Error::external)?)
                };
                Ok(LuaValue::Function(lua.create_function(list)?))
            }
            "variables" => {
                let table = match &derived.variables {
                    Some(variables) => table_of(lua, variables)?,
                    None => lua.create_table()?,
                };
                table.set_readonly(true);
                Ok(LuaValue::Table(table))
            }
            "objects" => {
                let handles = derived.objects.iter().map(|object| ObjectHandle(Arc::clone(object)));
                let handles: Vec<AnyUserData> =
                    handles.map(|handle| lua.create_userdata(handle)).collect::<mlua::Result<_>>()?;
                let table = lua.create_sequence_from(handles)?;
                table.set_readonly(true);
                Ok(LuaValue::Table(table))
            }
            _ => {
                let message = format!("unknown field `{name}` of a derived system");
                let known = DERIVED.part_names();
                let error = Error::not_found("field", name, known.iter().copied(), message);
                Err(mlua::Error::external(error.help(remedy_of_system_method(name, &known))))
            }
        }
    }
}
