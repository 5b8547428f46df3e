//! Applies the rules of a script's systems for objects that expand by themselves.

use std::cell::RefCell;
use std::sync::Arc;

use rustc_hash::FxHashMap;

use super::plan::DerivationPlan;
use super::step::{StepOutcome, Stepper};
use super::threads::ThreadPool;
use crate::machine::{Interpretations, Machine, SystemFunctions};
use burgeon_base::error::Result;
use burgeon_kit::rules::{Chain, ModuleKey};
use burgeon_kit::{RewriteOutcome, Rewriter, RuleSet};

/// The systems of a machine's script whose rules objects apply.
pub(super) struct SystemRewriter<'a> {
    machine: &'a Machine,
    threads: &'a ThreadPool,
    known: RefCell<FxHashMap<usize, Arc<RuleSet>>>,
    ready: RefCell<FxHashMap<usize, Ready>>,
    axioms: RefCell<FxHashMap<usize, Chain>>,
}

/// A system whose rules have been applied.
struct Ready {
    declared: SystemFunctions,
    stepper: Stepper,
}

impl<'a> SystemRewriter<'a> {
    pub(super) fn new(machine: &'a Machine, threads: &'a ThreadPool) -> Self {
        Self {
            machine,
            threads,
            known: RefCell::default(),
            ready: RefCell::default(),
            axioms: RefCell::default(),
        }
    }

    /// Makes system `index` ready to be derived.
    fn prepare(&self, index: usize) -> Result<Ready> {
        let rules = self.rules(index)?;
        let plan = Arc::new(DerivationPlan {
            system: index,
            grammar: rules.grammar.clone(),
            interpretations: Interpretations::default(),
            objects: None,
            chains: 1,
            batch: rules.batch,
            // How many modules each became has to be known.
            traced: true,
            profiled: false,
        });
        let declared = self.machine.library.systems.borrow()[index].prepare(self.machine)?;
        Ok(Ready { declared, stepper: Stepper::new(plan) })
    }
}

impl Rewriter for SystemRewriter<'_> {
    fn rules(&self, index: usize) -> Result<Arc<RuleSet>> {
        if let Some(known) = self.known.borrow().get(&index) {
            return Ok(Arc::clone(known));
        }
        let session = &self.machine.session;
        let systems = self.machine.library.systems.borrow();
        let system = &systems[index];
        let rules = Arc::new(RuleSet {
            grammar: system.grammar(&self.machine.library, session.draws_random()),
            values: Arc::clone(&session.values),
            place: system.place.clone(),
            has_object: system.object.is_some(),
            batch: session.options.batch.max(1),
        });
        self.known.borrow_mut().insert(index, Arc::clone(&rules));
        Ok(rules)
    }

    fn axiom(&self, index: usize) -> Result<Chain> {
        if let Some(chain) = self.axioms.borrow().get(&index) {
            return Ok(chain.clone());
        }
        let random = self.rules(index)?.grammar.draws_random();
        let axiom =
            self.machine.library.systems.borrow()[index].axiom(self.machine, ModuleKey::default(), random)?;
        self.axioms.borrow_mut().insert(index, axiom.chain.clone());
        Ok(axiom.chain)
    }

    fn rewrite(&self, index: usize, chain: Chain, step: usize) -> Result<RewriteOutcome> {
        let mut ready = self.ready.borrow_mut();
        let ready = match ready.entry(index) {
            std::collections::hash_map::Entry::Occupied(entry) => entry.into_mut(),
            std::collections::hash_map::Entry::Vacant(entry) => entry.insert(self.prepare(index)?),
        };
        let StepOutcome { chain, applied, .. } =
            ready.stepper.step((self.machine, self.threads), &ready.declared, chain, step)?;
        Ok(RewriteOutcome { chain, applied })
    }

    fn reuse(&self, index: usize, chain: Chain) {
        if let Some(ready) = self.ready.borrow_mut().get_mut(&index) {
            ready.stepper.reuse(chain);
        }
    }

    fn check(&self) -> Result<()> {
        self.machine.session.stop.check()
    }
}
