//! Warnings about declarations without effect: unreachable rules, modules that nothing draws, and late
//! declarations.
//!
//! Each warning is certain: a declaration that can have an effect causes none.

use std::borrow::Cow;
use std::collections::BTreeSet;

use mlua::Value;
use rustc_hash::{FxHashMap, FxHashSet};

use crate::machine::Machine;
use crate::machine::freeze::captured;
use crate::machine::library::{Library, StandardInterpretation};
use crate::machine::types::object_of_system;
use crate::results::DerivedSystem;
use burgeon_base::error::SourcePlace;
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_rewriting::{
    ContextElement, FIRST_SYMBOL, Grammar, Item, Pattern, Propensity, Region, Rule, Symbol,
};

use super::{DeclaredRule, DerivationRecord, RulePhase, SystemDeclaration};

impl SystemDeclaration {
    /// Records that the system is derived with all declarations so far.
    pub(crate) fn note_derivation(&self, machine: &Machine) {
        self.derivations.borrow_mut().push(DerivationRecord {
            place: Machine::place(machine.lua()),
            number: machine.driver.count(),
            axiom_is_new: self.axiom_is_new.take(),
        });
        self.late.borrow_mut().clear();
    }

    /// Warns about interpretations that never run, and rules that never apply.
    pub(crate) fn tell_forestalled(&self, machine: &Machine, grammar: &Grammar) {
        if let (None, Some(first)) = (&self.object, self.interpretations.first()) {
            let text = "the system has no object, so its interpretations never run";
            let warning = Warning::new(WarningKind::NoObject, text);
            let warning = warning.rule(format!("{} (interpretation)", first.rule.pattern.text));
            let warning = warning.at_place(first.rule.place.as_ref());
            machine.warn(match object_of_system(&machine.library.registry.borrow()) {
                Some(object) => warning.help(format!("set an object, such as lsystem({{ {object} }})")),
                None => warning,
            });
        }
        let groups = self.groups();
        let groups = || std::iter::once(None).chain(groups.iter().map(|group| Some(&**group)));
        for region in (0..).take(self.regions()) {
            for phase in RulePhase::ALL {
                groups().for_each(|group| self.tell_forestalled_in((region, phase, group), machine, grammar));
            }
        }
    }

    /// Warns about rules of a region and a phase that never apply. `group` are the rules to which the warnings belong; rules without a group
    /// apply together with them.
    fn tell_forestalled_in(
        &self,
        (region, phase, group): (Region, RulePhase, Option<&str>),
        machine: &Machine,
        grammar: &Grammar,
    ) {
        let mut sure = CandidateRules::default();
        let mut guards = GuardClasses::default();
        let cut = machine.library.cut.get().filter(|_| phase == RulePhase::Rewriting);
        let group_of = |index: usize| self.rules[index].group.as_deref();
        let can_apply = |(index, rule): &(usize, &Rule)| {
            rule.weight != Some(0.0)
                && rule.region() == region
                && rule.propensity() != Some(Propensity::Constant(0.0))
                && self.rules[*index].phase == phase
                && (group_of(*index).is_none() || group_of(*index) == group)
        };
        for (index, rule) in grammar.rules().iter().enumerate().filter(can_apply) {
            let guard = guards.class_of(machine, &self.rules, index);
            let around = around(grammar, index);
            if group_of(index) != group {
                sure.add(rule, around, guard);
                continue;
            }
            let warn = |warning: Warning| {
                machine.warn(warning.at_place(rule.place.as_ref()).rule(&rule.pattern.text))
            };
            let earlier = sure.forestalls(rule, &around, guard);
            if let Some(symbol) =
                rule.contexts().iter().find_map(|item| skipped_symbol(grammar, number(index), item))
            {
                let name = grammar.symbols().display_name(symbol);
                let own = self.rules[index].ignored.as_ref();
                let ignored = own.unwrap_or(self.ignored_in(region));
                let (text, help) = match ignored.considered {
                    _ if own.is_some() => (
                        format!("{name} is ignored by this rule, so this context never occurs"),
                        Cow::Borrowed("change the options ignore and consider of the rule, or its context"),
                    ),
                    Some(_) if !ignored.ignored.contains(&symbol) => (
                        format!("{name} is not among the modules to consider, so this context never occurs"),
                        Cow::Owned(format!("add it: system:consider(\"{name}\")")),
                    ),
                    _ => (
                        format!("{name} is ignored, so this context never occurs"),
                        Cow::Borrowed("remove it from system:ignore(...), or from the context"),
                    ),
                };
                warn(Warning::new(WarningKind::ImpossibleContext, text).help(help));
            } else if let Some(symbol) = cut.filter(|symbol| needs(rule, *symbol)) {
                let name = grammar.symbols().display_name(symbol);
                let text = format!("{name} is erased before rules are matched, so this rule never applies");
                let help = format!("match other modules; system:decompose and system:interpret see {name}");
                warn(Warning::new(WarningKind::ImpossibleContext, text).help(help));
            } else if let Some(earlier) = earlier {
                let place = earlier.place.as_ref().map_or_else(String::new, |place| format!(" in {place}"));
                let name = &earlier.pattern.text;
                let what = if earlier.guarded {
                    "applies first and has the same guard"
                } else {
                    "always applies first"
                };
                let text = format!("this rule is never applied: {name}{place} {what}");
                let help = match earlier.weight {
                    None if earlier.guarded => {
                        "join the two rules, change the guard of one, or set a weight for both"
                    }
                    Some(_) => "set a weight for both rules: { weight = 1 }",
                    None => {
                        "add a guard to the earlier rule, set a weight for both, or put this rule before it"
                    }
                };
                warn(Warning::new(WarningKind::UnreachableRule, text).help(help));
            }
            sure.add(rule, around, guard);
        }
    }

