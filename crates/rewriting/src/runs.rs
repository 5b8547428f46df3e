//! Rules that rewrite several modules at once.
//!
//! The modules of a run stand between the same two brackets. Everything here therefore depends only on the stretch of
//! modules between two brackets, so the result is the same for any division of a chain into pieces that end at brackets.

use crate::batch::{Batch, ChainPiece, NO_RULE, Scratch, narrow};
use crate::chain::{Chain, END, Mark};
use crate::choice::Candidates;
use burgeon_base::error::{Error, Result};

/// Divides the chain at the first bracket or end from each mark on, into pieces of at least `size` symbols.
pub(crate) fn pieces_at_brackets(chain: &Chain, size: usize, arities: &[u8]) -> Vec<ChainPiece> {
    let symbols = &chain.symbols;
    let mut pieces: Vec<ChainPiece> = Vec::new();
    let mut here = Mark::default();
    for mark in &chain.marks {
        let begin = pieces.last().map_or(0, |piece| piece.begin.module);
        if !pieces.is_empty() && mark.module.max(here.module) - begin < size {
            continue;
        }
        if mark.module > here.module {
            here = *mark;
        }
        while here.module > 0
            && here.module < symbols.len()
            && symbols[here.module] > END
            && symbols[here.module - 1] > END
        {
            here.param += usize::from(arities[usize::from(symbols[here.module])]);
            here.module += 1;
        }
        if here.module == symbols.len() {
            break;
        }
        if pieces.last().is_none_or(|piece| piece.begin.module < here.module) {
            if let Some(piece) = pieces.last_mut() {
                piece.end = here.module;
            }
            pieces.push(ChainPiece { begin: here, end: here.module });
        }
    }
    if let Some(piece) = pieces.last_mut() {
        piece.end = symbols.len();
    }
    pieces
}

/// Modules for which guards were evaluated again, one after the other.
#[derive(Debug, Default)]
pub(crate) struct RechosenModules(Vec<bool>);

impl RechosenModules {
    /// Returns true if the rule of the module with this index in [`Scratch::active`] is already final.
    pub(crate) fn contains(&self, index: u32) -> bool {
        self.0.get(index as usize).copied().unwrap_or(false)
    }
}

impl Batch<'_> {
    /// Removes the rules of modules that an earlier module's run contains: of overlapping runs, the first applies.
    pub(crate) fn drop_taken(&self, scratch: &mut Scratch) {
        let rules = self.plan.grammar.rules();
        let mut free = 0;
        for active in &mut scratch.active {
            let module = active.module as usize;
            if module < free {
                active.rule = NO_RULE;
            } else if active.rule != NO_RULE {
                free = module + rules[usize::from(active.rule)].run_length();
            }
        }
    }

    /// Calls the guard of `rule` for `members`, and retains those for which it holds.
    ///
    /// A failure counts only if no run contains the module, which depends on the modules before it. Between the brackets
    /// around a failure, the rules are therefore chosen again from left to right, and are then final. Returns the failure
    /// that comes first in the chain, with its application; only members before it are then retained.
    pub(crate) fn guard_runs(
        &self,
        rule: u16,
        members: &mut Vec<u32>,
        scratch: &mut Scratch,
        rechosen: &mut RechosenModules,
    ) -> Option<(u32, Error)> {
        let mut open = std::mem::take(members);
        let mut first: Option<(u32, Error)> = None;
        while !open.is_empty() {
            let mut holds: Vec<u32> = Vec::new();
            let result = self.rules.guard(&self.gather(rule, &open, scratch), &mut holds);
            let valid = result.as_ref().map_or_else(|failure| failure.at, |()| open.len());
            let held = open.iter().zip(&holds).take(valid).filter(|(_, holds)| **holds != 0);
            members.extend(held.map(|(member, _)| *member));
            let Err(failure) = result else { break };
            let failed = open.get(failure.at).copied().unwrap_or(open[0]);
            open.drain(..=failure.at.min(open.len() - 1));
            if let Err((index, error)) = self.choose_again(failed, scratch, rechosen)
                && first.as_ref().is_none_or(|(known, _)| index < *known)
            {
                first = Some((index, error));
            }
            let end = first.as_ref().map_or(u32::MAX, |(index, _)| *index);
            open.retain(|member| *member < end && !rechosen.contains(*member));
        }
        let end = first.as_ref().map_or(u32::MAX, |(index, _)| *index);
        members.retain(|member| *member < end && !rechosen.contains(*member));
        first
    }

    /// Chooses the rules of all modules between the brackets around an application, from left to right. Fails with the
    /// first application whose guard fails.
    fn choose_again(
        &self,
        around: u32,
        scratch: &mut Scratch,
        rechosen: &mut RechosenModules,
    ) -> Result<(), (u32, Error)> {
        let symbols = &self.chain.symbols;
        let module = scratch.active[around as usize].module as usize;
        let begin = symbols[..module].iter().rposition(|symbol| *symbol <= END).map_or(0, |at| at + 1);
        let end = symbols[module..].iter().position(|symbol| *symbol <= END);
        let end = end.map_or(symbols.len(), |at| module + at);
        let first = scratch.active.partition_point(|active| (active.module as usize) < begin);
        let last = scratch.active.partition_point(|active| (active.module as usize) < end);
        rechosen.0.resize(scratch.active.len(), false);
        rechosen.0[first..last].fill(true);
        scratch.active[first..last].iter_mut().for_each(|active| active.rule = NO_RULE);
        let grammar = &self.plan.grammar;
        let mut free = 0;
        for index in first..last {
            let module = scratch.active[index].module as usize;
            if module < free {
                continue;
            }
            let mut candidates = Candidates::default();
            for number in grammar.rules_at(self.place_at(module)) {
                let rule = &grammar.rules()[usize::from(*number)];
                if candidates.admit(rule) && self.matches_guarded(*number, rule, scratch.active[index]) {
                    let mut members = vec![narrow(index)];
                    if rule.guarded
                        && let Some(failed) = self.guard(*number, &mut members, scratch)
                    {
                        return Err(failed);
                    }
                    // A guard whose data is wrong ends the chain.
                    if self.is_failed(scratch.active[index]) {
                        scratch.active[first..last].iter_mut().for_each(|active| active.rule = NO_RULE);
                        return Ok(());
                    }
                    if !members.is_empty() {
                        candidates.add(*number, rule);
                    }
                    if candidates.is_settled() {
                        break;
                    }
                }
            }
            let rule = self.choose_rule(&candidates, module);
            scratch.active[index].rule = rule;
            if rule != NO_RULE {
                free = module + grammar.rules()[usize::from(rule)].run_length();
            }
        }
        Ok(())
    }

    /// Returns the number of parameters of the `length` modules from `module` on.
    pub(crate) fn run_params(&self, module: usize, length: usize) -> usize {
        let arities = self.plan.grammar.arities();
        let run = &self.chain.symbols[module..module + length];
        run.iter().map(|symbol| usize::from(arities[usize::from(*symbol)])).sum()
    }
}
