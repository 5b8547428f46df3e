//! Several steps in a row, each of which costs as much as it changes.

use std::cell::RefCell;

use crate::batch::{Batch, ChainPiece, narrow};
use crate::chain::{Chain, Mark, Symbol};
use crate::links::Links;
use crate::output::Output;
use crate::regions::RegionPath;
use crate::rules::Rules;
use crate::segments::SegmentedChain;
use crate::series_chain::{PlaceFollower, SeriesChain, equal_symbols};
use crate::series_pause::SeriesPause;
use crate::step::Stepper;
use crate::step_number::StepNumber;
use crate::windows::ContextWindow;
use burgeon_base::Stop;
use burgeon_base::error::Result;

/// Maximum number of symbols of a new segment.
const SEGMENT: usize = 256;

/// Minimum number of segments, since a step on few of them costs as much as a step on the whole chain.
const FEWEST: usize = 8;

/// Request for several steps in a row.
#[allow(missing_debug_implementations, reason = "contains a function")]
pub struct StepSeries<'a> {
    /// Number of the first step.
    pub first: usize,
    /// Number of the last step.
    pub last: usize,
    /// Set if a step that changes nothing ends the derivation although rules ran.
    pub ends_unchanged: bool,
    /// Symbols that end the series when a rule produces one of them.
    pub ends_at: &'a [Symbol],
    /// Function that is called after each step with its number and the number of symbols. The series ends if it returns
    /// `false`.
    pub watch: &'a mut dyn FnMut(usize, usize) -> bool,
    /// Follower of the places of modules, if rules read them.
    pub places: Option<PlaceFollower<'a>>,
}

/// Result of several steps in a row.
#[derive(Debug)]
pub struct SeriesOutcome {
    /// Chain after the last step.
    pub chain: Chain,
    /// Number of steps, at least 1.
    pub steps: usize,
    /// Set if the last step ends the derivation because nothing can change in later steps.
    pub settled: bool,
    /// Set if a function of a rule has read the number of the step.
    pub reads_step: bool,
    /// Set if a function of a rule has requested that the last step of the series is the last of all.
    pub is_last: bool,
    /// Number of symbols that were examined in all steps.
    pub read: usize,
}

/// Changes of a step.
#[derive(Default)]
struct StepChanges {
    ran: bool,
    changed: bool,
    /// Set if a rule has produced one of the requested symbols.
    is_watched: bool,
    read: usize,
    /// Number of symbols at the beginning of the chain that are the same as before.
    unchanged: usize,
}

impl Stepper {
    /// Returns true if [`perform`](Self::perform) is to perform the next steps, because the last step has changed little of a
    /// long `chain`. After a series in which most of the chain changed, it returns false for some steps. If rules read
    /// places, `follows` must be set: the series then has a [`PlaceFollower`].
    pub fn begin_series(&mut self, chain: &Chain, follows: bool) -> bool {
        let size = self.segment_size();
        let applied = self.applied_last.map_or(usize::MAX, |applied| applied.saturating_mul(4 * size));
        if chain.symbols.len() < FEWEST * size
            || applied > chain.symbols.len()
            || !self.plan.grammar.has_near_contexts()
            || self.plan.traced
            || self.plan.notes_places && !follows
        {
            return false;
        }
        self.pause.pass()
    }

    fn segment_size(&self) -> usize {
        self.plan.batch.clamp(1, SEGMENT)
    }

    /// Performs steps on `chain` in which only those segments of the chain are rewritten whose modules, or whose contexts,
    /// have changed. The chains are the same as those of [`step`](Self::step).
    ///
    /// Functions of rules must return the same results for the same modules in each step, unless they read the number of
    /// the step. The series ends early if most of the chain changes. Fails as a step does.
    pub fn perform(
        &mut self,
        rules: &dyn Rules,
        stop: &Stop,
        chain: &Chain,
        series: &mut StepSeries<'_>,
    ) -> Result<SeriesOutcome> {
        let plan = std::sync::Arc::clone(&self.plan);
        let located = series.places.as_ref().map_or(&[][..], |places| places.located);
        let mut pieces = SegmentedChain::new(chain, &plan.grammar, self.segment_size(), located);
        let mut window = ContextWindow::default();
        let mut links = std::mem::take(&mut self.links);
        links.build_with(&Chain::default(), &plan.grammar, rules.parameters());
        let mut outcome = SeriesOutcome {
            chain: Chain::default(),
            steps: 0,
            settled: false,
            reads_step: false,
            is_last: false,
            read: 0,
        };
        let mut busy = 0;
        for number in series.first..=series.last {
            stop.check()?;
            let step = StepNumber::new(number);
            let changes = self.step_segments(
                rules,
                stop,
                &step,
                &mut pieces,
                (&mut window, &mut links),
                series.ends_at,
            )?;
            outcome.steps += 1;
            outcome.read += changes.read;
            outcome.reads_step = step.is_read();
            outcome.is_last = step.is_last();
            let repeats = !changes.changed && series.ends_unchanged;
            outcome.settled = (!changes.ran || repeats) && !outcome.reads_step;
            // In the first step, all segments are examined.
            let is_busy = number > series.first && 2 * pieces.awake() > pieces.symbols;
            busy = if is_busy { busy + 1 } else { 0 };
            let mut goes_on = (series.watch)(number, pieces.symbols)
                && !(outcome.settled || outcome.reads_step || outcome.is_last || changes.is_watched);
            if goes_on && (busy == 2 || pieces.segments.len() < FEWEST) {
                self.pause = self.pause.after_series(outcome.steps);
                goes_on = false;
            }
            if let Some(places) = &mut series.places {
                let unchanged = changes.unchanged;
                let after = SeriesChain { segments: &pieces, grammar: &plan.grammar, unchanged };
                goes_on &= (places.follow)(&after, number, goes_on && number < series.last)?;
            }
            if !goes_on {
                break;
            }
        }
        if outcome.reads_step {
            // Guards that read the number of the step can decide differently in each step.
            self.pause = SeriesPause::endless();
        }
        self.links = links;
        outcome.chain = pieces.joined();
        outcome.chain.mark(plan.batch, plan.grammar.arities());
        Ok(outcome)
    }

