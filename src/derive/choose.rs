//! Chooses the rule of each module: by its contexts, its guard and its weight.

use smallvec::SmallVec;

use super::batch::{Active, Batch, NONE, Piece, Scratch, narrow};
use crate::error::Result;
use crate::rules::{Bindings, Choice, END};
use crate::script::read_column;

impl Batch<'_> {
    /// Chooses the rules of all modules of `piece`.
    pub(super) fn choose(&self, piece: Piece, scratch: &mut Scratch) -> Result<()> {
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

    /// Whether the contexts of `rule` are around `module`, and which modules they are.
    pub(super) fn matches(&self, rule: u16, module: usize, bindings: &mut Bindings) -> bool {
        let rule = &self.plan.grammar.rules()[usize::from(rule)];
        rule.contexts().is_empty()
            || rule.pattern.matches(self.chain, self.links, &self.plan.grammar, module, bindings)
    }

    fn choose_unguarded(&self, rules: &[u16], module: usize, bindings: &mut Bindings) -> u16 {
        let mut weighted: SmallVec<[u16; 8]> = SmallVec::new();
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
        let mut weighted: Vec<SmallVec<[u16; 4]>> = vec![SmallVec::new(); scratch.active.len()];
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
}
