//! `lsystem`: what a script declares of a system, in each machine.

use std::rc::Rc;
use std::sync::Arc;

use mlua::{Function, Lua, MultiValue, Table, UserData, UserDataMethods, UserDataRef, Value as LuaValue};

use super::convert::to_value;
use super::freeze::{Frozen, Reached, freeze};
use super::handles::{DerivedHandle, ObjectHandle, methods_key};
use super::library::Library;
use super::machine::Machine;
use crate::derive::{Axiom, derive};
use crate::error::{Error, Result, nearest};
use crate::objects::{Object, Value};
use crate::rules::{CLOSE, Chain, END, FIRST_SYMBOL, Grammar, Key, OPEN, Pattern, Rule, Symbol};

/// What a script declared of one system.
pub(crate) struct System {
    /// The object that each chain gets a copy of.
    pub object: Option<Arc<dyn Object>>,
    /// Whether only the last step is interpreted.
    pub last_only: bool,
    /// Its own seed, in place of the run's.
    pub seed: Option<u64>,
    /// Its place among the systems of the script.
    pub index: usize,
    axiom: Option<DeclaredAxiom>,
    rules: Vec<DeclaredRule>,
    interpretations: Vec<DeclaredInterpretation>,
    ignored: Vec<Symbol>,
    considered: Option<Vec<Symbol>>,
}

enum DeclaredAxiom {
    Modules(Vec<LuaValue>),
    Source(LuaValue, Function),
}

struct DeclaredRule {
    rule: Rule,
    guard: Option<Function>,
    successor: Function,
}

struct DeclaredInterpretation {
    symbol: Symbol,
    bound: usize,
    rule: Function,
    name: String,
    place: Option<crate::error::Place>,
}

/// A system ready to derive in one machine: the functions that the grammar's rules run.
pub(crate) struct Declared {
    /// By rule: the function that applies it to a batch.
    pub drivers: Vec<Function>,
    /// By rule: the function that asks its guard about a batch.
    pub guards: Vec<Option<Function>>,
    /// Keeps what the rules can reach frozen.
    _frozen: Frozen,
}

/// How modules are interpreted: the same in every machine.
#[derive(Debug, Clone, Default)]
pub(crate) struct Interpretations {
    /// By symbol: the number of its interpretation rule, from 0, or `u16::MAX`.
    pub by_symbol: Vec<u16>,
    /// By symbol: the method that the standard library gives it, or `u16::MAX`.
    pub methods: Vec<u16>,
    /// By interpretation: how many parameters it takes, its name and its place.
    pub list: Vec<(usize, String, Option<crate::error::Place>)>,
}

const METHODS: [&str; 6] = ["axiom", "rule", "interpret", "ignore", "consider", "derive"];

/// A system as a script holds it.
pub(crate) struct SystemHandle {
    library: Rc<Library>,
    index: usize,
}

/// The features of a data source as a script holds them.
pub(crate) struct SourceHandle(LuaValue);

impl UserData for SourceHandle {}

impl SourceHandle {
    pub(crate) fn new(features: LuaValue) -> Result<Self> {
        match features {
            LuaValue::Table(_) => Ok(Self(features)),
            _ => Err(Error::new("source takes a list of features")
                .help("write source { { id = \"a\", ... }, ... }")),
        }
    }
}

