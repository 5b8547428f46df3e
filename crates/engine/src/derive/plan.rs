//! Plan of a derivation, made before the first step.

use std::sync::{Arc, Mutex, RwLock};

use super::rewriter::SystemRewriter;
use crate::declare::TraceRequest;
use crate::machine::{
    Axiom, DerivationRequest, Environments, HookFunction, HookMoment, Interpretations, Machine, ModulePlaces,
    Objects, RulePhase, SystemFunctions, group_number,
};
use crate::results::{ReportSums, VariableValues};
use burgeon_base::error::{Error, Result, SourcePlace};
use burgeon_base::locks::LockRecovery;
use burgeon_base::warning::Warning;
use burgeon_rewriting::{Grammar, ModuleKey, StepPlan, Symbol};

/// Rules that apply repeatedly after the axiom and after each step.
pub(crate) struct Decomposition {
    pub steps: Arc<StepPlan>,
    /// Maximum number of times that the rules apply one after another.
    pub max_depth: usize,
    /// Set if a rule may use `this`.
    pub asks: bool,
}

/// Group of rules that a script can choose for the next steps.
pub(crate) struct RuleGroup {
    pub name: Arc<str>,
    /// Rules of the group, and rules without a group.
    pub steps: Arc<StepPlan>,
    /// Decomposition rules of the group, and those without a group, if there are any.
    pub decomposition: Option<Arc<StepPlan>>,
}

/// Constant data of a derivation, shared by all threads.
pub(crate) struct DerivationPlan {
    /// Index of the system in the script.
    pub system: usize,
    /// Rules, and how they are applied.
    pub steps: Arc<StepPlan>,
    /// Decomposition rules, if there are any.
    pub decomposition: Option<Decomposition>,
    /// Groups of rules.
    pub groups: Vec<RuleGroup>,
    /// Variables, as functions read them in the present phase.
    pub(super) variables: RwLock<Option<Arc<VariableValues>>>,
    /// Environments that interpretations change and rules read.
    pub environments: Option<Arc<Environments>>,
    /// Set if interpretations can assign variables.
    pub assigns_variables: bool,
    pub interpretations: Interpretations,
    pub objects: Option<Arc<Objects>>,
    /// Symbol of the modules that cut branches.
    pub cut: Option<Symbol>,
    /// Set if the number of steps is given, which `step()` requires.
    pub bounded: bool,
    /// Set if the time of each interpretation rule is measured.
    pub profiled: bool,
    /// Set for each symbol whose rules read where the object is; empty if there is none.
    pub located: Vec<bool>,
    /// Set if rules read where the object is, but the script asks for the last pass only.
    pub skips_passes: bool,
    /// Places of modules in the present chain, if a pass has noted them.
    pub(super) places: RwLock<Option<Arc<ModulePlaces>>>,
    /// Sums that the last interpretation pass reported.
    pub(super) reports: Mutex<ReportSums>,
}

impl DerivationPlan {
    /// Returns the places of modules in the present chain, if a pass has noted them.
    pub(super) fn places(&self) -> Option<Arc<ModulePlaces>> {
        self.places.read().recover().clone()
    }

    /// Sets the places of modules in the present chain, or `None` for another chain.
    pub(super) fn set_places(&self, places: Option<ModulePlaces>) {
        *self.places.write().recover() = places.map(Arc::new);
    }

    /// Returns the variables, if the system has some.
    pub(super) fn variables(&self) -> Option<Arc<VariableValues>> {
        self.variables.read().recover().clone()
    }

    /// Sets the objects and the environments that the functions of a machine use from now on.
    pub(super) fn show_objects(&self, machine: &Machine) {
        machine.current.objects.replace(self.objects.clone());
        machine.current.environments.replace(self.environments.clone());
    }

    /// Sets the variables that functions read from now on.
    pub(super) fn set_variables(&self, variables: VariableValues) {
        *self.variables.write().recover() = Some(Arc::new(variables));
    }

