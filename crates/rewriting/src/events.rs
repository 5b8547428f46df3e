//! Steps in which one module of each chain is rewritten, drawn by the propensities of the rules.
//!
//! Method: D. T. Gillespie, "Exact stochastic simulation of coupled chemical reactions", 1977.

use std::cell::RefCell;
use std::sync::Arc;

use crate::amounts::Amount;
use crate::batch::{Active, Batch, ChainPiece};
use crate::chain::{Chain, END, Mark, Symbol};
use crate::event_chain::{EventChain, EventWork, drawn_event};
use crate::events_between::{ChainsBetween, EventsNext, join_event_chains};
use crate::phases::PhaseOutcome;
use crate::propensities::PossibleEvent;
use crate::rules::Rules;
use crate::step::{Stepper, pieces};
use crate::step_number::StepNumber;
use crate::windows::ContextWindow;
use burgeon_base::error::Result;
use burgeon_base::random::Stream;
use burgeon_base::{KeyPart, ModuleKey, Stop};

/// Maximum number of symbols of a new segment, whose possible events are found again after each event in it.
const SEGMENT: usize = 64;

/// Function between two events: it gets the chains and the number of the second event.
pub type BetweenEvents<'a> = dyn FnMut(&ChainsBetween, usize) -> Result<EventsNext> + 'a;

/// Request for events.
#[allow(missing_debug_implementations, reason = "contains a function")]
pub struct EventSeries<'a> {
    /// Number of the first step.
    pub first: usize,
    /// Number of the last step.
    pub last: usize,
    /// Time at which the derivation ends. Later events do not occur.
    pub until: f64,
    /// Set if guards and propensities can give other results than before for the same modules.
    pub is_changed: bool,
    /// Symbols that end the series when a rule produces one of them.
    pub ends_at: &'a [Symbol],
    /// Function that is called after each step with its number and the number of symbols. The series ends if it returns
    /// `false`.
    pub watch: &'a mut dyn FnMut(usize, usize) -> bool,
    /// Function that is called between two steps, with the number of the second.
    pub between: Option<&'a mut BetweenEvents<'a>>,
}

/// Result of events.
#[derive(Debug)]
pub struct EventsOutcome {
    /// Chain after the last step.
    pub chain: Arc<Chain>,
    /// Number of steps, without the last one if the outcome is settled.
    pub steps: usize,
    /// Set if no other event can occur before the requested time.
    pub settled: bool,
    /// Set if a function of a rule has requested that the last step is the last of all.
    pub is_last: bool,
    /// Number of symbols that were examined.
    pub read: usize,
    /// For each symbol of the chain before the step, the rule that ran and the number of its successors; empty if the plan is
    /// not traced.
    pub applied: Vec<(u16, u32)>,
}

impl EventsOutcome {
    /// Creates the outcome of no step on `chain`.
    fn new(chain: &Arc<Chain>) -> Self {
        let (chain, applied) = (Arc::clone(chain), Vec::new());
        Self { chain, steps: 0, settled: false, is_last: false, read: 0, applied }
    }

    /// Returns the result of a phase that has requested one step. A step without an event does not count.
    pub fn into_phase_outcome(self) -> PhaseOutcome {
        PhaseOutcome {
            chain: self.chain,
            more_steps: match self.settled {
                true => self.steps,
                false => self.steps.saturating_sub(1),
            },
            settled: self.settled,
            is_last: self.is_last,
        }
    }
}

/// Time and random numbers of the next event of a chain.
struct NextEvent {
    time: f64,
    stream: Stream,
}

impl NextEvent {
    /// Draws the time of the next event of a chain with this key, which has the time `now`.
    fn draw(key: ModuleKey, step: usize, now: f64, total: Amount) -> Self {
        let mut stream = key.substream(KeyPart::Text(b"events")).child(step).stream();
        let waiting = -(1.0 - stream.uniform()).ln() / total.number();
        Self { time: now + waiting, stream }
    }
}

impl Stepper {
    /// Returns true if each step rewrites one module of each chain, drawn by the propensities of the rules.
    pub fn has_events(&self) -> bool {
        self.plan.grammar.has_events()
    }

    /// Returns the time of each chain, the sum of the waiting times of its events; empty before the first step.
    pub fn event_times(&self) -> &[f64] {
        &self.events.times
    }

