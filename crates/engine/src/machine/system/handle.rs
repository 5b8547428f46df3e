//! Script values for systems.

use std::cell::{Cell, RefCell};
use std::rc::Rc;
use std::sync::Arc;

use mlua::{
    Lua, MetaMethod, MultiValue, Table, UserData, UserDataFields, UserDataMethods, UserDataRef,
    Value as LuaValue,
};

use crate::machine::convert::to_value;
use crate::machine::library::Library;
use crate::machine::types::{DerivedHandle, ObjectHandle, object_of_system, read_often};
use crate::machine::{DerivationRequest, Machine};
use burgeon_base::error::{Error, Result, SourcePlace};
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_kit::{Object, Value};
use burgeon_language::slips::remedy_of_system_method;
use burgeon_language::{LSYSTEM, SYSTEM};
use burgeon_scene::CityClass;

use super::SystemDeclaration;
use super::declaration::{MAX_DEPTH, RulePhase};
use super::derive_arguments::DeriveArguments;
use super::hooks::HookMoment;
use super::ignored::{IgnoredModules, named_symbols, tell_conflict};
use crate::machine::environments::environments_of;

/// Script value for a system.
pub(crate) struct SystemHandle {
    library: Rc<Library>,
    index: usize,
}

impl SystemHandle {
    pub(crate) fn create(
        library: &Rc<Library>,
        options: Option<&Table>,
        [place, caller]: [Option<SourcePlace>; 2],
    ) -> Result<Self> {
        let mut system = SystemDeclaration {
            object: None,
            last_only: false,
            max_depth: MAX_DEPTH,
            city: None,
            seed: None,
            index: library.systems.borrow().len(),
            place,
            caller,
            axiom_place: None,
            axiom: None,
            rules: Vec::new(),
            interpretations: Vec::new(),
            hooks: Vec::new(),
            environments: Vec::new(),
            variables: None,
            ignored: IgnoredModules::default(),
            ring: false,
            subsystems: Vec::new(),
            linked: None,
            derivations: RefCell::default(),
            late: RefCell::default(),
            axiom_is_new: Cell::new(false),
            given: Cell::new(false),
        };
        for pair in options.into_iter().flat_map(Table::pairs::<LuaValue, LuaValue>) {
            let (key, value) = pair.map_err(|error| Error::internal(error.to_string()))?;
            let key = key.to_string().unwrap_or_default();
            match (key.as_str(), value) {
                ("object", value) => system.object = Some(prototype(library, value)?),
                ("interpret", LuaValue::String(when)) if when.to_string_lossy() == "last" => {
                    system.last_only = true
                }
                ("interpret", _) => {
                    return Err(Error::argument("lsystem: interpret must be \"last\"")
                        .help("omit it to interpret after every step"));
                }
                ("ring", LuaValue::Boolean(ring)) => system.ring = ring,
                ("ring", _) => {
                    return Err(Error::argument("lsystem: ring must be true or false")
                        .help("with ring = true, the first and the last module of a chain are neighbours"));
                }
                ("environment", value) => {
                    system.environments = environments_of(&value)?;
                    let noted = read_often(library.machine()?.lua(), &value);
                    noted.map_err(|error| Error::internal(error.to_string()))?;
                }
                ("variables", value) => {
                    let machine = library.machine()?;
                    let number = machine.prelude().variables_of.call::<Option<usize>>(value);
                    system.variables =
                        Some(number.map_err(|error| machine.translate(error))?.ok_or_else(|| {
                            Error::argument("lsystem: variables must be a result of variables(...)").help(
                            "write local clock = variables({ time = 0 }), and lsystem({ variables = clock })",
                        )
                        })?);
                }
                ("city", value) => match to_value(&value, false)? {
                    Value::Text(class) => {
                        system.city =
                            Some(CityClass::of(&class).map_err(|error| error.about("lsystem: city"))?);
                    }
                    _ => return Err(Error::argument("lsystem: city must be a string, such as \"Road\"")),
                },
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "the range is checked"
                )]
                ("max_depth", value) => match to_value(&value, false)? {
                    Value::Number(depth) if depth.fract() == 0.0 && (1.0..1e6).contains(&depth) => {
                        system.max_depth = depth as usize;
                    }
                    _ => return Err(Error::argument("lsystem: max_depth must be an integer of at least 1")),
                },
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "the range is checked"
                )]
                ("seed", value) => match to_value(&value, false)? {
                    Value::Number(seed) if seed.fract() == 0.0 && (0.0..9e15).contains(&seed) => {
                        system.seed = Some(seed as u64);
                    }
                    _ => return Err(Error::argument("lsystem: seed must be an integer of at least 0")),
                },
                (other, _) => {
                    let known = LSYSTEM.part_names();
                    let message = format!("unknown field `{other}` in lsystem");
                    let help = remedy_of_system_method(other, &known);
                    return Err(Error::not_found("field", other, known.iter().copied(), message).help(help));
                }
            }
        }
        system.check_environments()?;
        let index = system.index;
        let Ok(mut systems) = library.systems.try_borrow_mut() else { return Err(in_axiom("lsystem")) };
        systems.push(system);
        Ok(Self { library: Rc::clone(library), index })
    }

    /// Runs a declaration of `what`. Errors are collected, so that all can be reported together. Fails while
    /// rules run.
    fn declare(
        &self,
        lua: &Lua,
        what: &'static str,
        declare: impl FnOnce(&mut SystemDeclaration) -> Result<()>,
    ) -> mlua::Result<()> {
        let place = Machine::place(lua);
        let machine = self.library.machine().map_err(mlua::Error::external)?;
        machine.refuse_in_rules("a declaration").map_err(mlua::Error::external)?;
        let Ok(mut systems) = self.library.systems.try_borrow_mut() else {
            return Err(mlua::Error::external(in_axiom("a declaration")));
        };
        let system = &mut systems[self.index];
        system.unlink();
        if !system.derivations.get_mut().is_empty() {
            system.late.get_mut().push((what, place.clone()));
        }
        let result = declare(system);
        if let Err(error) = result {
            let error = error.at(place);
            let mut problems = self.library.problems.borrow_mut();
            // A loop that repeats a faulty declaration causes one error.
            if !problems.last().is_some_and(|known| known.is_same(&error)) {
                problems.push(error);
            }
        }
        Ok(())
    }
}

