//! Declaration of a system by a script, and its functions in one machine.

use std::cell::{Cell, RefCell};
use std::sync::Arc;

use crate::machine::Machine;
use crate::machine::freeze::{ReachableFunction, TableFreeze, freeze};
use crate::machine::library::Library;
use crate::machine::questions::argument_places;
use crate::machine::types::methods_key;
use burgeon_base::error::{Result, SourcePlace};
use burgeon_kit::{Object, ScriptType};
use burgeon_rewriting::{CLOSE, END, FIRST_SYMBOL, Grammar, OPEN, Pattern, Rule, Symbol};
use burgeon_scene::CityClass;
use mlua::{Function, Table, Value as LuaValue};

/// Default of the maximum depth of decompositions.
pub(super) const MAX_DEPTH: usize = 100;

/// Declaration of a system by a script.
pub(crate) struct SystemDeclaration {
    /// Object that is copied for each chain.
    pub object: Option<Arc<dyn Object>>,
    /// Set if only the last step is interpreted.
    pub last_only: bool,
    /// Class of the chains as CityJSON objects.
    pub city: Option<CityClass>,
    /// Maximum number of times that decomposition rules apply one after another.
    pub max_depth: usize,
    /// Seed of the system, if it overrides the seed of the run.
    pub seed: Option<u64>,
    /// Index among the systems of the script.
    pub index: usize,
    /// Location where the system was created.
    pub place: Option<SourcePlace>,
    /// Line of the script from which that location was called.
    pub caller: Option<SourcePlace>,
    /// Location where the axiom was set.
    pub axiom_place: Option<SourcePlace>,
    pub(crate) axiom: Option<DeclaredAxiom>,
    pub(crate) rules: Vec<DeclaredRule>,
    pub(crate) interpretations: Vec<DeclaredInterpretation>,
    pub(crate) ignored: Vec<Symbol>,
    pub(crate) considered: Option<Vec<Symbol>>,
    /// Record of each derivation.
    pub(crate) derivations: RefCell<Vec<DerivationRecord>>,
    /// Declarations since the last derivation, with their locations.
    pub(crate) late: RefCell<Vec<(&'static str, Option<SourcePlace>)>>,
    /// Set if the axiom was set since the last derivation.
    pub(crate) axiom_is_new: Cell<bool>,
    /// Set if the script passed the system to an object.
    pub(crate) given: Cell<bool>,
}

/// Record of one derivation of a system.
pub(crate) struct DerivationRecord {
    pub(crate) place: Option<SourcePlace>,
    /// Number among the derivations of the script.
    pub(crate) number: usize,
    /// Set if the derivation began from a new axiom.
    pub(crate) axiom_is_new: bool,
}

pub(crate) enum DeclaredAxiom {
    Modules(Vec<LuaValue>),
    Source(LuaValue, Function),
}

/// Phase of a derivation in which a rule applies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum RulePhase {
    /// Once in each step.
    Rewriting,
    /// After the axiom and after each step, repeatedly.
    Decomposition,
}

impl RulePhase {
    /// All phases, in the order of a step.
    pub(crate) const ALL: [Self; 2] = [Self::Rewriting, Self::Decomposition];

    /// Returns the name of the method that declares a rule of the phase.
    pub(crate) fn method(self) -> &'static str {
        match self {
            Self::Rewriting => "rule",
            Self::Decomposition => "decompose",
        }
    }
}

pub(crate) struct DeclaredRule {
    pub(crate) rule: Rule,
    pub(crate) phase: RulePhase,
    pub(crate) guard: Option<Function>,
    /// Source text of the guard, if it is known.
    pub(crate) guard_text: Option<String>,
    pub(crate) successor: Function,
    /// Set if the successor or the guard may use `this`.
    pub(crate) asks: bool,
}

pub(crate) struct DeclaredInterpretation {
    pub(crate) pattern: Pattern,
    pub(crate) rule: Function,
    pub(crate) place: Option<SourcePlace>,
    /// Set if a warning about returned modules has been reported.
    pub(crate) loses: bool,
}

/// Functions of a system's rules, prepared for derivation in one machine.
pub(crate) struct SystemFunctions {
    /// Function that applies each rule to a batch.
    pub drivers: Vec<Function>,
    /// Function that evaluates the guard of each rule for a batch.
    pub guards: Vec<Option<Function>>,
    /// Keeps tables that the rules can reach frozen.
    _frozen: TableFreeze,
}

