//! Declaration of a system by a script, and its functions in one machine.

use std::cell::{Cell, RefCell};
use std::sync::Arc;

use super::DeclaredInterpretation;
use super::dependents::DependentFunctions;
use super::hooks::DeclaredHook;
use crate::machine::Machine;
use crate::machine::divisions::DivisionRule;
use crate::machine::freeze::{ReachableFunction, TableFreeze, freeze};
use crate::machine::library::Library;
use crate::machine::row_tables::argument_places;
use crate::machine::types::methods_key;
use crate::results::DerivedSystem;
use burgeon_base::error::{Error, Result, SourcePlace};
use burgeon_kit::{Call, Locate, Object, ObjectPlace};
use burgeon_rewriting::{Grammar, Region, ReturnShape, Rule, RuleFormula, Successors, Symbol};

use super::ignored::IgnoredModules;
use super::subsystems::{DeclaredSubsystem, LinkedSubsystems};
use burgeon_scene::CityClass;
use mlua::{Function, Table, Value as LuaValue};

/// Default of the maximum depth of decompositions and interpretations.
pub(super) const MAX_DEPTH: usize = 100;

/// Declaration of a system by a script.
pub(crate) struct SystemDeclaration {
    /// Object that is copied for each chain.
    pub object: Option<Arc<dyn Object>>,
    /// Set if only the last step is interpreted.
    pub last_only: bool,
    /// Class of the chains as CityJSON objects.
    pub city: Option<CityClass>,
    /// Maximum number of times that decomposition rules, or interpretations that return modules, apply one after another.
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
    pub(super) hooks: Vec<DeclaredHook>,
    /// Environments that all chains share.
    pub(crate) environments: Vec<Arc<dyn Object>>,
    /// Number of the table of variables, if the system has one.
    pub(crate) variables: Option<usize>,
    /// Modules that contexts skip.
    pub(crate) ignored: IgnoredModules,
    /// Set if the first and the last module of a chain are neighbours.
    pub(crate) ring: bool,
    pub(super) subsystems: Vec<DeclaredSubsystem>,
    /// Sub-systems whose rules follow those of the system in `rules` and `interpretations`.
    pub(super) linked: Option<LinkedSubsystems>,
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
    /// Chains of a derived system, which the derivation continues.
    Derived(Arc<DerivedSystem>),
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

/// Use of `this` by the functions of a rule.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum ReceiverUse {
    /// The functions do not read it.
    Unused,
    /// The functions ask only for the place of the module.
    Place,
    /// The functions may use it in any way.
    Any,
}

#[derive(Clone)]
pub(crate) struct DeclaredRule {
    pub(crate) rule: Rule,
    pub(crate) phase: RulePhase,
    /// Group of rules that are candidates only while the group is used; `None` for rules that always are.
    pub(crate) group: Option<Arc<str>>,
    pub(crate) guard: Option<Function>,
    /// Function that returns the propensity, if it is not a number.
    pub(crate) propensity: Option<Function>,
    /// Modules that the contexts of this rule skip, if they are not those of the system.
    pub(crate) ignored: Option<IgnoredModules>,
    /// Source text of the guard, if it is known.
    pub(crate) guard_text: Option<String>,
    pub(crate) successor: Function,
    pub(crate) receiver_use: ReceiverUse,
    /// Set if the successor does nothing but divide a shape.
    pub(crate) divides: bool,
    /// Parameters that the successor and the guard read, by number; `None` for a function that may read all.
    pub(crate) reads: [Option<Vec<usize>>; 2],
}

impl DeclaredRule {
    /// Returns the rule for a region of its system.
    pub(super) fn in_region(&self, region: Region) -> Self {
        let own = self.clone();
        Self { rule: own.rule.in_region(region), ..own }
    }

    /// Returns true if the successor or the guard may use `this`.
    fn asks(&self) -> bool {
        self.receiver_use > ReceiverUse::Unused
    }
}

/// Functions for batches of each rule.
#[derive(Default)]
struct BatchFunctions {
    drivers: Vec<Function>,
    divisions: Vec<Option<DivisionRule>>,
    guards: Vec<Option<Function>>,
    propensities: Vec<Option<Function>>,
    appliers: Vec<Function>,
}

