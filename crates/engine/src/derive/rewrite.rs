//! Phases that rewrite the chain: cuts, rules, decomposition rules and placeholders.

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::hooks::EventHooks;
use super::interpret::InterpretationPass;
use super::passes::Interpret;
use super::pending::{Resolution, resolve};
use super::plan::{Decomposition, Derivation};
use super::state::DerivationState;
use super::step::{perform, perform_events, step};
use crate::machine::stops_at_depth;
use crate::results::Step;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::text::grouped;
use burgeon_rewriting::{
    Chain, ChainsBetween, CutChain, EventSeries, PLACEHOLDERS, Phase, PhaseOutcome, PlaceFollower,
    SeriesChain, StepSeries, Stepper, cut, module_brief, placeholder,
};

/// Removes the modules that cut branches, with what follows them in their branches.
pub(super) struct CutBranches;

impl Phase<DerivationState<'_>> for CutBranches {
    fn run(&self, state: &mut DerivationState<'_>, chain: Arc<Chain>, number: usize) -> Result<PhaseOutcome> {
        let plan = &state.derivation.plan;
        let arities = plan.steps.grammar.arities();
        let begin = Instant::now();
        let made = plan.cut.and_then(|symbol| cut(&chain, symbol, arities));
        state.has_cut = made.is_some();
        state.has_ever_cut |= state.has_cut;
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

/// Applies the rules once; or several times, if nothing observes the steps and each step changes little.
pub(super) struct Rewrite;

impl Phase<DerivationState<'_>> for Rewrite {
    fn run(&self, state: &mut DerivationState<'_>, chain: Arc<Chain>, number: usize) -> Result<PhaseOutcome> {
        if state.stepper.has_events() {
            return perform_events_of(state, chain, number);
        }
        let follows = state.follows_places();
        if !state.has_cut
            && (follows || state.performs_series())
            && state.stepper.begin_series(&chain, follows)
        {
            return perform_series(state, chain, number, follows);
        }
        let Derivation { plan, declared, .. } = state.derivation;
        let session = &state.leader.machine.session;
        session.stop.check()?;
        let begin = Instant::now();
        state.times.read += chain.symbols.len();
        let mut outcome = step(state.leader, plan, &mut state.stepper, declared, &chain, number)?;
        plan.set_places(None);
        state.times.rewriting += begin.elapsed();
        state.record(&chain, std::mem::take(&mut outcome.applied), number);
        state.previous = Some(chain);
        let reads_step = outcome.reads_step || state.pass.reads_step || state.decomposition_reads_step;
        // An environment can change although no module does.
        let evolves = plan.environments.is_some() && plan.bounded;
        let varies = std::mem::take(&mut state.variables_changed) || state.has_step_hooks() || evolves;
        let repeats = !outcome.changed && state.ends_unchanged();
        let settled = (!outcome.ran || repeats) && !reads_step && !varies && !state.has_cut;
        let is_last = outcome.is_last;
        Ok(PhaseOutcome { settled, is_last, ..PhaseOutcome::next(Arc::new(outcome.chain)) })
    }
}

/// Refuses further steps of a derivation without a number of steps that has not ended by itself.
pub(super) struct RefuseEndless;

/// Maximum number of steps of a derivation without a number of steps.
const MOST_OPEN_STEPS: usize = 200_000;

