//! Derivation: rewrites the chains of a system step by step, in parallel, and has them interpreted in between.
//!
//! Comes in: a system as a script declared it. Goes out: a [`Derived`] system. The chain of a step is read-only
//! while the next one is made, so a batch never sees what another batch does.

mod batch;
mod choose;
mod crew;
mod derived;
mod group;
mod output;
mod remark;
mod rewriter;
mod splice;
mod step;
mod trace;

pub(crate) use crew::{Crew, Job};
pub use derived::{Derived, RuleReport, Times};
pub use output::Use;
pub use remark::{Remark, Report, grouped};
pub(crate) use trace::around;
pub use trace::{Ancestor, MadeBy, Module, RuleName, Trace, Traced};

use std::sync::{Arc, PoisonError};
use std::time::Instant;

use crate::interpret::Interpreting;
use crate::script::{Interpretations, Machine, Objects};
use burgeon_base::error::{Error, Result};
use burgeon_base::warning::Warning;
use burgeon_kit::Object;
use burgeon_kit::rules::{Chain, Grammar, Key};
use rewriter::SystemRewriter;
use step::Stepper;

/// The first chains of a system and what belongs to each.
#[derive(Default)]
pub(crate) struct Axiom {
    pub chain: Chain,
    /// One object for each chain, or none at all.
    pub objects: Vec<Box<dyn Object>>,
    /// The id of each chain's feature.
    pub features: Vec<Option<String>>,
    /// What the features come from; empty without any, and for a list that the script made.
    pub source: String,
    /// How many features there were, those that were left out among them.
    pub given: usize,
    /// Features that were left out.
    pub remarks: Vec<Remark>,
}

impl Axiom {
    /// Chain number `index` alone.
    fn only(mut self, index: usize, arities: &[u8]) -> Self {
        Self {
            chain: self.chain.only(index, arities),
            objects: self.objects.drain(..).skip(index).take(1).collect(),
            features: self.features.drain(..).skip(index).take(1).collect(),
            ..self
        }
    }
}

/// What does not change while a system derives; shared by all threads.
pub(crate) struct Plan {
    /// The system's place among those of the script.
    pub system: usize,
    pub grammar: Grammar,
    pub interpretations: Interpretations,
    pub objects: Option<Arc<Objects>>,
    /// The number of chains.
    pub chains: usize,
    /// Symbols that a worker takes at a time.
    pub batch: usize,
    /// Whether it is noted which rules and modules make what.
    pub traced: bool,
    /// Whether the time of each interpretation rule is measured.
    pub profiled: bool,
}

impl Plan {
    /// Tells objects that expand by themselves that the script is only checked.
    fn sketch(&self) -> Result<()> {
        let Some(objects) = &self.objects else { return Ok(()) };
        (0..self.chains).try_for_each(|chain| {
            objects.write(chain, |object| {
                object.sketch();
                Ok(())
            })
        })
    }

    /// Has objects that expand by themselves do so; adds to `said` what they warn of.
    fn expand(&self, rules: &SystemRewriter<'_>, said: &mut Vec<Warning>) -> Result<()> {
        let Some(objects) = &self.objects else { return Ok(()) };
        if !objects.read(0, |object| Ok(object.expands()))? {
            return Ok(());
        }
        for chain in (0..self.chains).filter(|chain| !objects.has_failed(*chain)) {
            objects.write(chain, |object| {
                object.expand(rules)?;
                said.extend(object.take_warnings());
                Ok(())
            })?;
        }
        Ok(())
    }
}

/// Derives system `index` of the machine's script by at most `steps` steps, or to the end.
///
/// In a machine that only helps, it works on what the leading machine hands out, and returns the leader's result.
pub(crate) fn derive(machine: &Machine, index: usize, steps: Option<usize>) -> Result<Arc<Derived>> {
    let problems: Vec<Error> = machine.library.problems.borrow_mut().drain(..).collect();
    if !problems.is_empty() {
        return Err(Error::several(problems));
    }
    if let Some(derived) = machine.crew.follow(machine, index)? {
        return Ok(derived);
    }
    let derived = lead(machine, index, steps).map(Arc::new);
    machine.current.objects.replace(None);
    machine.crew.finished(&derived);
    derived
}

