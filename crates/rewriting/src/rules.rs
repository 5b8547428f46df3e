//! Functions of rules, which are called for batches of modules.

use crate::chain::Symbol;
use crate::dependents::DependentModules;
use crate::links::narrow;
use crate::step_number::StepNumber;
use crate::successors::{ModuleOrder, Successors};
use crate::text::{PlainNumbers, ShowParameters};
use burgeon_base::ModuleKey;
use burgeon_base::error::{Error, Result};

/// Rule number for a module to which no rule was applied.
pub const NO_RULE: u16 = u16::MAX;

/// Modules to which one rule is applied in one call.
#[derive(Debug)]
pub struct Applications<'a> {
    /// Number of the rule in the [`Grammar`](crate::Grammar).
    pub rule: u16,
    /// Number of applications.
    pub count: usize,
    /// Arguments of all applications, one application after the other.
    pub arguments: &'a [f64],
    /// Chain of each application; empty if there is only one chain.
    pub chains: &'a [u32],
    /// Random key of each application; empty if no rule uses random numbers.
    pub keys: &'a [ModuleKey],
    /// Index of each application's module in the chain; empty unless
    /// [`StepPlan::notes_places`](crate::StepPlan::notes_places) is set.
    pub places: &'a [u32],
    /// Set if the choice among weighted rules has consumed the first number of each stream.
    pub weighted: bool,
    /// Number of the step that is running.
    pub step: &'a StepNumber,
    /// Time of each chain; empty unless an event of a rule with a propensity occurs.
    pub times: &'a [f64],
}

/// Failure of a function.
#[derive(Debug)]
pub struct RuleFailure {
    /// Index of the application that failed.
    pub at: usize,
    /// Reason.
    pub error: Error,
}

impl From<Error> for RuleFailure {
    fn from(error: Error) -> Self {
        Self { at: 0, error }
    }
}

/// Caller of the successors and guards of a system's rules, in one thread.
///
/// Virtual machines and [closures](crate::ClosureSystem) are two implementations. The grammar determines which rule is
/// applied to which module; an implementation only calls functions, and never sees the chain.
pub trait Rules {
    /// Calls the successor of a rule for each application, in order, and adds the resulting modules to `successors`.
    fn apply(&self, applications: &Applications<'_>, successors: &mut Successors) -> Result<(), RuleFailure>;

    /// Calls the guard of a rule for each application, in order, and adds a number for each to `holds`: 0 if the guard
    /// does not hold. After a failure, `holds` contains the numbers of the applications before it.
    fn guard(&self, applications: &Applications<'_>, holds: &mut Vec<u32>) -> Result<(), RuleFailure>;

    /// Calls the propensity of a rule for each application, in order, and adds each result to `propensities`. After a failure,
    /// it contains the results of the applications before it.
    ///
    /// Only called for rules with [`Propensity::Computed`](crate::Propensity::Computed). The default fails.
    fn propensity(
        &self,
        applications: &Applications<'_>,
        propensities: &mut Vec<f64>,
    ) -> Result<(), RuleFailure> {
        let _ = (applications, propensities);
        Err(Error::argument("these rules compute no propensities").help("use constant propensities").into())
    }

    /// Chooses and applies the rules of modules of which each can depend on those before it. For each module, adds its successor
    /// to `successors`, and to `chosen` the number of the rule or [`NO_RULE`](crate::NO_RULE), with an application that keeps
    /// its module.
    ///
    /// After a failure, the last number of `chosen` is that of the rule whose function has failed. Only called if
    /// [`accepts_dependents`](Self::accepts_dependents) returns true. The default calls each function for one module at a time.
    fn apply_dependents(
        &self,
        modules: &DependentModules<'_>,
        successors: &mut Successors,
        chosen: &mut Vec<u32>,
    ) -> Result<(), RuleFailure> {
        apply_singly(self, modules, successors, chosen)
    }

    /// Returns true if the functions can be called in another order than by rules: they have no visible effects. The default
    /// returns true.
    fn accepts_dependents(&self) -> bool {
        true
    }

    /// Returns the formatter of module parameters in errors.
    fn parameters(&self) -> &dyn ShowParameters {
        &PlainNumbers
    }
}

impl<'a> Applications<'a> {
    /// Returns module number `at` as an application of `rule`.
    fn of_module(modules: &'a DependentModules<'_>, at: usize, rule: u16, arguments: &'a [f64]) -> Self {
        Self {
            rule,
            count: 1,
            arguments,
            chains: modules.chains.get(at..=at).unwrap_or_default(),
            keys: modules.keys.get(at..=at).unwrap_or_default(),
            places: modules.places.get(at..=at).unwrap_or_default(),
            weighted: false,
            step: modules.step,
            times: &[],
        }
    }
}

/// Chooses and applies the rules of `modules` with one call of `rules` for each function. See [`Rules::apply_dependents`].
fn apply_singly<R: Rules + ?Sized>(
    rules: &R,
    modules: &DependentModules<'_>,
    made: &mut Successors,
    chosen: &mut Vec<u32>,
) -> Result<(), RuleFailure> {
    let mut work = SingleCalls {
        neighbours: modules.neighbours.to_vec(),
        values: modules.values.to_vec(),
        arguments: modules.arguments.to_vec(),
        ..SingleCalls::default()
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
struct SingleCalls {
    neighbours: Vec<[u32; 2]>,
    values: Vec<f64>,
    arguments: Vec<f64>,
    /// Successor of the current module.
    one: Successors,
    holds: Vec<u32>,
    arranged: ModuleOrder,
    symbols: Vec<Symbol>,
}

impl SingleCalls {
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
            let application = Applications::of_module(
                modules,
                at,
                rule,
                &self.arguments[begin..begin + declared.arguments()],
            );
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
                [u32::from(self.symbols[index]), narrow(begin)]
            }
            None => self.neighbours[source],
        };
        made.symbols.extend_from_slice(&self.symbols);
        made.end();
    }
}