    /// Returns warnings about `symbols` of the final chains, and those that their interpretation `returned`, that this system
    /// neither draws nor uses.
    pub(crate) fn undrawn(
        &self,
        library: &Library,
        symbols: impl Iterator<Item = Symbol>,
        returned: &BTreeSet<Symbol>,
    ) -> Vec<(Symbol, Warning)> {
        let open: Vec<(Symbol, Warning)> = (FIRST_SYMBOL..)
            .take(library.symbols.borrow().names().count())
            .filter_map(|symbol| Some((symbol, self.warning_of(library, symbol)?)))
            .collect();
        let mut occurs = vec![false; open.last().map_or(0, |(symbol, _)| usize::from(*symbol) + 1)];
        if !open.is_empty() {
            for symbol in symbols.chain(returned.iter().copied()) {
                if let Some(occurs) = occurs.get_mut(usize::from(symbol)) {
                    *occurs = true;
                }
            }
        }
        let mut found: Vec<(Symbol, Warning)> =
            open.into_iter().filter(|(symbol, _)| occurs[usize::from(*symbol)]).collect();
        found.extend(returned.iter().filter(|symbol| self.begins_subsystem(**symbol)).map(|symbol| {
            let symbols = library.symbols.borrow();
            let name = symbols.display_name(*symbol);
            let text =
                format!("{name}, which an interpretation returned, begins a sub-system only in chains");
            let warning = Warning::new(WarningKind::UndrawnModule, text).at_place(self.place.as_ref());
            (*symbol, warning.help(format!("return {name} from a rule")))
        }));
        found.sort_by_key(|(symbol, _)| *symbol);
        found
    }

