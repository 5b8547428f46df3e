//! Modules of which each depends on others of the same step, and the calls that rewrite many of them.

use crate::batch::NO_RULE;
use crate::chain::{END, Symbol};
use crate::dependent_rules::DependentRules;
use crate::grammar::Grammar;
use crate::rules::{Applications, RuleFailure, Rules};
use crate::step_number::StepNumber;
use crate::successors::{ModuleOrder, Successors};
use burgeon_base::ModuleKey;

/// Modules whose rules are chosen and applied in one call, because each can depend on the successor of a module before it.
///
/// Each module has a neighbour: the module that contexts in the new chain see. The call tries rules whose other contexts match,
/// and applies the first whose context in the new chain is the neighbour and whose guard holds. The result is the neighbour of
/// later modules, or the neighbour of the module itself if contexts see no module of the result.
#[derive(Debug)]
pub struct DependentModules<'a> {
    /// Grammar with the rules.
    pub grammar: &'a Grammar,
    /// Contexts of the rules in the new chain.
    pub rules: &'a DependentRules,
    /// For each module: the index of its neighbour in `neighbours`, the index of the module itself in `neighbours`, and the
    /// number of trials up to its last.
    pub modules: &'a [[u32; 3]],
    /// Rules to try, in order: number of the rule, and index of its first argument.
    pub trials: &'a [[u32; 2]],
    /// Arguments of all trials. Those of contexts in the new chain are not yet set.
    pub arguments: &'a [f64],
    /// Symbol and index of the first value of each neighbour. The first is [`NO_NEIGHBOUR`](Self::NO_NEIGHBOUR); modules are
    /// as before the step, or [`SKIPPED`](Self::SKIPPED).
    pub neighbours: &'a [[u32; 2]],
    /// Parameters of neighbours.
    pub values: &'a [f64],
    /// Chain of each module; empty if there is only one chain.
    pub chains: &'a [u32],
    /// Random key of each module; empty if no rule uses random numbers.
    pub keys: &'a [ModuleKey],
    /// Index of each module in the chain; empty unless [`StepPlan::notes_places`](crate::StepPlan::notes_places) is set.
    pub places: &'a [u32],
    /// Number of the step that is running.
    pub step: &'a StepNumber,
}

impl DependentModules<'_> {
    /// Neighbour of a module without neighbour.
    pub const NO_NEIGHBOUR: [u32; 2] = [END as u32, 0];
    /// Symbol of a module that contexts skip: if it is kept, its neighbour is that of the module.
    pub const SKIPPED: u32 = u32::MAX;

    /// Returns module number `at` as an application of `rule`.
    fn application<'a>(&'a self, at: usize, rule: u16, arguments: &'a [f64]) -> Applications<'a> {
        Applications {
            rule,
            count: 1,
            arguments,
            chains: self.chains.get(at..=at).unwrap_or_default(),
            keys: self.keys.get(at..=at).unwrap_or_default(),
            places: self.places.get(at..=at).unwrap_or_default(),
            weighted: false,
            step: self.step,
            times: &[],
        }
    }
}

/// Chooses and applies the rules of `modules` with one call of `rules` for each function. See [`Rules::apply_dependents`].
pub(crate) fn apply_one_by_one<R: Rules + ?Sized>(
    rules: &R,
    modules: &DependentModules<'_>,
    made: &mut Successors,
    chosen: &mut Vec<u32>,
) -> Result<(), RuleFailure> {
    let mut work = OneByOne {
        neighbours: modules.neighbours.to_vec(),
        values: modules.values.to_vec(),
        arguments: modules.arguments.to_vec(),
        ..OneByOne::default()
    };
    work.one.draws = made.draws;
    made.clear();
    chosen.clear();
    let mut first = 0;
    for (at, [_, _, end]) in modules.modules.iter().enumerate() {
        chosen.push(u32::from(NO_RULE));
        let trials = &modules.trials[first..*end as usize];
        first = *end as usize;
        work.apply_first(rules, modules, at, trials, chosen).map_err(|error| RuleFailure { at, ..error })?;
        work.add_to(made, modules, at);
    }
    made.draws = work.one.draws;
    Ok(())
}

/// State of a call that rewrites one module after the other.
#[derive(Default)]
struct OneByOne {
    neighbours: Vec<[u32; 2]>,
    values: Vec<f64>,
    arguments: Vec<f64>,
    /// Successor of the current module.
    one: Successors,
    holds: Vec<u32>,
    arranged: ModuleOrder,
    symbols: Vec<Symbol>,
}

impl OneByOne {
    /// Applies the first of `trials` that applies to module number `at`, and sets its rule, the last of `chosen`.
    fn apply_first<R: Rules + ?Sized>(
        &mut self,
        rules: &R,
        modules: &DependentModules<'_>,
        at: usize,
        trials: &[[u32; 2]],
        chosen: &mut [u32],
    ) -> Result<(), RuleFailure> {
        self.one.clear();
        let [symbol, values] = self.neighbours[modules.modules[at][0] as usize];
        for [number, arguments] in trials {
            let [Ok(rule), Ok(symbol)] = [number, &symbol].map(|it| u16::try_from(*it)) else { continue };
            let declared = &modules.grammar.rules()[usize::from(rule)];
            let begin = *arguments as usize;
            if let Some(context) = modules.rules.context(rule).filter(|_| declared.has_new_contexts()) {
                if !context.admitted[usize::from(symbol)] {
                    continue;
                }
                let provided = &self.values[values as usize..][..context.bound];
                self.arguments[begin + context.first_argument..][..context.bound].copy_from_slice(provided);
            }
            let application =
                modules.application(at, rule, &self.arguments[begin..begin + declared.arguments()]);
            if let Some(last) = chosen.last_mut() {
                *last = *number;
            }
            if declared.guarded {
                self.holds.clear();
                rules.guard(&application, &mut self.holds)?;
                if self.holds.first().is_none_or(|holds| *holds == 0) {
                    continue;
                }
            }
            return rules.apply(&application, &mut self.one);
        }
        if let Some(last) = chosen.last_mut() {
            *last = u32::from(NO_RULE);
        }
        self.one.keep();
        Ok(())
    }

    /// Adds the successor of module number `at` to `made`, and makes it the neighbour of later modules.
    fn add_to(&mut self, made: &mut Successors, modules: &DependentModules<'_>, at: usize) {
        let [source, own, _] = modules.modules[at];
        let (source, own) = (source as usize, own as usize);
        self.one.rewind();
        self.symbols.clear();
        let arities = modules.grammar.arities();
        let first = made.params.len();
        if !self.one.read_next(arities, &mut self.arranged, &mut self.symbols, &mut made.params) {
            if self.neighbours[own][0] == DependentModules::SKIPPED {
                self.neighbours[own] = self.neighbours[source];
            }
            made.keep();
            return;
        }
        self.neighbours[own] = match modules.rules.nearest(&self.symbols) {
            Some(index) => {
                let before =
                    self.symbols[..index].iter().map(|symbol| usize::from(arities[usize::from(*symbol)]));
                let begin = self.values.len() + before.sum::<usize>();
                self.values.extend_from_slice(&made.params[first..]);
                [u32::from(self.symbols[index]), crate::batch::narrow(begin)]
            }
            None => self.neighbours[source],
        };
        made.symbols.extend_from_slice(&self.symbols);
        made.end();
    }
}
