//! Rewrites one piece of a chain: runs the chosen rules in batches, one call into Lua for each.

use std::sync::Arc;
use std::time::Instant;

use super::functions::{Applications, Failure, RuleFunctions};
use super::group::{ModuleOrder, RuleGroup};
use super::output::Output;
use super::plan::DerivationPlan;
use burgeon_base::error::{Error, Result};
use burgeon_kit::rules::{Bindings, Chain, ContextMatcher, Links, Mark, ModuleKey, Values, module_brief};

/// No rule.
pub(super) const NONE: u16 = burgeon_kit::RewriteOutcome::NONE;
/// A piece of the chain: from a mark up to another symbol.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ChainPiece {
    pub begin: Mark,
    pub end: usize,
}

/// What a thread keeps from batch to batch.
#[derive(Default)]
pub(crate) struct Scratch {
    pub(super) active: Vec<Active>,
    /// One for each rule.
    pub(super) groups: Vec<RuleGroup>,
    arguments: Vec<f64>,
    pub(super) bindings: Bindings,
    chains: Vec<u32>,
    keys: Vec<ModuleKey>,
    places: Vec<u32>,
    pub(super) arranged: ModuleOrder,
}

/// A module that has rules.
#[derive(Clone, Copy)]
pub(super) struct Active {
    pub module: u32,
    pub param: u32,
    pub chain: u32,
    pub rule: u16,
}

/// The step at hand, for one thread.
pub(crate) struct Batch<'a> {
    pub functions: &'a dyn RuleFunctions,
    pub plan: &'a Arc<DerivationPlan>,
    /// The parameters that are not numbers.
    pub values: &'a Values,
    pub chain: &'a Chain,
    pub links: &'a Links,
    pub step: usize,
}

impl Batch<'_> {
    /// Rewrites `piece`; `spare` is an emptied output whose memory is used again.
    pub(crate) fn rewrite(&self, piece: ChainPiece, scratch: &mut Scratch, spare: Output) -> Result<Output> {
        let rules = self.plan.grammar.rules().len();
        scratch.groups.resize_with(rules, RuleGroup::default);
        self.choose(piece, scratch)?;
        self.apply(scratch)?;
        let applied = if self.plan.traced { self.applied(piece, scratch) } else { Vec::new() };
        Ok(Output { applied, ..self.splice(piece, scratch, spare) })
    }

    /// The contexts of the chain's modules.
    #[inline]
    pub(super) fn around(&self) -> ContextMatcher<'_> {
        ContextMatcher { chain: self.chain, links: self.links, grammar: &self.plan.grammar }
    }

    /// Gathers what the functions of `rule` are run for: the applications `members`.
    pub(super) fn gather<'s>(
        &self,
        rule: u16,
        members: &[u32],
        scratch: &'s mut Scratch,
    ) -> Applications<'s> {
        let grammar = &self.plan.grammar;
        let declared = &grammar.rules()[usize::from(rule)];
        let arity = declared.arguments();
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
        if self.plan.notes_questions {
            scratch.places.extend(members.iter().map(|index| scratch.active[*index as usize].module));
        }
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
        }
    }

    fn gather_arguments(&self, rule: u16, members: &[u32], scratch: &mut Scratch) {
        let declared = &self.plan.grammar.rules()[usize::from(rule)];
        let arity = declared.arguments();
        scratch.arguments.reserve(members.len() * arity);
        let own = declared.pattern.predecessor.bound;
        if declared.contexts().is_empty() {
            for index in members {
                let at = scratch.active[*index as usize].param as usize;
                scratch.arguments.extend_from_slice(&self.chain.params[at..at + own]);
            }
        } else {
            let left = declared.pattern.left.len();
            for index in members {
                let active = scratch.active[*index as usize];
                self.around().bind(rule, active.module as usize, &mut scratch.bindings);
                let at = active.param as usize;
                for (place, item) in declared.contexts().iter().enumerate() {
                    if place == left {
                        scratch.arguments.extend_from_slice(&self.chain.params[at..at + own]);
                    }
                    if item.bound > 0 {
                        let at = self.links.param[scratch.bindings[place] as usize] as usize;
                        scratch.arguments.extend_from_slice(&self.chain.params[at..at + item.bound]);
                    }
                }
                if left == declared.contexts().len() {
                    scratch.arguments.extend_from_slice(&self.chain.params[at..at + own]);
                }
            }
        }
    }

    /// Runs every chosen rule over its modules. Of several errors the one that comes first in the chain is told.
    fn apply(&self, scratch: &mut Scratch) -> Result<()> {
        let mut first: Option<(u32, Error)> = None;
        for rule in 0..scratch.groups.len() {
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
        let applied = self.functions.apply(&self.gather(rule, members, scratch), &mut group);
        scratch.groups[usize::from(rule)] = group;
        applied.map_err(|failure| self.blame(failure, rule, members, scratch))
    }

    /// Leaves the chain of application `index` out, whose data is at fault: its modules stay as they are, and it is no
    /// more among `members`. Gives every other error back.
    pub(super) fn forgive(
        &self,
        index: u32,
        error: Error,
        members: &mut Vec<u32>,
        scratch: &mut Scratch,
    ) -> Result<()> {
        let Some(objects) = &self.plan.objects else { return Err(error) };
        let chain = scratch.active[index as usize].chain;
        objects.forgive(chain as usize, error)?;
        members.retain(|member| {
            let active = &mut scratch.active[*member as usize];
            if active.chain == chain {
                active.rule = NONE;
            }
            active.chain != chain
        });
        Ok(())
    }

    /// An error of a rule, with all that is known of where it happened.
    pub(super) fn blame(
        &self,
        failure: Failure,
        rule: u16,
        members: &[u32],
        scratch: &Scratch,
    ) -> (u32, Error) {
        let index = members.get(failure.at).copied().unwrap_or(members[0]);
        let active = scratch.active[index as usize];
        let grammar = &self.plan.grammar;
        let declared = &grammar.rules()[usize::from(rule)];
        let symbol = self.chain.symbols[active.module as usize];
        let arity = usize::from(grammar.arities()[usize::from(symbol)]);
        let params = &self.chain.params[active.param as usize..][..arity];
        let module = module_brief(grammar.symbols(), self.values, symbol, params);
        let error = failure.error.at(declared.place.clone()).rule(&declared.pattern.text);
        (index, error.module(module, self.step))
    }
}

/// Chains have fewer than 2^32 symbols and parameters; the limit on modules sees to that.
#[allow(clippy::cast_possible_truncation, reason = "below the limit on modules")]
pub(super) fn narrow(index: usize) -> u32 {
    index as u32
}

#[allow(clippy::cast_possible_truncation, reason = "rules are numbered in 16 bits")]
pub(super) fn narrow_rule(rule: usize) -> u16 {
    rule as u16
}