/// Returns the error for an action that the function of an axiom may not do.
pub(super) fn in_axiom(what: &str) -> Error {
    Error::scope(format!("{what} cannot be called in the function that returns each feature's chain"))
        .help("call it before derive, and use the result in the function")
}

/// Returns the object of a system, given as an object or as a constructor that is called without fields.
fn prototype(library: &Library, value: LuaValue) -> Result<Arc<dyn Object>> {
    let value = match value {
        LuaValue::Function(constructor) => {
            let machine = library.machine()?;
            constructor.call::<LuaValue>(()).map_err(|error| machine.translate(error))?
        }
        value => value,
    };
    if let Some(object) = ObjectHandle::object_of(&value) {
        return Ok(object);
    }
    let given = match to_value(&value, false) {
        Ok(Value::Text(text)) => format!(", not the string {text:?}"),
        Ok(value) => format!(", not {}", value.describe()),
        Err(_) => String::new(),
    };
    let error = Error::argument(format!("lsystem: object must be an object{given}"));
    Err(match object_of_system(&library.registry.borrow()) {
        Some(object) => error.help(format!("write {object}")),
        None => error,
    })
}

impl UserData for SystemHandle {
    fn add_fields<F: UserDataFields<Self>>(fields: &mut F) {
        fields.add_meta_field(MetaMethod::Type, "system");
    }

