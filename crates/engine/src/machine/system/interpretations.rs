//! Interpretation rules of a system: their declaration, their numbers, and their functions in a machine.

use std::sync::Arc;

use super::SystemDeclaration;
use crate::machine::Machine;
use crate::machine::convert::to_lua;
use crate::machine::library::Library;
use crate::machine::row_tables::argument_places;
use crate::machine::types::ScriptTypeEntry;
use burgeon_base::error::SourcePlace;
use burgeon_kit::{Object, ScriptType, Value};
use burgeon_rewriting::{CLOSE, END, Grammar, OPEN, PatternValue, Region, Rule, Symbol};

use super::ignored::IgnoredModules;
use super::subsystems::RegionOpener;
use mlua::{Function, Lua, Table};

/// Interpretation rule as a script declares it.
#[derive(Clone)]
pub(crate) struct DeclaredInterpretation {
    pub(crate) rule: Rule,
    pub(crate) guard: Option<Function>,
    /// Modules that the contexts of this rule skip, if they are not those of the system.
    pub(crate) ignored: Option<IgnoredModules>,
    pub(crate) function: Function,
}

impl DeclaredInterpretation {
    /// Returns the interpretation for a region of its system.
    pub(super) fn in_region(&self, region: Region) -> Self {
        let own = self.clone();
        Self { rule: own.rule.in_region(region), ..own }
    }
}

/// Interpretation of modules, equal in all machines.
///
/// The numbers of interpretation rules are those of their declarations. Then follow the numbers of the symbols with
/// several candidates, and those of hooks.
#[derive(Debug, Clone, Default)]
pub(crate) struct Interpretations {
    /// Number of the interpretation rule, of the candidates or of the hook by symbol, or `u16::MAX`, for each region.
    pub by_symbol: Vec<u16>,
    /// Method of the standard library by symbol, [`RESCALE`](Self::RESCALE) or `u16::MAX`, for each region.
    pub methods: Vec<u16>,
    /// Number of symbols.
    symbols: usize,
    /// Modules that open regions.
    pub openers: Vec<RegionOpener>,
    /// Interpretations by number.
    pub list: Vec<Interpretation>,
    /// Number of the hook that runs at the start of a chain, or `u16::MAX`.
    pub begin: u16,
    /// Candidates of the symbols with contexts, guards or weights.
    candidates: Vec<SymbolCandidates>,
    /// Interpretation rules for matching contexts, if any of them has contexts.
    pub grammar: Option<Arc<Grammar>>,
}

impl Interpretations {
    /// Method that stands for the scale of a region.
    pub(crate) const RESCALE: u16 = u16::MAX - 1;

    /// Returns the index of a symbol of a region in `by_symbol` and `methods`.
    #[inline]
    pub(crate) fn place_of(&self, region: Region, symbol: Symbol) -> usize {
        usize::from(region) * self.symbols + usize::from(symbol)
    }

    /// Returns the index of the first symbol of the region of each interpretation, by its number.
    fn region_bases(&self, lua: &Lua) -> mlua::Result<Table> {
        let bases = lua.create_table()?;
        for (place, number) in self.by_symbol.iter().enumerate().filter(|(_, number)| **number != u16::MAX) {
            let symbol = place % self.symbols;
            // Hooks have no region.
            if symbol > usize::from(END) {
                bases.raw_set(*number, place - symbol)?;
            }
        }
        Ok(bases)
    }
}

/// Interpretation rules of a symbol among which contexts, guards and weights choose.
#[derive(Debug, Clone)]
struct SymbolCandidates {
    region: Region,
    symbol: Symbol,
    /// Number among the interpretations.
    number: u16,
    rules: Vec<u16>,
}

/// Interpretation rule or hook, equal in all machines.
#[derive(Debug, Clone)]
pub(crate) struct Interpretation {
    /// Number of parameters that the rule takes from the module.
    pub bound: usize,
    /// Pattern of the rule.
    pub name: String,
    /// Location of the declaration.
    pub place: Option<SourcePlace>,
    /// Set if the number stands for several candidates, which are counted themselves.
    pub is_choice: bool,
}

/// Returns true if a rule always applies to its symbol.
pub(crate) fn is_unconditional(rule: &Rule) -> bool {
    !rule.has_contexts() && !rule.tests_modules() && rule.weight.is_none() && !rule.guarded
}

fn number(index: usize) -> u16 {
    u16::try_from(index).unwrap_or(u16::MAX)
}

