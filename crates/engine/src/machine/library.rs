//! Global names of scripts: `module`, `lsystem`, `param`, `require`, objects, and the standard library.

use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use mlua::{Function, Lua, Table, Value as LuaValue, Variadic};
use rustc_hash::{FxHashMap, FxHashSet};

use super::freeze::freeze_function;
use super::system::{EagerMark, SystemDeclaration, install_lazy, undeclared_letters};
use super::table_classes::declare_class;
use super::types::{Extension, ScriptTypeEntry, install_functions, install_kind};
use super::variables::VariableTable;
use super::{Machine, native};
use crate::declare::{Param, Session, Setting};
use crate::placeholders::{self, FRAGMENT, QUERY};
use burgeon_base::error::{Error, Result, SourcePlace};
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_kit::{Construct, Kind, ObjectContent, Registry, color_bytes};
use burgeon_language::LOCKED;
use burgeon_language::analysis::Globals;
use burgeon_packages::Package;
use burgeon_rewriting::{NameScope, Signature, Symbol, Symbols};

/// Bytecode of the standard library.
static STANDARD_COMPILED: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/stdlib.bytecode"));

/// Interpretation by the standard library, in all systems with an object of type `kind`.
pub(crate) struct StandardInterpretation {
    pub kind: String,
    pub symbol: Symbol,
    /// Index of the method, which is called with the parameters of the module.
    pub method: usize,
}

/// Names of the required packages by package; `None` is the script.
type RequiredPackages = BTreeMap<Option<Arc<str>>, BTreeSet<Arc<str>>>;

/// Declarations of a machine's script.
#[derive(Default)]
pub(crate) struct Library {
    pub symbols: RefCell<Symbols>,
    pub systems: RefCell<Vec<SystemDeclaration>>,
    pub standard: RefCell<Vec<StandardInterpretation>>,
    /// Module of the standard library that cuts branches.
    pub cut: Cell<Option<Symbol>>,
    pub problems: RefCell<Vec<Error>>,
    /// Location of each module's declaration.
    pub places: RefCell<FxHashMap<Symbol, SourcePlace>>,
    /// Constructors of modules, by symbol.
    pub constructors: RefCell<FxHashMap<Symbol, Function>>,
    /// Files that are being required, from the main file on.
    pub(super) loading: RefCell<Vec<PathBuf>>,
    pub(super) loaded: RefCell<FxHashMap<PathBuf, LuaValue>>,
    /// Rust and C functions that rules may reach, by address.
    pub stateless: RefCell<FxHashSet<usize>>,
    /// Names of the standard library's functions.
    functions: RefCell<Vec<String>>,
    standard_chunk: RefCell<Option<Function>>,
    names: RefCell<Vec<String>>,
    modules: RefCell<FxHashMap<String, Signature>>,
    /// Object types of the run, and types that the script has declared so far.
    pub registry: RefCell<Registry>,
    /// Object types by the address of their constructor.
    constructed: RefCell<FxHashMap<usize, Arc<Kind>>>,
    /// Functions of the types that the script declared.
    pub script_types: RefCell<Vec<ScriptTypeEntry>>,
    pub extensions: RefCell<Vec<Extension>>,
    /// Variables of systems.
    pub variables: RefCell<Vec<VariableTable>>,
    /// Names of the object constructors.
    kinds: RefCell<Vec<String>>,
    /// First declaration of each parameter, with its location.
    params: RefCell<Vec<(Param, Option<SourcePlace>)>>,
    /// Packages that files have required, by package; `None` is the script.
    pub(super) required: RefCell<RequiredPackages>,
    machine: RefCell<Option<std::rc::Weak<Machine>>>,
}

impl Library {
    /// Returns the names that scripts can use without declaring them.
    pub(crate) fn globals(&self) -> Globals {
        let machine = self.machine().ok();
        let session = machine.as_ref().map(|machine| &machine.session);
        let (shapes, deprecated) = session
            .map(|session| (Arc::clone(&session.shapes), Arc::clone(session.deprecated_names())))
            .unwrap_or_default();
        Globals {
            checks_calls: session.is_some_and(|session| session.options.check),
            names: self.names.borrow().clone(),
            modules: self.modules.borrow().clone(),
            kinds: self.kinds.borrow().clone(),
            value_methods: self.value_methods(),
            deprecated,
            shapes,
        }
    }

    /// Returns the methods of objects that never change.
    fn value_methods(&self) -> FxHashSet<String> {
        let registry = self.registry.borrow();
        let values = registry.kinds().filter(|kind| kind.has_capability::<dyn ObjectContent>());
        values.flat_map(|kind| kind.methods.iter().map(|method| method.name.to_string())).collect()
    }