impl SystemHandle {
    pub(crate) fn create(library: &Rc<Library>, options: Option<&Table>) -> Result<Self> {
        let mut system = System {
            object: None,
            last_only: false,
            seed: None,
            index: library.systems.borrow().len(),
            axiom: None,
            rules: Vec::new(),
            interpretations: Vec::new(),
            ignored: Vec::new(),
            considered: None,
        };
        for pair in options.into_iter().flat_map(Table::pairs::<LuaValue, LuaValue>) {
            let (key, value) = pair.map_err(|error| Error::new(error.to_string()))?;
            let key = key.to_string().unwrap_or_default();
            match (key.as_str(), value) {
                ("object", value) => system.object = Some(prototype(library, value)?),
                ("interpret", LuaValue::String(when)) if when.to_string_lossy() == "last" => {
                    system.last_only = true
                }
                ("interpret", _) => {
                    return Err(Error::new("lsystem: interpret must be \"last\"")
                        .help("leave it out to interpret after every step"));
                }
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "the range is checked"
                )]
                ("seed", value) => match to_value(&value, false)? {
                    Value::Number(seed) if seed.fract() == 0.0 && (0.0..9e15).contains(&seed) => {
                        system.seed = Some(seed as u64);
                    }
                    _ => return Err(Error::new("lsystem: seed must be a whole number from 0")),
                },
                (other, _) => {
                    let known = ["object", "interpret", "seed"];
                    let error = Error::new(format!("lsystem has no field called {other}"));
                    return Err(match nearest(other, known) {
                        Some(near) => error.help(format!("did you mean {near}?")),
                        None => error.help(format!("it has {}", known.join(", "))),
                    });
                }
            }
        }
        let index = system.index;
        library.systems.borrow_mut().push(system);
        Ok(Self { library: Rc::clone(library), index })
    }

    /// Runs a declaration; a mistake is kept, so that all of them can be told at once.
    fn declare(&self, lua: &Lua, declare: impl FnOnce(&mut System) -> Result<()>) {
        let place = Machine::place(lua);
        let rules_run = self.library.machine().and_then(|machine| machine.refuse_in_rules("a declaration"));
        if let Err(error) = rules_run {
            self.library.problems.borrow_mut().push(error.at(place));
            return;
        }
        let result = declare(&mut self.library.systems.borrow_mut()[self.index]);
        if let Err(error) = result {
            self.library.problems.borrow_mut().push(error.at(place));
        }
    }
}

/// The object of a system: one that was made, or a constructor to be called without fields.
fn prototype(library: &Library, value: LuaValue) -> Result<Arc<dyn Object>> {
    let value = match value {
        LuaValue::Function(constructor) => {
            let machine = library.machine()?;
            constructor.call::<LuaValue>(()).map_err(|error| machine.translate(error))?
        }
        value => value,
    };
    match value {
        LuaValue::UserData(data) => match data.borrow::<ObjectHandle>() {
            Ok(handle) => Ok(Arc::clone(&handle.0)),
            Err(_) => Err(Error::new("lsystem: object must be an object").help("write object = turtle()")),
        },
        _ => Err(Error::new("lsystem: object must be an object").help("write object = turtle()")),
    }
}

impl UserData for SystemHandle {
    fn add_methods<M: UserDataMethods<Self>>(methods: &mut M) {
        methods.add_function("axiom", |lua, (this, arguments): (UserDataRef<Self>, MultiValue)| {
            let arguments: Vec<LuaValue> = arguments.into_iter().collect();
            this.declare(lua, |system| system.set_axiom(arguments));
            Ok(this.again())
        });
        methods.add_function("rule", |lua, (this, arguments): (UserDataRef<Self>, MultiValue)| {
            let arguments: Vec<LuaValue> = arguments.into_iter().collect();
            let library = Rc::clone(&this.library);
            this.declare(lua, |system| system.add_rule(&library, lua, arguments));
            Ok(this.again())
        });
        methods.add_function(
            "interpret",
            |lua, (this, pattern, rule): (UserDataRef<Self>, LuaValue, LuaValue)| {
                let library = Rc::clone(&this.library);
                this.declare(lua, |system| system.add_interpretation(&library, lua, &pattern, rule));
                Ok(this.again())
            },
        );
        methods.add_function("ignore", |lua, (this, names): (UserDataRef<Self>, MultiValue)| {
            let library = Rc::clone(&this.library);
            this.declare(lua, |system| {
                let symbols = named_symbols(&library, &names)?;
                system.ignored.extend(symbols);
                Ok(())
            });
            Ok(this.again())
        });
        methods.add_function("consider", |lua, (this, names): (UserDataRef<Self>, MultiValue)| {
            let library = Rc::clone(&this.library);
            this.declare(lua, |system| {
                let symbols = named_symbols(&library, &names)?;
                system.considered.get_or_insert_default().extend(symbols);
                Ok(())
            });
            Ok(this.again())
        });
        methods.add_function("derive", |lua, (this, steps): (UserDataRef<Self>, LuaValue)| {
            let machine = this.library.machine().map_err(mlua::Error::external)?;
            machine.refuse_in_rules("derive").map_err(mlua::Error::external)?;
            let steps = match to_value(&steps, false).map_err(mlua::Error::external)? {
                Value::Nil => None,
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "the range is checked"
                )]
                Value::Number(steps) if steps.fract() == 0.0 && (0.0..1e9).contains(&steps) => {
                    Some(steps as usize)
                }
                other => {
                    return Err(mlua::Error::external(
                        Error::new(format!("derive takes a whole number of steps from 0, not {other}"))
                            .help("leave it out to derive until no rule applies"),
                    ));
                }
            };
            let derived = derive(&machine, this.index, steps)
                .map_err(|error| mlua::Error::external(error.at(Machine::place(lua))))?;
            Ok(DerivedHandle(derived))
        });
        methods.add_meta_function("__newindex", |_, (_, name): (LuaValue, String)| -> mlua::Result<()> {
            Err(mlua::Error::external(
                Error::new(format!("a system has no field {name} to assign"))
                    .help("its object, interpret and seed are given to lsystem"),
            ))
        });
        methods.add_meta_function("__index", |_, (_, name): (LuaValue, String)| -> mlua::Result<()> {
            let error = Error::new(format!("a system has no method called {name}"));
            Err(mlua::Error::external(match nearest(&name, METHODS) {
                Some(near) => error.help(format!("did you mean {near}?")),
                None => error.help(format!("it has {}", METHODS.join(", "))),
            }))
        });
    }
}

