//! Rewrites one piece of a chain: runs the chosen rules in batches, one call into Lua for each.

use std::sync::Arc;
use std::time::Instant;

use super::Plan;
use super::group::{Arranged, Group};
use super::output::Output;
use crate::machine::{Declared, Machine, read_column, write_column};
use burgeon_base::error::{Error, Result};
use burgeon_kit::rules::{Around, Bindings, Chain, Links, Mark, module_brief};

/// No rule.
pub(super) const NONE: u16 = burgeon_kit::RewriteOutcome::NONE;
/// A piece of the chain: from a mark up to another symbol.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Piece {
    pub begin: Mark,
    pub end: usize,
}

/// What a thread keeps from batch to batch.
#[derive(Default)]
pub(crate) struct Scratch {
    pub(super) active: Vec<Active>,
    /// One for each rule.
    pub(super) groups: Vec<Group>,
    arguments: Vec<f64>,
    pub(super) bindings: Bindings,
    /// The most random numbers that each rule has drawn for one module.
    draws: Vec<usize>,
    pub(super) arranged: Arranged,
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
    pub machine: &'a Machine,
    pub plan: &'a Arc<Plan>,
    pub declared: &'a Declared,
    pub chain: &'a Chain,
    pub links: &'a Links,
    pub step: usize,
}

impl Batch<'_> {
    /// Rewrites `piece`; `spare` is an emptied output whose memory is used again.
    pub(crate) fn rewrite(&self, piece: Piece, scratch: &mut Scratch, spare: Output) -> Result<Output> {
        let rules = self.plan.grammar.rules().len();
        scratch.groups.resize_with(rules, Group::default);
        scratch.draws.resize(rules, 0);
        self.choose(piece, scratch)?;
        self.apply(scratch)?;
        let applied = if self.plan.traced { self.applied(piece, scratch) } else { Vec::new() };
        Ok(Output { applied, ..self.splice(piece, scratch, spare) })
    }

    /// The contexts of the chain's modules.
    #[inline]
    pub(super) fn around(&self) -> Around<'_> {
        Around { chain: self.chain, links: self.links, grammar: &self.plan.grammar }
    }

    /// Writes the arguments of `rule` for `members` into the machine's input column.
    pub(super) fn fill(&self, rule: u16, members: &[u32], scratch: &mut Scratch) -> Result<()> {
        let grammar = &self.plan.grammar;
        let declared = &grammar.rules()[usize::from(rule)];
        let arity = declared.arguments();
        let current = &self.machine.current;
        if self.plan.chains > 1 {
            let mut chains = current.chains.borrow_mut();
            chains.clear();
            chains.extend(members.iter().map(|index| scratch.active[*index as usize].chain));
        }
        if grammar.draws_random() {
            let mut keys = current.keys.borrow_mut();
            keys.clear();
            keys.extend(
                members.iter().map(|index| self.chain.keys[scratch.active[*index as usize].module as usize]),
            );
            current.used.set(usize::from(declared.weight.is_some()));
        }
        if arity == 0 {
            return Ok(());
        }
        scratch.arguments.clear();
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
        let input = self
            .machine
            .prelude()
            .input(scratch.arguments.len() * 8)
            .map_err(|error| self.machine.translate(error))?;
        write_column(input, &scratch.arguments)
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
        let begin = members[0];
        let plain = |error: Error| (begin, error);
        let lua = |error: mlua::Error| (begin, self.machine.translate(error));
        let prelude = self.machine.prelude();
        self.fill(rule, members, scratch).map_err(plain)?;
        let counts = prelude.counts(members.len() * 4).map_err(lua)?;
        let draws = scratch.draws[usize::from(rule)];
        if draws > 0 {
            self.prepare_random(members.len(), draws).map_err(plain)?;
        }
        let current = &self.machine.current;
        current.drawn.set(0);
        let (modules, bytes): (usize, usize) =
            match self.machine.call(&self.declared.drivers[usize::from(rule)], members.len()) {
                Ok(made) => made,
                Err(error) => return Err(self.blame(error, rule, members, scratch)),
            };
        scratch.draws[usize::from(rule)] = draws.max(current.drawn.get());
        let (symbols, params, order, items) = prelude.outputs().map_err(lua)?;
        let group = &mut scratch.groups[usize::from(rule)];
        read_column(symbols, modules, &mut group.symbols).map_err(plain)?;
        read_column(params, bytes / 8, &mut group.params).map_err(plain)?;
        read_column(counts, members.len(), &mut group.ends).map_err(plain)?;
        read_column(order, items, &mut group.order).map_err(plain)?;
        group.rewind();
        Ok(())
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

    /// Draws the first numbers of every module's stream ahead, as many as the rule has wanted so far.
    fn prepare_random(&self, count: usize, draws: usize) -> Result<()> {
        let current = &self.machine.current;
        let mut column = Vec::with_capacity(count * draws);
        for key in current.keys.borrow().iter() {
            let mut stream = key.stream();
            for _ in 0..current.used.get() {
                stream.uniform();
            }
            column.extend((0..draws).map(|_| stream.uniform()));
        }
        let buffer = self
            .machine
            .prelude()
            .randoms(column.len() * 8, draws)
            .map_err(|error| self.machine.translate(error))?;
        write_column(buffer, &column)
    }

    /// An error of a rule, with all that is known of where it happened.
    pub(super) fn blame(
        &self,
        error: mlua::Error,
        rule: u16,
        members: &[u32],
        scratch: &Scratch,
    ) -> (u32, Error) {
        let prelude = self.machine.prelude();
        let at: usize = prelude.at.call(()).unwrap_or(0);
        // A machine that cannot even end the batch is thrown away with the run.
        let _ = prelude.finish.call::<()>(());
        let index = members.get(at).copied().unwrap_or(members[0]);
        let active = scratch.active[index as usize];
        let grammar = &self.plan.grammar;
        let declared = &grammar.rules()[usize::from(rule)];
        let symbol = self.chain.symbols[active.module as usize];
        let arity = usize::from(grammar.arities()[usize::from(symbol)]);
        let params = &self.chain.params[active.param as usize..][..arity];
        let module = module_brief(grammar.symbols(), &self.machine.session.values, symbol, params);
        let error = self
            .machine
            .translate(error)
            .at(declared.place.clone())
            .rule(&declared.pattern.text)
            .module(module, self.step);
        (index, error)
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
