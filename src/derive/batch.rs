//! Rewrites one piece of a chain: chooses rules, runs them in batches, and splices the successors in.

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::Plan;
use super::output::{Output, Use};
use crate::error::{Error, Result};
use crate::rules::{Bindings, CLOSE, Chain, Choice, END, Key, Links, Mark, OPEN, Symbol, module_text};
use crate::script::{Declared, Machine, read_column, write_column};

/// No rule.
pub(super) const NONE: u16 = u16::MAX;
/// Marks an application that leaves its module, in the counts that Lua writes.
const STAY: u32 = 0x8000_0000;
/// Marks the number of a shape, in the counts that Lua writes.
const SHAPE: u32 = 0x4000_0000;
/// Marks an application whose modules are in another order than they were made, in the counts that Lua writes.
const ORDERED: u32 = 0x2000_0000;
/// Brackets in the order that Lua writes.
const OPENS: u32 = 0xFFFF_FFFE;
const CLOSES: u32 = 0xFFFF_FFFF;

/// A piece of the chain: from a mark up to another symbol.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Piece {
    pub begin: Mark,
    pub end: usize,
}

/// What a thread keeps from batch to batch.
#[derive(Default)]
pub(crate) struct Scratch {
    active: Vec<Active>,
    groups: Vec<Group>,
    arguments: Vec<f64>,
    bindings: Bindings,
    /// The most random numbers that each rule has drawn for one module.
    draws: Vec<usize>,
    arranged: Arranged,
}

/// A successor whose modules are in another order than they were made.
#[derive(Default)]
struct Arranged {
    symbols: Vec<Symbol>,
    /// Where the parameters of each module that was made begin.
    starts: Vec<usize>,
}

/// A module that has rules.
#[derive(Clone, Copy)]
struct Active {
    module: u32,
    param: u32,
    chain: u32,
    rule: u16,
}

/// The modules that one rule is applied to, and what it made of them.
#[derive(Default)]
struct Group {
    members: Vec<u32>,
    symbols: Vec<Symbol>,
    params: Vec<f64>,
    ends: Vec<u32>,
    /// For each application whose modules are in another order: the number of its items, and the items.
    order: Vec<u32>,
    next: usize,
    symbol_at: usize,
    param_at: usize,
    order_at: usize,
    made: usize,
    time: Duration,
}

impl Group {
    fn rewind(&mut self) {
        (self.next, self.symbol_at, self.param_at, self.order_at, self.made) = (0, 0, 0, 0, 0);
    }

    /// The successor of the application whose modules end at `end`: its symbols, and its parameters behind `params`.
    fn arrange(&mut self, end: u32, arities: &[u8], to: &mut Arranged, params: &mut Vec<f64>) {
        let arity = |symbol: Symbol| usize::from(arities[usize::from(symbol)]);
        let made = &self.symbols[self.symbol_at..end as usize];
        self.symbol_at = end as usize;
        to.starts.clear();
        for symbol in made {
            to.starts.push(self.param_at);
            self.param_at += arity(*symbol);
        }
        let count = self.order[self.order_at] as usize;
        let items = &self.order[self.order_at + 1..][..count];
        self.order_at += 1 + count;
        to.symbols.clear();
        for item in items {
            let symbol = match *item {
                OPENS => OPEN,
                CLOSES => CLOSE,
                place => {
                    let symbol = made[place as usize];
                    let start = to.starts[place as usize];
                    params.extend_from_slice(&self.params[start..start + arity(symbol)]);
                    symbol
                }
            };
            to.symbols.push(symbol);
        }
    }
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

    fn choose(&self, piece: Piece, scratch: &mut Scratch) -> Result<()> {
        let grammar = &self.plan.grammar;
        let arities = grammar.arities();
        scratch.active.clear();
        let mut any_guarded = false;
        let (mut param, mut chain) = (piece.begin.param, piece.begin.chain);
        for module in piece.begin.module..piece.end {
            let symbol = self.chain.symbols[module];
            let rules = grammar.rules_of(symbol);
            if !rules.is_empty() {
                let mut guarded = false;
                let mut active =
                    Active { module: narrow(module), param: narrow(param), chain: narrow(chain), rule: NONE };
                match grammar.choice(symbol) {
                    Choice::Sole(rule) => active.rule = rule,
                    Choice::Contexts => {
                        active.rule = self.choose_unguarded(rules, module, &mut scratch.bindings)
                    }
                    Choice::Guards => guarded = true,
                }
                if active.rule != NONE || guarded {
                    scratch.active.push(active);
                    any_guarded |= guarded;
                }
            }
            param += usize::from(arities[usize::from(symbol)]);
            chain += usize::from(symbol == END);
        }
        if any_guarded {
            self.choose_guarded(scratch)?;
        }
        for group in &mut scratch.groups {
            group.members.clear();
        }
        for (index, active) in scratch.active.iter().enumerate() {
            if active.rule != NONE {
                scratch.groups[usize::from(active.rule)].members.push(narrow(index));
            }
        }
        Ok(())
    }

