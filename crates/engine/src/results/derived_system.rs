//! A system that has been derived.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::Duration;

use super::records::SourceFeatures;
use super::remark::Remark;
use super::row_features::RowFeatures;
use super::trace::RuleName;
use burgeon_base::error::{Result, SourcePlace};
use burgeon_base::warning::Warning;
use burgeon_data::output::RecordTable;
use burgeon_kit::Values;
use burgeon_kit::{Model, Object};
use burgeon_rewriting::{Chain, Symbol, Symbols, Use, chain_text, write_chains};
use burgeon_scene::{CityClass, Origin, Scene};

/// Where the time of a derivation went.
#[derive(Debug, Clone, Copy, Default)]
pub struct Times {
    /// Finding and applying rules.
    pub rewriting: Duration,
    /// Symbols that all steps together have read: the length of the chains before each step.
    pub read: usize,
    /// Interpretation passes.
    pub interpretation: Duration,
}

/// What a rule has done in a derivation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RuleReport {
    /// The rule.
    pub name: RuleName,
    /// Whether it is an interpretation rule.
    pub interprets: bool,
    /// How much it has done. The time of interpretation rules is measured if
    /// [`RunReports::profile`](crate::script::RunReports::profile) says so.
    pub done: Use,
}

/// The chains and objects that a system ended with.
pub struct DerivedSystem {
    /// The system's place in the script, from 0.
    pub system: usize,
    /// The chains.
    pub chain: Arc<Chain>,
    /// The chains that are left out, since their data is at fault, in order.
    pub(crate) left_out: Arc<[usize]>,
    /// The declared modules.
    pub symbols: Arc<Symbols>,
    /// The parameters that are not numbers.
    pub values: Arc<Values>,
    /// The object of each chain; none if the system has no objects. After a run they have given away what
    /// they had drawn to the run's scene.
    pub objects: Vec<Arc<dyn Object>>,
    /// The id of each chain's feature.
    pub features: Vec<Option<String>>,
    /// The number of derivation steps.
    pub steps: usize,
    /// Where the time went.
    pub times: Times,
    /// What the rules and the interpretation rules have done, in the order of their declaration.
    pub rules: Vec<RuleReport>,
    /// Where the system was made.
    pub place: Option<SourcePlace>,
    /// The line of the script that led there.
    pub caller: Option<SourcePlace>,
    /// The number of features that it was given, those that were left out among them.
    pub given: usize,
    /// What could not be built as asked: features that got no chain, then the chains in their order.
    pub remarks: Vec<Remark>,
    /// What its chains are in a city, if the script says.
    pub city: Option<CityClass>,
    pub(crate) source: SourceFeatures,
    /// The features that its modules came from, if rows of queries were put into its chains.
    pub(crate) rows: Option<RowFeatures>,
    /// Whether it has an object that draws.
    pub(crate) draws: bool,
    /// What its chains hold that nothing draws; it counts unless the script reads the chains.
    pub(crate) undrawn: Vec<(Symbol, Warning)>,
    /// The number of modules in all chains, without brackets.
    pub(crate) modules: usize,
    /// What the script has done with it since.
    pub(crate) uses: SystemUses,
}

/// What a script has done with a derived system.
#[derive(Default)]
pub(crate) struct SystemUses {
    /// Whether it has read the chains.
    read: AtomicBool,
    /// What it places.
    model: OnceLock<Arc<Model>>,
    /// Whether it has placed it.
    placed: AtomicBool,
    /// Whether functions of rules capture it.
    captured: AtomicBool,
    /// Whether the script has read any of its fields.
    inspected: AtomicBool,
}

impl DerivedSystem {
    /// The number of modules in all chains, without brackets.
    pub fn modules(&self) -> usize {
        self.modules
    }

    /// What is known of the features that its chains came from, in the order of the chains; nothing without features.
    /// What a list of the script knows is kept if [`RunReports::records`](crate::script::RunReports::records) says so.
    pub fn records(&self) -> Option<RecordTable> {
        match &self.rows {
            Some(rows) => Some(rows.table(self.system + 1)),
            None => self.source.table(&self.features, self.system + 1),
        }
    }