impl SystemDeclaration {
    /// Returns the interpretation of modules.
    pub(crate) fn interpretations(&self, library: &Library) -> Interpretations {
        let arities = library.symbols.borrow().arities();
        let count = arities.len() * self.regions();
        let mut found = Interpretations {
            by_symbol: vec![u16::MAX; count],
            methods: vec![u16::MAX; count],
            symbols: arities.len(),
            openers: self.openers().to_vec(),
            begin: u16::MAX,
            ..Interpretations::default()
        };
        let Some(object) = &self.object else { return found };
        for standard in library.standard.borrow().iter().filter(|known| object.kind().is_a(&known.kind)) {
            let methods = found.methods.iter_mut().skip(usize::from(standard.symbol)).step_by(arities.len());
            methods.for_each(|method| *method = number(standard.method));
        }
        self.add_rules(&mut found, &arities);
        for opener in self.openers().iter().filter(|opener| opener.scale.is_some()) {
            let methods = found.methods.iter_mut().skip(usize::from(opener.symbol)).step_by(arities.len());
            methods.for_each(|method| *method = Interpretations::RESCALE);
        }
        self.add_hooks(&mut found, object);
        let rules = || self.interpretations.iter().map(|known| &known.rule);
        if rules().any(Rule::has_contexts) {
            let symbols = Arc::new(library.symbols.borrow().clone());
            let with_ignored = |known: &DeclaredInterpretation| {
                let rule = known.rule.clone();
                match self.ignored_by(&known.rule, &known.ignored) {
                    Some(ignored) => rule.ignoring(ignored.among(&symbols)),
                    None => rule,
                }
            };
            let rules = self.interpretations.iter().map(with_ignored).collect();
            let ignored = self.ignored.among(&symbols);
            let grammar = Grammar::new(symbols, rules, &ignored, false).with_ring(self.ring);
            found.grammar = Some(Arc::new(grammar));
        }
        found
    }

    /// Adds the interpretation rules, and the candidates of symbols whose rule depends on the module.
    fn add_rules(&self, found: &mut Interpretations, arities: &[u8]) {
        let mut candidates: Vec<SymbolCandidates> = Vec::new();
        for (index, DeclaredInterpretation { rule, .. }) in (0u16..).zip(&self.interpretations) {
            found.list.push(Interpretation {
                bound: rule.pattern.own_bound(),
                name: rule.pattern.text.clone(),
                place: rule.place.clone(),
                is_choice: false,
            });
            let (region, symbol) = (rule.region(), rule.pattern.symbol);
            match candidates.iter_mut().find(|known| (known.region, known.symbol) == (region, symbol)) {
                Some(known) => known.rules.push(index),
                None => {
                    candidates.push(SymbolCandidates { region, symbol, number: index, rules: vec![index] })
                }
            }
        }
        for mut known in candidates {
            let (symbol, first) = (found.place_of(known.region, known.symbol), usize::from(known.number));
            found.methods[symbol] = u16::MAX;
            if known.rules.len() > 1 || !is_unconditional(&self.interpretations[first].rule) {
                known.number = number(found.list.len());
                let Interpretation { name, place, .. } = found.list[first].clone();
                let bound = usize::from(arities[usize::from(known.symbol)]);
                found.list.push(Interpretation { bound, name, place, is_choice: true });
                found.by_symbol[symbol] = known.number;
                found.candidates.push(known);
            } else {
                found.by_symbol[symbol] = known.number;
            }
        }
    }

    /// Adds the hooks of the object's type.
    fn add_hooks(&self, found: &mut Interpretations, object: &Arc<dyn Object>) {
        let kind = object.kind();
        let Some(script) = ScriptType::of(kind) else { return };
        let mut add = |what: &str, bound| {
            let (name, place) = (format!("{}: {what}", kind.name), self.place.clone());
            found.list.push(Interpretation { bound, name, place, is_choice: false });
            number(found.list.len() - 1)
        };
        let (begin, end) = (add("begin", 1), add("finish", 1));
        let [opens, closes] = script.branches;
        let open = if opens { add("push", 0) } else { u16::MAX };
        let close = if closes { add("pop", 0) } else { u16::MAX };
        found.begin = begin;
        for symbols in found.by_symbol.chunks_mut(found.symbols) {
            symbols[usize::from(END)] = end;
            symbols[usize::from(OPEN)] = open;
            symbols[usize::from(CLOSE)] = close;
        }
    }

