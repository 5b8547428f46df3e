//! Choice of the rule for each module, by contexts, guards and weights.

use crate::batch::{Active, Batch, ChainPiece, NO_RULE, Scratch, narrow};
use crate::chain::END;
use crate::choice::{Candidates, Choice};
use crate::rule::Rule;
use crate::runs::RechosenModules;
use burgeon_base::error::{Error, Result};

impl Batch<'_> {
    /// Chooses the rules of all modules of `piece`.
    pub(crate) fn choose(&self, piece: ChainPiece, scratch: &mut Scratch) -> Result<()> {
        let grammar = &self.plan.grammar;
        let arities = grammar.arities();
        scratch.active.clear();
        scratch.delayed.clear();
        let mut guarded: Vec<u32> = Vec::new();
        // Skipped chains stay unchanged.
        let failed = self.plan.failed.as_ref().filter(|failed| failed.any());
        let (mut param, mut chain) = (piece.begin.param, piece.begin.chain);
        for module in piece.begin.module..piece.end {
            let symbol = self.chain.symbols[module];
            let place = self.place_at(module);
            let rules = grammar.rules_at(place);
            if !rules.is_empty() && !failed.is_some_and(|failed| failed.contains(chain)) {
                let mut active = Active {
                    module: narrow(module),
                    param: narrow(param),
                    chain: narrow(chain),
                    rule: NO_RULE,
                };
                let choice = grammar.choice_at(place);
                match choice {
                    Choice::Sole(rule) => active.rule = rule,
                    Choice::Contexts => active.rule = self.choose_unguarded(rules, active),
                    Choice::Guards => guarded.push(narrow(scratch.active.len())),
                    Choice::NewContexts => {
                        let index = narrow(scratch.active.len());
                        match self.needs_new_chain(rules, active) {
                            true => scratch.delayed.push(index),
                            false => guarded.push(index),
                        }
                    }
                }
                if active.rule != NO_RULE || matches!(choice, Choice::Guards | Choice::NewContexts) {
                    scratch.active.push(active);
                }
            }
            param += usize::from(arities[usize::from(symbol)]);
            chain += usize::from(symbol == END);
        }
        if !guarded.is_empty() {
            self.choose_guarded(guarded, scratch)?;
        }
        if grammar.has_runs() {
            self.drop_taken(scratch);
        }
        for group in &mut scratch.groups {
            group.members.clear();
        }
        for (index, active) in scratch.active.iter().enumerate() {
            if active.rule != NO_RULE {
                scratch.groups[usize::from(active.rule)].members.push(narrow(index));
            }
        }
        Ok(())
    }

    /// Returns the index of the rules of the module at `module`.
    #[inline(always)]
    pub(crate) fn place_at(&self, module: usize) -> usize {
        let symbol = self.chain.symbols[module];
        match self.links.regions.get(module) {
            None => usize::from(symbol),
            Some(region) => self.plan.grammar.place_of(*region, symbol),
        }
    }

    /// Returns true if the predecessor and the contexts of rule number `rule` match.
    #[inline(always)]
    fn matches(&self, rule: u16, declared: &Rule, active: Active) -> bool {
        self.matches_old(rule, declared, active)
            && (!declared.has_new_contexts() || self.matches_new(rule, active))
    }

    /// Returns true if the predecessor and the contexts of rule number `rule` in the chain before the step match.
    #[inline(always)]
    pub(crate) fn matches_old(&self, rule: u16, declared: &Rule, active: Active) -> bool {
        let (module, param) = (active.module as usize, active.param as usize);
        (!declared.tests_modules() || self.contexts().matches_predecessors(rule, module, param))
            && (!declared.has_contexts() || self.contexts().matches(rule, module))
    }

    /// Does the same as [`matches`](Self::matches), but is not inlined where guards cost more.
    #[inline]
    pub(crate) fn matches_guarded(&self, rule: u16, declared: &Rule, active: Active) -> bool {
        #[inline(never)]
        fn matches(batch: &Batch<'_>, rule: u16, declared: &Rule, active: Active) -> bool {
            batch.matches(rule, declared, active)
        }
        !declared.has_contexts() && !declared.has_new_contexts() && !declared.tests_modules()
            || matches(self, rule, declared, active)
    }

    fn choose_unguarded(&self, rules: &[u16], active: Active) -> u16 {
        let mut candidates = Candidates::default();
        for number in rules {
            let rule = &self.plan.grammar.rules()[usize::from(*number)];
            if candidates.admit(rule) && self.matches(*number, rule, active) {
                candidates.add(*number, rule);
                if candidates.is_settled() {
                    break;
                }
            }
        }
        self.choose_rule(&candidates, active.module as usize)
    }

    /// Returns the rule to apply to `module`, or [`NO_RULE`].
    #[inline]
    pub(crate) fn choose_rule(&self, candidates: &Candidates, module: usize) -> u16 {
        candidates.choose(|| self.chain.keys[module].stream()).unwrap_or(NO_RULE)
    }

    /// Calls the guards of each symbol's rules in each region, one rule at a time, for all modules that the rule can still decide.
    ///
    /// Returns the error that comes first in the chain.
    pub(crate) fn choose_guarded(&self, mut open: Vec<u32>, scratch: &mut Scratch) -> Result<()> {
        let grammar = &self.plan.grammar;
        let place_of = |scratch: &Scratch, index: u32| -> usize {
            self.place_at(scratch.active[index as usize].module as usize)
        };
        open.sort_by_key(|index| place_of(scratch, *index));
        let mut first: Option<(u32, Error)> = None;
        let mut rechosen = RechosenModules::default();
        let mut rest = open.as_slice();
        while let Some(index) = rest.first() {
            let place = place_of(scratch, *index);
            let (members, others) =
                rest.split_at(rest.partition_point(|index| place_of(scratch, *index) == place));
            rest = others;
            let rules = grammar.rules_at(place);
            if !grammar.has_runs()
                && rules.iter().all(|rule| grammar.rules()[usize::from(*rule)].weight.is_none())
            {
                first = self.choose_first(rules, members, scratch, first);
                continue;
            }
            let mut candidates = vec![Candidates::default(); members.len()];
            for number in rules {
                let rule = &grammar.rules()[usize::from(*number)];
                let end = first.as_ref().map_or(u32::MAX, |(index, _)| *index);
                let asked = members.iter().zip(&candidates).filter(|(index, candidates)| {
                    **index < end
                        && candidates.admit(rule)
                        && !rechosen.contains(**index)
                        && self.matches_guarded(*number, rule, scratch.active[**index as usize])
                });
                let mut holds: Vec<u32> = asked.map(|(index, _)| *index).collect();
                if rule.guarded {
                    let failed = match grammar.has_runs() {
                        true => self.guard_runs(*number, &mut holds, scratch, &mut rechosen),
                        false => self.guard(*number, &mut holds, scratch),
                    };
                    first = [failed, first].into_iter().flatten().min_by_key(|(index, _)| *index);
                }
                let mut holds = holds.into_iter().peekable();
                for (index, candidates) in members.iter().zip(&mut candidates) {
                    if holds.next_if_eq(index).is_some() {
                        candidates.add(*number, rule);
                    }
                }
            }
            for (index, candidates) in members.iter().zip(&candidates) {
                if rechosen.contains(*index) {
                    continue;
                }
                let active = &mut scratch.active[*index as usize];
                active.rule = self.choose_rule(candidates, active.module as usize);
            }
        }
        first.map_or(Ok(()), |(_, error)| Err(error))
    }

    /// Sets the rule of each application in `members` to the first of `rules`, which have no weights, that matches and whose guard
    /// holds. Returns the error that comes first in the chain, `first` included.
    fn choose_first(
        &self,
        rules: &[u16],
        members: &[u32],
        scratch: &mut Scratch,
        mut first: Option<(u32, Error)>,
    ) -> Option<(u32, Error)> {
        let (mut open, mut holds) = (members.to_vec(), Vec::with_capacity(members.len()));
        for number in rules {
            let rule = &self.plan.grammar.rules()[usize::from(*number)];
            if let Some((end, _)) = &first {
                open.retain(|index| index < end);
            }
            let matches =
                |index: &&u32| self.matches_guarded(*number, rule, scratch.active[**index as usize]);
            holds.clear();
            holds.extend(open.iter().filter(matches));
            if rule.guarded {
                let failed = self.guard(*number, &mut holds, scratch);
                first = [failed, first].into_iter().flatten().min_by_key(|(index, _)| *index);
            }
            if holds.is_empty() {
                continue;
            }
            for index in &holds {
                scratch.active[*index as usize].rule = *number;
            }
            open.retain(|index| scratch.active[*index as usize].rule == NO_RULE);
        }
        first
    }

    /// Retains the applications in `members` for which the guard of `rule` holds. If the guard fails, retains only
    /// those before the failure, and returns the failure with its application.
    pub(crate) fn guard(
        &self,
        rule: u16,
        members: &mut Vec<u32>,
        scratch: &mut Scratch,
    ) -> Option<(u32, Error)> {
        if members.is_empty() {
            return None;
        }
        let mut holds: Vec<u32> = Vec::new();
        if let Some(condition) = self.plan.grammar.rules()[usize::from(rule)].condition()
            && self.evaluate_condition(rule, condition, members, scratch, &mut holds)
        {
            let mut holds = holds.into_iter();
            members.retain(|_| holds.next().is_some_and(|holds| holds != 0));
            return None;
        }
        holds.clear();
        let failed = loop {
            holds.clear();
            let result = self.rules.guard(&self.gather(rule, members, scratch), &mut holds);
            let Err(failure) = result else { break None };
            let (index, error) = self.blame(failure, rule, members, scratch);
            match self.forgive(index, error, members, scratch) {
                Err(error) => break Some((index, error)),
                Ok(()) if members.is_empty() => return None,
                Ok(()) => {}
            }
        };
        if let Some((index, _)) = &failed {
            members.retain(|member| member < index);
        }
        let mut holds = holds.into_iter();
        members.retain(|_| holds.next().is_some_and(|holds| holds != 0));
        failed
    }

    /// Returns true if the chain of an application is skipped because its data is wrong.
    pub(crate) fn is_failed(&self, active: Active) -> bool {
        self.plan.failed.as_ref().is_some_and(|failed| failed.contains(active.chain as usize))
    }
}