    /// Performs steps on `chain`, which must be marked (see [`Chain::mark`]). In each step, one event occurs in each chain: a
    /// rule is applied to a module, drawn in proportion to the propensities of all rules at all modules. The time until the
    /// event is exponentially distributed, with the sum of the propensities as its rate.
    ///
    /// Functions are called again only for modules near a change, unless they read the number of the step. If nothing occurs in
    /// a step, the outcome is settled, unless a guard or a propensity reads the number of the step. Fails as a step does.
    pub fn perform_events(
        &mut self,
        rules: &dyn Rules,
        stop: &Stop,
        chain: &Arc<Chain>,
        series: &mut EventSeries<'_>,
    ) -> Result<EventsOutcome> {
        let plan = Arc::clone(&self.plan);
        self.events.times.resize(plan.chains, 0.0);
        if !plan.grammar.has_near_contexts() || plan.traced || plan.notes_places {
            return self.perform_event(rules, stop, chain, series);
        }
        let mut state = std::mem::take(&mut self.events);
        let is_known = state.whole.take().is_some_and(|whole| Arc::ptr_eq(&whole, chain));
        if !is_known {
            let divided = Chains { chain, begins: chain.starts(plan.grammar.arities()) };
            let size = plan.batch.clamp(1, SEGMENT);
            let chains = divided.each().enumerate();
            state.chains =
                chains.map(|(number, chain)| EventChain::new(&chain, number, &plan, size)).collect();
        } else if series.is_changed {
            state.chains.iter_mut().for_each(EventChain::forget_events);
        }
        let mut links = std::mem::take(&mut self.links);
        links.build_with(&Chain::default(), &plan.grammar, rules.parameters());
        let keys: Vec<ModuleKey> = ends(chain).map(|end| chain.keys[end]).collect();
        let mut work = EventWork {
            rules,
            plan: &plan,
            stop,
            scratch: &mut self.scratch,
            links: &mut links,
            window: ContextWindow::default(),
            spare: self.outputs.pop().unwrap_or_default(),
        };
        let mut outcome = EventsOutcome::new(chain);
        let mut is_changed = false;
        let mut growth = vec![0; plan.grammar.rules().len()];
        for number in series.first..=series.last {
            stop.check()?;
            if number > series.first
                && let Some(between) = &mut series.between
            {
                let chains = ChainsBetween::new(std::mem::take(&mut state.chains), &state.times, &plan);
                let next = between(&chains, number)?;
                state.chains = chains.into_chains()?;
                match next {
                    EventsNext::Continue => {}
                    EventsNext::Recompute => state.chains.iter_mut().for_each(EventChain::forget_events),
                    EventsNext::End => break,
                }
            }
            let (finding, applying) = (StepNumber::new(number), StepNumber::new(number));
            let (mut occurs, mut is_watched, mut symbols) = (false, false, 0);
            for (index, (chain, key)) in state.chains.iter_mut().zip(&keys).enumerate() {
                let time = &mut state.times[index];
                let (total, read) = chain.find_events(&mut work, &finding)?;
                outcome.read += read;
                let mut next = match total {
                    Amount::ZERO => None,
                    total => Some(NextEvent::draw(*key, number, *time, total)),
                };
                if next.as_ref().is_none_or(|next| next.time > series.until) && series.until.is_finite() {
                    *time = series.until;
                    next = None;
                }
                if let Some(mut next) = next {
                    occurs = true;
                    *time = next.time;
                    let changes = chain.apply_event(
                        &mut work,
                        &applying,
                        (&mut next.stream, &state.times),
                        series.ends_at,
                    )?;
                    outcome.read += changes.read;
                    is_watched |= changes.is_watched;
                    for (rule, done) in &work.spare.uses {
                        growth[usize::from(*rule)] += done.made;
                        self.uses[usize::from(*rule)] += *done;
                    }
                    work.spare.clear();
                }
                if finding.is_read() {
                    chain.forget_events();
                }
                symbols += chain.pieces().symbols;
            }
            is_changed |= occurs;
            outcome.is_last = applying.is_last();
            outcome.settled = !occurs && !finding.is_read();
            if outcome.settled {
                break;
            }
            outcome.steps += 1;
            if symbols > plan.limit {
                return Err(self.limit_error(&growth, number));
            }
            if !(series.watch)(number, symbols) || outcome.is_last || is_watched {
                break;
            }
        }
        self.outputs.push(work.spare);
        self.links = links;
        if is_changed {
            outcome.chain = Arc::new(join_event_chains(&state.chains, &plan));
        }
        state.whole = Some(Arc::clone(&outcome.chain));
        self.events = state;
        Ok(outcome)
    }