impl SystemHandle {
    fn again(&self) -> Self {
        Self { library: Rc::clone(&self.library), index: self.index }
    }
}

fn named_symbols(library: &Library, names: &MultiValue) -> Result<Vec<Symbol>> {
    let symbols = library.symbols.borrow();
    let mut found = Vec::new();
    for name in names {
        match name {
            LuaValue::String(text) => {
                for name in text.to_string_lossy().split_whitespace() {
                    found.push(symbols.find(name)?);
                }
            }
            _ => {
                return Err(
                    Error::new("ignore and consider take names of modules").help("write ignore(\"Turn\")")
                );
            }
        }
    }
    Ok(found)
}

impl System {
    fn set_axiom(&mut self, mut arguments: Vec<LuaValue>) -> Result<()> {
        let is_source =
            matches!(arguments.first(), Some(LuaValue::UserData(data)) if data.is::<SourceHandle>());
        if is_source {
            let (Some(LuaValue::Function(function)), 2) = (arguments.get(1).cloned(), arguments.len()) else {
                return Err(Error::new(
                    "axiom(source, function) takes a function that makes each feature's chain",
                ));
            };
            self.axiom = Some(DeclaredAxiom::Source(arguments.swap_remove(0), function));
        } else {
            self.axiom = Some(DeclaredAxiom::Modules(arguments));
        }
        Ok(())
    }

    fn add_rule(&mut self, library: &Library, lua: &Lua, mut arguments: Vec<LuaValue>) -> Result<()> {
        let usage = "write system:rule(\"A(x)\", function(this, x) return ... end)";
        let Some(LuaValue::String(text)) = arguments.first().cloned() else {
            return Err(Error::new("a rule begins with a pattern").help(usage));
        };
        let pattern = Pattern::parse(&text.to_string_lossy(), &library.symbols.borrow())?;
        let name = pattern.text.clone();
        let named = |error: Error| error.rule(&name);
        let options = match (arguments.len(), arguments.get(1)) {
            (3, Some(LuaValue::Table(options))) => Some(options.clone()),
            (3, _) => {
                return Err(named(
                    Error::new("the options of a rule are a table").help("write { weight = 2 }"),
                ));
            }
            (2, _) => None,
            (count, _) => {
                return Err(named(
                    Error::new(format!("rule takes 2 or 3 arguments, not {count}")).help(usage),
                ));
            }
        };
        let (weight, guard) = match options {
            Some(options) => rule_options(&options, pattern.formals.len()).map_err(named)?,
            None => (None, None),
        };
        let place = Machine::place(lua);
        let successor = match arguments.pop() {
            Some(LuaValue::Function(function)) => {
                check_parameters(&function, &pattern, "the successor").map_err(named)?;
                function
            }
            Some(LuaValue::String(body)) => {
                compile_successor(library, &pattern, &body.to_string_lossy(), place.as_ref())
                    .map_err(named)?
            }
            other => {
                let what = other.map_or("nothing", |value| value.type_name());
                return Err(named(
                    Error::new(format!("the successor must be a function or a string, not {what}"))
                        .help(usage),
                ));
            }
        };
        if let Some(guard) = &guard {
            check_parameters(guard, &pattern, "the guard").map_err(named)?;
        }
        let rule = Rule::new(pattern, weight, guard.is_some(), place);
        self.rules.push(DeclaredRule { rule, guard, successor });
        Ok(())
    }