impl Phase<DerivationState<'_>> for RefuseEndless {
    fn run(&self, state: &mut DerivationState<'_>, chain: Arc<Chain>, number: usize) -> Result<PhaseOutcome> {
        if number <= MOST_OPEN_STEPS {
            return Ok(PhaseOutcome::next(chain));
        }
        let steps = grouped(MOST_OPEN_STEPS);
        let modules = grouped(chain.symbols.len().saturating_sub(1));
        let text =
            format!("the derivation has not ended after {steps} steps (modules in the chain: {modules})");
        let error = Error::limit(Limit::Size, text).help(
            "end the rule with a guard or a counter, or write the number of steps: system:derive(1000000)",
        );
        let rules = state.derivation.plan.steps.grammar.rules();
        let uses = state.uses();
        let most = rules.iter().zip(&uses).rev().max_by_key(|(_, of_rule)| of_rule.applied);
        Err(match most {
            Some((rule, of_rule)) => {
                let often = grouped(of_rule.applied);
                error
                    .at_place(rule.place.as_ref())
                    .rule(format!("{} (applied most, {often} times)", rule.pattern.text))
            }
            None => error.at_place(state.derivation.place.as_ref()),
        })
    }
}

/// Maximum number of steps between two stored chains.
const STORED_STEPS: usize = 64;

/// Performs steps from step `number` on, in each of which only the parts of the chain are rewritten that can change. If
/// `follows` is set, the places that rules read are found between the steps.
fn perform_series(
    state: &mut DerivationState<'_>,
    chain: Arc<Chain>,
    number: usize,
    follows: bool,
) -> Result<PhaseOutcome> {
    let Derivation { plan, declared, limit, .. } = state.derivation;
    let end = if state.derivation.is_open() { (*limit).min(MOST_OPEN_STEPS.max(number)) } else { *limit };
    let machine = state.leader.machine;
    let session = &machine.session;
    let begin = Instant::now();
    let mut read = chain.symbols.len();
    let mut last = 0;
    let ends_unchanged = state.ends_unchanged();
    let mut following = Duration::ZERO;
    let (leader, memory, uses) = (state.leader, &mut state.memory, &mut state.interpretations);
    let mut follow = |chain: &SeriesChain<'_>, number: usize, goes_on: bool| {
        memory.keep(chain.unchanged());
        if !goes_on {
            return Ok(true);
        }
        let begin = Instant::now();
        let followed = InterpretationPass::follow(leader, plan, chain, number, uses, memory);
        following += begin.elapsed();
        followed
    };
    let ends_at: Vec<_> = (0..PLACEHOLDERS).map(placeholder).chain(plan.cut).collect();
    let outcome = perform(
        machine,
        plan,
        &mut state.stepper,
        declared,
        &chain,
        &mut StepSeries {
            first: number,
            last: match state.checkpoints {
                Some(_) => end.min(number + STORED_STEPS - 1),
                None => end,
            },
            ends_unchanged,
            ends_at: &ends_at,
            watch: &mut |number, symbols| {
                read += std::mem::replace(&mut last, symbols);
                session.progress.note(number, *limit, symbols);
                !session.has_many_unused()
            },
            places: follows.then_some(PlaceFollower { located: &plan.located, follow: &mut follow }),
        },
    )?;
    state.times.read += read;
    state.times.rewriting += begin.elapsed().saturating_sub(following);
    state.times.interpretation += following;
    state.previous = Some(chain);
    let chain = Arc::new(outcome.chain);
    if follows {
        plan.set_places(None);
        state.memory.set_chain(&chain);
    }
    Ok(PhaseOutcome {
        chain,
        more_steps: outcome.steps - 1,
        settled: outcome.settled,
        is_last: outcome.is_last,
    })
}

