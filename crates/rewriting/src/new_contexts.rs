//! Rules with contexts in the chain that a step writes.
//!
//! Modules whose rules have no such contexts are rewritten first, as in every step. The others are rewritten in rounds: a
//! module when all others that can be part of its contexts are final. For left contexts these are the modules on the path to the
//! axiom, for right contexts those that follow in its branch. The modules of a round do not depend on one another, so each
//! round calls the functions of a rule once.
//!
//! If the contexts are single modules, one call rewrites many modules that depend on one another instead. If a function fails
//! there, the modules are rewritten in rounds, which determine the error.

use crate::batch::{Active, Batch, ChainPiece, NO_RULE, Scratch, narrow};
use crate::chain::{CLOSE, Chain, END, Mark, OPEN};
use crate::choice::Candidates;
use crate::grammar::NewContexts;
use crate::new_chain::{NewBindings, NewMatcher};
use burgeon_base::error::Result;
use std::time::Duration;

/// Divides the chain at the first end from each mark on, into pieces of at least `size` symbols.
pub(crate) fn pieces_at_ends(chain: &Chain, size: usize, arities: &[u8]) -> Vec<ChainPiece> {
    let mut pieces: Vec<ChainPiece> = Vec::new();
    let mut here = Mark::default();
    let mut begin = Mark::default();
    for (index, symbol) in chain.symbols.iter().enumerate() {
        here.module = index + 1;
        here.param += usize::from(arities[usize::from(*symbol)]);
        here.chain += usize::from(*symbol == END);
        let is_last = here.module == chain.symbols.len();
        if is_last || *symbol == END && here.module - begin.module >= size {
            pieces.push(ChainPiece { begin, end: here.module });
            begin = here;
        }
    }
    pieces
}