/// Interpretation of modules, equal in all machines.
#[derive(Debug, Clone, Default)]
pub(crate) struct Interpretations {
    /// Number of the interpretation rule by symbol, from 0, or `u16::MAX`.
    pub by_symbol: Vec<u16>,
    /// Method of the standard library by symbol, or `u16::MAX`.
    pub methods: Vec<u16>,
    /// Interpretation rules by number.
    pub list: Vec<Interpretation>,
    /// Number of the hook that runs at the start of a chain, or `u16::MAX`.
    pub begin: u16,
}

/// Interpretation rule, equal in all machines.
#[derive(Debug, Clone)]
pub(crate) struct Interpretation {
    /// Number of parameters that the rule takes.
    pub bound: usize,
    /// Pattern of the rule.
    pub name: String,
    /// Location of the declaration.
    pub place: Option<SourcePlace>,
    /// Set if a warning about returned modules has been reported.
    pub loses: bool,
}

impl SystemDeclaration {
    /// Returns true if every interpretation pass begins with empty objects, so that earlier passes have no
    /// effect.
    pub(crate) fn draws_afresh(&self) -> bool {
        self.object.as_ref().is_none_or(|object| object.kind().begins_empty)
    }

    /// Returns true if only the last pass has an effect: each pass begins with an empty object, and no rule
    /// uses `this`.
    pub(crate) fn shows_last_only(&self) -> bool {
        let empties = |object: &Arc<dyn Object>| object.kind().begins_empty && !object.expands();
        self.last_only
            || (self.object.as_ref().is_some_and(empties) && !self.rules.iter().any(|rule| rule.asks))
    }

    /// Returns true if a rule applies in `phase`.
    pub(crate) fn has_rules_in(&self, phase: RulePhase) -> bool {
        self.rules.iter().any(|declared| declared.phase == phase)
    }

    /// Returns the rules of a phase in the form that machines share. The numbers of rules are those of all phases.
    pub(crate) fn grammar(&self, library: &Library, random: bool, phase: RulePhase) -> Grammar {
        let symbols = Arc::new(library.symbols.borrow().clone());
        let ignored = match &self.considered {
            Some(considered) => (FIRST_SYMBOL..)
                .take(symbols.names().count())
                .filter(|symbol| !considered.contains(symbol) || self.ignored.contains(symbol))
                .collect(),
            None => self.ignored.clone(),
        };
        let rules = self.rules.iter().map(|declared| declared.rule.clone()).collect();
        let grammar = Grammar::new(symbols, rules, &ignored, random);
        grammar.with_candidates(|number| self.rules[usize::from(number)].phase == phase)
    }

    /// Returns the interpretation of modules.
    pub(crate) fn interpretations(&self, library: &Library) -> Interpretations {
        let symbols = library.symbols.borrow().arities().len();
        let (mut by_symbol, mut methods) = (vec![u16::MAX; symbols], vec![u16::MAX; symbols]);
        let mut list = Vec::new();
        if let Some(object) = &self.object {
            for standard in library.standard.borrow().iter().filter(|known| object.kind().is_a(&known.kind)) {
                methods[usize::from(standard.symbol)] = u16::try_from(standard.method).unwrap_or(u16::MAX);
            }
            for (index, known) in (0u16..).zip(&self.interpretations) {
                let DeclaredInterpretation { pattern, place, loses, .. } = known;
                let item = pattern.predecessor;
                by_symbol[usize::from(item.symbol)] = index;
                methods[usize::from(item.symbol)] = u16::MAX;
                list.push(Interpretation {
                    bound: item.bound,
                    name: pattern.text.clone(),
                    place: place.clone(),
                    loses: *loses,
                });
            }
        }
        let mut begin = u16::MAX;
        if let Some(kind) = self.object.as_ref().map(|object| object.kind())
            && let Some(script) = ScriptType::of(kind)
        {
            let mut add = |what: &str, bound| {
                let number = u16::try_from(list.len()).unwrap_or(u16::MAX);
                let (name, place) = (format!("{}: {what}", kind.name), self.place.clone());
                list.push(Interpretation { bound, name, place, loses: false });
                number
            };
            begin = add("begin", 1);
            by_symbol[usize::from(END)] = add("finish", 1);
            for (symbol, what, runs) in
                [(OPEN, "push", script.branches[0]), (CLOSE, "pop", script.branches[1])]
            {
                if runs {
                    by_symbol[usize::from(symbol)] = add(what, 0);
                }
            }
        }
        Interpretations { by_symbol, methods, list, begin }
    }