/// Performs events from step `number` on: several, if nothing observes the chains between them.
fn perform_events_of(
    state: &mut DerivationState<'_>,
    chain: Arc<Chain>,
    number: usize,
) -> Result<PhaseOutcome> {
    let derivation = state.derivation;
    let Derivation { plan, declared, limit, until, last_only, .. } = derivation;
    let machine = state.leader.machine;
    let session = &machine.session;
    let begin = Instant::now();
    let ends_at: Vec<_> = (0..PLACEHOLDERS).map(placeholder).chain(plan.cut).collect();
    let is_alone = state.is_last_step || !state.performs_events_together();
    let has_changed_variables = std::mem::take(&mut state.variables_changed);
    let evolves = plan.environments.is_some();
    let is_asked = !*last_only && plan.objects.is_some();
    let mut hooks = EventHooks::new(state.leader, derivation, state.group);
    let mut hooking = Duration::ZERO;
    let mut between = |chains: &ChainsBetween, number: usize| {
        let begin = Instant::now();
        let next = hooks.run(chains, number);
        hooking += begin.elapsed();
        next
    };
    let has_hooks = state.has_step_hooks();
    let mut outcome = perform_events(
        machine,
        plan,
        &mut state.stepper,
        declared,
        &chain,
        &mut EventSeries {
            first: number,
            last: if is_alone { number } else { *limit },
            until: *until,
            is_changed: has_changed_variables || evolves || is_asked || session.asks_for_chains(),
            ends_at: &ends_at,
            watch: &mut |number, symbols| {
                session.progress.note(number, *limit, symbols);
                !session.has_many_unused()
            },
            between: has_hooks.then_some(&mut between),
        },
    )?;
    plan.set_places(None);
    state.variables_changed |= hooks.early.is_some() && hooks.has_changed_variables;
    state.early_hooks = hooks.early;
    state.use_group(hooks.group);
    state.times.read += outcome.read;
    state.times.rewriting += begin.elapsed().saturating_sub(hooking);
    state.record(&chain, std::mem::take(&mut outcome.applied), number);
    state.previous = Some(chain);
    // Hooks and environments can make events possible although no module changes.
    let reads_step = state.pass.reads_step || state.decomposition_reads_step;
    let is_first = outcome.steps == 0;
    let varies = is_first && (has_changed_variables || state.has_cut)
        || state.has_step_hooks()
        || evolves
        || reads_step;
    let is_over = state.stepper.event_times().iter().all(|time| time >= until);
    let phase = outcome.into_phase_outcome();
    Ok(PhaseOutcome { settled: phase.settled && (!varies || is_over), ..phase })
}

/// Applies the decomposition rules until none applies, or up to the maximum depth.
pub(super) struct Decompose;

impl Phase<DerivationState<'_>> for Decompose {
    fn run(&self, state: &mut DerivationState<'_>, chain: Arc<Chain>, number: usize) -> Result<PhaseOutcome> {
        let (Some(rules), Some(mut decomposer)) =
            (&state.derivation.plan.decomposition, state.decomposer.take())
        else {
            return Ok(PhaseOutcome::next(chain));
        };
        let made = Self::apply(state, rules, &mut decomposer, chain, number);
        let made = made.map_err(|error| decomposer.blame_for_memory(error, &[]));
        state.decomposer = Some(decomposer);
        made
    }
}

impl Decompose {
    fn apply(
        state: &mut DerivationState<'_>,
        rules: &Decomposition,
        decomposer: &mut Stepper,
        mut chain: Arc<Chain>,
        number: usize,
    ) -> Result<PhaseOutcome> {
        let Derivation { plan, declared, .. } = state.derivation;
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
            let mut outcome = step(state.leader, plan, decomposer, declared, &chain, number)?;
            plan.set_places(None);
            state.times.rewriting += begin.elapsed();
            state.decomposition_reads_step |= outcome.reads_step;
            is_last |= outcome.is_last;
            if !outcome.changed {
                break;
            }
            state.times.read += chain.symbols.len();
            state.record(&chain, std::mem::take(&mut outcome.applied), number);
            decomposer.reuse(chain);
            chain = Resolve.run(state, Arc::new(outcome.chain), number)?.chain;
        }
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
    let mut trial = Stepper::new(&rules.steps);
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
        .at_place(rule.place.as_ref())
        .rule(&rule.pattern.text);
    session.warn(match module {
        Some(module) => warning.module(module, number),
        None => warning,
    });
    Ok(())
}

/// Replaces placeholders by other modules.
pub(super) struct Resolve;

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