impl Batch<'_> {
    /// Returns true if a rule with contexts in the new chain can be chosen for a module.
    pub(crate) fn needs_new_chain(&self, rules: &[u16], active: Active) -> bool {
        let mut candidates = Candidates::default();
        for number in rules {
            let rule = &self.plan.grammar.rules()[usize::from(*number)];
            if !candidates.admit(rule) || !self.matches_old(*number, rule, active) {
                continue;
            }
            if rule.has_new_contexts() {
                return true;
            }
            // A guard may not hold.
            if !rule.guarded {
                candidates.add(*number, rule);
            }
        }
        false
    }

    /// Returns true if the contexts of `rule` in the new chain match.
    #[inline(never)]
    pub(crate) fn matches_new(&self, rule: u16, active: Active) -> bool {
        let new = &mut self.new_chain.borrow_mut();
        let (chain, links, grammar) = (self.chain, self.links, &self.plan.grammar);
        NewMatcher { new, chain, links, grammar, rule }.matches(active.module)
    }

    /// Rewrites the modules of `scratch.delayed`, after all others of `piece` have been rewritten. The successors of all modules are
    /// then in the new chain.
    pub(crate) fn rewrite_delayed(&self, piece: ChainPiece, scratch: &mut Scratch) -> Result<()> {
        let grammar = &self.plan.grammar;
        let active = scratch.active.iter().map(|active| active.module as usize);
        self.new_chain.borrow_mut().start(piece.begin.module..piece.end, active, self.links);
        let mut times = vec![Duration::ZERO; scratch.groups.len()];
        self.take_written(scratch, &mut times);
        let is_done = match grammar.dependent_rules() {
            Some(rules) if self.rules.accepts_dependents() => {
                self.rewrite_dependents(rules, piece, scratch, &mut times)?
            }
            _ => false,
        };
        if !is_done {
            self.rewrite_rounds(piece, scratch, &mut times)?;
        }
        for (group, time) in scratch.groups.iter_mut().zip(times) {
            group.clear();
            group.members.clear();
            group.time = time;
        }
        for (index, active) in scratch.active.iter().enumerate().filter(|(_, active)| active.rule != NO_RULE)
        {
            scratch.groups[usize::from(active.rule)].members.push(narrow(index));
        }
        Ok(())
    }

    /// Rewrites the modules of `scratch.delayed` in rounds, and adds the time of each rule to `times`.
    fn rewrite_rounds(&self, piece: ChainPiece, scratch: &mut Scratch, times: &mut [Duration]) -> Result<()> {
        let grammar = &self.plan.grammar;
        let mut delayed = std::mem::take(&mut scratch.delayed);
        let rounds = self.rounds(piece, scratch, &delayed);
        delayed.sort_by_key(|index| rounds[*index as usize]);
        let mut members = Vec::new();
        let mut rest = delayed.as_slice();
        while let Some(first) = rest.first() {
            self.stop.check()?;
            let round = rounds[*first as usize];
            let count = rest.partition_point(|index| rounds[*index as usize] == round);
            members.clear();
            members.extend(
                rest[..count].iter().filter(|index| !self.is_failed(scratch.active[**index as usize])),
            );
            rest = &rest[count..];
            self.new_chain.borrow_mut().find_constants(grammar, self.rules.parameters());
            self.choose_guarded(members.clone(), scratch)?;
            for index in &members {
                let rule = scratch.active[*index as usize].rule;
                if rule != NO_RULE {
                    scratch.groups[usize::from(rule)].members.push(*index);
                }
            }
            self.apply(scratch)?;
            self.take_written(scratch, times);
        }
        scratch.delayed = delayed;
        Ok(())
    }

    /// Moves the successors that the rules have written to the new chain.
    fn take_written(&self, scratch: &mut Scratch, times: &mut [Duration]) {
        let arities = self.plan.grammar.arities();
        for (group, time) in scratch.groups.iter_mut().zip(times) {
            if !group.members.is_empty() {
                *time += group.time;
                self.new_chain.borrow_mut().take_group(group, &mut scratch.arranged, arities);
            }
        }
    }

    /// Returns for each active module the number of the round in which it is rewritten, if it is one of `delayed`.
    fn rounds(&self, piece: ChainPiece, scratch: &Scratch, delayed: &[u32]) -> Vec<u32> {
        let mut rounds = vec![0; scratch.active.len()];
        let mut open: Vec<u32> = Vec::new();
        let mut round = 0;
        let places = piece.begin.module..piece.end;
        let symbols = &self.chain.symbols[piece.begin.module..piece.end];
        let module = |index: &u32| scratch.active[*index as usize].module;
        if self.plan.grammar.new_contexts() == NewContexts::Left {
            let mut delayed = delayed.iter().peekable();
            for (place, symbol) in places.zip(symbols) {
                match *symbol {
                    OPEN => open.push(round),
                    CLOSE => round = open.pop().unwrap_or_default(),
                    END => round = 0,
                    _ => {
                        if let Some(index) = delayed.next_if(|index| module(index) == narrow(place)) {
                            rounds[*index as usize] = round;
                            round += 1;
                        }
                    }
                }
            }
        } else {
            let mut delayed = delayed.iter().rev().peekable();
            for (place, symbol) in places.zip(symbols).rev() {
                match *symbol {
                    CLOSE => open.push(std::mem::take(&mut round)),
                    OPEN => round = round.max(open.pop().unwrap_or_default()),
                    END => round = 0,
                    _ => {
                        if let Some(index) = delayed.next_if(|index| module(index) == narrow(place)) {
                            rounds[*index as usize] = round;
                            round += 1;
                        }
                    }
                }
            }
        }
        rounds
    }

    /// Gathers the arguments of a rule with contexts in the new chain.
    #[inline(never)]
    pub(crate) fn gather_new(&self, rule: u16, members: &[u32], scratch: &mut Scratch) {
        let (chain, links, grammar) = (self.chain, self.links, &self.plan.grammar);
        let pattern = &grammar.rules()[usize::from(rule)].pattern;
        let contexts = grammar.rules()[usize::from(rule)].contexts();
        let (news, lefts) = (pattern.new_left.len(), pattern.left.len());
        let mut new_bindings = NewBindings::new();
        let old_contexts = self.contexts().of_rule(rule);
        for index in members {
            let active = scratch.active[*index as usize];
            old_contexts.bind(active.module as usize, &mut scratch.bindings);
            let new = &mut self.new_chain.borrow_mut();
            let mut matcher = NewMatcher { new, chain, links, grammar, rule };
            matcher.bind(active.module, &mut new_bindings);
            let (old, arguments) = (&scratch.bindings, &mut scratch.arguments);
            let item_count = contexts.len();
            for (place, item) in contexts.iter().enumerate() {
                if place == news + lefts {
                    pattern.predecessors[0].push_arguments(&chain.params, active.param as usize, arguments);
                }
                // The order is that of the pattern: new, left, right and again new contexts.
                if (news..news + old.len()).contains(&place) {
                    let begin = links.param[old[place - news] as usize] as usize;
                    item.push_arguments(&chain.params, begin, arguments);
                } else {
                    let place = if place < news { place } else { place - old.len() };
                    item.push_arguments(matcher.params(new_bindings[place]), 0, arguments);
                }
            }
            if item_count == news + lefts {
                pattern.predecessors[0].push_arguments(&chain.params, active.param as usize, arguments);
            }
        }
    }
}
