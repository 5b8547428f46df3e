//! Globals of scripts that declare modules, parameters, systems and files.

use std::sync::Arc;

use mlua::{Function, MultiValue, Table, Value as LuaValue, Variadic};

use super::Machine;
use super::convert::to_lua;
use super::expectation::expect;
use super::library::Library;
use super::messages::{print, script_warning};
use super::require::require;
use super::system::{SourceHandle, SystemHandle};
use super::types::{declare_type, extend_type, named_fields, no_table};
use crate::declare::{API_VERSION, Param, declare_camera, has_name};
use burgeon_base::error::{Error, Result};
use burgeon_kit::Field;
use burgeon_language::PARAM;
use burgeon_packages::FileName;
use burgeon_rewriting::{NameScope, Signature, Symbol};

impl Library {
    /// Sets the globals that declare modules and parameters, and the globals about the run.
    pub(super) fn install_plain(&self, machine: &Machine, globals: &Table) -> mlua::Result<()> {
        let lua = machine.lua();
        let library = std::rc::Rc::clone(&machine.library);
        globals.raw_set(
            "warn",
            lua.create_function(move |_, (text, help): (LuaValue, LuaValue)| {
                library.outside_rules("warn").map_err(mlua::Error::external)?;
                let warning = script_warning(&text, &help).map_err(mlua::Error::external)?;
                library.machine().map_err(mlua::Error::external)?.warn_of_values(warning);
                Ok(())
            })?,
        )?;
        let library = std::rc::Rc::clone(&machine.library);
        globals.raw_set(
            "expect",
            lua.create_function(move |_, values: (LuaValue, LuaValue, LuaValue)| {
                library.outside_rules("expect").map_err(mlua::Error::external)?;
                let machine = library.machine().map_err(mlua::Error::external)?;
                expect(&machine.session.options, &values).map_err(mlua::Error::external)
            })?,
        )?;
        let library = std::rc::Rc::clone(&machine.library);
        globals.raw_set(
            "module",
            lua.create_function(move |lua, (name, parameters): (String, Variadic<String>)| {
                library.at_top_level("module").map_err(mlua::Error::external)?;
                let scope = library.scope_at(lua);
                let (symbol, constructor) =
                    declare(&library, &scope, &name, &parameters).map_err(mlua::Error::external)?;
                if let (false, Some(place)) =
                    (library.symbols.borrow().is_standard(symbol), Machine::place(lua))
                {
                    library.places.borrow_mut().entry(symbol).or_insert(place);
                }
                Ok(constructor)
            })?,
        )?;
        let (library, session) = (std::rc::Rc::clone(&machine.library), Arc::clone(&machine.session));
        globals.raw_set(
            "param",
            lua.create_function(move |lua, (name, options): (LuaValue, LuaValue)| {
                library.at_top_level("param").map_err(mlua::Error::external)?;
                let LuaValue::String(name) = name else {
                    return Err(mlua::Error::external(
                        Error::argument("the first argument of param must be a name")
                            .help("write param(\"height\", { default = 3 })"),
                    ));
                };
                let name = name.to_string_lossy();
                let options =
                    named_fields(&format!("param {name}"), options).map_err(mlua::Error::external)?;
                let place = Machine::place(lua);
                let fields: Vec<Field> = PARAM.options().cloned().collect();
                let options = session
                    .replace_former_names("param", &fields, &options, place.as_ref())
                    .map_err(mlua::Error::external)?;
                let mut param = Param::declare(&name, &options).map_err(mlua::Error::external)?;
                if let Some(owner) = place.as_ref().and_then(|place| session.package_of(&place.file)) {
                    session.redefault(&mut param, owner).map_err(mlua::Error::external)?;
                    let package = owner.manifest.name.clone();
                    param.name = format!("{package}.{name}");
                    param.package = Some(package);
                }
                param.stored = session.curves().setting(&param).map_err(mlua::Error::external)?;
                match library.param_value(&param) {
                    Ok(value) => param.value = value,
                    Err(error) => session.forgive(&param.name, error).map_err(mlua::Error::external)?,
                }
                let value = param.script_value().map_err(mlua::Error::external)?;
                library.add_param(param, place).map_err(mlua::Error::external)?;
                to_lua(lua, &value, false)
            })?,
        )?;
        let (library, session) = (std::rc::Rc::clone(&machine.library), Arc::clone(&machine.session));
        globals.raw_set(
            "camera",
            lua.create_function(move |lua, options: LuaValue| {
                let place = Machine::place(lua);
                let declare = || {
                    library.at_top_level("camera")?;
                    let options = named_fields("camera", options)?;
                    let camera = declare_camera(&options, place)?;
                    session.add_camera(camera)
                };
                declare().map_err(mlua::Error::external)
            })?,
        )?;
        globals.raw_set("lod", machine.session.options.lod)?;
        let session = Arc::clone(&machine.session);
        let library = std::rc::Rc::clone(&machine.library);
        globals.raw_set(
            "print",
            lua.create_function(move |lua, values: MultiValue| {
                session.count_print();
                session
                    .options
                    .reports
                    .print
                    .as_ref()
                    .map_or(Ok(()), |hook| print(lua, &library, &values, hook))
            })?,
        )
    }