    fn add_methods<M: UserDataMethods<Self>>(methods: &mut M) {
        methods.add_meta_method(MetaMethod::ToString, |_, _, ()| Ok("a system"));
        methods.add_function("axiom", |lua, (this, arguments): (UserDataRef<Self>, MultiValue)| {
            let arguments: Vec<LuaValue> = arguments.into_iter().collect();
            let library = Rc::clone(&this.library);
            let place = Machine::place(lua);
            let machine = this.library.machine().map_err(mlua::Error::external)?;
            this.declare(lua, "axiom", |system| {
                if system.axiom.is_some() && system.axiom_is_new.get() {
                    let earlier =
                        system.axiom_place.as_ref().map_or_else(String::new, |at| format!(" in {at}"));
                    let text = format!("this axiom replaces the axiom{earlier}, which was never derived");
                    let help = "set one axiom with all modules, or derive the system before the next axiom";
                    machine.warn(Warning::new(WarningKind::NoEffect, text).help(help));
                }
                system.axiom_place = place;
                system.axiom_is_new.set(true);
                system.set_axiom(&library, lua, arguments)
            })?;
            Ok(this.again())
        });
        for phase in RulePhase::ALL {
            let declared = move |lua: &Lua, (this, arguments): (UserDataRef<Self>, MultiValue)| {
                let arguments: Vec<LuaValue> = arguments.into_iter().collect();
                let library = Rc::clone(&this.library);
                this.declare(lua, "rule", |system| system.add_rule(&library, lua, phase, arguments))?;
                Ok(this.again())
            };
            methods.add_function(phase.method(), declared);
        }
        methods.add_function("interpret", |lua, (this, arguments): (UserDataRef<Self>, MultiValue)| {
            let arguments: Vec<LuaValue> = arguments.into_iter().collect();
            let library = Rc::clone(&this.library);
            this.declare(lua, "interpretation", |system| {
                system.add_interpretation(&library, lua, arguments)
            })?;
            Ok(this.again())
        });
        for moment in HookMoment::ALL {
            let declared = move |lua: &Lua, (this, arguments): (UserDataRef<Self>, MultiValue)| {
                let arguments: Vec<LuaValue> = arguments.into_iter().collect();
                let place = Machine::place(lua);
                this.declare(lua, "hook", |system| system.add_hook(moment, arguments, place))?;
                Ok(this.again())
            };
            methods.add_function(moment.method(), declared);
        }
        methods.add_function("ignore", |lua, (this, names): (UserDataRef<Self>, MultiValue)| {
            let library = Rc::clone(&this.library);
            this.declare(lua, "ignore", |system| {
                let symbols = named_symbols(&library, lua, &names)?;
                system.ignored.ignored.extend(symbols);
                tell_conflict(&library, lua, &mut system.ignored)
            })?;
            Ok(this.again())
        });
        methods.add_function("consider", |lua, (this, names): (UserDataRef<Self>, MultiValue)| {
            let library = Rc::clone(&this.library);
            this.declare(lua, "consider", |system| {
                let symbols = named_symbols(&library, lua, &names)?;
                system.ignored.considered.get_or_insert_default().extend(symbols);
                tell_conflict(&library, lua, &mut system.ignored)
            })?;
            Ok(this.again())
        });
        methods.add_function("subsystem", |lua, (this, arguments): (UserDataRef<Self>, MultiValue)| {
            let arguments: Vec<LuaValue> = arguments.into_iter().collect();
            let (library, place) = (Rc::clone(&this.library), Machine::place(lua));
            let inner = arguments.get(1).and_then(SystemHandle::index_of);
            this.declare(lua, "sub-system", |system| {
                system.add_subsystem(&library, &library.scope_at(lua), &arguments, inner, place)
            })?;
            if let Some(inner) = inner {
                this.library.systems.borrow()[inner].given.set(true);
            }
            Ok(this.again())
        });
        methods.add_function(
            "derive",
            |lua, (this, steps, group): (UserDataRef<Self>, LuaValue, LuaValue)| {
                let machine = this.library.machine().map_err(mlua::Error::external)?;
                machine.refuse_in_rules("derive").map_err(mlua::Error::external)?;
                let DeriveArguments { steps, group, time } =
                    DeriveArguments::read(&steps, &group).map_err(mlua::Error::external)?;
                let derived = machine
                    .driver
                    .derive(&machine, this.index, DerivationRequest { steps, group: group.as_deref(), time })
                    .map_err(|error| mlua::Error::external(error.at(Machine::place(lua))))?;
                Ok(DerivedHandle(derived))
            },
        );
        methods.add_meta_function("__newindex", |_, (_, name): (LuaValue, String)| -> mlua::Result<()> {
            let help = match &*name {
                "axiom" | "rule" | "interpret" | "decompose" => format!("call it: system:{name}(...)"),
                _ => "pass object, interpret and seed to lsystem".to_owned(),
            };
            Err(mlua::Error::external(
                Error::script(format!("cannot assign `{name}` of a system")).help(help),
            ))
        });
        methods.add_meta_function("__index", |_, (_, name): (LuaValue, String)| -> mlua::Result<()> {
            let message = format!("unknown method `{name}` of a system");
            let known = SYSTEM.part_names();
            let error = Error::not_found("method", &name, known.iter().copied(), message);
            Err(mlua::Error::external(error.help(remedy_of_system_method(&name, &known))))
        });
    }
}

impl SystemHandle {
    /// Returns the index of the system in the script, for an object that uses its rules.
    pub(crate) fn give(&self) -> usize {
        self.library.systems.borrow()[self.index].given.set(true);
        self.index
    }

    /// Returns the index of a system, if `value` is one.
    fn index_of(value: &LuaValue) -> Option<usize> {
        let LuaValue::UserData(data) = value else { return None };
        data.borrow::<Self>().ok().map(|handle| handle.index)
    }

    fn again(&self) -> Self {
        Self { library: Rc::clone(&self.library), index: self.index }
    }
}