    fn add_interpretation(
        &mut self,
        library: &Library,
        lua: &Lua,
        pattern: &LuaValue,
        rule: LuaValue,
    ) -> Result<()> {
        let usage = "write system:interpret(\"A(x)\", function(this, x) ... end)";
        let LuaValue::String(text) = pattern else {
            return Err(Error::new("an interpretation begins with a pattern").help(usage));
        };
        let pattern = Pattern::parse(&text.to_string_lossy(), &library.symbols.borrow())?;
        let name = pattern.text.clone();
        if !pattern.left.is_empty() || !pattern.right.is_empty() {
            return Err(Error::new("an interpretation has no contexts")
                .rule(&name)
                .help("contexts are for rules; carry what is needed in a parameter of the module"));
        }
        let LuaValue::Function(rule) = rule else {
            return Err(Error::new("an interpretation needs a function").rule(&name).help(usage));
        };
        check_parameters(&rule, &pattern, "the interpretation").map_err(|error| error.rule(&name))?;
        let item = pattern.predecessor;
        if let Some(known) = self.interpretations.iter().find(|known| known.symbol == item.symbol) {
            let line = known.place.as_ref().map_or(String::new(), |place| format!(" in line {}", place.line));
            return Err(Error::new(format!("{name} is interpreted already{line}"))
                .rule(&name)
                .help("a module has one interpretation; join the two functions"));
        }
        self.interpretations.push(DeclaredInterpretation {
            symbol: item.symbol,
            bound: item.bound,
            rule,
            name,
            place: Machine::place(lua),
        });
        Ok(())
    }

    /// Whether every interpretation pass begins with empty objects, so that earlier passes leave no trace.
    pub(crate) fn draws_afresh(&self) -> bool {
        self.object.as_ref().is_none_or(|object| object.begins_empty())
    }

    /// The rules as they can be shared between machines.
    pub(crate) fn grammar(&self, library: &Library, random: bool) -> Grammar {
        let symbols = Arc::new(library.symbols.borrow().clone());
        let ignored = match &self.considered {
            Some(considered) => (FIRST_SYMBOL..)
                .take(symbols.names().count())
                .filter(|symbol| !considered.contains(symbol) || self.ignored.contains(symbol))
                .collect(),
            None => self.ignored.clone(),
        };
        let rules = self.rules.iter().map(|declared| declared.rule.clone()).collect();
        Grammar::new(symbols, rules, &ignored, random)
    }

    /// How modules are interpreted.
    pub(crate) fn interpretations(&self, library: &Library) -> Interpretations {
        let symbols = library.symbols.borrow().arities().len();
        let (mut by_symbol, mut methods) = (vec![u16::MAX; symbols], vec![u16::MAX; symbols]);
        let mut list = Vec::new();
        if let Some(object) = &self.object {
            for standard in library.standard.borrow().iter().filter(|known| known.kind == object.kind().name)
            {
                methods[usize::from(standard.symbol)] = u16::try_from(standard.method).unwrap_or(u16::MAX);
            }
            for (index, known) in (0u16..).zip(&self.interpretations) {
                by_symbol[usize::from(known.symbol)] = index;
                methods[usize::from(known.symbol)] = u16::MAX;
                list.push((known.bound, known.name.clone(), known.place.clone()));
            }
        }
        Interpretations { by_symbol, methods, list }
    }