    /// Prepares `machine` for deriving this system: creates the drivers and freezes reachable tables.
    pub(crate) fn prepare(&self, machine: &Machine) -> Result<SystemFunctions> {
        let mut reached = Vec::new();
        let (drivers, guards) =
            self.prepare_functions(machine, &mut reached).map_err(|error| machine.translate(error))?;
        let frozen = freeze(machine.lua(), &machine.library.stateless.borrow(), &reached)?;
        Ok(SystemFunctions { drivers, guards, _frozen: frozen })
    }

    /// Switches `machine` to this system: sets `this` and the interpretation rules.
    pub(crate) fn enter(&self, machine: &Machine) -> mlua::Result<()> {
        let prelude = machine.prelude();
        let lua = machine.lua();
        let this = match &self.object {
            Some(object) => {
                machine.current.kind.replace(Some(Arc::clone(object.kind())));
                let this = lua.create_table()?;
                let metatable = lua.create_table()?;
                let methods: Table = lua.named_registry_value(&methods_key(&object.kind().name))?;
                metatable.raw_set("__index", methods)?;
                metatable.raw_set("__metatable", "this")?;
                this.set_metatable(Some(metatable))?;
                this.set_readonly(true);
                LuaValue::Table(this)
            }
            None => LuaValue::Nil,
        };
        let kind = self.object.as_ref().map(|object| object.kind());
        let types = machine.library.script_types.borrow();
        let of = kind.and_then(|kind| types.iter().find(|known| known.kind.name == kind.name));
        let name = kind.map(|kind| kind.name.to_string());
        prelude.set_this.call::<()>((this, name, of.map(|of| of.table.clone())))?;
        prelude.fresh_interpreters.call::<()>(())?;
        if self.object.is_some() {
            for (index, known) in self.interpretations.iter().enumerate() {
                let pattern = &known.pattern;
                let places = argument_places(lua, pattern, &machine.library.symbols.borrow())?;
                prelude.interpreter.call::<()>((index, &known.rule, pattern.predecessor.bound, places))?;
            }
        }
        if let Some(of) = of {
            let hooks: (Function, Function, Function, Function) = prelude.hooks.call(&of.table)?;
            let mut index = self.interpretations.len();
            let [opens, closes] = ScriptType::of(&of.kind).map_or([false; 2], |script| script.branches);
            for (hook, bound, runs) in
                [(hooks.0, 1, true), (hooks.1, 1, true), (hooks.2, 0, opens), (hooks.3, 0, closes)]
            {
                if runs {
                    prelude.interpreter.call::<()>((index, hook, bound))?;
                    index += 1;
                }
            }
        }
        Ok(())
    }

    fn prepare_functions(
        &self,
        machine: &Machine,
        reached: &mut Vec<ReachableFunction>,
    ) -> mlua::Result<(Vec<Function>, Vec<Option<Function>>)> {
        let prelude = machine.prelude();
        let mut drivers = Vec::new();
        let mut guards = Vec::new();
        for declared in &self.rules {
            let arity = declared.rule.arguments();
            let symbols = machine.library.symbols.borrow();
            let places = argument_places(machine.lua(), &declared.rule.pattern, &symbols)?;
            drivers.push(prelude.driver.call((&declared.successor, arity, &places))?);
            let reach = |function: &Function| ReachableFunction {
                function: function.clone(),
                name: declared.rule.pattern.text.clone(),
                place: declared.rule.place.clone(),
            };
            reached.push(reach(&declared.successor));
            guards.push(match &declared.guard {
                Some(guard) => {
                    reached.push(reach(guard));
                    Some(prelude.guard_driver.call((guard, arity, places))?)
                }
                None => None,
            });
        }
        for known in self.interpretations.iter().filter(|_| self.object.is_some()) {
            reached.push(ReachableFunction {
                function: known.rule.clone(),
                name: known.pattern.text.clone(),
                place: known.place.clone(),
            });
        }
        let types = machine.library.script_types.borrow();
        let functions =
            types.iter().flat_map(|known| known.functions.iter().map(|it| (&*known.kind.name, it)));
        let extensions = machine.library.extensions.borrow();
        for (of, known) in functions.chain(extensions.iter().map(|it| ("extend", &it.function))) {
            let (name, function) = (format!("{of}: {}", known.name), known.function.clone());
            reached.push(ReachableFunction { function, name, place: None });
        }
        Ok((drivers, guards))
    }
}