    /// Creates the library of a script that has not run.
    pub(crate) fn new() -> Self {
        Self { symbols: RefCell::new(placeholders::symbols()), ..Self::default() }
    }

    /// Returns the machine of this library. Fails until the machine is complete.
    pub(crate) fn machine(&self) -> Result<std::rc::Rc<Machine>> {
        let machine = self.machine.borrow().as_ref().and_then(std::rc::Weak::upgrade);
        machine.ok_or_else(|| Error::internal("not available while the machine is being created"))
    }

    pub(crate) fn set_machine(&self, machine: &std::rc::Rc<Machine>) {
        *self.machine.borrow_mut() = Some(std::rc::Rc::downgrade(machine));
    }

    /// Records that `constructor` makes objects of type `kind`.
    pub(super) fn note_constructor(&self, constructor: &Function, kind: &Arc<Kind>) {
        self.constructed.borrow_mut().insert(constructor.to_pointer() as usize, Arc::clone(kind));
    }

    /// Returns the type of the objects that `constructor` makes, if it is an object constructor.
    pub(super) fn kind_of(&self, constructor: &Function) -> Option<Arc<Kind>> {
        self.constructed.borrow().get(&(constructor.to_pointer() as usize)).cloned()
    }

    /// Returns the name scope of the line that is being run.
    pub(crate) fn scope_at(&self, lua: &Lua) -> NameScope {
        match self.machine() {
            Ok(machine) => self.scope_of(Machine::asker(lua, &machine.session)),
            Err(_) => NameScope::default(),
        }
    }

    /// Returns the scope of a query; `None` without packages, because then module names are unique.
    pub(crate) fn question_scope<'a>(
        &self,
        session: &'a Session,
        asker: impl FnOnce(&'a Session) -> Option<&'a Package>,
    ) -> Option<Arc<NameScope>> {
        let has_packages = !session.packages().order().is_empty();
        has_packages.then(|| Arc::new(self.scope_of(asker(session))))
    }

    /// Returns the name scope of a package, or of the script.
    pub(crate) fn scope_of(&self, package: Option<&Package>) -> NameScope {
        let package: Option<Arc<str>> = package.map(|package| package.manifest.name.as_str().into());
        let required = self.required.borrow().get(&package).cloned().unwrap_or_default();
        NameScope { package, required }
    }

    /// Returns the value of a parameter for this run, from options, preset or default.
    pub(super) fn param_value(&self, param: &Param) -> Result<Setting> {
        let machine = self.machine()?;
        let session = &machine.session;
        let values = &session.options.params;
        let name = param.short_name();
        let is_set = |name: &str| {
            let preset = values.preset.iter().flat_map(|preset| &preset.params);
            values.set.iter().any(|(known, _)| known == name)
                || preset.into_iter().any(|(known, _)| known == name)
        };
        if !is_set(name) {
            return param.given(&values.set, values.preset.as_ref(), false);
        }
        let params = self.params.borrow();
        let others = || {
            params
                .iter()
                .map(|(other, _)| other)
                .filter(|other| other.short_name() == name && other.package != param.package)
        };
        match param.package {
            // The name denotes the script's own parameter, even if it is declared later.
            Some(_) if session.declares_own(name) => param.given(&values.set, values.preset.as_ref(), false),
            Some(_) => match others().find(|other| other.package.is_some()) {
                Some(other) => Err(Param::ambiguous(&[other, param])),
                None => param.given(&values.set, values.preset.as_ref(), true),
            },
            // Static analysis did not find this declaration, so the value may have gone to a package before.
            None => match others().find(|other| !is_set(&other.name) && !session.declares_own(name)) {
                Some(other) => {
                    let owner = other.package.as_deref().unwrap_or("a package");
                    Err(Error::argument(format!("{name} is a parameter of the script and of {owner}"))
                        .help(format!("set the parameter of {owner} too: --set {}=VALUE", other.name)))
                }
                None => param.given(&values.set, values.preset.as_ref(), false),
            },
        }
    }

    /// Adds a parameter, or warns that the name is already declared. An equal declaration in another file, or
    /// in the same line again, shares the parameter.
    pub(super) fn add_param(&self, param: Param, place: Option<SourcePlace>) -> Result<()> {
        let machine = self.machine()?;
        let mut params = self.params.borrow_mut();
        if let Some((known, first)) = params.iter().find(|(known, _)| known.name == param.name) {
            let files = [first, &place].map(|place| place.as_ref().map(|place| &place.file));
            let shared = *known == param && (*first == place || files[0] != files[1]);
            if !shared {
                let first = first.as_ref().map_or_else(String::new, |first| format!(" in {first}"));
                let text = format!(
                    "the parameter {} is already declared{first}, and users see only that declaration",
                    param.name
                );
                let help = "declare it once and reuse its value, or rename this one";
                machine.warn(Warning::new(WarningKind::ParameterTwice, text).at(place).help(help));
            }
            return Ok(());
        }
        let own = place.as_ref().is_none_or(|place| Path::new(&place.file) == machine.session.script());
        machine.session.add_param(Param { own, ..param.clone() });
        params.push((param, place));
        Ok(())
    }

