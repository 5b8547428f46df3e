//! Rewriting of a piece of a chain: applies the chosen rules in batches, with one call of each rule's functions.

use std::cell::RefCell;
use std::time::{Duration, Instant};

use crate::chain::{Chain, Mark};
use crate::dependent_batch::DependentBatch;
use crate::links::Links;
use crate::matching::{Bindings, ContextMatcher};
use crate::new_chain::NewChain;
use crate::ordinals::Ordinals;
use crate::output::Output;
use crate::plan::StepPlan;
pub use crate::rules::NO_RULE;
use crate::rules::{Applications, RuleFailure, Rules};
use crate::step_number::StepNumber;
use crate::successors::{ModuleOrder, Successors};
use crate::text::module_brief;
use burgeon_base::ModuleKey;
use burgeon_base::Stop;
use burgeon_base::error::{Error, Result};

/// Piece of a chain, from a mark to another symbol.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ChainPiece {
    pub begin: Mark,
    pub end: usize,
}

/// Memory that a thread reuses from batch to batch.
#[derive(Debug, Default)]
pub struct Scratch {
    pub(crate) active: Vec<Active>,
    /// Successors of each rule.
    pub(crate) groups: Vec<Successors>,
    pub(crate) arguments: Vec<f64>,
    pub(crate) bindings: Bindings,
    pub(crate) chains: Vec<u32>,
    pub(crate) keys: Vec<ModuleKey>,
    pub(crate) places: Vec<u32>,
    pub(crate) arranged: ModuleOrder,
    pub(crate) ordinals: Ordinals,
    /// Indices of the active modules whose rules need the new chain.
    pub(crate) delayed: Vec<u32>,
    pub(crate) dependents: DependentBatch,
}

/// Module that has rules.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Active {
    pub module: u32,
    pub param: u32,
    pub chain: u32,
    pub rule: u16,
}

/// Current step, for one thread.
pub(crate) struct Batch<'a> {
    pub rules: &'a dyn Rules,
    pub plan: &'a StepPlan,
    pub chain: &'a Chain,
    pub links: &'a Links,
    pub step: &'a StepNumber,
    /// Time of each chain, if rules have propensities.
    pub times: &'a [f64],
    pub stop: &'a Stop,
    /// Number to add to an index in `chain` for the index in the whole chain; it wraps around.
    pub first: u32,
    /// Successors so far, if rules have contexts in the new chain.
    pub new_chain: RefCell<NewChain>,
}