    fn matches(&self, rule: u16, module: usize, bindings: &mut Bindings) -> bool {
        let rule = &self.plan.grammar.rules()[usize::from(rule)];
        rule.contexts().is_empty()
            || rule.pattern.matches(self.chain, self.links, &self.plan.grammar, module, bindings)
    }

    fn choose_unguarded(&self, rules: &[u16], module: usize, bindings: &mut Bindings) -> u16 {
        let mut weighted: smallvec::SmallVec<[u16; 8]> = smallvec::SmallVec::new();
        for rule in rules {
            let weight = self.plan.grammar.rules()[usize::from(*rule)].weight;
            if (weight.is_none() && !weighted.is_empty()) || !self.matches(*rule, module, bindings) {
                continue;
            }
            if weight.is_none() {
                return *rule;
            }
            weighted.push(*rule);
        }
        self.draw(&weighted, module)
    }

    /// Draws one of the weighted candidates with the first number of the module's stream.
    fn draw(&self, candidates: &[u16], module: usize) -> u16 {
        let weight = |rule: u16| self.plan.grammar.rules()[usize::from(rule)].weight.unwrap_or(0.0);
        let Some(last) = candidates.last() else { return NONE };
        let total: f64 = candidates.iter().map(|rule| weight(*rule)).sum();
        let mut left = self.chain.keys[module].stream().uniform() * total;
        for rule in candidates {
            left -= weight(*rule);
            if left < 0.0 {
                return *rule;
            }
        }
        *last
    }

    /// Asks the guards, rule by rule, each about all modules that it may still decide.
    fn choose_guarded(&self, scratch: &mut Scratch) -> Result<()> {
        let grammar = &self.plan.grammar;
        let mut weighted: Vec<smallvec::SmallVec<[u16; 4]>> =
            vec![smallvec::SmallVec::new(); scratch.active.len()];
        let mut open: Vec<u32> = (0u32..)
            .zip(&scratch.active)
            .filter(|(_, active)| {
                grammar.choice(self.chain.symbols[active.module as usize]) == Choice::Guards
            })
            .map(|(index, _)| index)
            .collect();
        for (rule, declared) in (0u16..).zip(grammar.rules()) {
            let symbol = declared.pattern.predecessor.symbol;
            if open.is_empty() || grammar.choice(symbol) != Choice::Guards {
                continue;
            }
            let mut asked: Vec<u32> = Vec::new();
            for index in &open {
                let module = scratch.active[*index as usize].module as usize;
                let late = declared.weight.is_none() && !weighted[*index as usize].is_empty();
                if !late
                    && self.chain.symbols[module] == symbol
                    && self.matches(rule, module, &mut scratch.bindings)
                {
                    asked.push(*index);
                }
            }
            if declared.guarded {
                asked = self.ask(rule, &asked, scratch)?;
            }
            if declared.weight.is_some() {
                asked.iter().for_each(|index| weighted[*index as usize].push(rule));
            } else {
                asked.iter().for_each(|index| scratch.active[*index as usize].rule = rule);
                open.retain(|index| scratch.active[*index as usize].rule == NONE);
            }
        }
        for index in open {
            let active = &mut scratch.active[index as usize];
            active.rule = self.draw(&weighted[index as usize], active.module as usize);
        }
        Ok(())
    }

    /// The ones among `asked` for which the guard of `rule` holds.
    fn ask(&self, rule: u16, asked: &[u32], scratch: &mut Scratch) -> Result<Vec<u32>> {
        let Some(guard) = &self.declared.guards[usize::from(rule)] else { return Ok(asked.to_vec()) };
        if asked.is_empty() {
            return Ok(Vec::new());
        }
        self.fill(rule, asked, scratch)?;
        let prelude = self.machine.prelude();
        let counts = prelude.counts(asked.len() * 4).map_err(|error| self.machine.translate(error))?;
        if let Err(error) = guard.call::<()>(asked.len()) {
            return Err(self.blame(error, rule, asked, scratch).1);
        }
        let mut holds: Vec<u32> = Vec::new();
        read_column(counts, asked.len(), &mut holds)?;
        Ok(asked.iter().zip(holds).filter(|(_, holds)| *holds != 0).map(|(index, _)| *index).collect())
    }