    /// Prepares `machine` for deriving this system: drivers, interpretation rules, `this`, frozen tables.
    pub(crate) fn prepare(&self, machine: &Machine) -> Result<Declared> {
        let mut reached = Vec::new();
        let (drivers, guards) =
            self.prepare_functions(machine, &mut reached).map_err(|error| machine.translate(error))?;
        let frozen = freeze(machine.lua(), &machine.library.stateless.borrow(), &reached)?;
        Ok(Declared { drivers, guards, _frozen: frozen })
    }

    fn prepare_functions(
        &self,
        machine: &Machine,
        reached: &mut Vec<Reached>,
    ) -> mlua::Result<(Vec<Function>, Vec<Option<Function>>)> {
        let prelude = machine.prelude();
        let lua = machine.lua();
        let mut drivers = Vec::new();
        let mut guards = Vec::new();
        // `this` must be known before any driver runs.
        let this = match &self.object {
            Some(object) => {
                *machine.current.methods.borrow_mut() = object.kind().methods.iter().collect();
                let this = lua.create_table()?;
                let metatable = lua.create_table()?;
                let methods: Table = lua.named_registry_value(&methods_key(object.kind().name))?;
                metatable.raw_set("__index", methods)?;
                metatable.raw_set("__metatable", "this")?;
                this.set_metatable(Some(metatable))?;
                this.set_readonly(true);
                LuaValue::Table(this)
            }
            None => LuaValue::Nil,
        };
        prelude.set_this.call::<()>(this)?;
        for declared in &self.rules {
            let arity = declared.rule.arguments();
            drivers.push(prelude.driver.call((&declared.successor, arity))?);
            let reach = |function: &Function| Reached {
                function: function.clone(),
                name: declared.rule.pattern.text.clone(),
                place: declared.rule.place.clone(),
            };
            reached.push(reach(&declared.successor));
            guards.push(match &declared.guard {
                Some(guard) => {
                    reached.push(reach(guard));
                    Some(prelude.guard_driver.call((guard, arity))?)
                }
                None => None,
            });
        }
        prelude.fresh_interpreters.call::<()>(())?;
        if self.object.is_some() {
            for (index, known) in self.interpretations.iter().enumerate() {
                prelude.interpreter.call::<()>((index, &known.rule, known.bound))?;
                reached.push(Reached {
                    function: known.rule.clone(),
                    name: known.name.clone(),
                    place: known.place.clone(),
                });
            }
        }
        Ok((drivers, guards))
    }

    /// In a machine that only helps: runs the function that makes each feature's chain, for what it changes.
    pub(crate) fn replay_axiom(&self, machine: &Machine) -> Result<()> {
        match &self.axiom {
            Some(DeclaredAxiom::Source(..)) => self.axiom(machine, Key::default(), false).map(|_| ()),
            _ => Ok(()),
        }
    }

    /// Makes the first chains: one from modules, or one for each feature.
    pub(crate) fn axiom(&self, machine: &Machine, key: Key, random: bool) -> Result<Axiom> {
        let mut axiom = Axiom::default();
        let mut builder = Builder { machine, chain: &mut axiom.chain, random };
        match &self.axiom {
            None => return Err(Error::new("the system has no axiom").help("write system:axiom(A(1))")),
            Some(DeclaredAxiom::Modules(modules)) => {
                builder.list(modules, key)?;
                builder.push(END, &[], key);
                axiom.objects.extend(self.object.as_ref().map(|object| object.boxed()));
                axiom.features.push(None);
            }
            Some(DeclaredAxiom::Source(source, function)) => {
                self.features(machine, source, function, key, random, &mut axiom)?
            }
        }
        Ok(axiom)
    }