    /// Returns the warning about modules with this symbol in a chain of this system, if nothing draws or uses
    /// them.
    fn warning_of(&self, library: &Library, symbol: Symbol) -> Option<Warning> {
        let of = self.object.as_ref()?.kind();
        let (kind, is_a) = (&of.name, |known: &StandardInterpretation| of.is_a(&known.kind));
        let (symbols, standard) = (library.symbols.borrow(), library.standard.borrow());
        let signature = symbols.signature(symbol);
        if self.interpretations.iter().any(|known| known.rule.pattern.symbol == symbol)
            || standard.iter().any(|known| known.symbol == symbol && is_a(known))
            || library.cut.get() == Some(symbol)
            || self.begins_subsystem(symbol)
        {
            return None;
        }
        let bare = signature.parameters.join(", ");
        let name = symbols.display_name(symbol);
        let (formals, comma) =
            if bare.is_empty() { (String::new(), "") } else { (format!("({bare})"), ", ") };
        let interpret = format!("system:interpret(\"{name}{formals}\", function(this{comma}{bare}) ... end)");
        let places = library.places.borrow();
        let place = places.get(&symbol);
        let hidden = standard.iter().find(|known| {
            known.symbol != symbol && is_a(known) && symbols.signature(known.symbol).name == signature.name
        });
        if let Some(hidden) = hidden {
            let text = format!(
                "{} replaces the standard library's {}, so the {kind} draws nothing for it",
                signature.usage(),
                symbols.signature(hidden.symbol).usage()
            );
            let help = format!("interpret it, {interpret}, or rename it");
            return Some(Warning::new(WarningKind::HiddenModule, text).help(help).at_place(place));
        }
        // Without interpretations, an object draws only modules of the standard library, if it draws any.
        let draws = !self.interpretations.is_empty() || standard.iter().any(is_a);
        let is_used = !draws
            || (0..).take(self.regions()).any(|region| self.ignored_in(region).names(symbol))
            || self.rules.iter().filter_map(|rule| rule.ignored.as_ref()).any(|own| own.names(symbol))
            || self.rules.iter().any(|declared| names(&declared.rule.pattern, symbol))
            || self.interpretations.iter().any(|declared| names(&declared.rule.pattern, symbol));
        if is_used {
            return None;
        }
        if let Some(known) = standard.iter().find(|known| known.symbol == symbol) {
            let text = format!("the standard library draws {name} only with a {}", known.kind);
            return Some(
                Warning::new(WarningKind::UndrawnModule, text).help(interpret).at_place(self.place.as_ref()),
            );
        }
        let text = format!("{name} has neither a rule nor an interpretation, so it is never drawn");
        let help = format!("{interpret}; if it is only a mark, ignore it: system:ignore(\"{name}\")");
        Some(
            Warning::new(WarningKind::UndrawnModule, text).help(help).at_place(place.or(self.place.as_ref())),
        )
    }
}

/// Predecessor and contexts, without parameter names.
#[derive(Clone, Default, PartialEq, Eq, Hash)]
struct PatternElements {
    predecessors: Vec<ContextElement>,
    /// Left and right context in the old chain, and in the new chain.
    contexts: [Vec<ContextElement>; 4],
    /// Number of the set of modules that the contexts skip.
    ignored: usize,
}

/// Number of the first rule with an equivalent guard; `None` without a guard.
type GuardClass = Option<usize>;

/// Guards so far, grouped into classes of equivalent guards.
#[derive(Default)]
struct GuardClasses {
    /// Rule numbers and captured values, by predecessor and source text of the guard.
    first: FxHashMap<(Symbol, String), Vec<CapturingGuard>>,
}

/// Number of a rule, and the values that its guard captures.
type CapturingGuard = (usize, Vec<Value>);

/// Maximum number of guards with equal text that are compared. A loop can declare thousands that capture
/// different values.
const MOST_COMPARED: usize = 64;

impl GuardClasses {
    /// Returns the class of the guard of rule `index`.
    ///
    /// Guards are equivalent if they are the same function, or if their texts, captured values and arguments
    /// are equal.
    fn class_of(&mut self, machine: &Machine, rules: &[DeclaredRule], index: usize) -> GuardClass {
        let rule = &rules[index];
        let guard = rule.guard.as_ref()?;
        let text = rule.guard_text.clone().unwrap_or_default();
        let known = self.first.entry((rule.rule.pattern.symbol, text)).or_default();
        let captures = captured(machine.lua(), guard).unwrap_or_default();
        let same = known.iter().find(|(other, of_other)| {
            let other = &rules[*other];
            bounds(&other.rule) == bounds(&rule.rule)
                && (other.guard.as_ref() == Some(guard) || rule.guard_text.is_some() && *of_other == captures)
        });
        if let Some((first, _)) = same {
            return Some(*first);
        }
        if known.len() < MOST_COMPARED {
            known.push((index, captures));
        }
        Some(index)
    }
}

