//! Rewriting of modules that depend on one another, with one call of functions for many of them.
//!
//! Contexts in the new chain are then single modules, so the neighbour of a module is either final before the call, or it is the
//! result of a module earlier in the call. A walk along the chain finds these neighbours.

use std::time::{Duration, Instant};

use crate::batch::{Active, Batch, ChainPiece, NO_RULE, Scratch, narrow, narrow_rule};
use crate::chain::{CLOSE, END, OPEN};
use crate::dependent_batch::{DependentBatch, Neighbour};
use crate::dependent_rules::DependentRules;
use crate::dependents::DependentModules;
use crate::new_chain::{NewChain, NewPlace};
use crate::rules::RuleFailure;
use burgeon_base::error::Result;

/// Walk along a chain that knows the neighbour of the next module.
struct NeighbourWalk {
    here: Neighbour,
    /// Neighbours outside of the branches that contain the next module.
    open: Vec<Neighbour>,
}

impl NeighbourWalk {
    /// Passes a bracket or an end, in the direction of the walk.
    fn pass(&mut self, symbol: u16, is_backward: bool) {
        match (symbol, is_backward) {
            (OPEN, false) => self.open.push(self.here),
            (CLOSE, true) => self.open.push(std::mem::replace(&mut self.here, Neighbour::None)),
            (END, _) => self.here = Neighbour::None,
            _ => self.here = self.open.pop().unwrap_or(Neighbour::None),
        }
    }
}

