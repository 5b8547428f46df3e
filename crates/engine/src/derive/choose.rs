//! Chooses the rule of each module: by its contexts, its guard and its weight.

use super::batch::{Active, Batch, ChainPiece, NONE, Scratch, narrow};
use burgeon_base::error::{Error, Result};
use burgeon_kit::rules::{Candidates, Choice, END, Symbol};

impl Batch<'_> {
    /// Chooses the rules of all modules of `piece`.
    pub(super) fn choose(&self, piece: ChainPiece, scratch: &mut Scratch) -> Result<()> {
        let grammar = &self.plan.grammar;
        let arities = grammar.arities();
        scratch.active.clear();
        let mut guarded: Vec<u32> = Vec::new();
        // Nothing more becomes of a chain that is left out.
        let failing = self.plan.objects.as_ref().filter(|objects| objects.any_failed());
        let (mut param, mut chain) = (piece.begin.param, piece.begin.chain);
        for module in piece.begin.module..piece.end {
            let symbol = self.chain.symbols[module];
            let rules = grammar.rules_of(symbol);
            if !rules.is_empty() && !failing.is_some_and(|objects| objects.has_failed(chain)) {
                let mut active =
                    Active { module: narrow(module), param: narrow(param), chain: narrow(chain), rule: NONE };
                match grammar.choice(symbol) {
                    Choice::Sole(rule) => active.rule = rule,
                    Choice::Contexts => active.rule = self.choose_unguarded(rules, module),
                    Choice::Guards => guarded.push(narrow(scratch.active.len())),
                }
                if active.rule != NONE || grammar.choice(symbol) == Choice::Guards {
                    scratch.active.push(active);
                }
            }
            param += usize::from(arities[usize::from(symbol)]);
            chain += usize::from(symbol == END);
        }
        if !guarded.is_empty() {
            self.choose_guarded(guarded, scratch)?;
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

    fn choose_unguarded(&self, rules: &[u16], module: usize) -> u16 {
        let mut candidates = Candidates::default();
        for number in rules {
            let rule = &self.plan.grammar.rules()[usize::from(*number)];
            if candidates.admit(rule) && self.around().matches(*number, module) {
                candidates.add(*number, rule);
                if candidates.is_settled() {
                    break;
                }
            }
        }
        self.chosen(&candidates, module)
    }

    /// The rule that is applied to `module`, or none.
    #[inline]
    fn chosen(&self, candidates: &Candidates, module: usize) -> u16 {
        candidates.choose(|| self.chain.keys[module].stream()).unwrap_or(NONE)
    }

    /// Asks the guards of each symbol's rules, rule by rule, each about all modules that it may still decide.
    ///
    /// Of several errors the one that comes first in the chain is told.
    fn choose_guarded(&self, mut open: Vec<u32>, scratch: &mut Scratch) -> Result<()> {
        let grammar = &self.plan.grammar;
        let symbol_of = |scratch: &Scratch, index: u32| -> Symbol {
            self.chain.symbols[scratch.active[index as usize].module as usize]
        };
        open.sort_by_key(|index| symbol_of(scratch, *index));
        let mut first: Option<(u32, Error)> = None;
        let mut rest = open.as_slice();
        while let Some(index) = rest.first() {
            let symbol = symbol_of(scratch, *index);
            let (members, others) =
                rest.split_at(rest.partition_point(|index| symbol_of(scratch, *index) == symbol));
            rest = others;
            let mut candidates = vec![Candidates::default(); members.len()];
            for number in grammar.rules_of(symbol) {
                let rule = &grammar.rules()[usize::from(*number)];
                let end = first.as_ref().map_or(u32::MAX, |(index, _)| *index);
                let asked = members.iter().zip(&candidates).filter(|(index, candidates)| {
                    let module = scratch.active[**index as usize].module as usize;
                    **index < end && candidates.admit(rule) && self.around().matches(*number, module)
                });
                let mut holds: Vec<u32> = asked.map(|(index, _)| *index).collect();
                if rule.guarded
                    && let Some(failed) = self.ask(*number, &mut holds, scratch)?
                {
                    first = Some(failed);
                }
                let mut holds = holds.into_iter().peekable();
                for (index, candidates) in members.iter().zip(&mut candidates) {
                    if holds.next_if_eq(index).is_some() {
                        candidates.add(*number, rule);
                    }
                }
            }
            for (index, candidates) in members.iter().zip(&candidates) {
                let active = &mut scratch.active[*index as usize];
                active.rule = self.chosen(candidates, active.module as usize);
            }
        }
        first.map_or(Ok(()), |(_, error)| Err(error))
    }

    /// Leaves those among `asked` for which the guard of `rule` holds. Where it fails, only those before that module,
    /// which is returned with the error.
    fn ask(&self, rule: u16, asked: &mut Vec<u32>, scratch: &mut Scratch) -> Result<Option<(u32, Error)>> {
        if asked.is_empty() {
            return Ok(None);
        }
        let mut holds: Vec<u32> = Vec::new();
        let failed = loop {
            let told = self.functions.ask(&self.gather(rule, asked, scratch), &mut holds);
            let Err(failure) = told else { break None };
            let (index, error) = self.blame(failure, rule, asked, scratch);
            match self.forgive(index, error, asked, scratch) {
                Err(error) => break Some((index, error)),
                Ok(()) if asked.is_empty() => return Ok(None),
                Ok(()) => {}
            }
        };
        if let Some((index, _)) = &failed {
            asked.retain(|asked| asked < index);
        }
        let mut holds = holds.into_iter();
        asked.retain(|_| holds.next().is_some_and(|holds| holds != 0));
        Ok(failed)
    }
}