    /// Fails if rules are running, because `what` is allowed only at the top level. The standard library
    /// always runs at the top level.
    pub(super) fn at_top_level(&self, what: &str) -> Result<()> {
        self.machine()?.refuse_in_rules(what)
    }

    /// Fails while rules or interpretations run, because only the top level and hooks can call `what`.
    pub(super) fn outside_rules(&self, what: &str) -> Result<()> {
        let machine = self.machine()?;
        if machine.runs_hook() { Ok(()) } else { machine.refuse_in_rules(what) }
    }

    /// Sets the globals of the machine and runs the standard library.
    pub(crate) fn install(&self, machine: &Machine) -> Result<()> {
        self.install_names(machine).map_err(|error| machine.translate(error))?;
        self.install_pending(machine).map_err(|error| machine.translate(error))?;
        self.note_names(machine.lua());
        let (name, chunk) = match machine.session.stdlib() {
            None => ("stdlib.lua", machine.load_compiled(STANDARD_COMPILED)?),
            Some((name, text)) => (name, machine.load(name, text)?),
        };
        let mark = |begins: bool| machine.prelude().begin_standard.call::<()>(begins);
        mark(true).map_err(|error| machine.translate(error))?;
        let exports: LuaValue = chunk.call(()).map_err(|error| machine.translate(error))?;
        mark(false).map_err(|error| machine.translate(error))?;
        let LuaValue::Table(exports) = exports else {
            return Err(Error::script(format!("{name} does not return a table"))
                .help("end it with return { name = value, ... }"));
        };
        let globals = machine.lua().globals();
        for pair in exports.pairs::<String, LuaValue>() {
            let (name, value) = pair.map_err(|_| {
                Error::script(format!("{name} returns a table with keys that are not names"))
                    .help("return { name = value, ... }")
            })?;
            if name.starts_with(char::is_lowercase) {
                self.functions.borrow_mut().push(name.clone());
            }
            globals.raw_set(name, value).map_err(|error| machine.translate(error))?;
        }
        self.standard_chunk.replace(Some(chunk));
        for name in [
            "__interpretation",
            "__cut",
            "__class",
            "__letters",
            "__refuse",
            "__describe",
            "__freeze",
            "__color",
            "__modules_of_parts",
        ] {
            globals.raw_set(name, LuaValue::Nil).map_err(|error| machine.translate(error))?;
        }
        self.note_names(machine.lua());
        self.note_functions(&globals);
        let mut symbols = self.symbols.borrow_mut();
        symbols.end_of_standard();
        *self.modules.borrow_mut() = symbols
            .names()
            .filter_map(|name| Some((name.to_owned(), symbols.signature(symbols.find(name).ok()?).clone())))
            .collect();
        Ok(())
    }

    /// Creates the constructors of placeholder modules.
    fn install_pending(&self, machine: &Machine) -> mlua::Result<()> {
        let symbols = self.symbols.borrow();
        let [query, fragment] = [QUERY, FRAGMENT].map(|symbol| machine.constructor(&symbols, symbol));
        machine.prelude().pending.call((query?, fragment?))
    }

    /// Compiles the standard library to native code once a script that names one of its functions is loaded.
    pub(crate) fn prepare_functions(&self, lua: &Lua, text: &str) -> mlua::Result<()> {
        if self.functions.borrow().iter().any(|name| text.contains(name))
            && let Some(chunk) = self.standard_chunk.take()
        {
            native(lua, &chunk)?;
        }
        Ok(())
    }

    /// Records the Rust and C functions of all scripts as stateless.
    fn note_functions(&self, globals: &Table) {
        let mut known = self.stateless.borrow_mut();
        for pair in globals.pairs::<LuaValue, LuaValue>().flatten() {
            match pair.1 {
                LuaValue::Function(function) => {
                    known.insert(function.to_pointer() as usize);
                }
                LuaValue::Table(inner) => {
                    for (_, value) in inner.pairs::<LuaValue, LuaValue>().flatten() {
                        if let LuaValue::Function(function) = value {
                            known.insert(function.to_pointer() as usize);
                        }
                    }
                }
                _ => {}
            }
        }
    }