    /// Keeps the places of the modules that remain; `applied` has the number of symbols that each symbol became.
    pub(super) fn keep_places(&self, applied: &[(u16, u32)]) {
        if let Some(places) = self.places() {
            self.set_places(Some(places.after(applied)));
        }
    }

    /// Returns true if rules have propensities.
    pub(super) fn has_events(&self) -> bool {
        let groups = self.groups.iter().map(|group| &group.steps);
        groups.chain([&self.steps]).any(|steps| steps.grammar.has_events())
    }

    /// Marks self-expanding objects as checked only.
    pub(super) fn sketch(&self) -> Result<()> {
        let Some(objects) = &self.objects else { return Ok(()) };
        (0..self.steps.chains).try_for_each(|chain| {
            objects.write(chain, |object| {
                object.sketch();
                Ok(())
            })
        })
    }

    /// Expands self-expanding objects, and adds their warnings to `said`.
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

/// Derivation before its first step.
pub(super) struct Derivation {
    /// Initial chains; their objects are in the plan.
    pub axiom: Axiom,
    pub plan: Arc<DerivationPlan>,
    /// Rule functions in the leading machine.
    pub declared: SystemFunctions,
    /// Chains whose lineage is requested.
    pub traced: Option<TraceRequest>,
    /// Location where the system was created.
    pub place: Option<SourcePlace>,
    /// Line of the script from which that location was called.
    pub caller: Option<SourcePlace>,
    /// Location where the axiom was set.
    pub axiom_place: Option<SourcePlace>,
    /// Set if only the last pass runs, because nothing can observe the others.
    pub last_only: bool,
    /// Set if rules use `this` only to ask for the place of their module.
    pub asks_places_only: bool,
    /// Set if each pass discards the drawings of the passes before.
    pub draws_afresh: bool,
    /// Set if the system has an object that draws.
    pub draws: bool,
    /// Maximum number of steps.
    pub limit: usize,
    /// Time at which a derivation by events ends.
    pub until: f64,
    /// Number of the group of rules with which the derivation begins; `None` for the rules without a group.
    pub group: Option<usize>,
    /// Key of the random numbers of hooks.
    pub key: ModuleKey,
    /// Hooks of each moment that has some.
    pub hooks: Vec<(HookMoment, Vec<HookFunction>)>,
}

impl Derivation {
    /// Returns true if the derivation ends only by itself: it has neither a number of steps nor a time.
    pub(super) fn is_open(&self) -> bool {
        !self.plan.bounded && self.until == f64::INFINITY
    }