/// Functions of a system's rules, prepared for derivation in one machine.
pub(crate) struct SystemFunctions {
    /// Function that applies each rule to a batch.
    pub drivers: Vec<Function>,
    /// Rules that only divide a shape.
    pub divisions: Vec<Option<DivisionRule>>,
    /// Function that evaluates the guard of each rule for a batch.
    pub guards: Vec<Option<Function>>,
    /// Function that evaluates the propensity of each rule for a batch.
    pub propensities: Vec<Option<Function>>,
    /// Functions for modules that depend on one another.
    pub dependents: DependentFunctions,
    /// Keeps tables that the rules can reach frozen.
    _frozen: TableFreeze,
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
            || self.environments.is_empty()
                && (self.object.as_ref().is_some_and(empties) && !self.rules.iter().any(DeclaredRule::asks))
    }

    /// Fails if the system has environments that no pass would change.
    pub(crate) fn check_environments(&self) -> Result<()> {
        if self.environments.is_empty() {
            return Ok(());
        }
        if self.object.is_none() {
            return Err(Error::argument("lsystem: a system with an environment needs an object")
                .help("add object = turtle(), whose interpretations change the environment"));
        }
        if self.last_only {
            return Err(Error::argument(
                "lsystem: interpret is \"last\", but rules read the environment after each step",
            )
            .help("leave interpret out"));
        }
        Ok(())
    }

    /// Returns true if a rule of `phase` may use `this`.
    pub(crate) fn asks_in(&self, phase: RulePhase) -> bool {
        self.rules.iter().any(|declared| declared.phase == phase && declared.asks())
    }

    /// Returns for each of `symbols` symbols whether its rules may read where the object is; empty if none does, or if the
    /// object has no place.
    pub(crate) fn located_symbols(&self, symbols: usize) -> Vec<bool> {
        let moves = |object: &Arc<dyn Object>| object.kind().has_capability::<dyn Locate>();
        if !self.object.as_ref().is_some_and(moves) || !self.rules.iter().any(DeclaredRule::asks) {
            return Vec::new();
        }
        let mut located = vec![false; symbols];
        for declared in self.rules.iter().filter(|declared| declared.asks()) {
            located[usize::from(declared.rule.pattern.symbol)] = true;
        }
        located
    }

    /// Returns true if rules use `this` only to ask for the place of their module, and the object itself answers.
    pub(crate) fn asks_places_only(&self) -> bool {
        let answers = |object: &Arc<dyn Object>| {
            let kind = object.kind();
            let own = |name: &&str| {
                let method = kind.methods.iter().find(|method| method.name == **name);
                method.is_some_and(|method| matches!(method.call, Call::Read(_)))
            };
            object.base().is_none()
                && kind.has_capability::<dyn Locate>()
                && ObjectPlace::METHODS.iter().all(own)
        };
        self.object.as_ref().is_some_and(answers)
            && self.rules.iter().all(|declared| declared.receiver_use < ReceiverUse::Any)
    }

    /// Returns true if a rule applies in `phase`.
    pub(crate) fn has_rules_in(&self, phase: RulePhase) -> bool {
        self.rules.iter().any(|declared| declared.phase == phase)
    }

    /// Returns a part of the system that an object which applies its rules would not use, and the remedy.
    pub(crate) fn unfit_for_objects(&self) -> Option<(&'static str, &'static str)> {
        if self.has_rules_in(RulePhase::Decomposition) {
            Some(("decomposition rules", "declare the rules with system:rule"))
        } else if self.rules.iter().any(|declared| declared.group.is_some()) {
            Some(("groups of rules", "declare the rules without a group"))
        } else if self.rules.iter().any(|declared| declared.rule.propensity().is_some()) {
            Some(("propensities", "use weights, or derive a system of its own"))
        } else if self.variables.is_some() {
            Some(("variables", "pass values in parameters of modules"))
        } else if !self.environments.is_empty() {
            Some(("environments", "pass values in parameters of modules"))
        } else if !self.subsystems.is_empty() {
            Some(("sub-systems", "declare all rules in one system"))
        } else if !self.hooks.is_empty() {
            Some(("hooks", "calculate before the system is passed to the object"))
        } else {
            None
        }
    }

    /// Returns the names of the groups of rules, in the order of declaration.
    pub(crate) fn groups(&self) -> Vec<Arc<str>> {
        let mut groups: Vec<Arc<str>> = Vec::new();
        for group in self.rules.iter().filter_map(|declared| declared.group.as_ref()) {
            if !groups.contains(group) {
                groups.push(Arc::clone(group));
            }
        }
        groups
    }

    /// Returns the rules of a phase in the form that machines share. The numbers of rules are those of all phases. Rules of
    /// groups other than `group` are no candidates. Fails if the candidates cannot be applied in one step.
    pub(crate) fn grammar(
        &self,
        library: &Library,
        random: bool,
        phase: RulePhase,
        group: Option<&str>,
    ) -> Result<Grammar> {
        let symbols = Arc::new(library.symbols.borrow().clone());
        let ignored = self.ignored.among(&symbols);
        // Weights of interpretation rules draw from the keys of modules, too.
        let random = random || self.interpretations.iter().any(|known| known.rule.weight.is_some());
        let machine = library.machine()?;
        let completed = |declared: &DeclaredRule| {
            let mut rule = declared.rule.clone();
            if let Some(guard) = &declared.guard
                && let Some((mut condition, _)) = self.formulas_of(&machine, guard)
                && let (Some(condition), true) = (condition.pop(), condition.is_empty())
            {
                rule = rule.with_condition(condition);
            }
            if let Some((parameters, Some(shape))) = self.formulas_of(&machine, &declared.successor) {
                rule = rule.with_production(shape, parameters);
            }
            match self.ignored_by(&declared.rule, &declared.ignored) {
                Some(ignored) => rule.ignoring(ignored.among(&symbols)),
                None => rule,
            }
        };
        let rules = self.rules.iter().map(completed).collect();
        let openers: Vec<(Symbol, Region)> =
            self.openers().iter().map(|opener| (opener.symbol, opener.region)).collect();
        let grammar =
            Grammar::new(symbols, rules, &ignored, random).with_ring(self.ring).with_regions(&openers);
        let grammar = grammar.with_candidates(|number| {
            let declared = &self.rules[usize::from(number)];
            declared.phase == phase && (declared.group.is_none() || declared.group.as_deref() == group)
        });
        grammar.with_compatible_rules()
    }

    /// Returns the formulas of a function that only calculates with numbers, and the shape that it returns. Only the function of an
    /// axiom can still change variables in them.
    fn formulas_of(
        &self,
        machine: &Machine,
        function: &Function,
    ) -> Option<(Vec<RuleFormula>, Option<ReturnShape>)> {
        type Found = (Option<String>, Option<Vec<f64>>, Option<usize>);
        let (code, outer, shape): Found = machine.prelude().formulas.call(function).ok()?;
        let (code, outer) = (code?, outer?);
        if !outer.is_empty() && self.changes_variables(machine) {
            return None;
        }
        let codes = code.split(';').filter(|code| !code.is_empty());
        let formulas: Vec<RuleFormula> =
            codes.map(|code| RuleFormula::read(code, &outer)).collect::<Option<_>>()?;
        let shapes = machine.current.shapes.borrow();
        let shape = shape.and_then(|number| shapes.get(number.checked_sub(Successors::SHAPE as usize)?));
        Some((formulas, shape.cloned()))
    }

    /// Prepares `machine` for deriving this system: creates the drivers and freezes reachable tables.
    pub(crate) fn prepare(&self, machine: &Machine) -> Result<SystemFunctions> {
        let mut reached = Vec::new();
        let BatchFunctions { drivers, divisions, guards, propensities, appliers } =
            self.prepare_functions(machine, &mut reached).map_err(|error| machine.translate(error))?;
        let frozen = freeze(machine.lua(), &machine.library.stateless.borrow(), reached)?;
        let dependents = DependentFunctions::new(appliers);
        Ok(SystemFunctions { drivers, divisions, guards, propensities, dependents, _frozen: frozen })
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
                metatable.raw_set("__newindex", &prelude.refuse_field)?;
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
        self.enter_interpretations(machine, of)
    }

    fn prepare_functions<'a>(
        &'a self,
        machine: &Machine,
        reached: &mut Vec<ReachableFunction<'a>>,
    ) -> mlua::Result<BatchFunctions> {
        let prelude = machine.prelude();
        let mut made = BatchFunctions::default();
        let has_dependents = self.rules.iter().any(|declared| declared.rule.has_new_contexts());
        for declared in &self.rules {
            let arity = declared.rule.arguments();
            let symbols = machine.library.symbols.borrow();
            let places = argument_places(machine.lua(), &declared.rule.pattern, &symbols)?;
            let [successor_reads, guard_reads] = &declared.reads;
            made.drivers.push(prelude.driver.call((
                &declared.successor,
                arity,
                &places,
                successor_reads.as_deref(),
            ))?);
            // Hooks can change what a rule reads, and so can other rules by variables.
            let divides = declared.divides && self.hooks.is_empty() && self.variables.is_none();
            made.divisions.push(match divides {
                true => DivisionRule::read(machine, &declared.successor, arity)?,
                false => None,
            });
            let rule = &declared.rule;
            let reach = |function: &Function| {
                ReachableFunction::of_rule(function, &*rule.pattern.text, rule.place.as_ref())
            };
            reached.push(reach(&declared.successor));
            reached.extend(declared.guard.iter().chain(&declared.propensity).map(reach));
            let guard = declared.guard.as_ref();
            if has_dependents {
                made.appliers.push(prelude.applier.call((&declared.successor, guard, arity, &places))?);
            }
            let guard =
                guard.map(|guard| prelude.guard_driver.call((guard, arity, &places, guard_reads.as_deref())));
            made.guards.push(guard.transpose()?);
            let propensity = declared.propensity.as_ref();
            let propensity = propensity.map(|it| prelude.propensity_driver.call((it, arity, &places)));
            made.propensities.push(propensity.transpose()?);
        }
        for known in self.interpretations.iter().filter(|_| self.object.is_some()) {
            let functions = std::iter::once(&known.function).chain(&known.guard);
            reached.extend(functions.map(|function| {
                ReachableFunction::of_rule(function, &*known.rule.pattern.text, known.rule.place.as_ref())
            }));
        }
        reached.extend(self.reachable_hooks());
        let types = machine.library.script_types.borrow();
        let functions =
            types.iter().flat_map(|known| known.functions.iter().map(|it| (&*known.kind.name, it)));
        let extensions = machine.library.extensions.borrow();
        for (of, known) in functions.chain(extensions.iter().map(|it| ("extend", &it.function))) {
            let name = format!("{of}: {}", known.name);
            reached.push(ReachableFunction::of_rule(&known.function, name, None));
        }
        Ok(made)
    }
}
