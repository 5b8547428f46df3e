//! Phases of a derivation in the leading machine: rewriting, resolving placeholders, publishing and
//! interpreting.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Instant;

use super::checkpoints::CheckpointWriter;
use super::interpret::{InterpretationPass, PassOutcome};
use super::pending::{Resolution, resolve};
use super::plan::{Decomposition, Derivation, DerivationPlan};
use super::rewriter::SystemRewriter;
use super::step::step;
use super::threads::LeadingMachine;
use crate::declare::TraceRequest;
use crate::machine::{Driver as _, HookFunction, HookMoment, HookView, stops_at_depth};
use crate::results::{RowFeatures, RuleName, RuleReport, Step, Times, VariableValues};
use burgeon_base::error::Result;
use burgeon_base::warning::Warning;
use burgeon_rewriting::{
    Chain, CutChain, KeyPart, Phase, PhaseOutcome, Phases, StepOutcome, Stepper, Symbol, Use, cut,
    module_brief,
};

/// State of a derivation, shared by its phases.
pub(super) struct DerivationState<'a> {
    leader: LeadingMachine<'a>,
    derivation: &'a Derivation,
    rewriter: SystemRewriter<'a>,
    stepper: Stepper,
    /// Executor of the decomposition rules, if there are any.
    decomposer: Option<Stepper>,
    /// Chain before the current step; its memory is reused once nothing reads it.
    previous: Option<Arc<Chain>>,
    times: Times,
    interpretations: Vec<Use>,
    /// Warnings of objects before the first pass.
    first: Vec<Warning>,
    /// Warnings of objects since the first pass.
    later: Vec<Warning>,
    steps: Vec<Step>,
    /// Features of the modules, if they are recorded.
    features: Option<RefCell<RowFeatures>>,
    /// Number of states of the chain that were published.
    published: u32,
    /// Result of the last pass.
    pass: PassOutcome,
    /// Set if a decomposition has read the number of the step.
    decomposition_reads_step: bool,
    /// Number of the group of rules in use; `None` for the rules without a group.
    group: Option<usize>,
    /// Set if a variable has changed since the step began.
    variables_changed: bool,
    /// Set if branches were cut at the beginning of the step.
    has_cut: bool,
    /// Writer of checkpoints, if later runs can continue from them.
    checkpoints: Option<CheckpointWriter>,
}

/// Results of the phases of a derivation.
pub(super) struct DerivationResults {
    pub chain: Arc<Chain>,
    /// Number of steps.
    pub steps_made: usize,
    pub times: Times,
    pub rules: Vec<RuleReport>,
    pub warnings: Vec<Warning>,
    /// Steps of the lineage, if it is traced.
    pub steps: Vec<Step>,
    pub features: Option<RowFeatures>,
    /// Symbols of modules that the last pass returned and could not draw.
    pub undrawn: BTreeSet<Symbol>,
}

