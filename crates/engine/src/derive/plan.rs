//! What is decided before the first step of a derivation.

use std::sync::Arc;

use super::rewriter::SystemRewriter;
use crate::declare::TraceRequest;
use crate::machine::{Axiom, Interpretations, Machine, Objects, SystemFunctions};
use burgeon_base::error::{Result, SourcePlace};
use burgeon_base::warning::Warning;
use burgeon_rewriting::{ModuleKey, StepPlan};

/// What does not change while a system derives; shared by all threads.
pub(crate) struct DerivationPlan {
    /// The system's place among those of the script.
    pub system: usize,
    /// Rules, and how they are applied.
    pub steps: Arc<StepPlan>,
    pub interpretations: Interpretations,
    pub objects: Option<Arc<Objects>>,
    /// Whether the time of each interpretation rule is measured.
    pub profiled: bool,
}

impl DerivationPlan {
    /// Tells objects that expand by themselves that the script is only checked.
    pub(super) fn sketch(&self) -> Result<()> {
        let Some(objects) = &self.objects else { return Ok(()) };
        (0..self.steps.chains).try_for_each(|chain| {
            objects.write(chain, |object| {
                object.sketch();
                Ok(())
            })
        })
    }

    /// Has objects that expand by themselves do so; adds to `said` what they warn of.
    pub(super) fn expand(&self, rules: &SystemRewriter<'_>, said: &mut Vec<Warning>) -> Result<()> {
        let Some(objects) = &self.objects else { return Ok(()) };
        if !objects.read(0, |object| Ok(object.expands()))? {
            return Ok(());
        }
        for chain in (0..self.steps.chains).filter(|chain| !objects.failed().contains(*chain)) {
            objects.write(chain, |object| {
                object.expand(rules)?;
                said.extend(object.take_warnings());
                Ok(())
            })?;
        }
        Ok(())
    }
}

/// A derivation that is about to begin.
pub(super) struct Derivation {
    /// The first chains, whose objects the plan has.
    pub axiom: Axiom,
    pub plan: Arc<DerivationPlan>,
    /// The functions of its rules in the leading machine.
    pub declared: SystemFunctions,
    /// The chains whose lineage is asked for.
    pub traced: Option<TraceRequest>,
    /// Where the system was made.
    pub place: Option<SourcePlace>,
    /// The line of the script that led there.
    pub caller: Option<SourcePlace>,
    /// Where its axiom was set.
    pub axiom_place: Option<SourcePlace>,
    /// Whether only the last pass is made, as nobody could see the others.
    pub last_only: bool,
    /// Whether what passes drew before the last one is gone after it.
    pub draws_afresh: bool,
    /// Whether it has an object that draws.
    pub draws: bool,
    /// The greatest number of steps.
    pub limit: usize,
}

impl Derivation {
    /// Plans the derivation of system `index` by at most `steps` steps: its first chains, its rules and its objects.
    pub(super) fn plan(machine: &Machine, index: usize, steps: Option<usize>) -> Result<Self> {
        let session = &machine.session;
        let options = &session.options;
        let traced = options.reports.trace.filter(|traced| traced.system == index);
        // What was declared since the last derivation holds as well.
        machine.current.system.set(None);
        machine.library.systems.borrow()[index].note_derivation(machine);
        let systems = machine.library.systems.borrow();
        let system = &systems[index];
        let grammar = system.grammar(&machine.library, session.draws_random());
        let key = ModuleKey::seed(system.seed.unwrap_or(options.seed));
        let mut axiom = system.axiom(machine, key, grammar.draws_random())?;
        if let Some(chain) = traced.and_then(|traced| traced.chain) {
            axiom = axiom.only(chain, grammar.arities());
        }
        let objects = std::mem::take(&mut axiom.objects);
        // Where nothing else would be built, the error tells more.
        let forgiving = axiom.given > 1 && !options.strict;
        let objects = (!objects.is_empty()).then(|| Arc::new(Objects::new(objects, forgiving)));
        let plan = Arc::new(DerivationPlan {
            system: index,
            steps: Arc::new(StepPlan {
                grammar,
                failed: objects.as_ref().map(|objects| Arc::clone(objects.failed())),
                chains: axiom.features.len(),
                batch: options.batch.max(1),
                limit: options.limits.modules,
                traced: traced.is_some() || options.reports.records,
                notes_places: traced.is_some_and(|traced| traced.chain.is_some()),
            }),
            interpretations: system.interpretations(&machine.library),
            objects,
            profiled: options.reports.profile,
        });
        let declared = system.prepare(machine)?;
        system.tell_forestalled(machine, &plan.steps.grammar);
        let limit = [steps, options.steps].into_iter().flatten().min().unwrap_or(usize::MAX);
        let draws_afresh = system.draws_afresh();
        Ok(Self {
            axiom,
            plan,
            declared,
            traced,
            place: system.place.clone(),
            caller: system.caller.clone(),
            axiom_place: system.axiom_place.clone(),
            last_only: system.shows_last_only(),
            draws_afresh,
            draws: draws_afresh && system.object.is_some(),
            limit: if options.check { 0 } else { limit },
        })
    }
}
