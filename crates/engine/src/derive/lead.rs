//! A whole derivation, in the machine whose result counts: it is planned, its steps are made, and what came of it is
//! settled.

use std::cell::{Cell, RefCell};
use std::sync::Arc;
use std::time::Instant;

use super::interpret::InterpretationPass;
use super::pending::{Resolution, resolve};
use super::plan::{Derivation, DerivationPlan};
use super::rewriter::SystemRewriter;
use super::step::step;
use super::threads::{LeadingMachine, ThreadPool};
use crate::declare::TraceRequest;
use crate::machine::{Axiom, Machine, Objects};
use crate::results::{
    DerivedSystem, Remark, RowFeatures, RuleName, RuleReport, Step, SystemUses, Times, Trace, Use,
};
use burgeon_base::error::{Error, Result, SourcePlace};
use burgeon_base::warning::Warning;
use burgeon_kit::{Drawing, Object};
use burgeon_rewriting::{Chain, Stepper};

/// How a derivation has ended.
pub(super) enum Ending {
    /// With a system as the script asked for it.
    Derived(Box<DerivedSystem>),
    /// With the lineage that the options of the run ask for.
    Traced(Box<Trace>),
}

/// Derives system `index` of the machine's script by at most `steps` steps, or to the end.
pub(super) fn lead(
    machine: &Machine,
    threads: &ThreadPool,
    index: usize,
    steps: Option<usize>,
) -> Result<Ending> {
    let mut derivation = Derivation::plan(machine, index, steps)?;
    let chain = std::mem::take(&mut derivation.axiom.chain);
    let grown = Growth::new(LeadingMachine { machine, threads }, &derivation).grow(chain)?;
    settle(machine, derivation, grown)
}

/// The steps of a derivation, and what is counted on the way.
struct Growth<'a> {
    leader: LeadingMachine<'a>,
    derivation: &'a Derivation,
    rewriter: SystemRewriter<'a>,
    stepper: Stepper,
    times: Times,
    interpretations: Vec<Use>,
    /// What objects have warned of before the first pass, and since.
    first: Vec<Warning>,
    later: Vec<Warning>,
    steps: Vec<Step>,
    /// The features that modules came from, where they are told.
    features: Option<RefCell<RowFeatures>>,
    /// How many states of the chain questions have been shown.
    shown: Cell<u32>,
}

/// What the steps of a derivation gave.
struct StepResults {
    chain: Arc<Chain>,
    done: usize,
    times: Times,
    rules: Vec<RuleReport>,
    warnings: Vec<Warning>,
    steps: Vec<Step>,
    features: Option<RowFeatures>,
}

impl<'a> Growth<'a> {
    fn new(leader: LeadingMachine<'a>, derivation: &'a Derivation) -> Self {
        Self {
            leader,
            derivation,
            rewriter: SystemRewriter::new(leader),
            stepper: Stepper::new(Arc::clone(&derivation.plan.steps)),
            times: Times::default(),
            interpretations: vec![Use::default(); derivation.plan.interpretations.list.len()],
            first: Vec::new(),
            later: Vec::new(),
            steps: Vec::new(),
            features: None,
            shown: Cell::new(0),
        }
    }

    /// Makes steps from the first `chain` on, until nothing can change or there have been enough.
    fn grow(mut self, mut chain: Chain) -> Result<StepResults> {
        let (derivation, session) = (self.derivation, &self.leader.machine.session);
        let plan = &derivation.plan;
        chain.mark(plan.steps.batch, plan.steps.grammar.arities());
        if session.options.reports.records && self.derivation.traced.is_none() {
            self.features = Some(RefCell::new(RowFeatures::new(chain.symbols.len())));
        }
        let view = self
            .leader
            .machine
            .current
            .chains_derived
            .borrow()
            .with_begun(plan.system, plan.steps.grammar.symbols());
        session.show_chains(view);
        if !session.options.check {
            chain = self.resolve(chain, 0)?;
        }
        let mut chain = Arc::new(chain);
        self.show(&chain);
        let interprets = plan.objects.is_some() && !session.options.check;
        if session.options.check {
            plan.sketch()?;
        }
        if interprets {
            plan.expand(&self.rewriter, &mut self.first)?;
        }
        if interprets && !derivation.last_only {
            self.interpret(&chain, 0)?;
        }
        let mut done = 0;
        while done < derivation.limit {
            session.stop.check()?;
            let (made, outcome) = self.step(&chain, done + 1)?;
            let made = Arc::new(self.resolve(made, done + 1)?);
            self.show(&made);
            self.stepper.reuse(std::mem::replace(&mut chain, made));
            let still = !outcome.changed && derivation.draws_afresh && !plan.steps.grammar.draws_random();
            if !outcome.ran || still {
                break;
            }
            done += 1;
            session.progress.note(done, derivation.limit, chain.symbols.len());
            session.forget_unused(&chain.params);
            if interprets && !derivation.last_only {
                self.interpret(&chain, done)?;
            }
        }
        if interprets && derivation.last_only {
            self.interpret(&chain, done)?;
        }
        let later = self.later;
        self.first.retain(|warning| later.iter().all(|other| !other.says_the_same(warning)));
        Ok(StepResults {
            chain,
            done,
            times: self.times,
            rules: reports(plan, self.stepper.uses(), &self.interpretations),
            warnings: self.first.into_iter().chain(later).collect(),
            steps: self.steps,
            features: self.features.map(RefCell::into_inner),
        })
    }

