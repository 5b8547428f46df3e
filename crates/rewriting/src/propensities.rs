//! Events that can occur: the modules to which rules with propensities can be applied.

use crate::amounts::{Amount, MOST_PROPENSITY};
use crate::batch::{Active, Batch, ChainPiece, NO_RULE, Scratch, narrow, narrow_rule};
use crate::chain::END;
use crate::rule::Propensity;
use crate::rules::RuleFailure;
use burgeon_base::error::{Error, Result};

/// Application of a rule to a module that can be the next event.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PossibleEvent {
    pub active: Active,
    pub amount: Amount,
}

impl Batch<'_> {
    /// Adds the events that can occur in `piece` to `events`: for each module, in order, the rules whose contexts match and
    /// whose guards hold, unless their propensity is 0.
    pub(crate) fn find_events(
        &self,
        piece: ChainPiece,
        scratch: &mut Scratch,
        events: &mut Vec<PossibleEvent>,
    ) -> Result<()> {
        self.match_events(piece, scratch);
        let mut amounts = vec![Amount::ZERO; scratch.active.len()];
        let mut values = Vec::new();
        let mut first: Option<(u32, Error)> = None;
        for rule in 0..scratch.groups.len() {
            let mut members = std::mem::take(&mut scratch.groups[rule].members);
            if let Some((index, _)) = &first {
                members.retain(|member| member < index);
            }
            let number = narrow_rule(rule);
            let failures = [
                match self.plan.grammar.rules()[rule].guarded {
                    true => self.guard(number, &mut members, scratch),
                    false => None,
                },
                self.propensities(number, &mut members, scratch, &mut values),
            ];
            first = failures.into_iter().flatten().chain(first).min_by_key(|(index, _)| *index);
            for (member, value) in members.iter().zip(&values) {
                amounts[*member as usize] = Amount::of(*value);
            }
            members.clear();
            scratch.groups[rule].members = members;
        }
        if let Some((_, error)) = first {
            return Err(error);
        }
        let possible = scratch.active.iter().zip(amounts);
        events.extend(
            possible
                .filter(|(active, amount)| *amount > Amount::ZERO && !self.is_failed(**active))
                .map(|(active, amount)| PossibleEvent { active: *active, amount }),
        );
        Ok(())
    }

    /// Collects the modules of `piece` with each rule whose predecessor and contexts match.
    fn match_events(&self, piece: ChainPiece, scratch: &mut Scratch) {
        let grammar = &self.plan.grammar;
        scratch.groups.resize_with(grammar.rules().len(), Default::default);
        scratch.groups.iter_mut().for_each(|group| group.members.clear());
        scratch.active.clear();
        scratch.delayed.clear();
        let (mut param, mut chain) = (piece.begin.param, piece.begin.chain);
        for module in piece.begin.module..piece.end {
            let symbol = self.chain.symbols[module];
            let active =
                |rule| Active { module: narrow(module), param: narrow(param), chain: narrow(chain), rule };
            let rules = grammar.rules_at(self.place_at(module));
            if !rules.is_empty() && !self.is_failed(active(NO_RULE)) {
                for rule in rules {
                    if self.matches_old(*rule, &grammar.rules()[usize::from(*rule)], active(*rule)) {
                        scratch.groups[usize::from(*rule)].members.push(narrow(scratch.active.len()));
                        scratch.active.push(active(*rule));
                    }
                }
            }
            param += usize::from(grammar.arities()[usize::from(symbol)]);
            chain += usize::from(symbol == END);
        }
    }

    /// Sets `values` to the propensity of `rule` for each application in `members`. If it fails, retains only those before the
    /// failure, and returns the failure with its application.
    fn propensities(
        &self,
        rule: u16,
        members: &mut Vec<u32>,
        scratch: &mut Scratch,
        values: &mut Vec<f64>,
    ) -> Option<(u32, Error)> {
        loop {
            values.clear();
            if members.is_empty() {
                return None;
            }
            let result = match self.plan.grammar.rules()[usize::from(rule)].propensity() {
                Some(Propensity::Computed) => {
                    self.rules.propensity(&self.gather(rule, members, scratch), values)
                }
                Some(Propensity::Constant(value)) => {
                    values.resize(members.len(), value);
                    Ok(())
                }
                None => Ok(()),
            };
            let invalid = values.iter().position(|value| !(0.0..=MOST_PROPENSITY).contains(value));
            let failure = match (invalid, result) {
                (Some(at), _) => RuleFailure { at, error: invalid_propensity(values[at]) },
                (None, Err(failure)) => failure,
                (None, Ok(())) => return None,
            };
            let (index, error) = self.blame(failure, rule, members, scratch);
            if let Err(error) = self.forgive(index, error, members, scratch) {
                members.retain(|member| *member < index);
                return Some((index, error));
            }
        }
    }

    /// Applies the rules of the chosen events in `scratch`, which are in the order of the chain, at most one for a module.
    pub(crate) fn apply_events(&self, scratch: &mut Scratch) -> Result<()> {
        scratch.groups.iter_mut().for_each(|group| group.members.clear());
        for (index, active) in scratch.active.iter().enumerate() {
            scratch.groups[usize::from(active.rule)].members.push(narrow(index));
        }
        self.apply(scratch)
    }
}

/// Returns the error for a propensity that is no rate.
fn invalid_propensity(value: f64) -> Error {
    let error =
        Error::script(format!("the propensity is {value}, but it must be from 0 to {MOST_PROPENSITY:e}"));
    error.help("return a finite number of events per unit of time, 0 if the rule does not apply; for high rates, choose a \
                smaller unit of time")
}