/// Derives the axiom `chain` in the phases of its system.
pub(super) fn derive(
    leader: LeadingMachine<'_>,
    derivation: &Derivation,
    mut chain: Chain,
) -> Result<DerivationResults> {
    let (plan, session) = (&derivation.plan, &leader.machine.session);
    let grammar = &plan.steps.grammar;
    let mut stepper = Stepper::new(Arc::clone(&plan.steps));
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
        decomposer: plan.decomposition.as_ref().map(|rules| Stepper::new(Arc::clone(&rules.steps))),
        previous: None,
        times: Times::default(),
        interpretations,
        first: Vec::new(),
        later: Vec::new(),
        steps: Vec::new(),
        features: records.then(|| RefCell::new(RowFeatures::new(chain.symbols.len()))),
        published: 0,
        pass: PassOutcome::default(),
        decomposition_reads_step: false,
        group: None,
        variables_changed: false,
        has_cut: false,
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
    let later = state.later;
    state.first.retain(|warning| later.iter().all(|other| !other.says_the_same(warning)));
    Ok(DerivationResults {
        chain: derived.chain,
        steps_made,
        times: state.times,
        rules: reports(plan, &uses, &state.interpretations),
        warnings: state.first.into_iter().chain(later).collect(),
        steps: state.steps,
        features: state.features.map(RefCell::into_inner),
        undrawn: state.pass.undrawn,
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

/// Runs the hooks for a moment.
struct RunHooks(HookMoment, Vec<HookFunction>);

impl Phase<DerivationState<'_>> for RunHooks {
    fn run(&self, state: &mut DerivationState<'_>, chain: Arc<Chain>, number: usize) -> Result<PhaseOutcome> {
        let Self(moment, hooks) = self;
        let (machine, plan) = (state.leader.machine, &state.derivation.plan);
        machine.session.stop.check()?;
        if *moment == HookMoment::Start {
            state.publish(&chain);
        }
        machine.enter(plan.system)?;
        machine.refresh();
        let view = HookView {
            step: number,
            chain: Arc::clone(&chain),
            symbols: Arc::clone(plan.steps.grammar.symbols()),
            groups: plan.groups.iter().map(|group| Arc::clone(&group.name)).collect(),
            group: state.group,
            is_last: false,
        };
        let key = state.derivation.key.at_place(number).substream(KeyPart::Text(moment.method().as_bytes()));
        let view = machine.run_hooks(hooks, moment.method(), view, key)?;
        state.use_group(view.group);
        state.take_variables();
        Ok(PhaseOutcome { is_last: view.is_last, ..PhaseOutcome::next(chain) })
    }
}

/// Removes the modules that cut branches, with what follows them in their branches.
struct CutBranches;

impl Phase<DerivationState<'_>> for CutBranches {
    fn run(&self, state: &mut DerivationState<'_>, chain: Arc<Chain>, number: usize) -> Result<PhaseOutcome> {
        let plan = &state.derivation.plan;
        let arities = plan.steps.grammar.arities();
        let begin = Instant::now();
        let made = plan.cut.and_then(|symbol| cut(&chain, symbol, arities));
        state.has_cut = made.is_some();
        let Some(CutChain { chain: mut made, applied }) = made else { return Ok(PhaseOutcome::next(chain)) };
        made.mark(plan.steps.batch, arities);
        plan.keep_places(&applied);
        if let Some(features) = &state.features {
            features.borrow_mut().step(&applied);
        }
        if state.derivation.traced.is_some() {
            let before = state.traced_chain(&chain);
            state.steps.push(Step { number, chain: before, applied, ..Step::default() });
        }
        let made = Arc::new(made);
        // Queries of the step see the chain without what was cut.
        state.publish(&made);
        state.stepper.reuse(chain);
        state.times.rewriting += begin.elapsed();
        Ok(PhaseOutcome::next(made))
    }
}

/// Applies the rules once.
struct Rewrite;

impl Phase<DerivationState<'_>> for Rewrite {
    fn run(&self, state: &mut DerivationState<'_>, chain: Arc<Chain>, number: usize) -> Result<PhaseOutcome> {
        let Derivation { plan, declared, .. } = state.derivation;
        let session = &state.leader.machine.session;
        session.stop.check()?;
        let begin = Instant::now();
        state.times.read += chain.symbols.len();
        let mut outcome = step(state.leader, plan, &mut state.stepper, declared, &chain, number)?;
        plan.set_places(None);
        state.times.rewriting += begin.elapsed();
        state.record(&chain, &mut outcome, number);
        state.previous = Some(chain);
        // A step that could repeat forever without a difference does not count. A function that reads the number of the
        // step can make a difference in a later step.
        let repeats = !outcome.changed && state.derivation.draws_afresh && !plan.steps.grammar.draws_random();
        let reads_step = outcome.reads_step || state.pass.reads_step || state.decomposition_reads_step;
        let varies = std::mem::take(&mut state.variables_changed) || state.derivation.has_step_hooks;
        let settled = (!outcome.ran || repeats) && !reads_step && !varies && !state.has_cut;
        Ok(PhaseOutcome { chain: Arc::new(outcome.chain), settled, is_last: outcome.is_last })
    }
}

/// Applies the decomposition rules until none applies, or up to the maximum depth.
struct Decompose;

impl Phase<DerivationState<'_>> for Decompose {
    fn run(
        &self,
        state: &mut DerivationState<'_>,
        mut chain: Arc<Chain>,
        number: usize,
    ) -> Result<PhaseOutcome> {
        let Derivation { plan, declared, .. } = state.derivation;
        let (Some(rules), Some(mut decomposer)) = (&plan.decomposition, state.decomposer.take()) else {
            return Ok(PhaseOutcome::next(chain));
        };
        let mut is_last = false;
        for depth in 1.. {
            let begin = Instant::now();
            if depth > rules.max_depth {
                warn_of_depth(state, rules, &chain, number)?;
                break;
            }
            // A pass costs as much as drawing, so it runs only to find places.
            if rules.asks && !plan.located.is_empty() && !plan.skips_passes {
                let variables = plan.variables();
                Interpret.run(state, Arc::clone(&chain), number)?;
                state.restore_variables(variables)?;
            }
            let mut outcome = step(state.leader, plan, &mut decomposer, declared, &chain, number)?;
            plan.set_places(None);
            state.times.rewriting += begin.elapsed();
            state.decomposition_reads_step |= outcome.reads_step;
            is_last |= outcome.is_last;
            if !outcome.changed {
                break;
            }
            state.times.read += chain.symbols.len();
            state.record(&chain, &mut outcome, number);
            decomposer.reuse(chain);
            chain = Resolve.run(state, Arc::new(outcome.chain), number)?.chain;
        }
        state.decomposer = Some(decomposer);
        Ok(PhaseOutcome { is_last, ..PhaseOutcome::next(chain) })
    }
}

