//! A chain with the events that can occur in it, so that the next event costs as much as it changes.

use std::cell::RefCell;
use std::sync::Arc;

use crate::amounts::{Amount, AmountTree};
use crate::batch::{Active, Batch, ChainPiece, NO_RULE, Scratch, narrow};
use crate::chain::{Chain, Mark, Symbol};
use crate::links::Links;
use crate::output::Output;
use crate::plan::StepPlan;
use crate::propensities::PossibleEvent;
use crate::rules::Rules;
use crate::segments::SegmentedChain;
use crate::step_number::StepNumber;
use crate::windows::ContextWindow;
use burgeon_base::Stop;
use burgeon_base::error::Result;
use burgeon_base::random::Stream;

/// Rules, and memory that events reuse.
pub(crate) struct EventWork<'a> {
    pub rules: &'a dyn Rules,
    pub plan: &'a StepPlan,
    pub stop: &'a Stop,
    pub scratch: &'a mut Scratch,
    pub links: &'a mut Links,
    pub window: ContextWindow,
    pub spare: Output,
}

/// One chain in segments, each with the events that can occur in it.
#[derive(Debug)]
pub(crate) struct EventChain {
    pieces: SegmentedChain,
    /// Number of the chain.
    number: usize,
    /// Possible events of each segment, with places in the segment.
    events: Vec<Vec<PossibleEvent>>,
    /// Sum of the propensities of each segment.
    amounts: AmountTree,
    /// Indices of the segments whose events must be found again.
    stale: Vec<usize>,
    /// Maximum number of segments between a segment and the end of what its contexts reach.
    longest_reach: usize,
}

/// Chains between events.
#[derive(Debug, Default)]
pub(crate) struct EventState {
    /// Time of each chain.
    pub times: Vec<f64>,
    pub chains: Vec<EventChain>,
    /// Chain that `chains` divide.
    pub whole: Option<Arc<Chain>>,
}

impl EventState {
    /// Forgets the events that can occur, but not the times.
    pub(crate) fn forget_chains(&mut self) {
        self.chains.clear();
        self.whole = None;
    }
}

/// Changes of an event.
#[derive(Debug, Default, Clone, Copy)]
pub(crate) struct EventChanges {
    /// Set if the rule has produced one of the requested symbols.
    pub is_watched: bool,
    /// Number of symbols that were examined.
    pub read: usize,
}

impl EventChain {
    /// Divides `chain`, which is chain number `number`, into segments of `size` symbols.
    pub(crate) fn new(chain: &Chain, number: usize, plan: &StepPlan, size: usize) -> Self {
        let mut made = Self {
            pieces: SegmentedChain::new(chain, &plan.grammar, size, &[]),
            number,
            events: Vec::new(),
            amounts: AmountTree::default(),
            stale: Vec::new(),
            longest_reach: 0,
        };
        made.forget_events();
        made
    }

    /// Returns the chain in segments.
    pub(crate) fn pieces(&self) -> &SegmentedChain {
        &self.pieces
    }

    /// Discards the possible events, because something else than a module has changed.
    pub(crate) fn forget_events(&mut self) {
        let count = self.pieces.segments.len();
        self.events.clear();
        self.events.resize_with(count, Vec::new);
        self.amounts.fill(std::iter::repeat_n(Amount::ZERO, count));
        self.stale.clear();
        self.stale.extend((0..count).filter(|index| self.pieces.segments[*index].has_rules()));
    }

    /// Finds the events that can occur, as far as they can have changed. Returns the sum of their propensities, and the number of
    /// symbols that were examined.
    pub(crate) fn find_events(
        &mut self,
        work: &mut EventWork<'_>,
        step: &StepNumber,
    ) -> Result<(Amount, usize)> {
        let mut read = 0;
        for index in std::mem::take(&mut self.stale) {
            work.stop.check()?;
            let mut events = std::mem::take(&mut self.events[index]);
            events.clear();
            let begin = self.with_batch(work, (step, &[]), index, |batch, piece, scratch, _| {
                read += piece.end - piece.begin.module;
                batch.find_events(piece, scratch, &mut events)?;
                Ok(piece.begin)
            })?;
            for event in &mut events {
                event.active.module -= narrow(begin.module);
                event.active.param -= narrow(begin.param);
            }
            let amount = events.iter().fold(Amount::ZERO, |sum, event| sum.plus(event.amount));
            self.events[index] = events;
            self.amounts.set(index, amount);
        }
        Ok((self.amounts.total(), read))
    }

