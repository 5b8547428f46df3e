//! Phases of a derivation in the leading machine: rewriting, resolving placeholders, publishing and
//! interpreting.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::sync::Arc;

use super::checkpoints::CheckpointWriter;
use super::hooks::RunHooks;
use super::interpret::{PassMemory, PassOutcome};
use super::passes::{ExpandObjects, Interpret};
use super::plan::{Derivation, DerivationPlan};
use super::rewrite::{CutBranches, Decompose, RefuseEndless, Resolve, Rewrite};
use super::rewriter::SystemRewriter;
use super::state::DerivationState;
use super::threads::LeadingMachine;
use crate::machine::{Driver as _, HookMoment};
use crate::results::{RowFeatures, RuleName, RuleReport, Step, Times};
use burgeon_base::error::Result;
use burgeon_base::warning::Warning;
use burgeon_rewriting::{Chain, Phase, PhaseOutcome, Phases, Stepper, Symbol, Use};

/// Results of the phases of a derivation.
pub(super) struct DerivationResults {
    pub chain: Arc<Chain>,
    /// Number of steps.
    pub steps_made: usize,
    /// Time of the last event, the latest of all chains.
    pub time: f64,
    pub times: Times,
    pub rules: Vec<RuleReport>,
    pub warnings: Vec<Warning>,
    /// Steps of the lineage, if it is traced.
    pub steps: Vec<Step>,
    pub features: Option<RowFeatures>,
    /// Symbols of modules that the last pass returned and could not draw.
    pub undrawn: BTreeSet<Symbol>,
    /// Set if branches were cut.
    pub has_cut: bool,
}

/// Derives the axiom `chain` in the phases of its system.
pub(super) fn derive(
    leader: LeadingMachine<'_>,
    derivation: &Derivation,
    mut chain: Chain,
) -> Result<DerivationResults> {
    let (plan, session) = (&derivation.plan, &leader.machine.session);
    let grammar = &plan.steps.grammar;
    let mut stepper = Stepper::new(&plan.steps);
    let mut interpretations = vec![Use::default(); plan.interpretations.list.len()];
    let derived: Vec<_> = leader.threads.derived().into_iter().flatten().collect();
    let mut checkpoints = CheckpointWriter::new(session, derivation, &derived);
    let mut begin = 0;
    if let Some((step, checkpoint)) =
        checkpoints.as_mut().and_then(|checkpoints| checkpoints.begin(session, derivation.limit))
    {
        begin = step;
        chain = checkpoint.chain(&session.values);
        stepper.continue_from(&checkpoint.rules);
        interpretations.clone_from(&checkpoint.interpretations);
    }
    chain.mark(plan.steps.batch, grammar.arities());
    let records = session.options.reports.records && derivation.traced.is_none();
    let mut state = DerivationState {
        leader,
        derivation,
        rewriter: SystemRewriter::new(leader),
        stepper,
        decomposer: plan.decomposition.as_ref().map(|rules| Stepper::new(&rules.steps)),
        previous: None,
        times: Times::default(),
        interpretations,
        first: Vec::new(),
        later: Vec::new(),
        steps: Vec::new(),
        features: records.then(|| RefCell::new(RowFeatures::new(chain.symbols.len()))),
        published: 0,
        memory: PassMemory::default(),
        pass: PassOutcome::default(),
        decomposition_reads_step: false,
        group: None,
        variables_changed: false,
        early_hooks: None,
        is_last_step: false,
        has_cut: false,
        has_ever_cut: false,
        checkpoints,
    };
    state.use_group(derivation.group);
    let view = leader.machine.current.chains_derived.borrow().with_begun(plan.system, grammar.symbols());
    session.show_chains(view);
    let derived = burgeon_rewriting::derive(
        &phases(&state, begin),
        &mut state,
        Arc::new(chain),
        begin,
        derivation.limit,
    )?;
    // If the last pass reads the number of the step, the derivation continues with the same chain to its last step.
    let steps_made = if state.pass.reads_step { derivation.limit } else { derived.steps };
    let uses = state.uses();
    let time = state.time();
    let later = state.later;
    state.first.retain(|warning| later.iter().all(|other| !other.says_the_same(warning)));
    Ok(DerivationResults {
        chain: derived.chain,
        steps_made,
        time,
        times: state.times,
        rules: reports(plan, &uses, &state.interpretations),
        warnings: state.first.into_iter().chain(later).collect(),
        steps: state.steps,
        features: state.features.map(RefCell::into_inner),
        undrawn: state.pass.undrawn,
        has_cut: state.has_ever_cut,
    })
}