/// Warns if a decomposition rule would apply to `chain`, which has reached the maximum depth.
fn warn_of_depth(
    state: &DerivationState<'_>,
    rules: &Decomposition,
    chain: &Arc<Chain>,
    number: usize,
) -> Result<()> {
    let Derivation { plan, declared, .. } = state.derivation;
    let mut trial = Stepper::new(Arc::clone(&rules.steps));
    if !step(state.leader, plan, &mut trial, declared, chain, number)?.changed {
        return Ok(());
    }
    let (session, grammar) = (&state.leader.machine.session, &rules.steps.grammar);
    let applied = trial.uses().iter().position(|uses| uses.applied > 0);
    let Some(rule) = applied.and_then(|number| grammar.rules().get(number)) else { return Ok(()) };
    let (symbol, arities) = (rule.pattern.symbol, grammar.arities());
    let mut param = 0;
    let module = chain.symbols.iter().find_map(|other| {
        let begin = param;
        param += usize::from(arities[usize::from(*other)]);
        (*other == symbol)
            .then(|| module_brief(grammar.symbols(), &session.values, symbol, &chain.params[begin..param]))
    });
    let warning = stops_at_depth("decomposition", rules.max_depth, "still applies")
        .at(rule.place.clone())
        .rule(&rule.pattern.text);
    session.warn(match module {
        Some(module) => warning.module(module, number),
        None => warning,
    });
    Ok(())
}

/// Replaces placeholders by other modules.
struct Resolve;

impl Phase<DerivationState<'_>> for Resolve {
    fn run(&self, state: &mut DerivationState<'_>, chain: Arc<Chain>, step: usize) -> Result<PhaseOutcome> {
        let begin = Instant::now();
        let resolved = resolve(state.leader, &state.derivation.plan, &chain, step, state.features.as_ref())?;
        let Some(Resolution { chain: made, applied, answers, .. }) = resolved else {
            return Ok(PhaseOutcome::next(chain));
        };
        if state.derivation.traced.is_some() {
            let before = state.traced_chain(&chain);
            state.steps.push(Step { number: step, chain: before, applied, answers, asked: Vec::new() });
        }
        state.stepper.reuse(chain);
        state.times.rewriting += begin.elapsed();
        Ok(PhaseOutcome::next(Arc::new(made)))
    }
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

/// Expands self-expanding objects before the first pass.
struct ExpandObjects;

impl Phase<DerivationState<'_>> for ExpandObjects {
    fn run(&self, state: &mut DerivationState<'_>, chain: Arc<Chain>, _: usize) -> Result<PhaseOutcome> {
        state.derivation.plan.expand(&state.rewriter, &mut state.first)?;
        Ok(PhaseOutcome::next(chain))
    }
}

/// Runs an interpretation pass over the chain.
struct Interpret;

impl Phase<DerivationState<'_>> for Interpret {
    fn run(&self, state: &mut DerivationState<'_>, chain: Arc<Chain>, step: usize) -> Result<PhaseOutcome> {
        let begin = Instant::now();
        let plan = &state.derivation.plan;
        if state.derivation.draws_afresh {
            // The drawings of earlier passes are discarded.
            state.later.clear();
        }
        state.later.retain(|warning| !warning.is_of_pass());
        let failed = state.failed().len();
        let uses = &mut state.interpretations;
        // If only the last pass runs, the chain stays the same from `step` to the last step.
        let last_only = state.derivation.last_only && plan.bounded;
        let number = if last_only { state.derivation.limit } else { step };
        state.pass =
            InterpretationPass::pass(state.leader, plan, &chain, (step, number), uses, &mut state.later)?;
        plan.expand(&state.rewriter, &mut state.later)?;
        if state.failed().len() > failed {
            state.publish(&chain);
        }
        state.take_variables();
        state.times.interpretation += begin.elapsed();
        Ok(PhaseOutcome { is_last: state.pass.is_last, ..PhaseOutcome::next(chain) })
    }
}