    fn note_names(&self, lua: &Lua) {
        let mut names: Vec<String> = lua
            .globals()
            .pairs::<String, LuaValue>()
            .filter_map(|pair| pair.ok())
            .map(|(name, _)| name)
            .filter(|name| !name.starts_with("__"))
            .collect();
        names.sort();
        *self.names.borrow_mut() = names;
    }

    fn install_names(&self, machine: &Machine) -> mlua::Result<()> {
        let lua = machine.lua();
        let globals = lua.globals();
        for name in LOCKED {
            globals.raw_set(name, LuaValue::Nil)?;
        }
        let math: Table = globals.raw_get("math")?;
        for name in ["random", "randomseed", "noise"] {
            math.raw_set(name, LuaValue::Nil)?;
        }
        for pair in machine.prelude().globals.pairs::<String, LuaValue>() {
            let (name, value) = pair?;
            globals.raw_set(name, value)?;
        }
        for (library, name, own) in
            [("string", "format", "format"), ("coroutine", "resume", "resume"), ("math", "lerp", "lerp")]
        {
            globals.raw_get::<Table>(library)?.raw_set(name, globals.raw_get::<LuaValue>(own)?)?;
            globals.raw_set(own, LuaValue::Nil)?;
        }
        self.install_plain(machine, &globals)?;
        self.install_systems(machine, &globals)?;
        self.install_files(machine, &globals)?;
        self.install_api(machine, &globals)?;
        lua.set_app_data(EagerMark(Arc::clone(&machine.session)));
        install_lazy(lua, self)?;
        self.registry.borrow_mut().clone_from(&machine.session.options.registry);
        for kind in machine.session.options.registry.kinds() {
            install_kind(machine, &globals, kind)?;
            install_functions(machine, kind, &globals)?;
            if matches!(kind.construct, Construct::Fields(_)) {
                self.kinds.borrow_mut().push(kind.name.to_string());
            }
        }
        let library = std::rc::Rc::clone(&machine.library);
        globals.raw_set(
            "__interpretation",
            lua.create_function(move |_, (kind, module, method): (String, String, String)| {
                let symbol = library.symbols.borrow().find(&module).map_err(mlua::Error::external)?;
                // If the run does not have this type, no system draws with it.
                let registry = library.registry.borrow();
                let Some(known) = registry.get(&kind) else { return Ok(()) };
                let method = known.methods.iter().position(|known| known.name == method);
                let method = method.ok_or_else(|| {
                    mlua::Error::external(Error::internal(format!("{kind} has no such method")))
                })?;
                library.standard.borrow_mut().push(StandardInterpretation { kind, symbol, method });
                Ok(())
            })?,
        )?;
        let library = std::rc::Rc::clone(&machine.library);
        globals.raw_set(
            "__cut",
            lua.create_function(move |_, module: String| {
                let symbol = library.symbols.borrow().find(&module).map_err(mlua::Error::external)?;
                library.cut.set(Some(symbol));
                library.symbols.borrow_mut().reserve(symbol);
                Ok(())
            })?,
        )?;
        let library = std::rc::Rc::clone(&machine.library);
        globals.raw_set(
            "__letters",
            lua.create_function(move |lua, (patterns, strings): (Vec<String>, Vec<String>)| {
                let scope = library.scope_at(lua);
                let letters = undeclared_letters(&patterns, &strings, &library.symbols.borrow(), &scope);
                let lists = letters.map_err(mlua::Error::external)?.into_iter().map(|letter| {
                    let required = letter.required;
                    let parameters = letter.parameters.into_iter().enumerate();
                    let parameters =
                        parameters.map(|(index, name)| if index < required { name } else { name + "?" });
                    std::iter::once(letter.name).chain(parameters).collect::<Vec<String>>()
                });
                Ok(lists.collect::<Vec<_>>())
            })?,
        )?;
        globals.raw_set("__freeze", freeze_function(lua)?)?;
        globals.raw_set("__color", lua.create_function(|_, text: String| Ok(read_color(&text)))?)?;
        globals.raw_set(
            "__class",
            lua.create_function(
                |lua, (name, metatable, make, fields): (String, Table, Option<Function>, Variadic<String>)| {
                    make.iter().try_for_each(|make| native(lua, make))?;
                    declare_class(lua, name, metatable, make, fields.into())
                },
            )?,
        )
    }
}

/// Returns the channels of a colour as text, from 0 to 1: red, green, blue and opacity. Otherwise returns the nearest name, if one
/// is similar.
fn read_color(text: &str) -> (Option<Vec<f64>>, Option<&'static str>) {
    match color_bytes(text) {
        Ok(bytes) => (Some(bytes.iter().map(|byte| f64::from(*byte) / 255.0).collect()), None),
        Err(near) => (None, near),
    }
}