impl Batch<'_> {
    /// Rewrites the modules of `scratch.delayed`, after all others of `piece`, and adds the time of each rule to `times`.
    /// Returns false if a function has failed: the modules are then not rewritten.
    pub(crate) fn rewrite_dependents(
        &self,
        rules: &DependentRules,
        piece: ChainPiece,
        scratch: &mut Scratch,
        times: &mut [Duration],
    ) -> Result<bool> {
        let mut call = std::mem::take(&mut scratch.dependents);
        let delayed = std::mem::take(&mut scratch.delayed);
        call.applied.clear();
        call.applied.resize(times.len(), 0);
        let begin = Instant::now();
        let result = match rules.is_backward() {
            true => {
                let places = (piece.begin.module..piece.end).rev();
                self.walk_dependents(rules, places, delayed.iter().rev(), scratch, &mut call)
            }
            false => {
                let places = piece.begin.module..piece.end;
                self.walk_dependents(rules, places, delayed.iter(), scratch, &mut call)
            }
        };
        let all: usize = call.applied.iter().sum();
        let time = begin.elapsed().as_secs_f64() / all.max(1) as f64;
        for (spent, count) in times.iter_mut().zip(&call.applied).filter(|(_, count)| **count > 0) {
            *spent += Duration::from_secs_f64(time * *count as f64);
        }
        let failure = match result {
            Ok(None) => None,
            Ok(Some(failure)) if self.stop.check().is_ok() => {
                self.new_chain.borrow_mut().forget(&delayed);
                delayed.iter().for_each(|index| scratch.active[*index as usize].rule = NO_RULE);
                Some(failure)
            }
            Ok(Some(failure)) => {
                let rule = call.chosen.last().map_or(NO_RULE, |rule| narrow_rule(*rule as usize));
                scratch.dependents = call;
                let members = std::mem::take(&mut scratch.dependents.members);
                return Err(match rule {
                    NO_RULE => failure.error,
                    rule => self.blame(failure, rule, &members, scratch).1,
                });
            }
            Err(error) => return Err(error),
        };
        scratch.dependents = call;
        scratch.delayed = delayed;
        Ok(failure.is_none())
    }

    /// Rewrites the active modules with the indices `delayed`, in the order of `places`, their chain. Returns the failure of a
    /// function.
    fn walk_dependents<'d>(
        &self,
        rules: &DependentRules,
        places: impl Iterator<Item = usize>,
        delayed: impl Iterator<Item = &'d u32>,
        scratch: &mut Scratch,
        call: &mut DependentBatch,
    ) -> Result<Option<RuleFailure>> {
        let mut delayed = delayed.copied().peekable();
        let mut walk = NeighbourWalk { here: Neighbour::None, open: Vec::new() };
        let is_backward = rules.is_backward();
        call.clear();
        for place in places {
            let symbol = self.chain.symbols[place];
            if symbol <= END {
                walk.pass(symbol, is_backward);
                continue;
            }
            let old = narrow(place);
            let member = delayed.next_if(|index| scratch.active[*index as usize].module == old);
            match member.filter(|index| !self.is_failed(scratch.active[*index as usize])) {
                Some(index) => {
                    self.add_dependent(rules, index, walk.here, scratch, call);
                    walk.here = Neighbour::Pending(narrow(call.members.len() - 1));
                }
                None => {
                    if let Some(found) = self.nearest(rules, &self.new_chain.borrow(), old) {
                        walk.here = Neighbour::Final(found);
                    }
                }
            }
            if call.members.len() >= self.plan.batch {
                if let Some(failure) = self.run_dependents(rules, scratch, call)? {
                    return Ok(Some(failure));
                }
                let new = self.new_chain.borrow();
                let nearest = |index| self.nearest(rules, &new, scratch.active[index as usize].module);
                walk.here = call.settle(walk.here, nearest);
                for neighbour in &mut walk.open {
                    *neighbour = call.settle(*neighbour, nearest);
                }
                call.clear();
            }
        }
        match call.members.is_empty() {
            true => Ok(None),
            false => self.run_dependents(rules, scratch, call),
        }
    }

    /// Returns the module that contexts see of what has replaced the symbol at `old`.
    #[inline]
    fn nearest(&self, rules: &DependentRules, new: &NewChain, old: u32) -> Option<NewPlace> {
        let offset = rules.nearest(new.symbols_of(old, self.chain))?;
        Some(NewPlace { old, offset: narrow(offset) })
    }

    /// Adds active module `index`, which has the neighbour `source`, to the modules of the next call.
    fn add_dependent(
        &self,
        rules: &DependentRules,
        index: u32,
        source: Neighbour,
        scratch: &mut Scratch,
        call: &mut DependentBatch,
    ) {
        let grammar = &self.plan.grammar;
        let arities = grammar.arities();
        let active = scratch.active[index as usize];
        let neighbour = match (source, call.last) {
            (Neighbour::None, _) => 0,
            (Neighbour::Pending(index), _) => call.modules[index as usize][1],
            (Neighbour::Final(place), Some((known, number))) if known == place => number,
            (Neighbour::Final(place), _) => {
                let number = narrow(call.neighbours.len());
                let new = self.new_chain.borrow();
                let (symbol, params) = new.module(place, self.chain, self.links, arities);
                call.neighbours.push([u32::from(symbol), narrow(call.values.len())]);
                call.values.extend_from_slice(params);
                call.last = Some((place, number));
                number
            }
        };
        let symbol = self.chain.symbols[active.module as usize];
        let own = narrow(call.neighbours.len());
        let shown = if rules.is_ignored(symbol) { DependentModules::SKIPPED } else { u32::from(symbol) };
        call.neighbours.push([shown, narrow(call.values.len())]);
        let begin = active.param as usize;
        let params = &self.chain.params[begin..begin + usize::from(arities[usize::from(symbol)])];
        call.values.extend_from_slice(params);
        for number in grammar.rules_at(self.place_at(active.module as usize)) {
            let rule = &grammar.rules()[usize::from(*number)];
            if !self.matches_old(*number, rule, active) {
                continue;
            }
            call.trials.push([u32::from(*number), narrow(call.arguments.len())]);
            self.gather_for_trial(*number, active, scratch, &mut call.arguments);
            if !rule.guarded && !rule.has_new_contexts() {
                break;
            }
        }
        call.modules.push([neighbour, own, narrow(call.trials.len())]);
        call.members.push(index);
        call.sources.push(source);
    }

    /// Adds the arguments of `rule` for a module, with zeros for those of contexts in the new chain.
    fn gather_for_trial(&self, rule: u16, active: Active, scratch: &mut Scratch, arguments: &mut Vec<f64>) {
        let declared = &self.plan.grammar.rules()[usize::from(rule)];
        let pattern = &declared.pattern;
        let end = arguments.len() + declared.arguments();
        if declared.has_contexts() {
            self.contexts().of_rule(rule).bind(active.module as usize, &mut scratch.bindings);
        }
        let (news, lefts) = (pattern.new_left.len(), pattern.left.len());
        let own = &pattern.predecessors[0];
        for (place, item) in declared.contexts().iter().enumerate() {
            if place == news + lefts {
                own.push_arguments(&self.chain.params, active.param as usize, arguments);
            }
            let bound = place.checked_sub(news).and_then(|place| scratch.bindings.get(place));
            match bound.filter(|_| declared.has_contexts()) {
                Some(module) => {
                    let begin = self.links.param[*module as usize] as usize;
                    item.push_arguments(&self.chain.params, begin, arguments);
                }
                None => arguments.resize(arguments.len() + item.bound, 0.0),
            }
        }
        if declared.contexts().len() <= news + lefts {
            own.push_arguments(&self.chain.params, active.param as usize, arguments);
        }
        arguments.resize(end, 0.0);
    }

    /// Chooses and applies the rules of the modules of `call`. Returns the failure of a function.
    fn run_dependents(
        &self,
        rules: &DependentRules,
        scratch: &mut Scratch,
        call: &mut DependentBatch,
    ) -> Result<Option<RuleFailure>> {
        self.stop.check()?;
        self.gather_origins(&call.members, scratch);
        let modules = DependentModules {
            grammar: &self.plan.grammar,
            rules,
            modules: &call.modules,
            trials: &call.trials,
            arguments: &call.arguments,
            neighbours: &call.neighbours,
            values: &call.values,
            chains: &scratch.chains,
            keys: &scratch.keys,
            places: &scratch.places,
            step: self.step,
        };
        if let Err(failure) = self.rules.apply_dependents(&modules, &mut call.successors, &mut call.chosen) {
            return Ok(Some(failure));
        }
        for (index, rule) in call.members.iter().zip(&call.chosen) {
            let rule = narrow_rule(*rule as usize);
            scratch.active[*index as usize].rule = rule;
            if let Some(count) = call.applied.get_mut(usize::from(rule)) {
                *count += 1;
            }
        }
        call.successors.members.clear();
        call.successors.members.extend_from_slice(&call.members);
        let arities = self.plan.grammar.arities();
        self.new_chain.borrow_mut().take_group(&mut call.successors, &mut scratch.arranged, arities);
        Ok(None)
    }
}