    /// Plans the derivation of system `index`: initial chains, rules and objects.
    pub(super) fn plan(machine: &Machine, index: usize, request: DerivationRequest<'_>) -> Result<Self> {
        let DerivationRequest { steps, group, time } = request;
        let session = &machine.session;
        let options = &session.options;
        let traced = options.reports.trace.filter(|traced| traced.system == index);
        // Declarations since the last derivation also apply.
        machine.current.system.set(None);
        machine.library.systems.borrow()[index].note_derivation(machine);
        let systems = machine.library.systems.borrow();
        let system = &systems[index];
        let group_names = system.groups();
        let group = group.map(|name| group_number(&group_names, name)).transpose()?;
        let grammar_of = |phase, group: Option<&str>| {
            system.grammar(&machine.library, session.draws_random(), phase, group)
        };
        let grammar = grammar_of(RulePhase::Rewriting, None)?;
        let key = ModuleKey::seed(system.seed.unwrap_or(options.seed));
        let mut axiom = system.axiom(machine, key, grammar.draws_random())?;
        if let Some(chain) = traced.and_then(|traced| traced.chain) {
            axiom = axiom.only(chain, grammar.arities());
        }
        if grammar.has_events() {
            system.advance_continued(&mut axiom.chain);
        }
        let objects = std::mem::take(&mut axiom.objects);
        // If the system has only one feature, the error is more helpful than an empty model.
        let is_part = options.part.is_some();
        let forgiving = (axiom.given > 1 || is_part) && !options.strict;
        let objects = (!objects.is_empty()).then(|| Arc::new(Objects::new(objects, forgiving)));
        let limit = [steps, options.steps].into_iter().flatten().min();
        let located = system.located_symbols(grammar.arities().len());
        let step_plan = |grammar| {
            Arc::new(StepPlan {
                grammar,
                failed: objects.as_ref().map(|objects| Arc::clone(objects.failed())),
                chains: axiom.features.len(),
                batch: options.batch.max(1),
                limit: options.limits.modules,
                traced: traced.is_some() || options.reports.records,
                notes_places: !located.is_empty() || traced.is_some_and(|traced| traced.chain.is_some()),
            })
        };
        let decomposes = system.has_rules_in(RulePhase::Decomposition);
        let decomposition_of = |group: Option<&str>| {
            decomposes.then(|| grammar_of(RulePhase::Decomposition, group).map(step_plan)).transpose()
        };
        let groups = group_names.into_iter().map(|name| {
            let steps = step_plan(grammar_of(RulePhase::Rewriting, Some(&name))?);
            Ok(RuleGroup { steps, decomposition: decomposition_of(Some(&name))?, name })
        });
        let groups = groups.collect::<Result<Vec<RuleGroup>>>()?;
        if time.is_some()
            && !groups.iter().map(|group| &group.steps.grammar).chain([&grammar]).any(Grammar::has_events)
        {
            return Err(Error::argument("derive: a time needs rules with propensities")
                .help("give the rules propensities, { propensity = 0.5 }, or derive a number of steps"));
        }
        let decomposition = decomposition_of(None)?.map(|steps| Decomposition {
            steps,
            max_depth: system.max_depth,
            asks: system.asks_in(RulePhase::Decomposition),
        });
        let earlier = axiom.variables.take();
        let variables = system.variables.and_then(|table| machine.library.initial_variables(table));
        let variables = variables.map(|variables| variables.continued(earlier.as_ref()));
        let assigns_variables = system.interpretations_reach_variables(machine)?;
        if options.part.is_some() && axiom.given > 1 && system.has_state_of_all_chains() {
            return Err(Error::script(
                "hooks, variables and environments belong to all chains, but --part derives a part of them",
            )
            .at_place(system.place.as_ref())
            .help("run the script without --part, or keep values in parameters of modules"));
        }
        let plan = Arc::new(DerivationPlan {
            system: index,
            steps: step_plan(grammar),
            decomposition,
            groups,
            variables: RwLock::new(variables.map(Arc::new)),
            assigns_variables,
            environments: Environments::new(&system.environments),
            interpretations: system.interpretations(&machine.library),
            objects,
            cut: machine.library.cut.get(),
            bounded: limit.is_some(),
            profiled: options.reports.profile,
            places: RwLock::default(),
            reports: Mutex::default(),
            skips_passes: system.last_only && !located.is_empty(),
            located,
        });
        let declared = system.prepare(machine)?;
        system.tell_forestalled(machine, &plan.steps.grammar);
        let draws_afresh = system.draws_afresh();
        let asks_places_only = !plan.located.is_empty() && system.asks_places_only();
        Ok(Self {
            axiom,
            plan,
            declared,
            traced,
            place: system.place.clone(),
            caller: system.caller.clone(),
            axiom_place: system.axiom_place.clone(),
            last_only: system.last_only
                || (system.shows_last_only() && !assigns_variables && !session.may_stop()),
            asks_places_only,
            draws_afresh,
            draws: draws_afresh && system.object.is_some(),
            limit: if options.check { 0 } else { limit.unwrap_or(usize::MAX) },
            until: time.unwrap_or(f64::INFINITY),
            group,
            key,
            hooks: system.hooks_by_moment(),
        })
    }
}