    /// Sets the globals that declare systems and object types.
    pub(super) fn install_systems(&self, machine: &Machine, globals: &Table) -> mlua::Result<()> {
        let lua = machine.lua();
        let library = std::rc::Rc::clone(&machine.library);
        globals.raw_set(
            "lsystem",
            lua.create_function(move |lua, options: LuaValue| {
                let create = || {
                    library.at_top_level("lsystem")?;
                    let options = match options {
                        LuaValue::Nil => None,
                        LuaValue::Table(options) => Some(options),
                        other => return Err(no_table("lsystem", &other)),
                    };
                    let places = [Machine::place(lua), Machine::outermost(lua)];
                    SystemHandle::create(&library, options.as_ref(), places)
                };
                create().map_err(mlua::Error::external)
            })?,
        )?;
        let library = std::rc::Rc::clone(&machine.library);
        globals.raw_set(
            "object",
            lua.create_function(move |_, (name, declared): (LuaValue, LuaValue)| {
                let machine = library.machine().map_err(mlua::Error::external)?;
                declare_type(&machine, &name, &declared).map_err(mlua::Error::external)
            })?,
        )?;
        let library = std::rc::Rc::clone(&machine.library);
        globals.raw_set(
            "extend",
            lua.create_function(move |_, (constructor, declared): (LuaValue, LuaValue)| {
                let machine = library.machine().map_err(mlua::Error::external)?;
                extend_type(&machine, &constructor, &declared).map_err(mlua::Error::external)
            })?,
        )
    }

    /// Sets the globals that load data and other files.
    pub(super) fn install_files(&self, machine: &Machine, globals: &Table) -> mlua::Result<()> {
        let lua = machine.lua();
        let library = std::rc::Rc::clone(&machine.library);
        globals.raw_set(
            "source",
            lua.create_function(move |_, (what, options): (LuaValue, LuaValue)| {
                let made = library
                    .at_top_level("source")
                    .and_then(|()| SourceHandle::new(&*library.machine()?, &what, &options));
                made.map_err(mlua::Error::external)
            })?,
        )?;
        let library = std::rc::Rc::clone(&machine.library);
        globals.raw_set(
            "require",
            lua.create_function(move |lua, name: LuaValue| {
                let name = match name {
                    LuaValue::String(name) => name.to_string_lossy(),
                    _ => String::new(),
                };
                let required = library
                    .at_top_level("require")
                    .and_then(|()| require(&library, &library.machine()?.session, lua, &name));
                required.map_err(mlua::Error::external)
            })?,
        )
    }

    /// Sets the global `api`.
    pub(super) fn install_api(&self, machine: &Machine, globals: &Table) -> mlua::Result<()> {
        let lua = machine.lua();
        let api = lua.create_table()?;
        api.raw_set("version", API_VERSION)?;
        let session = Arc::clone(&machine.session);
        api.raw_set(
            "has",
            lua.create_function(move |lua, name: LuaValue| {
                let LuaValue::String(name) = name else {
                    return Err(mlua::Error::external(
                        Error::argument("the argument of api.has must be a name")
                            .help("write api.has(\"extruder.bend\")"),
                    ));
                };
                let name = name.to_string_lossy();
                Ok(match FileName::parse(&name) {
                    Ok(file) if file.path.is_empty() => {
                        session.has_package(&file.package, Machine::asker(lua, &session))
                    }
                    _ => has_name(&name, &session.options.registry),
                })
            })?,
        )?;
        globals.raw_set("api", api)
    }
}

fn declare(
    library: &Library,
    scope: &NameScope,
    name: &str,
    parameters: &[String],
) -> Result<(Symbol, Function)> {
    let symbol = match name.contains('.') {
        // Successors given as text use qualified names of package modules.
        true => library.symbols.borrow().find_in(name, scope)?,
        false => {
            let signature = Signature::new(name, parameters)?;
            library.symbols.borrow_mut().declare_in(signature, scope.package.as_deref())?
        }
    };
    if let Some(constructor) = library.constructors.borrow().get(&symbol) {
        return Ok((symbol, constructor.clone()));
    }
    // The standard library declares modules before the machine is complete, so the prelude is called
    // directly.
    let machine = library.machine()?;
    let constructor =
        machine.constructor(&library.symbols.borrow(), symbol).map_err(|error| machine.translate(error))?;
    library.constructors.borrow_mut().insert(symbol, constructor.clone());
    Ok((symbol, constructor))
}