    fn features(
        &self,
        machine: &Machine,
        source: &LuaValue,
        function: &Function,
        key: Key,
        random: bool,
        axiom: &mut Axiom,
    ) -> Result<()> {
        let LuaValue::UserData(data) = source else { return Ok(()) };
        let handle = data.borrow::<SourceHandle>().map_err(|error| machine.translate(error))?;
        let LuaValue::Table(features) = &handle.0 else { return Ok(()) };
        for (index, feature) in features.sequence_values::<LuaValue>().enumerate() {
            let feature = feature.map_err(|error| machine.translate(error))?;
            let id = match &feature {
                LuaValue::Table(feature) => match feature.raw_get::<LuaValue>("id") {
                    Ok(LuaValue::Nil) | Err(_) => (index + 1).to_string(),
                    Ok(id) => id.to_string().unwrap_or_default(),
                },
                _ => (index + 1).to_string(),
            };
            let key = key.feature(&id);
            let made: MultiValue = function.call(feature).map_err(|error| machine.translate(error))?;
            let mut made: Vec<LuaValue> = made.into_iter().collect();
            let own = match made.first() {
                Some(LuaValue::UserData(data)) => {
                    data.borrow::<ObjectHandle>().ok().map(|handle| Arc::clone(&handle.0))
                }
                _ => None,
            };
            if own.is_some() {
                made.remove(0);
            }
            let object = own.or_else(|| self.object.clone());
            if let (Some(object), Some(expected)) = (&object, &self.object)
                && object.kind().name != expected.kind().name
            {
                return Err(Error::new(format!(
                    "feature {id} got a {} where the system's object is a {}",
                    object.kind().name,
                    expected.kind().name
                )));
            }
            axiom.objects.extend(object.map(|object| object.boxed()));
            axiom.features.push(Some(id));
            let mut builder = Builder { machine, chain: &mut axiom.chain, random };
            builder.list(&made, key)?;
            builder.push(END, &[], key);
        }
        Ok(())
    }
}

/// Writes modules that were made outside of rules into a chain.
struct Builder<'a> {
    machine: &'a Machine,
    chain: &'a mut Chain,
    random: bool,
}

impl Builder<'_> {
    fn push(&mut self, symbol: Symbol, params: &[f64], key: Key) {
        self.chain.symbols.push(symbol);
        self.chain.params.extend_from_slice(params);
        if self.random {
            self.chain.keys.push(key);
        }
    }

    fn list(&mut self, items: &[LuaValue], key: Key) -> Result<()> {
        let mut ordinal = 0;
        self.items(items, key, &mut ordinal, 0)
    }

    fn items(&mut self, items: &[LuaValue], key: Key, ordinal: &mut usize, depth: usize) -> Result<()> {
        for item in items {
            let LuaValue::Table(table) = item else {
                return Err(Error::new(format!(
                    "an axiom is made of modules, but one item is a {}",
                    item.type_name()
                ))
                .help("write system:axiom(A(1), { B() })"));
            };
            let is_module = self
                .machine
                .prelude()
                .is_module
                .call::<bool>(table)
                .map_err(|error| self.machine.translate(error))?;
            if !is_module {
                if depth > 200 {
                    return Err(Error::new(
                        "branches are nested more than 200 deep, or a branch contains itself",
                    ));
                }
                let inner: Vec<LuaValue> = table
                    .sequence_values()
                    .collect::<mlua::Result<_>>()
                    .map_err(|error| self.machine.translate(error))?;
                self.push(OPEN, &[], key);
                self.items(&inner, key, ordinal, depth + 1)?;
                self.push(CLOSE, &[], key);
                continue;
            }
            let read = |index: usize| {
                table.raw_get::<LuaValue>(index).map_err(|error| self.machine.translate(error))
            };
            let symbol = match read(1)? {
                LuaValue::Integer(symbol) => Symbol::try_from(symbol).unwrap_or(END),
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "written by the prelude"
                )]
                LuaValue::Number(symbol) => symbol as Symbol,
                _ => END,
            };
            let arity = self.machine.library.symbols.borrow().signature(symbol).arity();
            let mut params = Vec::with_capacity(arity);
            for index in 0..arity {
                params.push(self.machine.session.values.pack(to_value(&read(index + 3)?, true)?));
            }
            self.push(symbol, &params, key.child(*ordinal));
            *ordinal += 1;
        }
        Ok(())
    }
}