fn lead(machine: &Machine, index: usize, steps: Option<usize>) -> Result<Derived> {
    let session = &machine.session;
    let options = &session.options;
    let random = session.draws_random();
    let traced = options.trace.filter(|traced| traced.system == index);
    // What was declared since the last derivation holds as well.
    machine.current.system.set(None);
    machine.library.systems.borrow()[index].note_derivation(machine);
    let (axiom, plan, declared) = {
        let systems = machine.library.systems.borrow();
        let system = &systems[index];
        let grammar = system.grammar(&machine.library, random);
        let key = Key::seed(system.seed.unwrap_or(options.seed));
        let mut axiom = system.axiom(machine, key, grammar.draws_random())?;
        if let Some(chain) = traced.and_then(|traced| traced.chain) {
            axiom = axiom.only(chain, grammar.arities());
        }
        let objects = std::mem::take(&mut axiom.objects);
        // Where nothing else would be built, the error tells more.
        let forgiving = axiom.given > 1 && !options.strict;
        let objects = (!objects.is_empty()).then(|| Arc::new(Objects::new(objects, forgiving)));
        let plan = Plan {
            system: index,
            grammar,
            interpretations: system.interpretations(&machine.library),
            objects,
            chains: axiom.features.len(),
            batch: options.batch.max(1),
            traced: traced.is_some(),
            profiled: options.profile,
        };
        let declared = system.prepare(machine)?;
        system.tell_forestalled(machine, &plan.grammar);
        (axiom, Arc::new(plan), declared)
    };
    let place = machine.library.systems.borrow()[index].place.clone();
    let last_only = machine.library.systems.borrow()[index].shows_last_only();
    let settled = machine.library.systems.borrow()[index].draws_afresh();
    let draws = settled && machine.library.systems.borrow()[index].object.is_some();
    let limit = match (steps, options.steps) {
        (Some(a), Some(b)) => a.min(b),
        (Some(limit), None) | (None, Some(limit)) => limit,
        (None, None) => usize::MAX,
    };
    let limit = if options.check { 0 } else { limit };

    let mut times = Times::default();
    let mut axiom = axiom;
    let mut chain = std::mem::take(&mut axiom.chain);
    chain.mark(plan.batch, plan.grammar.arities());
    let mut stepper = Stepper::new(Arc::clone(&plan));
    let rewriter = SystemRewriter::new(machine);
    let interprets = plan.objects.is_some() && !options.check;
    if options.check {
        plan.sketch()?;
    }
    let mut done = 0;
    let mut trace = traced.map(|_| {
        let place = machine.library.systems.borrow()[index].axiom_place.clone();
        Trace::new(&plan, &session.values, place)
    });
    let mut interpretations = vec![Use::default(); plan.interpretations.list.len()];
    let (mut first, mut said) = (Vec::new(), Vec::new());
    let mut interpret = |chain: Chain, step: usize, times: &mut Times| -> Result<Chain> {
        let begin = Instant::now();
        if settled {
            // What only earlier passes drew is gone.
            said.clear();
        }
        let chain = Interpreting::pass(machine, &plan, chain, step, &mut interpretations, &mut said)?;
        plan.expand(&rewriter, &mut said)?;
        times.interpretation += begin.elapsed();
        Ok(chain)
    };
    if interprets {
        plan.expand(&rewriter, &mut first)?;
    }
    if interprets && !last_only {
        chain = interpret(chain, 0, &mut times)?;
    }
    while done < limit {
        session.stop.check()?;
        let begin = Instant::now();
        times.read += chain.symbols.len();
        let before = match traced {
            Some(Traced { chain: Some(_), .. }) => chain.clone(),
            _ => Chain::default(),
        };
        let outcome = stepper.step(machine, &declared, chain, done + 1)?;
        times.rewriting += begin.elapsed();
        chain = outcome.chain;
        if let Some(trace) = &mut trace {
            trace.steps.push(trace::Step { chain: before, applied: outcome.applied });
        }
        if !outcome.ran || (!outcome.changed && settled && !plan.grammar.draws_random()) {
            break;
        }
        done += 1;
        session.progress.note(done, limit, chain.symbols.len());
        session.forget_unused(&chain.params);
        if interprets && !last_only {
            chain = interpret(chain, done, &mut times)?;
        }
    }
    if interprets && last_only {
        chain = interpret(chain, done, &mut times)?;
    }
    first.retain(|warning: &Warning| said.iter().all(|later| later.message() != warning.message()));
    for warning in first.into_iter().chain(said) {
        session.warn(warning.at(place.clone()));
    }
    let undrawn = machine.library.systems.borrow()[index].undrawn(&machine.library, &chain.symbols);
    let rules = reports(&plan, stepper.uses(), &interpretations);
    drop(stepper);
    drop(rewriter);
    drop(declared);
    machine.current.objects.replace(None);
    session.keep(&chain.params);
    let plan = Arc::try_unwrap(plan).map_err(|_| Error::internal("a worker still holds the plan"))?;
    let objects = match plan.objects.map(Arc::try_unwrap) {
        Some(Ok(objects)) if trace.is_some() => {
            let mut objects: Vec<_> = objects.into_owned().into_iter().map(|(object, _)| object).collect();
            if let Some(mut trace) = trace {
                let drawings = objects.iter_mut().map(|object| object.drawing_mut());
                trace.makers = drawings.map(|drawing| drawing?.take_makers()).collect();
                trace.chain = chain;
                session.traced.lock().unwrap_or_else(PoisonError::into_inner).replace(trace);
            }
            return Err(Error::internal("the traced system is derived"));
        }
        Some(Ok(objects)) => {
            let mut remarks = Vec::new();
            let objects = settle(objects, &axiom, &mut remarks)?;
            // What was left out before comes first, and the chains follow in their order.
            axiom.remarks.append(&mut remarks);
            objects
        }
        Some(Err(_)) => return Err(Error::internal("a worker still holds the objects")),
        None => Vec::new(),
    };
    let mut derived = Derived::new(
        index,
        chain,
        Arc::clone(plan.grammar.symbols()),
        Arc::clone(&session.values),
        objects,
        axiom.features,
        done,
        times,
        rules,
        place,
    );
    (derived.given, derived.remarks, derived.undrawn) = (axiom.given, axiom.remarks, undrawn);
    derived.draws = draws;
    Ok(derived)
}

/// The objects as they are after the last pass, and what is to be remarked on them. Fails if all of them have failed.
fn settle(objects: Objects, axiom: &Axiom, remarks: &mut Vec<Remark>) -> Result<Vec<Arc<dyn Object>>> {
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
        settled.push(Arc::from(object));
    }
    match first {
        Some(error) if failed == settled.len() => Err(error),
        _ => Ok(settled),
    }
}

/// What the rules and interpretation rules have done, in the order of their declaration.
fn reports(plan: &Plan, rules: &[Use], interpretations: &[Use]) -> Vec<RuleReport> {
    let rules = plan.grammar.rules().iter().zip(rules).map(|(rule, done)| RuleReport {
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