impl DerivationState<'_> {
    /// Uses the rules of the group with this number in the next steps; `None` for the rules without a group.
    fn use_group(&mut self, group: Option<usize>) {
        if group == self.group {
            return;
        }
        self.group = group;
        let plan = &self.derivation.plan;
        let chosen = group.and_then(|number| plan.groups.get(number));
        self.stepper.set_plan(chosen.map_or(&plan.steps, |group| &group.steps));
        let decomposition = plan.decomposition.as_ref().map(|rules| &rules.steps);
        let decomposition = chosen.map_or(decomposition, |group| group.decomposition.as_ref());
        if let Some((decomposer, steps)) = self.decomposer.as_mut().zip(decomposition) {
            decomposer.set_plan(steps);
        }
    }

    /// Publishes the variables that a hook or an interpretation has assigned.
    fn take_variables(&mut self) {
        let plan = &self.derivation.plan;
        let variables = self.leader.machine.current.variables.borrow();
        if let (Some(variables), Some(before)) = (&*variables, plan.variables())
            && !variables.is_same(&before)
        {
            self.variables_changed = true;
            plan.set_variables(variables.clone());
        }
    }

    /// Sets the variables to earlier values, because the pass that has assigned them is not part of the derivation.
    fn restore_variables(&mut self, variables: Option<Arc<VariableValues>>) -> Result<()> {
        let Some(variables) = variables else { return Ok(()) };
        self.leader.machine.load_variables(Some(&variables))?;
        self.derivation.plan.set_variables(Arc::unwrap_or_clone(variables));
        Ok(())
    }

    /// Returns a copy of the chain for the lineage, if its modules will be inspected; otherwise an empty
    /// chain.
    fn traced_chain(&self, chain: &Chain) -> Chain {
        match self.derivation.traced {
            Some(TraceRequest { chain: Some(_), .. }) => chain.clone(),
            _ => Chain::default(),
        }
    }

    /// Records a step on `chain` for features and the lineage.
    fn record(&mut self, chain: &Chain, outcome: &mut StepOutcome, number: usize) {
        if let Some(features) = &self.features {
            features.borrow_mut().step(&outcome.applied);
        }
        if self.derivation.traced.is_some() {
            let before = self.traced_chain(chain);
            let applied = std::mem::take(&mut outcome.applied);
            let asked = self.leader.machine.session.rows.take_noted();
            self.steps.push(Step { number, chain: before, applied, answers: Vec::new(), asked });
        }
    }

    /// Returns the work of each rule in all phases.
    fn uses(&self) -> Vec<Use> {
        let mut uses = self.stepper.uses().to_vec();
        if let Some(decomposer) = &self.decomposer {
            uses.iter_mut().zip(decomposer.uses()).for_each(|(sum, more)| *sum += *more);
        }
        uses
    }

    /// Publishes the current chain to queries.
    fn publish(&mut self, chain: &Arc<Chain>) {
        let (machine, plan) = (self.leader.machine, &self.derivation.plan);
        self.published += 1;
        let symbols = plan.steps.grammar.symbols();
        let view = machine.current.chains_derived.borrow();
        let view = view.with_current(plan.system, symbols, chain, self.failed(), self.published);
        machine.session.show_chains(view);
    }

    /// Returns the indices of the chains with faulty data.
    fn failed(&self) -> Vec<usize> {
        self.derivation.plan.objects.as_ref().map(|objects| objects.failed().list()).unwrap_or_default()
    }
}

/// Returns the work of the rules and interpretation rules, in the order of declaration.
fn reports(plan: &DerivationPlan, rules: &[Use], interpretations: &[Use]) -> Vec<RuleReport> {
    let rules = plan.steps.grammar.rules().iter().zip(rules).map(|(rule, done)| RuleReport {
        name: RuleName { text: rule.pattern.text.clone(), place: rule.place.clone() },
        interprets: false,
        done: *done,
    });
    let interpretations = plan.interpretations.list.iter().zip(interpretations);
    let interpretations =
        interpretations.filter(|(known, _)| !known.is_choice).map(|(known, done)| RuleReport {
            name: RuleName { text: known.name.clone(), place: known.place.clone() },
            interprets: true,
            done: *done,
        });
    rules.chain(interpretations).collect()
}