/// Returns the number of parameters that a rule binds for its predecessor and for each module of its
/// contexts.
fn bounds(rule: &Rule) -> Vec<usize> {
    rule.pattern.predecessors.iter().chain(rule.contexts()).map(|item| item.bound).collect()
}

/// Rules so far that are candidates whenever their contexts match and their guards hold, by what they match.
#[derive(Default)]
struct CandidateRules<'a> {
    rules: FxHashMap<(PatternElements, GuardClass), [Option<&'a Rule>; 3]>,
    /// Symbols that have a rule with a weight.
    weighted: FxHashSet<Symbol>,
}

// Slots for rules that match the same. A rule in slot BEFORE_ALL takes precedence over all later rules. A
// rule in slot BEFORE_PLAIN has no weight, but a rule with a weight came first; it takes precedence only over
// later rules without a weight. A rule in slot WEIGHTED has a weight, and also takes precedence over later
// rules without a weight.
const BEFORE_ALL: usize = 0;
const BEFORE_PLAIN: usize = 1;
const WEIGHTED: usize = 2;

impl<'a> CandidateRules<'a> {
    /// Returns an earlier rule that always takes precedence over `rule`: without contexts or with equal
    /// contexts, and without a guard; or with equal contexts and an equivalent `guard`.
    fn forestalls(&self, rule: &Rule, around: &PatternElements, guard: GuardClass) -> Option<&'a Rule> {
        let mut anywhere = PatternElements::default();
        anywhere.predecessors.push(ContextElement::Module(rule.pattern.symbol));
        // All rules with a propensity can apply.
        if rule.propensity().is_some() {
            return None;
        }
        let last = if rule.weight.is_some() { BEFORE_ALL } else { WEIGHTED };
        let of = |around: &PatternElements, guard: GuardClass| {
            let known = self.rules.get(&(around.clone(), guard))?;
            known[BEFORE_ALL..=last].iter().flatten().next().copied()
        };
        let guarded = || guard.and_then(|guard| of(around, Some(guard)));
        of(&anywhere, None).or_else(|| of(around, None)).or_else(guarded)
    }

    fn add(&mut self, rule: &'a Rule, around: PatternElements, guard: GuardClass) {
        let symbol = rule.pattern.symbol;
        let place = match rule.weight {
            Some(_) => WEIGHTED,
            None if self.weighted.contains(&symbol) => BEFORE_PLAIN,
            None => BEFORE_ALL,
        };
        if rule.weight.is_some() {
            self.weighted.insert(symbol);
        }
        self.rules.entry((around, guard)).or_default()[place].get_or_insert(rule);
    }
}

/// Returns the elements of the pattern of rule `index`.
fn around(grammar: &Grammar, index: usize) -> PatternElements {
    let rule = number(index);
    let contexts = [
        grammar.left_of(rule),
        grammar.right_of(rule),
        grammar.new_left_of(rule),
        grammar.new_right_of(rule),
    ];
    let has_contexts = contexts.iter().any(|context| !context.is_empty());
    PatternElements {
        predecessors: grammar.predecessors_of(rule).to_vec(),
        contexts: contexts.map(<[_]>::to_vec),
        ignored: if has_contexts { grammar.ignored_set(rule) } else { 0 },
    }
}

fn number(index: usize) -> u16 {
    u16::try_from(index).unwrap_or(u16::MAX)
}

/// Returns a symbol of a context module if the contexts of a rule skip all that it matches.
fn skipped_symbol(grammar: &Grammar, rule: u16, item: &Item) -> Option<Symbol> {
    let symbols = item.symbols.listed()?;
    symbols.first().copied().filter(|_| symbols.iter().all(|symbol| grammar.is_ignored(rule, *symbol)))
}

/// Returns true if a rule applies only where a module with this symbol is.
fn needs(rule: &Rule, symbol: Symbol) -> bool {
    let mut items = rule.pattern.predecessors.iter().chain(rule.contexts());
    items.any(|item| item.symbols.listed() == Some(&[symbol]))
}