    /// Makes step number `step`, and notes it where the lineage is asked for.
    fn step(&mut self, chain: &Arc<Chain>, number: usize) -> Result<(Chain, StepChange)> {
        let begin = Instant::now();
        self.times.read += chain.symbols.len();
        let before = self.noted(chain);
        let outcome = {
            let Derivation { plan, declared, .. } = self.derivation;
            step(self.leader, plan, &mut self.stepper, declared, chain, number)?
        };
        self.times.rewriting += begin.elapsed();
        if let Some(features) = &self.features {
            features.borrow_mut().step(&outcome.applied);
        }
        if self.derivation.traced.is_some() {
            let (applied, asked) = (outcome.applied, self.leader.machine.session.rows.take_noted());
            self.steps.push(Step { number, chain: before, applied, answers: Vec::new(), asked });
        }
        Ok((outcome.chain, StepChange { ran: outcome.ran, changed: outcome.changed }))
    }

    /// The chain for the lineage, if its modules will be asked for.
    fn noted(&self, chain: &Chain) -> Chain {
        match self.derivation.traced {
            Some(TraceRequest { chain: Some(_), .. }) => chain.clone(),
            _ => Chain::default(),
        }
    }

    /// Puts in what modules of the chain stand for, as it is after `step` steps.
    fn resolve(&mut self, chain: Chain, step: usize) -> Result<Chain> {
        let begin = Instant::now();
        let resolved = resolve(self.leader, &self.derivation.plan, &chain, step, self.features.as_ref())?;
        let Some(Resolution { chain: made, applied, answers, .. }) = resolved else { return Ok(chain) };
        if self.derivation.traced.is_some() {
            let before = self.noted(&chain);
            self.steps.push(Step { number: step, chain: before, applied, answers, asked: Vec::new() });
        }
        self.stepper.reuse(Arc::new(chain));
        self.times.rewriting += begin.elapsed();
        Ok(made)
    }

    /// Shows questions the chain as it stands.
    fn show(&self, chain: &Arc<Chain>) {
        let (machine, plan) = (self.leader.machine, &self.derivation.plan);
        self.shown.set(self.shown.get() + 1);
        let view = machine.current.chains_derived.borrow();
        let view = view.with_current(
            plan.system,
            plan.steps.grammar.symbols(),
            chain,
            self.failed(),
            self.shown.get(),
        );
        machine.session.show_chains(view);
    }

    /// Returns the chains whose data was at fault.
    fn failed(&self) -> Vec<usize> {
        self.derivation.plan.objects.as_ref().map(|objects| objects.failed().list()).unwrap_or_default()
    }

    /// Has the chain interpreted as it stands after `step` steps.
    fn interpret(&mut self, chain: &Arc<Chain>, step: usize) -> Result<()> {
        let begin = Instant::now();
        let plan = &self.derivation.plan;
        if self.derivation.draws_afresh {
            // What only earlier passes drew is gone.
            self.later.clear();
        }
        self.later.retain(|warning| !warning.is_of_pass());
        let failed = self.failed().len();
        let (leader, uses) = (self.leader, &mut self.interpretations);
        InterpretationPass::pass(leader, plan, chain, step, uses, &mut self.later)?;
        plan.expand(&self.rewriter, &mut self.later)?;
        if self.failed().len() > failed {
            self.show(chain);
        }
        self.times.interpretation += begin.elapsed();
        Ok(())
    }
}

/// What a step did.
struct StepChange {
    /// Whether any rule ran.
    ran: bool,
    /// Whether any rule that ran replaced or erased its module.
    changed: bool,
}