    /// Performs a step on the segments that are not resting.
    fn step_segments(
        &mut self,
        rules: &dyn Rules,
        stop: &Stop,
        step: &StepNumber,
        pieces: &mut SegmentedChain,
        (window, links): (&mut ContextWindow, &mut Links),
        ends_at: &[Symbol],
    ) -> Result<StepChanges> {
        let plan = std::sync::Arc::clone(&self.plan);
        let grammar = &plan.grammar;
        let mut changes = StepChanges::default();
        let mut outputs: Vec<(usize, usize, Output)> = Vec::new();
        let (mut chains, mut first) = (0, 0);
        let has_regions = !grammar.region_openers().is_empty();
        let mut regions = RegionPath::default();
        for index in 0..pieces.segments.len() {
            if has_regions {
                pieces.segments[index].enter(&regions);
            }
            let segment = &pieces.segments[index];
            let (ends, length) = (segment.brackets.ends, segment.chain.symbols.len());
            if !segment.is_resting {
                changes.read += segment.chain.symbols.len();
                let (piece, reach) = match grammar.has_contexts() {
                    true => window.fill(pieces, index, chains, grammar),
                    false => {
                        let begin = Mark { chain: chains, ..Mark::default() };
                        (ChainPiece { begin, end: segment.chain.symbols.len() }, index..index + 1)
                    }
                };
                let chain = match grammar.has_contexts() {
                    true => {
                        links.build_with(&window.chain, grammar, rules.parameters());
                        &window.chain
                    }
                    false => &segment.chain,
                };
                if has_regions {
                    links.find_regions(chain, piece.begin.module, regions.clone(), grammar);
                }
                let batch = Batch {
                    rules,
                    plan: &plan,
                    chain,
                    links,
                    step,
                    times: &[],
                    stop,
                    first: narrow(first).wrapping_sub(narrow(piece.begin.module)),
                    new_chain: RefCell::default(),
                };
                let spare = self.outputs.pop().unwrap_or_default();
                let output = batch.rewrite(piece, &mut self.scratch, spare)?;
                pieces.segments[index].reach = reach;
                pieces.segments[index].is_resting = !output.ran && !pieces.segments[index].is_located;
                outputs.push((index, first, output));
            }
            if has_regions {
                regions.skip(&pieces.segments[index].region_change);
            }
            chains += ends;
            first += length;
        }
        let mut changed = Vec::new();
        changes.unchanged = pieces.symbols;
        let mut growth = vec![0; grammar.rules().len()];
        for (index, first, mut output) in outputs {
            changes.ran |= output.ran;
            changes.changed |= output.changed;
            for (rule, done) in &output.uses {
                growth[usize::from(*rule)] += done.made;
                self.uses[usize::from(*rule)] += *done;
            }
            // Rules that keep their modules advance their random keys.
            if output.changed || output.ran && grammar.draws_random() {
                changes.is_watched |= output.chain.symbols.iter().any(|symbol| ends_at.contains(symbol));
                output.chain = pieces.replace(index, std::mem::take(&mut output.chain), grammar);
                if changed.is_empty() {
                    let new = &pieces.segments[index].chain;
                    changes.unchanged = first + equal_symbols(&output.chain, new, grammar.arities());
                }
                changed.push(index);
            }
            output.clear();
            self.outputs.push(output);
        }
        if pieces.symbols > plan.limit {
            return Err(self.limit_error(&growth, step.number()));
        }
        if grammar.has_contexts() {
            pieces.wake(&changed);
        }
        pieces.balance(&changed, grammar);
        Ok(changes)
    }
}