    /// Performs one step on the whole chain.
    fn perform_event(
        &mut self,
        rules: &dyn Rules,
        stop: &Stop,
        chain: &Arc<Chain>,
        series: &mut EventSeries<'_>,
    ) -> Result<EventsOutcome> {
        let plan = Arc::clone(&self.plan);
        let (grammar, number) = (&plan.grammar, series.first);
        let (finding, applying) = (StepNumber::new(number), StepNumber::new(number));
        self.links.build_with(chain, grammar, rules.parameters());
        let links = std::mem::take(&mut self.links);
        let batch = |step, times| Batch {
            rules,
            plan: &plan,
            chain,
            links: &links,
            step,
            times,
            stop,
            first: 0,
            new_chain: RefCell::default(),
        };
        let mut events = Vec::new();
        for piece in pieces(chain, plan.batch) {
            stop.check()?;
            batch(&finding, &[]).find_events(piece, &mut self.scratch, &mut events)?;
        }
        let chosen = self.choose_events(chain, &events, series);
        let occurs = !chosen.is_empty();
        let mut outcome = EventsOutcome {
            settled: !occurs && !finding.is_read(),
            read: chain.symbols.len(),
            ..EventsOutcome::new(chain)
        };
        let times = self.events.times.clone();
        let batch = batch(&applying, &times);
        let whole = ChainPiece { begin: Mark::default(), end: chain.symbols.len() };
        self.scratch.active = chosen;
        batch.apply_events(&mut self.scratch)?;
        if plan.traced {
            outcome.applied = batch.applied_rules(whole, &self.scratch);
        }
        let mut output = batch.splice(whole, &mut self.scratch, self.outputs.pop().unwrap_or_default());
        outcome.is_last = applying.is_last();
        outcome.steps = usize::from(!outcome.settled);
        let mut growth = vec![0; grammar.rules().len()];
        for (rule, done) in &output.uses {
            growth[usize::from(*rule)] += done.made;
            self.uses[usize::from(*rule)] += *done;
        }
        if occurs {
            outcome.chain = Arc::new(std::mem::take(&mut output.chain));
        }
        output.clear();
        self.outputs.push(output);
        self.links = links;
        if outcome.chain.symbols.len() > plan.limit {
            return Err(self.limit_error(&growth, number));
        }
        if !outcome.settled {
            (series.watch)(number, outcome.chain.symbols.len());
        }
        Ok(outcome)
    }

    /// Draws the next event of each chain among `events`, and sets the times of the chains.
    fn choose_events(
        &mut self,
        chain: &Chain,
        events: &[PossibleEvent],
        series: &EventSeries<'_>,
    ) -> Vec<Active> {
        let mut chosen = Vec::new();
        let mut rest = events;
        for ((number, end), time) in (0..).zip(ends(chain)).zip(&mut self.events.times) {
            let (own, others) = rest.split_at(rest.partition_point(|event| event.active.chain == number));
            rest = others;
            let total = own.iter().fold(Amount::ZERO, |sum, event| sum.plus(event.amount));
            let next = (total > Amount::ZERO)
                .then(|| NextEvent::draw(chain.keys[end], series.first, *time, total))
                .filter(|next| next.time <= series.until);
            match next {
                Some(mut next) => {
                    *time = next.time;
                    chosen.extend(drawn_event(own, total.draw(&mut next.stream)));
                }
                None if series.until.is_finite() => *time = series.until,
                None => {}
            }
        }
        chosen
    }
}

/// Chains that are stored together.
struct Chains<'a> {
    chain: &'a Chain,
    begins: Vec<Mark>,
}

impl Chains<'_> {
    /// Returns each chain alone.
    fn each(&self) -> impl Iterator<Item = Chain> + '_ {
        self.begins.windows(2).map(|pair| self.chain.part(pair[0], pair[1]))
    }
}

/// Returns the indices of the ends of chains.
fn ends(chain: &Chain) -> impl Iterator<Item = usize> + '_ {
    chain.symbols.iter().enumerate().filter(|(_, symbol)| **symbol == END).map(|(index, _)| index)
}