/// Takes leave of the machine: tells what is to be told, and gives the objects to who looks at them.
fn settle(machine: &Machine, derivation: Derivation, grown: StepResults) -> Result<Ending> {
    let session = &machine.session;
    let Derivation { mut axiom, plan, declared, traced, place, caller, axiom_place, draws, .. } = derivation;
    for warning in grown.warnings {
        session.warn(warning.at(place.clone()).called_at(caller.clone()));
    }
    let undrawn =
        machine.library.systems.borrow()[plan.system].undrawn(&machine.library, &grown.chain.symbols);
    let city = machine.library.systems.borrow()[plan.system].city;
    drop(declared);
    machine.current.objects.replace(None);
    session.keep(&grown.chain.params);
    let plan = Arc::try_unwrap(plan).map_err(|_| Error::internal("a worker still holds the plan"))?;
    let DerivationPlan { system, steps, interpretations, objects, .. } = plan;
    let grammar = &steps.grammar;
    let objects = objects.map(Arc::try_unwrap).transpose();
    let objects = objects.map_err(|_| Error::internal("a worker still holds the objects"))?;
    if traced.is_some()
        && let Some(objects) = objects
    {
        let named =
            |text: &str, place: &Option<SourcePlace>| RuleName { text: text.into(), place: place.clone() };
        let rules = grammar.rules().iter().map(|rule| named(&rule.pattern.text, &rule.place));
        let interpreters = interpretations.list.iter().map(|known| named(&known.name, &known.place));
        let shared = (grammar.symbols(), &session.values);
        let by_symbol = interpretations.by_symbol.clone();
        let mut trace = Trace::new(shared, rules.collect(), interpreters.collect(), by_symbol, axiom_place);
        let drawn = objects.into_owned().into_iter();
        trace.makers = drawn.map(|(mut object, _)| object.drawing_mut()?.take_makers()).collect();
        (trace.steps, trace.chain) = (grown.steps, Arc::unwrap_or_clone(grown.chain));
        return Ok(Ending::Traced(Box::new(trace)));
    }
    let mut rows = grown.features.filter(|features| !features.is_empty());
    let left_out = objects.as_ref().map(|objects| objects.failed().list()).unwrap_or_default();
    let objects = match objects {
        Some(objects) => {
            let mut remarks = Vec::new();
            let objects = shared(objects, &axiom, rows.as_mut(), &mut remarks)?;
            // What was left out before comes first, and the chains follow in their order.
            axiom.remarks.append(&mut remarks);
            objects
        }
        None => Vec::new(),
    };
    Ok(Ending::Derived(Box::new(DerivedSystem {
        system,
        modules: grown.chain.modules(),
        chain: grown.chain,
        left_out: left_out.into(),
        symbols: Arc::clone(grammar.symbols()),
        values: Arc::clone(&session.values),
        objects,
        features: axiom.features,
        steps: grown.done,
        times: grown.times,
        rules: grown.rules,
        place,
        caller,
        given: axiom.given,
        remarks: axiom.remarks,
        city,
        source: axiom.known,
        rows,
        draws,
        undrawn,
        uses: SystemUses::default(),
    })))
}

/// The objects as they are after the last pass, and what is to be remarked on them. Fails if all of them have failed.
fn shared(
    objects: Objects,
    axiom: &Axiom,
    rows: Option<&mut RowFeatures>,
    remarks: &mut Vec<Remark>,
) -> Result<Vec<Arc<dyn Object>>> {
    let mut makers = Vec::new();
    let mut settled: Vec<Arc<dyn Object>> = Vec::new();
    let (mut failed, mut first) = (0, None);
    for (index, (mut object, failure)) in objects.into_owned().into_iter().enumerate() {
        let feature = axiom.features.get(index).and_then(Option::as_deref);
        if let Some(error) = failure {
            object.begin();
            remarks.push(Remark::skipped(&axiom.source, feature, &error));
            failed += 1;
            first.get_or_insert(error);
        } else {
            let notes = object.notes().iter();
            remarks.extend(notes.map(|note| Remark::simplified(&axiom.source, feature, note)));
        }
        if rows.is_some() {
            makers.push(object.drawing_mut().and_then(Drawing::take_makers));
        }
        settled.push(Arc::from(object));
    }
    if let Some(rows) = rows {
        rows.set_makers(makers);
    }
    match first {
        Some(error) if failed == settled.len() => Err(error),
        _ => Ok(settled),
    }
}

/// What the rules and interpretation rules have done, in the order of their declaration.
fn reports(plan: &DerivationPlan, rules: &[Use], interpretations: &[Use]) -> Vec<RuleReport> {
    let rules = plan.steps.grammar.rules().iter().zip(rules).map(|(rule, done)| RuleReport {
        name: RuleName { text: rule.pattern.text.clone(), place: rule.place.clone() },
        interprets: false,
        done: *done,
    });
    let interpretations =
        plan.interpretations.list.iter().zip(interpretations).map(|(known, done)| RuleReport {
            name: RuleName { text: known.name.clone(), place: known.place.clone() },
            interprets: true,
            done: *done,
        });
    rules.chain(interpretations).collect()
}