fn rule_options(options: &Table, _arity: usize) -> Result<(Option<f64>, Option<Function>)> {
    let (mut weight, mut guard) = (None, None);
    for pair in options.pairs::<LuaValue, LuaValue>() {
        let (key, value) = pair.map_err(|error| Error::new(error.to_string()))?;
        let key = key.to_string().unwrap_or_default();
        match (key.as_str(), value) {
            ("weight", value) => match to_value(&value, false)? {
                Value::Number(number) if number > 0.0 && number.is_finite() => weight = Some(number),
                other => {
                    return Err(Error::new(format!("weight must be a number above 0, not {other}")));
                }
            },
            ("when", LuaValue::Function(function)) => guard = Some(function),
            ("when", other) => {
                return Err(Error::new(format!("when must be a function, not a {}", other.type_name()))
                    .help("write { when = function(this, x) return x > 0 end }"));
            }
            (other, _) => {
                let error = Error::new(format!("a rule has no option called {other}"));
                return Err(match nearest(other, ["weight", "when"]) {
                    Some(near) => error.help(format!("did you mean {near}?")),
                    None => error.help("it has weight and when"),
                });
            }
        }
    }
    Ok((weight, guard))
}

/// Refuses a function that takes more parameters than the pattern gives.
fn check_parameters(function: &Function, pattern: &Pattern, what: &str) -> Result<()> {
    let info = function.info();
    let given = pattern.formals.len() + 1;
    let taken = usize::from(info.num_params);
    if taken > given {
        let formals = std::iter::once("this").chain(pattern.formals.iter().map(String::as_str));
        let formals: Vec<&str> = formals.collect();
        return Err(Error::new(format!("{what} takes {taken} parameters, but the pattern gives {given}"))
            .help(format!("write function({})", formals.join(", "))));
    }
    Ok(())
}

/// Compiles a successor given as a string of Lua, with the formal parameters, `this` and all modules in scope.
fn compile_successor(
    library: &Library,
    pattern: &Pattern,
    body: &str,
    place: Option<&crate::error::Place>,
) -> Result<Function> {
    let machine = library.machine()?;
    let (file, line) = place.map_or(("rule", 1), |place| (place.file.as_str(), place.line));
    let symbols = library.symbols.borrow();
    let mentioned: Vec<(Symbol, &str)> = (FIRST_SYMBOL..)
        .zip(symbols.names())
        .filter(|(symbol, name)| {
            symbols.find(name).is_ok_and(|known| known == *symbol) && mentions(body, name)
        })
        .collect();
    let mut text = "\n".repeat(line.saturating_sub(1));
    for (symbol, name) in mentioned {
        let signature = symbols.signature(symbol);
        let parameters: String = signature
            .parameters
            .iter()
            .enumerate()
            .map(|(index, name)| format!(", \"{name}{}\"", if index < signature.required { "" } else { "?" }))
            .collect();
        // The analysis learns the signature from this call; it declares the same module again.
        text.push_str(&format!("local {name} = module(\"{name}\"{parameters}) "));
    }
    let formals: String = pattern.formals.iter().map(|formal| format!(", {formal}")).collect();
    text.push_str(&format!("local __system = nil; __system:rule(\"\", function(this{formals}) {body}\nend)"));
    drop(symbols);
    let analysis = super::analysis::analyse(file, &text, &library.globals());
    machine.session.note(&analysis);
    let problems: Vec<Error> =
        analysis.problems.into_iter().filter(|problem| !problem.message().contains("__system")).collect();
    if !problems.is_empty() {
        return Err(Error::several(problems));
    }
    let text = analysis.text.replacen("local __system = nil; __system:rule(\"\", ", "return (", 1);
    let chunk = machine.load(file, &text)?;
    chunk.call(()).map_err(|error| machine.translate(error))
}

/// Whether `name` stands in `text` as a whole word.
fn mentions(text: &str, name: &str) -> bool {
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    text.match_indices(name)
        .any(|(at, _)| !text[..at].ends_with(is_word) && !text[at + name.len()..].starts_with(is_word))
}