    /// Writes the arguments of `rule` for `members` into the machine's input column.
    fn fill(&self, rule: u16, members: &[u32], scratch: &mut Scratch) -> Result<()> {
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
                self.matches(rule, active.module as usize, &mut scratch.bindings);
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
            if !members.is_empty()
                && let Err((index, error)) = self.run(narrow_rule(rule), &members, scratch)
            {
                first = Some((index, error));
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
            match self.declared.drivers[usize::from(rule)].call(members.len()) {
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
    fn blame(&self, error: mlua::Error, rule: u16, members: &[u32], scratch: &Scratch) -> (u32, Error) {
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
        let module = module_text(grammar.symbols(), &self.machine.session.values, symbol, params);
        let error = self
            .machine
            .translate(error)
            .at(declared.place.clone())
            .rule(&declared.pattern.text)
            .module(module, self.step);
        (index, error)
    }

    /// For each symbol of `piece`, the rule that ran and how many symbols come of it.
    fn applied(&self, piece: Piece, scratch: &Scratch) -> Vec<(u16, u32)> {
        let shapes = self.machine.current.shapes.borrow();
        let mut applied = vec![(NONE, 1); piece.end - piece.begin.module];
        let mut read = vec![(0, 0, 0); scratch.groups.len()];
        for active in scratch.active.iter().filter(|active| active.rule != NONE) {
            let (next, from, item) = &mut read[usize::from(active.rule)];
            let group = &scratch.groups[usize::from(active.rule)];
            let end = group.ends[*next];
            *next += 1;
            let count = if end & STAY != 0 {
                1
            } else if end & SHAPE != 0 {
                narrow(shapes[(end & !SHAPE) as usize].symbols.len())
            } else if end & ORDERED != 0 {
                *from = end & !ORDERED;
                let count = group.order[*item];
                *item += 1 + count as usize;
                count
            } else {
                end - std::mem::replace(from, end)
            };
            applied[active.module as usize - piece.begin.module] = (active.rule, count);
        }
        applied
    }

    fn splice(&self, piece: Piece, scratch: &mut Scratch, mut output: Output) -> Output {
        let grammar = &self.plan.grammar;
        let random = grammar.draws_random();
        let shapes = self.machine.current.shapes.borrow();
        let out = &mut output.chain;
        out.symbols.reserve(2 * (piece.end - piece.begin.module));
        out.params.reserve(2 * (piece.end - piece.begin.module));
        let (mut module, mut param) = (piece.begin.module, piece.begin.param);
        let keep = |out: &mut Chain, modules: std::ops::Range<usize>, params: std::ops::Range<usize>| {
            out.symbols.extend_from_slice(&self.chain.symbols[modules.clone()]);
            out.params.extend_from_slice(&self.chain.params[params]);
            if random {
                out.keys.extend_from_slice(&self.chain.keys[modules]);
            }
        };
        for active in &scratch.active {
            if active.rule == NONE {
                continue;
            }
            let group = &mut scratch.groups[usize::from(active.rule)];
            let end = group.ends[group.next];
            group.next += 1;
            if end & STAY != 0 {
                if random {
                    let here = active.module as usize;
                    let params = active.param as usize;
                    keep(out, module..here, param..params);
                    let arity = usize::from(grammar.arities()[usize::from(self.chain.symbols[here])]);
                    keep(out, here..here + 1, params..params + arity);
                    if let Some(key) = out.keys.last_mut() {
                        *key = key.advanced();
                    }
                    (module, param) = (here + 1, params + arity);
                }
                continue;
            }
            output.changed = true;
            let here = active.module as usize;
            keep(out, module..here, param..active.param as usize);
            let (symbols, params) = if end & SHAPE != 0 {
                let shape = &shapes[(end & !SHAPE) as usize];
                (shape.symbols.as_slice(), shape.params)
            } else if end & ORDERED != 0 {
                group.arrange(end & !ORDERED, grammar.arities(), &mut scratch.arranged, &mut out.params);
                (scratch.arranged.symbols.as_slice(), 0)
            } else {
                let symbols = &group.symbols[group.symbol_at..end as usize];
                group.symbol_at = end as usize;
                let arity = |symbol: &Symbol| usize::from(grammar.arities()[usize::from(*symbol)]);
                (symbols, symbols.iter().map(arity).sum())
            };
            group.made += symbols.len();
            out.symbols.extend_from_slice(symbols);
            out.params.extend_from_slice(&group.params[group.param_at..group.param_at + params]);
            if random {
                let parent = self.chain.keys[here];
                let mut ordinal = 0;
                out.keys.extend(symbols.iter().map(|symbol| {
                    let key = parent.child(ordinal);
                    ordinal += usize::from(*symbol > END);
                    if *symbol > END { key } else { Key::default() }
                }));
            }
            group.param_at += params;
            module = here + 1;
            param =
                active.param as usize + usize::from(grammar.arities()[usize::from(self.chain.symbols[here])]);
        }
        let rest = piece.end - module;
        let rest_params: usize = self.chain.symbols[module..module + rest]
            .iter()
            .map(|symbol| usize::from(grammar.arities()[usize::from(*symbol)]))
            .sum();
        keep(out, module..piece.end, param..param + rest_params);
        for (rule, group) in scratch.groups.iter().enumerate() {
            if !group.members.is_empty() {
                output.ran = true;
                let done = Use { applied: group.members.len(), made: group.made, time: group.time };
                output.uses.push((narrow_rule(rule), done));
            }
        }
        output.chain.mark(self.plan.batch, grammar.arities());
        output
    }
}

/// Chains have fewer than 2^32 symbols and parameters; the limit on modules sees to that.
#[allow(clippy::cast_possible_truncation, reason = "below the limit on modules")]
fn narrow(index: usize) -> u32 {
    index as u32
}

#[allow(clippy::cast_possible_truncation, reason = "rules are numbered in 16 bits")]
fn narrow_rule(rule: usize) -> u16 {
    rule as u16
}