    /// Sets the interpretation rules of this system in `machine`, whose object has the type `of` if a script has
    /// declared it.
    pub(super) fn enter_interpretations(
        &self,
        machine: &Machine,
        of: Option<&ScriptTypeEntry>,
    ) -> mlua::Result<()> {
        let (lua, prelude) = (machine.lua(), machine.prelude());
        let known = self.interpretations(&machine.library);
        let symbols = machine.library.symbols.borrow();
        let rules = lua.create_table()?;
        for (symbol, rule) in known.by_symbol.iter().enumerate().filter(|(_, rule)| **rule != u16::MAX) {
            if !known.list[usize::from(*rule)].is_choice {
                rules.raw_set(symbol, *rule)?;
            }
        }
        if self.regions() > 1 {
            rules.raw_set("bases", known.region_bases(lua)?)?;
        }
        let standards = lua.create_table()?;
        if let Some(object) = &self.object {
            for standard in machine.library.standard.borrow().iter() {
                if object.kind().is_a(&standard.kind) {
                    let entry = lua.create_table()?;
                    entry.raw_set("method", standard.method)?;
                    entry.raw_set("parameters", symbols.signature(standard.symbol).arity())?;
                    entry.raw_set("arguments", object.kind().methods[standard.method].arguments.len())?;
                    standards.raw_set(standard.symbol, entry)?;
                }
            }
        }
        prelude.interpretations.call::<()>((rules, standards, self.max_depth))?;
        if self.object.is_none() {
            return Ok(());
        }
        for (index, DeclaredInterpretation { rule, function, .. }) in self.interpretations.iter().enumerate()
        {
            let places = argument_places(lua, &rule.pattern, &symbols)?;
            prelude.interpreter.call::<()>((index, function, rule.pattern.own_bound(), places))?;
        }
        for SymbolCandidates { region, symbol, number, rules } in &known.candidates {
            let list = lua.create_table()?;
            let mut most = 0;
            for rule in rules {
                most = most.max(self.interpretations[usize::from(*rule)].rule.arguments());
                list.raw_push(self.candidate(machine, *rule)?)?;
            }
            let arity = symbols.signature(*symbol).arity();
            let place = known.place_of(*region, *symbol);
            prelude.candidates.call::<()>((*number, *symbol, place, arity, list, most))?;
        }
        let Some(of) = of else { return Ok(()) };
        let (begin, end, open, close): (Function, Function, Function, Function) =
            prelude.hooks.call(&of.table)?;
        let of_symbol = |symbol: Symbol| known.by_symbol[usize::from(symbol)];
        for (number, hook, bound) in [
            (known.begin, begin, 1),
            (of_symbol(END), end, 1),
            (of_symbol(OPEN), open, 0),
            (of_symbol(CLOSE), close, 0),
        ] {
            if number != u16::MAX {
                prelude.interpreter.call::<()>((number, hook, bound))?;
            }
        }
        Ok(())
    }

    /// Returns an interpretation rule for `prelude/interpretation.luau`, which chooses among candidates.
    fn candidate(&self, machine: &Machine, number: u16) -> mlua::Result<Table> {
        let DeclaredInterpretation { rule, guard, .. } = &self.interpretations[usize::from(number)];
        let pattern = &rule.pattern;
        let candidate = machine.lua().create_table()?;
        candidate.raw_set("rule", number)?;
        candidate.raw_set("weight", rule.weight)?;
        candidate.raw_set("guard", guard.as_ref())?;
        candidate.raw_set("has_contexts", rule.has_contexts())?;
        candidate.raw_set("count", rule.arguments())?;
        candidate.raw_set("left", pattern.left_bound())?;
        let item = pattern.predecessors.first();
        let places = item.into_iter().flat_map(|item| item.bound_places());
        candidate.raw_set("places", machine.lua().create_sequence_from(places)?)?;
        let values = machine.lua().create_table()?;
        for (place, value) in item.into_iter().flat_map(|item| &item.values) {
            let value = match value {
                PatternValue::Stored(value) => machine.session.values.unpack(value.pack()),
                PatternValue::Text(text) => Value::Text(Arc::clone(text)),
            };
            let required = machine.lua().create_table()?;
            required.raw_set("place", *place)?;
            required.raw_set("value", to_lua(machine.lua(), &value, false)?)?;
            values.raw_push(required)?;
        }
        candidate.raw_set("values", values)?;
        Ok(candidate)
    }
}
