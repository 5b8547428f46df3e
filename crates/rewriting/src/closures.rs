//! Systems whose rules are closures.

use std::cell::Cell;
use std::sync::Arc;

use crate::chain::{CLOSE, Chain, DEEPEST, END, OPEN, Symbol};
use crate::events::EventSeries;
use crate::grammar::{Grammar, MOST_RULES};
use crate::ordinals::Ordinals;
use crate::pattern::Pattern;
use crate::phases::{Phase, PhaseOutcome, Phases, derive};
use crate::plan::StepPlan;
use crate::regions::Region;
use crate::rule::{Propensity, Rule};
use crate::rules::{Applications, RuleFailure, Rules};
use crate::series::StepSeries;
use crate::step::{NoHelpers, Stepper};
use crate::step_number::StepNumber;
use crate::successors::Successors;
use crate::symbols::{Signature, Symbols};
use crate::text::{PlainNumbers, chain_text};
use burgeon_base::Stop;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::random::Stream;
use burgeon_base::{KeyPart, ModuleKey};

type SuccessorClosure = Box<dyn Fn(&AppliedModule<'_>, &mut Successors)>;
type GuardClosure = Box<dyn Fn(&AppliedModule<'_>) -> bool>;
type PropensityClosure = Box<dyn Fn(&AppliedModule<'_>) -> f64>;

/// Module to which a closure is applied.
#[derive(Debug)]
pub struct AppliedModule<'a> {
    /// Arguments that the pattern names, in its order: first the left context, then the module, then the right context.
    pub arguments: &'a [f64],
    key: ModuleKey,
    step: &'a StepNumber,
    drawn: Cell<usize>,
}

impl AppliedModule<'_> {
    /// Returns the next random number of the module's own stream, uniform in [0, 1).
    pub fn random(&self) -> f64 {
        let mut stream = self.key.stream();
        for _ in 0..self.drawn.get() {
            stream.uniform();
        }
        self.drawn.set(self.drawn.get() + 1);
        stream.uniform()
    }

    /// Returns the random numbers of `parts`, a name and further keys, for this module. They do not depend on
    /// [`AppliedModule::random`], nor change its numbers.
    pub fn stream(&self, parts: &[KeyPart<'_>]) -> Stream {
        parts.iter().fold(self.key, |key, part| key.substream(*part)).stream()
    }

    /// Returns the number of the step that is running, from 1. A derivation does not end while a rule reads it, because
    /// a later step may change the chain.
    pub fn step(&self) -> usize {
        self.step.read()
    }
}

/// System whose rules are closures.
///
/// A parametric system with a guard: a stem of Lindenmayer's *Anabaena*, whose cells divide when they are long enough:
///
/// ```
/// use burgeon_rewriting::ClosureSystem;
///
/// let mut stem = ClosureSystem::new(0);
/// let cell = stem.module("Cell", &["length"])?;
/// stem.rule_when("Cell(l)", |module| module.arguments[0] >= 2.0, move |module, out| {
///     out.push(cell, &[module.arguments[0] / 2.0]);
///     out.push(cell, &[module.arguments[0] / 2.0]);
/// })?;
/// stem.rule("Cell(l)", move |module, out| out.push(cell, &[module.arguments[0] + 0.5]))?;
///
/// let first = stem.chain(|out| out.push(cell, &[1.0]))?;
/// assert_eq!(stem.text(&stem.derive(first, 4)?), "Cell(1.5) Cell(1.5)\n");
/// # Ok::<(), burgeon_base::Error>(())
/// ```
///
/// A context-sensitive system, in which a signal moves through a branching chain:
///
/// ```
/// # use burgeon_rewriting::ClosureSystem;
/// let mut tree = ClosureSystem::new(0);
/// let (on, off) = (tree.module("On", &[])?, tree.module("Off", &[])?);
/// tree.rule("On < Off", move |_, out| out.push(on, &[]))?;
/// let chain = tree.chain(|out| {
///     out.push(on, &[]);
///     out.open();
///     out.push(off, &[]);
///     out.push(off, &[]);
///     out.close();
///     out.push(off, &[]);
/// })?;
/// assert_eq!(tree.text(&tree.derive(chain, 1)?), "On [ On Off ] On\n");
/// # Ok::<(), burgeon_base::Error>(())
/// ```
///
/// A stochastic system: random numbers depend only on the seed and the lineage of a module.
///
/// ```
/// # use burgeon_rewriting::ClosureSystem;
/// let mut buds = ClosureSystem::new(7);
/// let (bud, leaf, flower) = (buds.module("Bud", &[])?, buds.module("Leaf", &[])?, buds.module("Flower", &[])?);
/// buds.rule_weighted("Bud", 3.0, move |_, out| out.push(leaf, &[]))?;
/// buds.rule_weighted("Bud", 1.0, move |_, out| out.push(flower, &[]))?;
/// let chain = buds.chain(|out| (0..1000).for_each(|_| out.push(bud, &[])))?;
/// let leaves = buds.derive(chain, 1)?.symbols.iter().filter(|symbol| **symbol == leaf).count();
/// assert!((700..800).contains(&leaves), "{leaves}");
/// # Ok::<(), burgeon_base::Error>(())
/// ```
#[allow(missing_debug_implementations, reason = "rules are code")]
pub struct ClosureSystem {
    seed: u64,
    symbols: Symbols,
    rules: Vec<Rule>,
    successors: Vec<SuccessorClosure>,
    guards: Vec<Option<GuardClosure>>,
    propensities: Vec<Option<PropensityClosure>>,
    ignored: Vec<Symbol>,
    openers: Vec<(Symbol, Region)>,
    /// Region of the rules that are added.
    region: Region,
    ring: bool,
    limit: usize,
}

impl ClosureSystem {
    /// Creates a system without modules and rules.
    pub fn new(seed: u64) -> Self {
        Self {
            seed,
            symbols: Symbols::default(),
            rules: Vec::new(),
            successors: Vec::new(),
            guards: Vec::new(),
            propensities: Vec::new(),
            ignored: Vec::new(),
            openers: Vec::new(),
            region: 0,
            ring: false,
            limit: 100_000_000,
        }
    }

    /// Declares a module with named parameters. Fails if a name is invalid, or if the module is already declared with
    /// other parameters.
    pub fn module(&mut self, name: &str, parameters: &[&str]) -> Result<Symbol> {
        let parameters: Vec<String> = parameters.iter().map(|&parameter| parameter.to_owned()).collect();
        self.symbols.declare(Signature::new(name, &parameters)?)
    }

    /// Adds a rule. `successor` writes the modules that replace the module to the [`Successors`]; a successor that
    /// writes nothing erases it. Fails if the pattern is invalid.
    pub fn rule(
        &mut self,
        pattern: &str,
        successor: impl Fn(&AppliedModule<'_>, &mut Successors) + 'static,
    ) -> Result<()> {
        self.add(pattern, None, None, Box::new(successor))
    }

    /// Adds a rule that applies if `guard` holds.
    pub fn rule_when(
        &mut self,
        pattern: &str,
        guard: impl Fn(&AppliedModule<'_>) -> bool + 'static,
        successor: impl Fn(&AppliedModule<'_>, &mut Successors) + 'static,
    ) -> Result<()> {
        self.add(pattern, None, Some(Box::new(guard)), Box::new(successor))
    }

    /// Adds a rule that is chosen at random among the weighted rules of its module, in proportion to its weight.
    pub fn rule_weighted(
        &mut self,
        pattern: &str,
        weight: f64,
        successor: impl Fn(&AppliedModule<'_>, &mut Successors) + 'static,
    ) -> Result<()> {
        if !(weight >= 0.0 && weight.is_finite()) {
            return Err(Error::argument(format!(
                "the weight of {pattern} must be finite and at least 0, not {weight}"
            ))
            .help("give a number of 0 or more"));
        }
        self.add(pattern, Some(weight), None, Box::new(successor))
    }

    /// Adds a rule that is applied to one module at a time, at the rate `propensity` (events per unit of time). If one rule has
    /// a propensity, all rules need one, and a step is one event.
    ///
    /// The decay of a thousand atoms, which live for one unit of time on average:
    ///
    /// ```
    /// use burgeon_rewriting::ClosureSystem;
    ///
    /// let mut matter = ClosureSystem::new(0);
    /// let (atom, rest) = (matter.module("Atom", &[])?, matter.module("Rest", &[])?);
    /// matter.rule_with_propensity("Atom", |_| 1.0, move |_, out| out.push(rest, &[]))?;
    /// let chain = matter.chain(|out| (0..1000).for_each(|_| out.push(atom, &[])))?;
    /// let chain = matter.derive_until(chain, 1.0)?;
    /// let left = chain.symbols.iter().filter(|symbol| **symbol == atom).count();
    /// assert!((320..420).contains(&left), "{left}, expected 1000/e");
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn rule_with_propensity(
        &mut self,
        pattern: &str,
        propensity: impl Fn(&AppliedModule<'_>) -> f64 + 'static,
        successor: impl Fn(&AppliedModule<'_>, &mut Successors) + 'static,
    ) -> Result<()> {
        self.add(pattern, None, None, Box::new(successor))?;
        if let (Some(rule), Some(last)) = (self.rules.pop(), self.propensities.last_mut()) {
            self.rules.push(rule.with_propensity(Propensity::Computed));
            *last = Some(Box::new(propensity));
        }
        Ok(())
    }

    fn add(
        &mut self,
        pattern: &str,
        weight: Option<f64>,
        guard: Option<GuardClosure>,
        successor: SuccessorClosure,
    ) -> Result<()> {
        if self.rules.len() == MOST_RULES {
            return Err(Error::limit(Limit::Size, format!("the system has more than {MOST_RULES} rules"))
                .help("join rules, and distinguish their modules by a parameter"));
        }
        let pattern = Pattern::parse(pattern, &self.symbols)?;
        self.rules.push(Rule::new(pattern, weight, guard.is_some(), None).in_region(self.region));
        self.successors.push(successor);
        self.guards.push(guard);
        self.propensities.push(None);
        Ok(())
    }

    /// Makes contexts skip modules with these symbols.
    ///
    /// ```
    /// use burgeon_rewriting::ClosureSystem;
    ///
    /// let mut system = ClosureSystem::new(0);
    /// let (a, b, c) = (system.module("A", &[])?, system.module("B", &[])?, system.module("C", &[])?);
    /// system.rule("A < B", move |_, out| out.push(a, &[]))?;
    /// let chain = || system.chain(|out| [a, c, b].into_iter().for_each(|symbol| out.push(symbol, &[])));
    /// assert_eq!(system.text(&system.derive(chain()?, 1)?), "A C B\n");
    /// let chain = chain()?;
    /// system.ignore(&[c]);
    /// assert_eq!(system.text(&system.derive(chain, 1)?), "A C A\n");
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn ignore(&mut self, symbols: &[Symbol]) {
        self.ignored.extend_from_slice(symbols);
    }

    /// Makes the contexts of the rule that was added last skip modules with these symbols, in place of those of the system.
    /// Fails if the system has no rule.
    pub fn ignore_in_last_rule(&mut self, symbols: &[Symbol]) -> Result<()> {
        let Some(rule) = self.rules.pop() else {
            return Err(Error::argument("the system has no rule").help("add the rule first"));
        };
        self.rules.push(rule.ignoring(symbols.to_vec()));
        Ok(())
    }

    /// Makes modules with this symbol open a region with this number: what follows such a module in its branch is rewritten by
    /// the rules of that region. An example is at [`Grammar::with_regions`].
    pub fn open_region(&mut self, opener: Symbol, region: Region) {
        self.openers.push((opener, region));
    }

    /// Sets the number of the region to which rules belong that are added from now on; 0 for the rules outside of all regions.
    pub fn add_rules_to(&mut self, region: Region) {
        self.region = region;
    }

    /// Makes the first and the last module of each chain neighbours if `ring` is set.
    pub fn ring(&mut self, ring: bool) {
        self.ring = ring;
    }

    /// Sets the maximum number of modules and brackets of a chain; 100 million by default.
    ///
    /// ```
    /// use burgeon_rewriting::ClosureSystem;
    ///
    /// let mut system = ClosureSystem::new(0);
    /// let a = system.module("A", &[])?;
    /// system.rule("A", move |_, out| (0..2).for_each(|_| out.push(a, &[])))?;
    /// system.limit(1000);
    /// let error = system.derive(system.chain(|out| out.push(a, &[]))?, 50).expect_err("2^50 modules");
    /// assert_eq!(error.kind().code(), "limit.modules");
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn limit(&mut self, modules: usize) {
        self.limit = modules;
    }

    /// Returns a chain of the modules that `write` pushes. Fails if brackets do not match or nest too deep, or if a
    /// module has the wrong number of parameters.
    pub fn chain(&self, write: impl FnOnce(&mut Successors)) -> Result<Chain> {
        let mut made = Successors::default();
        write(&mut made);
        let arities = self.symbols.arities();
        let mut depth = 0_usize;
        let mut params = 0;
        for symbol in &made.symbols {
            depth = match *symbol {
                OPEN => depth + 1,
                CLOSE => depth.checked_sub(1).ok_or_else(unbalanced_error)?,
                _ => depth,
            };
            if depth > DEEPEST {
                return Err(Error::limit(Limit::Size, format!("branches nest deeper than {DEEPEST}")));
            }
            let arity = arities.get(usize::from(*symbol)).filter(|_| *symbol != END);
            params += usize::from(*arity.ok_or_else(|| Error::argument("the chain has an unknown symbol"))?);
        }
        if depth > 0 {
            return Err(unbalanced_error());
        }
        if params != made.params.len() {
            let found = made.params.len();
            return Err(Error::argument(format!("the modules take {params} parameters, not {found}")));
        }
        made.symbols.push(END);
        let seed = ModuleKey::seed(self.seed);
        let mut ordinals = Ordinals::default();
        let keys = made.symbols.iter().map(|symbol| match *symbol > END {
            true => seed.successor(self.symbols.name_hash(*symbol), ordinals.next(*symbol)),
            false => ModuleKey::default(),
        });
        Ok(Chain { keys: keys.collect(), symbols: made.symbols, params: made.params, marks: Vec::new() })
    }

    /// Derives a chain by at most `steps` steps; stops early if no rule applies and no guard reads the number of the step.
    ///
    /// A guard must always return the same for the same arguments, because it is not called again while nothing around its
    /// module changes.
    pub fn derive(&self, chain: Chain, steps: usize) -> Result<Chain> {
        self.derive_within(chain, steps, f64::INFINITY)
    }

    /// Derives a chain of rules with propensities until `time`; events that would occur later do not. Fails if a rule has no
    /// propensity. An example is at [`rule_with_propensity`](Self::rule_with_propensity).
    pub fn derive_until(&self, chain: Chain, time: f64) -> Result<Chain> {
        if self.propensities.iter().any(Option::is_none) {
            return Err(Error::argument("without propensities, a derivation has no time")
                .help("add the rules by rule_with_propensity"));
        }
        self.derive_within(chain, usize::MAX, time)
    }

    fn derive_within(&self, mut chain: Chain, steps: usize, until: f64) -> Result<Chain> {
        let grammar = Grammar::new(Arc::new(self.symbols.clone()), self.rules.clone(), &self.ignored, true)
            .with_ring(self.ring)
            .with_regions(&self.openers)
            .with_compatible_rules()?;
        chain.mark(BATCH, grammar.arities());
        let chains = chain.symbols.iter().filter(|symbol| **symbol == END).count();
        let plan = Arc::new(StepPlan {
            grammar,
            failed: None,
            chains,
            batch: BATCH,
            limit: self.limit,
            traced: false,
            notes_places: false,
        });
        let mut stepper = Stepper::new(&plan);
        let phases = Phases {
            first: Vec::new(),
            each: vec![Box::new(RewritePhase { system: self, last: steps, until })],
            last: Vec::new(),
        };
        let derived = derive(&phases, &mut stepper, Arc::new(chain), 0, steps)?;
        Ok(Arc::unwrap_or_clone(derived.chain))
    }

    /// Returns the chains as text, one line per chain.
    pub fn text(&self, chain: &Chain) -> String {
        chain_text(chain, &self.symbols, &PlainNumbers)
    }
}

/// Number of symbols to which rules are applied at a time.
const BATCH: usize = 4096;

fn unbalanced_error() -> Error {
    Error::argument("the brackets of the chain do not match").help("close each branch that was opened")
}

/// Phase that applies the closures of a system.
struct RewritePhase<'a> {
    system: &'a ClosureSystem,
    /// Number of the last step.
    last: usize,
    /// Time of the last event at most.
    until: f64,
}

impl Phase<Stepper> for RewritePhase<'_> {
    fn run(&self, stepper: &mut Stepper, chain: Arc<Chain>, step: usize) -> Result<PhaseOutcome> {
        let stop = Stop::new();
        if stepper.has_events() {
            let mut series = EventSeries {
                first: step,
                last: self.last,
                until: self.until,
                is_changed: false,
                ends_at: &[],
                watch: &mut |_, _| true,
                between: None,
            };
            let outcome = stepper.perform_events(self.system, &stop, &chain, &mut series)?;
            return Ok(outcome.into_phase_outcome());
        }
        if stepper.begin_series(&chain, false) {
            let outcome = stepper.perform(
                self.system,
                &stop,
                &chain,
                &mut StepSeries {
                    first: step,
                    last: self.last,
                    ends_unchanged: false,
                    ends_at: &[],
                    watch: &mut |_, _| true,
                    places: None,
                },
            )?;
            return Ok(PhaseOutcome {
                more_steps: outcome.steps - 1,
                settled: outcome.settled,
                is_last: outcome.is_last,
                chain: Arc::new(outcome.chain),
            });
        }
        let outcome = stepper.step(self.system, &NoHelpers, &stop, &chain, step)?;
        stepper.reuse(chain);
        Ok(PhaseOutcome {
            more_steps: 0,
            settled: !outcome.ran && !outcome.reads_step,
            is_last: outcome.is_last,
            chain: Arc::new(outcome.chain),
        })
    }
}

impl ClosureSystem {
    /// Returns the modules to which a closure is applied.
    fn each<'a>(&self, applications: &'a Applications<'_>) -> impl Iterator<Item = AppliedModule<'a>> {
        let arity = self.rules[usize::from(applications.rule)].arguments();
        (0..applications.count).map(move |application| AppliedModule {
            arguments: &applications.arguments[application * arity..][..arity],
            key: applications.keys.get(application).copied().unwrap_or_default(),
            step: applications.step,
            drawn: Cell::new(usize::from(applications.weighted)),
        })
    }
}

impl Rules for ClosureSystem {
    fn apply(&self, applications: &Applications<'_>, successors: &mut Successors) -> Result<(), RuleFailure> {
        let successor = &self.successors[usize::from(applications.rule)];
        successors.clear();
        for module in self.each(applications) {
            successor(&module, successors);
            successors.end();
        }
        Ok(())
    }

    fn guard(&self, applications: &Applications<'_>, holds: &mut Vec<u32>) -> Result<(), RuleFailure> {
        if let Some(guard) = &self.guards[usize::from(applications.rule)] {
            holds.extend(self.each(applications).map(|module| u32::from(guard(&module))));
        }
        Ok(())
    }

    fn propensity(
        &self,
        applications: &Applications<'_>,
        propensities: &mut Vec<f64>,
    ) -> Result<(), RuleFailure> {
        if let Some(propensity) = &self.propensities[usize::from(applications.rule)] {
            propensities.extend(self.each(applications).map(|module| propensity(&module)));
        }
        Ok(())
    }
}