    /// The chains as text, a line for each.
    pub fn chain_text(&self) -> String {
        chain_text(&self.chain, &self.symbols, &self.values)
    }

    /// The chains as text for the script, which may make of their modules what it likes.
    pub(crate) fn read_chains(&self) -> String {
        self.uses.read.store(true, Ordering::Relaxed);
        self.chain_text()
    }

    /// Whether the script has read its chains.
    pub(crate) fn is_read(&self) -> bool {
        self.uses.read.load(Ordering::Relaxed)
    }

    /// Writes the chains as text, a line for each.
    pub fn write_chains(&self, out: &mut impl std::io::Write) -> std::io::Result<()> {
        write_chains(out, &self.chain, &self.symbols, &self.values)
    }

    /// What its objects have drawn, as one model that another system can place.
    ///
    /// A system that is placed somewhere is not shown by itself.
    pub fn model(&self) -> Result<Arc<dyn Object>> {
        self.uses.placed.store(true, Ordering::Relaxed);
        if let Some(model) = self.uses.model.get() {
            return Ok(Arc::clone(model) as Arc<dyn Object>);
        }
        let mut scene = Scene::default();
        self.add_to(&mut scene)?;
        let model = Arc::clone(self.uses.model.get_or_init(|| Arc::new(Model::new(scene))));
        Ok(model as Arc<dyn Object>)
    }

    /// What others place of it, once one has asked for it.
    pub(crate) fn placed_model(&self) -> Option<&Model> {
        self.uses.model.get().map(Arc::as_ref)
    }

    /// Whether another system places it: it has done so, or a function of its rules holds this system only to place it, be it
    /// never.
    pub fn is_placed(&self) -> bool {
        let is = |use_of_it: &AtomicBool| use_of_it.load(Ordering::Relaxed);
        is(&self.uses.placed) || is(&self.uses.captured) && !is(&self.uses.inspected)
    }

    /// Reports whether another system has placed it.
    pub(crate) fn has_been_placed(&self) -> bool {
        self.uses.placed.load(Ordering::Relaxed)
    }

    /// Notes that a function of a rule can reach it.
    pub(crate) fn note_captured(&self) {
        self.uses.captured.store(true, Ordering::Relaxed);
    }

    /// Notes that the script reads a field of it.
    pub(crate) fn note_inspected(&self) {
        self.uses.inspected.store(true, Ordering::Relaxed);
    }

    /// As [`DerivedSystem::add_to`], but the objects that nobody else holds give away what they have drawn.
    pub(crate) fn hand_over(&mut self, scene: &mut Scene) -> Result<()> {
        let name = self.name();
        for (chain, (object, feature)) in self.objects.iter_mut().zip(&self.features).enumerate() {
            let known = (scene.meshes.len(), scene.instances.len());
            match Arc::get_mut(object) {
                Some(object) => object.hand_over(scene, &name, feature.as_deref())?,
                None => object.show(scene, &name, feature.as_deref())?,
            }
            sign(scene, known, Origin { system: self.system, chain, record: Some(chain) });
            if let Some(rows) = &self.rows {
                rows.divide(scene, known.1, chain);
            }
        }
        Ok(())
    }

    fn name(&self) -> String {
        format!("system {}", self.system + 1)
    }

    /// Adds what its objects have drawn to `scene`, in the order of the chains.
    pub fn add_to(&self, scene: &mut Scene) -> Result<()> {
        let name = self.name();
        for (chain, (object, feature)) in self.objects.iter().zip(&self.features).enumerate() {
            let known = (scene.meshes.len(), scene.instances.len());
            object.show(scene, &name, feature.as_deref())?;
            sign(scene, known, Origin { system: self.system, chain, record: Some(chain) });
            if let Some(rows) = &self.rows {
                rows.divide(scene, known.1, chain);
            }
        }
        Ok(())
    }
}

/// Notes the origin of the meshes and instances that `scene` has got since it had as many as `known`.
fn sign(scene: &mut Scene, known: (usize, usize), origin: Origin) {
    for mesh in &mut scene.meshes[known.0..] {
        // A mesh that was placed keeps its own.
        mesh.origin.get_or_insert(origin);
    }
    for instance in &mut scene.instances[known.1..] {
        instance.origin = Some(origin);
    }
}