/// Returns the phases of a system.
///
/// For a check, placeholders are not resolved and chains are not interpreted. If nothing can observe the
/// earlier passes, only the last chain is interpreted. A derivation that continues from step `begin` does not decompose
/// its first chain again.
fn phases<'a>(state: &DerivationState<'a>, begin: usize) -> Phases<'static, DerivationState<'a>> {
    let (derivation, options) = (state.derivation, &state.leader.machine.session.options);
    if options.check {
        return Phases {
            first: vec![Box::new(Publish), Box::new(Sketch)],
            each: Vec::new(),
            last: Vec::new(),
        };
    }
    let interprets = derivation.plan.objects.is_some();
    let mut phases: Phases<'static, DerivationState<'a>> = Phases {
        first: vec![Box::new(Resolve)],
        each: vec![Box::new(CutBranches), Box::new(Rewrite), Box::new(Resolve)],
        last: Vec::new(),
    };
    if state.decomposer.is_some() {
        if begin == 0 {
            phases.first.push(Box::new(Decompose));
        }
        phases.each.push(Box::new(Decompose));
    }
    phases.first.push(Box::new(Publish));
    phases.each.push(Box::new(Publish));
    if interprets {
        phases.first.push(Box::new(ExpandObjects));
    }
    if state.checkpoints.is_some() {
        phases.each.push(Box::new(Store));
    }
    match (interprets, derivation.last_only) {
        (true, true) => phases.last.push(Box::new(Interpret)),
        (true, false) => {
            phases.first.push(Box::new(Interpret));
            phases.each.push(Box::new(Interpret));
        }
        (false, _) => {}
    }
    if derivation.is_open() {
        phases.each.insert(0, Box::new(RefuseEndless));
    }
    for (moment, hooks) in &derivation.hooks {
        let hook = Box::new(RunHooks(*moment, hooks.clone()));
        match moment {
            HookMoment::Start => phases.first.insert(0, hook),
            HookMoment::BeforeStep => phases.each.insert(0, hook),
            HookMoment::AfterStep => phases.each.push(hook),
            HookMoment::End => phases.last.push(hook),
        }
    }
    phases
}

/// Publishes the chain to queries, and frees the memory of the previous chain.
struct Publish;

impl Phase<DerivationState<'_>> for Publish {
    fn run(&self, state: &mut DerivationState<'_>, chain: Arc<Chain>, step: usize) -> Result<PhaseOutcome> {
        state.publish(&chain);
        if let Some(previous) = state.previous.take() {
            let session = &state.leader.machine.session;
            state.stepper.reuse(previous);
            session.progress.note(step, state.derivation.limit, chain.symbols.len());
            session.forget_unused(&chain.params);
        }
        Ok(PhaseOutcome::next(chain))
    }
}

/// Stores the chain for later runs.
struct Store;

impl Phase<DerivationState<'_>> for Store {
    fn run(&self, state: &mut DerivationState<'_>, chain: Arc<Chain>, step: usize) -> Result<PhaseOutcome> {
        let status = (!state.failed().is_empty(), step == state.derivation.limit);
        let uses = (&*state.uses(), &*state.interpretations);
        if let Some(checkpoints) = &mut state.checkpoints {
            checkpoints.store(&state.leader.machine.session, step, &chain, status, uses);
        }
        Ok(PhaseOutcome::next(chain))
    }
}

/// Marks self-expanding objects as checked only.
struct Sketch;

impl Phase<DerivationState<'_>> for Sketch {
    fn run(&self, state: &mut DerivationState<'_>, chain: Arc<Chain>, _: usize) -> Result<PhaseOutcome> {
        state.derivation.plan.sketch()?;
        Ok(PhaseOutcome::next(chain))
    }
}

/// Returns the work of the rules and interpretation rules, in the order of declaration.
fn reports(plan: &DerivationPlan, rules: &[Use], interpretations: &[Use]) -> Vec<RuleReport> {
    let rules = plan.steps.grammar.rules().iter().zip(rules).map(|(rule, done)| RuleReport {
        name: RuleName::new(&rule.pattern.text, rule.place.as_ref()),
        interprets: false,
        done: *done,
    });
    let interpretations = plan.interpretations.list.iter().zip(interpretations);
    let interpretations = interpretations.filter(|(known, _)| !known.is_choice).map(|(known, done)| {
        RuleReport { name: RuleName::new(&known.name, known.place.as_ref()), interprets: true, done: *done }
    });
    rules.chain(interpretations).collect()
}