/// Returns true if a pattern names `symbol`.
fn names(pattern: &Pattern, symbol: Symbol) -> bool {
    let names = |items: &[Item]| items.iter().any(|item| item.symbols.names(symbol));
    names(&pattern.predecessors) || names(&pattern.context_items())
}

/// Warns about declarations without effect, after a script has run to its end. A script that `returns` a
/// value may be required by others.
pub(crate) fn tell_unseen(machine: &Machine, returns: bool) {
    let library = &machine.library;
    let systems = library.systems.borrow();
    let done = machine.driver.derived();
    let derived = |number: usize| done.get(number).and_then(|derived| derived.as_ref().ok());
    for system in systems.iter() {
        for (what, place) in system.late.borrow().iter() {
            let text = format!("{what} has no effect after derive");
            let warning = Warning::new(WarningKind::LateDeclaration, text).at_place(place.as_ref());
            machine.warn(warning.help("call it before system:derive()"));
        }
        if !machine.session.options.check {
            tell_derived_twice(machine, system, derived);
        }
    }
    if machine.session.options.check {
        tell_undrawn(machine, &systems);
    } else {
        for derived in done.iter().flatten().filter(|derived| !derived.is_read()) {
            let unseen = derived.undrawn.iter().filter(|(symbol, _)| !machine.session.has_asked(*symbol));
            unseen.for_each(|(_, warning)| machine.warn(warning.clone()));
        }
    }
    let first = systems.iter().find(|system| system.axiom.is_some() && !system.given.get());
    if let (true, Some(system), false) = (done.is_empty(), first, returns) {
        let warning = Warning::new(WarningKind::NotDerived, "no system is derived, so the model is empty");
        machine.warn(warning.at_place(system.place.as_ref()).help("end the script with system:derive()"));
    }
}

/// Warns about repeated derivations of a system from the same axiom, if both models are visible.
fn tell_derived_twice<'a>(
    machine: &Machine,
    system: &SystemDeclaration,
    derived: impl Fn(usize) -> Option<&'a std::sync::Arc<DerivedSystem>>,
) {
    let is_seen = |derivation: &DerivationRecord| {
        derived(derivation.number).is_some_and(|derived| !derived.is_placed() && !derived.objects.is_empty())
    };
    let derivations = system.derivations.borrow();
    let mut seen: Option<&DerivationRecord> = None;
    for derivation in derivations.iter() {
        if derivation.axiom_is_new {
            seen = None;
        }
        if !is_seen(derivation) {
            continue;
        }
        if let Some(earlier) = seen {
            let line = |place: &SourcePlace| format!(" after the time in {place}");
            let earlier = earlier.place.as_ref().map(line).unwrap_or_default();
            let text = format!("the system is derived again{earlier}, and both models are kept");
            let warning = Warning::new(WarningKind::DerivedTwice, text).at_place(derivation.place.as_ref());
            machine.warn(
                warning.help("derive it once; a model that another system places is not shown separately"),
            );
        }
        seen.get_or_insert(derivation);
    }
}

/// Warns in a check about modules that rules or axioms make and no system draws.
fn tell_undrawn(machine: &Machine, systems: &[SystemDeclaration]) {
    let (library, done) = (&machine.library, machine.driver.derived());
    let symbols = done.iter().flatten().flat_map(|derived| derived.chain.symbols.iter().copied());
    let mut made: Vec<Symbol> = symbols.collect();
    made.extend(machine.current.shapes.borrow().iter().flat_map(|shape| shape.symbols.iter().copied()));
    made.sort_unstable();
    made.dedup();
    let asked = machine.session.queried_words();
    made.retain(|symbol| {
        *symbol >= FIRST_SYMBOL
            && !machine.session.has_asked(*symbol)
            && !asked.contains(&library.symbols.borrow().signature(*symbol).name)
    });
    for symbol in made {
        let mut of_systems = systems.iter().map(|system| system.warning_of(library, symbol));
        // If one system draws the module or uses it otherwise, the module may belong to that system.
        if let Some(Some(first)) = of_systems.next()
            && of_systems.all(|warning| warning.is_some())
        {
            machine.warn(first);
        }
    }
}
