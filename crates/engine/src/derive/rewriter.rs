//! Applies the rules of a script's systems for self-expanding objects.

use std::cell::{RefCell, RefMut};
use std::collections::hash_map::Entry;
use std::sync::{Arc, Mutex, RwLock};

use rustc_hash::FxHashMap;

use super::pending::{Resolution, resolve};
use super::plan::DerivationPlan;
use super::step::step;
use super::threads::LeadingMachine;
use crate::machine::{Interpretations, RulePhase, SystemFunctions};
use burgeon_base::error::{Error, Result};
use burgeon_kit::{RewriteOutcome, Rewriter, RuleSet};
use burgeon_rewriting::{Chain, ModuleKey, StepOutcome, StepPlan, Stepper};

/// Systems of a script whose rules objects apply.
pub(super) struct SystemRewriter<'a> {
    leader: LeadingMachine<'a>,
    known: RefCell<FxHashMap<usize, Arc<RuleSet>>>,
    ready: RefCell<FxHashMap<usize, Ready>>,
    axioms: RefCell<FxHashMap<usize, Chain>>,
}

/// System prepared for steps.
struct Ready {
    declared: SystemFunctions,
    plan: Arc<DerivationPlan>,
    stepper: Stepper,
}

impl<'a> SystemRewriter<'a> {
    pub(super) fn new(leader: LeadingMachine<'a>) -> Self {
        Self { leader, known: RefCell::default(), ready: RefCell::default(), axioms: RefCell::default() }
    }

    /// Prepares system `index` for steps.
    fn prepare(&self, index: usize) -> Result<Ready> {
        let rules = self.rules(index)?;
        let plan = Arc::new(DerivationPlan {
            system: index,
            steps: Arc::new(StepPlan {
                grammar: rules.grammar.clone(),
                failed: None,
                chains: 1,
                batch: rules.batch,
                limit: self.leader.machine.session.options.limits.modules,
                // The caller needs the number of successors of each module.
                traced: true,
                notes_places: false,
            }),
            decomposition: None,
            interpretations: Interpretations::default(),
            objects: None,
            cut: None,
            bounded: true,
            profiled: false,
            located: Vec::new(),
            skips_passes: false,
            groups: Vec::new(),
            variables: RwLock::default(),
            assigns_variables: false,
            environments: None,
            places: RwLock::default(),
            reports: Mutex::default(),
        });
        let declared = self.leader.machine.library.systems.borrow()[index].prepare(self.leader.machine)?;
        Ok(Ready { declared, stepper: Stepper::new(&plan.steps), plan })
    }

    /// Reads the rules of system `index`. Fails if an object cannot apply them.
    fn read_rules(&self, index: usize) -> Result<RuleSet> {
        let session = &self.leader.machine.session;
        let systems = self.leader.machine.library.systems.borrow();
        let system = &systems[index];
        if let Some((what, help)) = system.unfit_for_objects() {
            return Err(Error::script(format!(
                "an object applies the rules of this system, which must not have {what}"
            ))
            .at_place(system.place.as_ref())
            .help(help));
        }
        Ok(RuleSet {
            grammar: system.grammar(
                &self.leader.machine.library,
                session.draws_random(),
                RulePhase::Rewriting,
                None,
            )?,
            values: Arc::clone(&session.values),
            place: system.place.clone(),
            has_object: system.object.is_some(),
            batch: session.options.batch.max(1),
        })
    }

    /// Returns system `index`, prepared for steps.
    fn ready(&self, index: usize) -> Result<RefMut<'_, Ready>> {
        if !self.ready.borrow().contains_key(&index) {
            let ready = self.prepare(index)?;
            self.ready.borrow_mut().insert(index, ready);
        }
        RefMut::filter_map(self.ready.borrow_mut(), |ready| ready.get_mut(&index))
            .map_err(|_| Error::internal("a system is not ready"))
    }
}

impl Rewriter for SystemRewriter<'_> {
    fn rules(&self, index: usize) -> Result<Arc<RuleSet>> {
        let mut known = self.known.borrow_mut();
        let rules = match known.entry(index) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(unknown) => unknown.insert(Arc::new(self.read_rules(index)?)),
        };
        Ok(Arc::clone(rules))
    }

    fn axiom(&self, index: usize) -> Result<Chain> {
        if let Some(chain) = self.axioms.borrow().get(&index) {
            return Ok(chain.clone());
        }
        let random = self.rules(index)?.grammar.draws_random();
        let axiom = self.leader.machine.library.systems.borrow()[index].axiom(
            self.leader.machine,
            ModuleKey::default(),
            random,
        )?;
        let plan = Arc::clone(&self.ready(index)?.plan);
        let chain = match resolve(self.leader, &plan, &axiom.chain, 0, None)? {
            Some(resolution) => resolution.chain,
            None => axiom.chain,
        };
        self.axioms.borrow_mut().insert(index, chain.clone());
        Ok(chain)
    }

    fn rewrite(&self, index: usize, chain: Chain, number: usize) -> Result<RewriteOutcome> {
        let ready = &mut *self.ready(index)?;
        let before = Arc::new(chain);
        let StepOutcome { chain, applied, .. } =
            step(self.leader, &ready.plan, &mut ready.stepper, &ready.declared, &before, number)?;
        ready.stepper.reuse(before);
        Ok(match resolve(self.leader, &ready.plan, &chain, number, None)? {
            Some(resolution) => {
                ready.stepper.reuse(Arc::new(chain));
                let applied = together(applied, &resolution);
                RewriteOutcome { chain: resolution.chain, applied }
            }
            None => RewriteOutcome { chain, applied },
        })
    }

    fn reuse(&self, index: usize, chain: Chain) {
        if let Some(ready) = self.ready.borrow_mut().get_mut(&index) {
            ready.stepper.reuse(Arc::new(chain));
        }
    }

    fn check(&self) -> Result<()> {
        self.leader.machine.session.stop.check()
    }
}

/// Returns `applied` with the numbers of successors after placeholders have been resolved.
fn together(applied: Vec<(u16, u32)>, resolution: &Resolution) -> Vec<(u16, u32)> {
    let mut became = resolution.applied.iter();
    let counted = applied.into_iter().map(|(rule, count)| {
        let of_rule = became.by_ref().take(count as usize);
        (rule, of_rule.map(|(_, count)| count).sum())
    });
    counted.collect()
}