    /// Draws an event, in proportion to the propensities, and applies its rule. Some propensity must be greater than 0.
    pub(crate) fn apply_event(
        &mut self,
        work: &mut EventWork<'_>,
        step: &StepNumber,
        (stream, times): (&mut Stream, &[f64]),
        ends_at: &[Symbol],
    ) -> Result<EventChanges> {
        let (index, rest) = self.amounts.find(self.amounts.total().draw(stream));
        let Some(event) = drawn_event(&self.events[index], rest) else { return Ok(EventChanges::default()) };
        let mut output = self.with_batch(work, (step, times), index, |batch, piece, scratch, spare| {
            scratch.active.clear();
            scratch.active.push(Active {
                module: event.module + narrow(piece.begin.module),
                param: event.param + narrow(piece.begin.param),
                ..event
            });
            batch.apply_events(scratch)?;
            Ok(batch.splice(piece, scratch, std::mem::take(spare)))
        })?;
        let mut changes = EventChanges { is_watched: false, read: output.chain.symbols.len() };
        if work.scratch.active.first().is_some_and(|active| active.rule == NO_RULE) {
            // The chain has failed, so nothing occurs in it any more.
            self.forget_events();
        } else {
            let grammar = &work.plan.grammar;
            changes.is_watched = output.changed && output.chain.symbols.iter().any(|it| ends_at.contains(it));
            output.chain = self.pieces.replace(index, std::mem::take(&mut output.chain), grammar);
            // Without a change only the random key of the module is new, on which no propensity depends.
            if output.changed {
                self.note_change(index, work.plan);
            }
        }
        work.spare = output;
        Ok(changes)
    }

    /// Marks the segment at `index`, which has changed, and those whose contexts reach it, and divides or joins segments whose
    /// length requires it.
    fn note_change(&mut self, index: usize, plan: &StepPlan) {
        let (last, far) = (self.pieces.segments.len() - 1, self.longest_reach);
        let reaching = (index.saturating_sub(far)..=last.min(index + far)).filter(|other| {
            *other != index && {
                let segment = &self.pieces.segments[*other];
                segment.has_rules() && segment.reach.contains(&index)
            }
        });
        self.stale = std::iter::once(index).chain(reaching).collect();
        let parts = self.pieces.divide(index, &plan.grammar);
        if self.pieces.is_sparse() {
            self.pieces.join(&plan.grammar);
            self.forget_events();
        } else if parts > 1 {
            self.longest_reach += parts - 1;
            for stale in self.stale.iter_mut().filter(|stale| **stale > index) {
                *stale += parts - 1;
            }
            self.stale.extend(index + 1..index + parts);
            self.events.splice(index..=index, std::iter::repeat_with(Vec::new).take(parts));
            self.amounts.divide(index, parts);
        }
    }

    /// Calls `act` with a batch in which the segment at `index`, with the modules that its contexts reach, is a piece.
    fn with_batch<T>(
        &mut self,
        work: &mut EventWork<'_>,
        (step, times): (&StepNumber, &[f64]),
        index: usize,
        act: impl FnOnce(&Batch<'_>, ChainPiece, &mut Scratch, &mut Output) -> Result<T>,
    ) -> Result<T> {
        let grammar = &work.plan.grammar;
        let (piece, chain) = match grammar.has_contexts() {
            true => {
                let (piece, reach) = work.window.fill(&self.pieces, index, self.number, grammar);
                work.links.build_with(&work.window.chain, grammar, work.rules.parameters());
                self.longest_reach = self.longest_reach.max(index - reach.start).max(reach.end - index);
                self.pieces.segments[index].reach = reach;
                (piece, &work.window.chain)
            }
            false => {
                let chain = &self.pieces.segments[index].chain;
                let begin = Mark { chain: self.number, ..Mark::default() };
                (ChainPiece { begin, end: chain.symbols.len() }, chain)
            }
        };
        let (rules, plan, stop, links) = (work.rules, work.plan, work.stop, &*work.links);
        let batch =
            Batch { rules, plan, chain, links, step, times, stop, first: 0, new_chain: RefCell::default() };
        act(&batch, piece, work.scratch, &mut work.spare)
    }
}

/// Returns the event that contains the place `drawn` of the sum of the propensities.
pub(crate) fn drawn_event(events: &[PossibleEvent], mut drawn: Amount) -> Option<Active> {
    for event in events {
        match drawn.minus(event.amount) {
            Some(rest) => drawn = rest,
            None => return Some(event.active),
        }
    }
    None
}