impl Batch<'_> {
    /// Rewrites `piece`. Reuses the memory of `spare`, an emptied output.
    pub(crate) fn rewrite(&self, piece: ChainPiece, scratch: &mut Scratch, spare: Output) -> Result<Output> {
        let rules = self.plan.grammar.rules().len();
        scratch.groups.resize_with(rules, Successors::default);
        self.choose(piece, scratch)?;
        self.apply(scratch)?;
        if !scratch.delayed.is_empty() {
            self.rewrite_delayed(piece, scratch)?;
        }
        let applied = if self.plan.traced { self.applied_rules(piece, scratch) } else { Vec::new() };
        Ok(Output { applied, ..self.splice(piece, scratch, spare) })
    }

    /// Returns the matcher of contexts.
    #[inline]
    pub(crate) fn contexts(&self) -> ContextMatcher<'_> {
        ContextMatcher { chain: self.chain, links: self.links, grammar: &self.plan.grammar }
    }

    /// Gathers the arguments, chains and keys of the applications `members` of `rule`.
    pub(crate) fn gather<'s>(
        &'s self,
        rule: u16,
        members: &[u32],
        scratch: &'s mut Scratch,
    ) -> Applications<'s> {
        let grammar = &self.plan.grammar;
        let declared = &grammar.rules()[usize::from(rule)];
        let arity = declared.arguments();
        self.gather_origins(members, scratch);
        scratch.arguments.clear();
        if arity > 0 {
            self.gather_arguments(rule, members, scratch);
        }
        Applications {
            rule,
            count: members.len(),
            arguments: &scratch.arguments,
            chains: &scratch.chains,
            keys: &scratch.keys,
            places: &scratch.places,
            weighted: declared.weight.is_some(),
            step: self.step,
            times: self.times,
        }
    }

    /// Gathers the chains, random keys and places of the modules `members`.
    pub(crate) fn gather_origins(&self, members: &[u32], scratch: &mut Scratch) {
        let grammar = &self.plan.grammar;
        scratch.chains.clear();
        if self.plan.chains > 1 {
            scratch.chains.extend(members.iter().map(|index| scratch.active[*index as usize].chain));
        }
        scratch.keys.clear();
        if grammar.draws_random() {
            let key = |index: &u32| self.chain.keys[scratch.active[*index as usize].module as usize];
            scratch.keys.extend(members.iter().map(key));
        }
        scratch.places.clear();
        if self.plan.notes_places {
            let place = |index: &u32| scratch.active[*index as usize].module.wrapping_add(self.first);
            scratch.places.extend(members.iter().map(place));
        }
    }

    fn gather_arguments(&self, rule: u16, members: &[u32], scratch: &mut Scratch) {
        let declared = &self.plan.grammar.rules()[usize::from(rule)];
        let arity = declared.arguments();
        scratch.arguments.reserve(members.len() * arity);
        if declared.has_new_contexts() {
            self.gather_new(rule, members, scratch);
            return;
        }
        if declared.skips_arguments() {
            self.gather_some(rule, members, scratch);
            return;
        }
        let own = declared.pattern.own_bound();
        if declared.contexts().is_empty() {
            for index in members {
                let at = scratch.active[*index as usize].param as usize;
                extend_few(&mut scratch.arguments, &self.chain.params[at..at + own]);
            }
            return;
        }
        let (lefts, rights) = declared.contexts().split_at(declared.pattern.left.len());
        let contexts = self.contexts().of_rule(rule);
        let params = &self.chain.params;
        let Scratch { active, arguments, bindings, .. } = scratch;
        for index in members {
            let active = active[*index as usize];
            contexts.bind(active.module as usize, bindings);
            let mut bound = bindings.iter().map(|index| self.links.param[*index as usize] as usize);
            for (item, at) in lefts.iter().zip(&mut bound) {
                extend_few(arguments, &params[at..at + item.bound]);
            }
            let at = active.param as usize;
            extend_few(arguments, &params[at..at + own]);
            for (item, at) in rights.iter().zip(bound) {
                extend_few(arguments, &params[at..at + item.bound]);
            }
        }
    }

    /// Gathers the arguments of a rule that rewrites several modules at once, or whose pattern has values.
    #[inline(never)]
    fn gather_some(&self, rule: u16, members: &[u32], scratch: &mut Scratch) {
        let declared = &self.plan.grammar.rules()[usize::from(rule)];
        let arities = self.plan.grammar.arities();
        let left = declared.pattern.left.len();
        let contexts = self.contexts().of_rule(rule);
        for index in members {
            let active = scratch.active[*index as usize];
            if declared.has_contexts() {
                contexts.bind(active.module as usize, &mut scratch.bindings);
            }
            let begin = |place: usize| self.links.param[scratch.bindings[place] as usize] as usize;
            for (place, item) in declared.contexts().iter().enumerate().take(left) {
                item.push_arguments(&self.chain.params, begin(place), &mut scratch.arguments);
            }
            let mut at = active.param as usize;
            let symbols = &self.chain.symbols[active.module as usize..];
            for (item, symbol) in declared.pattern.predecessors.iter().zip(symbols) {
                item.push_arguments(&self.chain.params, at, &mut scratch.arguments);
                at += usize::from(arities[usize::from(*symbol)]);
            }
            for (place, item) in declared.contexts().iter().enumerate().skip(left) {
                item.push_arguments(&self.chain.params, begin(place), &mut scratch.arguments);
            }
        }
    }

    /// Applies every chosen rule to its modules. Returns the error that comes first in the chain.
    pub(crate) fn apply(&self, scratch: &mut Scratch) -> Result<()> {
        let mut first: Option<(u32, Error)> = None;
        for rule in 0..scratch.groups.len() {
            scratch.groups[rule].time = Duration::ZERO;
            if scratch.groups[rule].members.is_empty() {
                continue;
            }
            let mut members = std::mem::take(&mut scratch.groups[rule].members);
            if let Some((index, _)) = &first {
                members.retain(|member| member < index);
            }
            let begin = Instant::now();
            while !members.is_empty()
                && let Err((index, error)) = self.run(narrow_rule(rule), &members, scratch)
            {
                if let Err(error) = self.forgive(index, error, &mut members, scratch) {
                    first = Some((index, error));
                    break;
                }
            }
            scratch.groups[rule].members = members;
            scratch.groups[rule].time = begin.elapsed();
        }
        first.map_or(Ok(()), |(_, error)| Err(error))
    }

    fn run(&self, rule: u16, members: &[u32], scratch: &mut Scratch) -> Result<(), (u32, Error)> {
        let mut group = std::mem::take(&mut scratch.groups[usize::from(rule)]);
        let is_made = self.plan.grammar.rules()[usize::from(rule)]
            .production()
            .is_some_and(|production| self.produce(rule, production, members, scratch, &mut group));
        let applied = match is_made {
            true => Ok(()),
            false => self.rules.apply(&self.gather(rule, members, scratch), &mut group),
        };
        group.rewind();
        scratch.groups[usize::from(rule)] = group;
        applied.map_err(|failure| self.blame(failure, rule, members, scratch))
    }

    /// Skips the chain of application `index` if its data is wrong: its modules stay unchanged, and its applications
    /// are removed from `members`. Returns every other error.
    pub(crate) fn forgive(
        &self,
        index: u32,
        error: Error,
        members: &mut Vec<u32>,
        scratch: &mut Scratch,
    ) -> Result<()> {
        let Some(failed) = &self.plan.failed else { return Err(error) };
        let chain = scratch.active[index as usize].chain;
        failed.forgive(chain as usize, error)?;
        members.retain(|member| {
            let active = &mut scratch.active[*member as usize];
            if active.chain == chain {
                active.rule = NO_RULE;
            }
            active.chain != chain
        });
        Ok(())
    }

    /// Returns the error of a rule with its location, rule, modules and step.
    pub(crate) fn blame(
        &self,
        failure: RuleFailure,
        rule: u16,
        members: &[u32],
        scratch: &Scratch,
    ) -> (u32, Error) {
        let index = members.get(failure.at).copied().unwrap_or(members[0]);
        let active = scratch.active[index as usize];
        let grammar = &self.plan.grammar;
        let declared = &grammar.rules()[usize::from(rule)];
        let mut param = active.param as usize;
        let run = &self.chain.symbols[active.module as usize..][..declared.run_length()];
        let modules = run.iter().map(|symbol| {
            let params = &self.chain.params[param..][..usize::from(grammar.arities()[usize::from(*symbol)])];
            param += params.len();
            module_brief(grammar.symbols(), self.rules.parameters(), *symbol, params)
        });
        let module = modules.collect::<Vec<_>>().join(" ");
        let error = failure.error.at_place(declared.place.as_ref()).rule(&declared.pattern.text);
        (index, error.module(module, self.step.number()))
    }
}

/// Appends `items`. For a few numbers this is faster than a call that copies memory.
#[inline(always)]
pub(crate) fn extend_few<T: Copy>(out: &mut Vec<T>, items: &[T]) {
    const FEW: usize = 6;
    if items.len() > FEW {
        out.extend_from_slice(items);
        return;
    }
    for item in items {
        out.push(*item);
    }
}

/// Converts an index in a chain to 32 bits; the limit on modules keeps chains below 2^32 symbols and parameters.
#[allow(clippy::cast_possible_truncation, reason = "below the limit on modules")]
pub(crate) fn narrow(index: usize) -> u32 {
    index as u32
}

#[allow(clippy::cast_possible_truncation, reason = "rules are numbered in 16 bits")]
pub(crate) fn narrow_rule(rule: usize) -> u16 {
    rule as u16
}
