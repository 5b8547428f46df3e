//! Results of the derivation of one system.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::Duration;

use super::records::{SourceFeatures, drop_indices};
use super::report_sums::ReportTable;
use super::row_features::RowFeatures;
use super::trace::RuleName;
use super::variables::VariableValues;
use burgeon_base::error::{Result, SourcePlace};
use burgeon_base::warning::Warning;
use burgeon_kit::Values;
use burgeon_kit::{Model, Object};
use burgeon_rewriting::{Chain, Symbol, Symbols, Use, chain_text, write_chains};
use burgeon_scene::{CityClass, Origin, Scene};
use burgeon_spatial::RecordTable;

/// Time spent on a derivation.
#[derive(Debug, Clone, Copy, Default)]
pub struct Times {
    /// Time for finding and applying rules.
    pub rewriting: Duration,
    /// Number of symbols read by all steps: the sum of the chain lengths before each step.
    pub read: usize,
    /// Time for interpretation passes.
    pub interpretation: Duration,
}

/// Statistics of one rule in a derivation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RuleReport {
    /// Name and location of the rule.
    pub name: RuleName,
    /// Set for an interpretation rule.
    pub interprets: bool,
    /// Number of matches and applications, and time. The time of interpretation rules is measured only if
    /// [`RunReports::profile`](crate::script::RunReports::profile) is set.
    pub done: Use,
}

/// Chains and objects at the end of a system's derivation.
pub struct DerivedSystem {
    /// Index of the system in the script, from 0.
    pub system: usize,
    /// Final chains.
    pub chain: Arc<Chain>,
    /// Indices of the chains that were skipped because of faulty data, ascending.
    pub(crate) left_out: Arc<[usize]>,
    /// All chains with the indices of the skipped ones, if some were built only for others near them.
    pub(crate) context: Option<(Arc<Chain>, Arc<[usize]>)>,
    /// Declared modules.
    pub symbols: Arc<Symbols>,
    /// Parameter values other than numbers.
    pub values: Arc<Values>,
    /// Object of each chain; empty if the system has no objects. After a run, the objects have moved their
    /// drawings to the scene of the run.
    pub objects: Vec<Arc<dyn Object>>,
    /// Feature id of each chain.
    pub features: Vec<Option<String>>,
    /// Number of derivation steps.
    pub steps: usize,
    /// Time of the last event; of several chains, the latest. 0 without rules with propensities.
    pub time: f64,
    /// Time spent on the derivation.
    pub times: Times,
    /// Statistics of the rules and interpretation rules, in the order of declaration.
    pub rules: Vec<RuleReport>,
    /// Location where the system was created.
    pub place: Option<SourcePlace>,
    /// Line of the script from which that location was called.
    pub caller: Option<SourcePlace>,
    /// Number of input features, including skipped features.
    pub given: usize,
    /// Warnings about skipped and simplified features: first the features without a chain, then the chains in order.
    pub feature_warnings: Vec<Warning>,
    /// Class of the chains as CityJSON objects, if the script sets one.
    pub city: Option<CityClass>,
    pub(crate) source: SourceFeatures,
    /// Features of the rows that queries put into the chains, and the modules that came from each row.
    pub(crate) rows: Option<RowFeatures>,
    /// Set if the system has an object that draws.
    pub(crate) draws: bool,
    /// Warnings about symbols of the final chains that nothing draws; ignored if the script reads the chains.
    pub(crate) undrawn: Vec<(Symbol, Warning)>,
    /// Set if the script gives the system a seed of its own.
    pub has_own_seed: bool,
    /// Set if the module `Cut` erased branches.
    pub(crate) has_cut: bool,
    /// Number of modules in all chains, without brackets.
    pub(crate) modules: usize,
    /// Variables of the system after the last step.
    pub(crate) variables: Option<VariableValues>,
    /// Sums that the last interpretation pass reported, without those of skipped chains.
    pub(crate) reported: ReportTable,
    /// Later uses of the system by the script.
    pub(crate) uses: SystemUses,
}

/// Uses of a derived system by the script.
#[derive(Default)]
pub(crate) struct SystemUses {
    /// Set once the script has read the chains.
    read: AtomicBool,
    /// Model for placing the system, built at the first use.
    model: OnceLock<Arc<Model>>,
    /// Set once the system has been placed.
    placed: AtomicBool,
    /// Set if functions of rules capture the system.
    captured: AtomicBool,
    /// Set once a function of a rule has read a field of the system.
    read_by_rule: AtomicBool,
}

impl DerivedSystem {
    /// Returns `warning` with the location where the system was created, and the line that called it.
    pub fn locate(&self, warning: Warning) -> Warning {
        warning.at_place(self.place.as_ref()).called_from(self.caller.as_ref())
    }

    /// Returns the number of modules in all chains, without brackets.
    pub fn modules(&self) -> usize {
        self.modules
    }

    /// Returns the number of modules of each declared name in all chains.
    pub(crate) fn counts(&self) -> Vec<(&str, usize)> {
        self.uses.read.store(true, Ordering::Relaxed);
        self.symbols.counts(&self.chain)
    }

    /// Drops the chains at the indices `chains`, which are ascending. Queries still see them.
    pub(crate) fn drop_chains(&mut self, chains: &[usize]) {
        if chains.is_empty() {
            return;
        }
        let kept = self.chain.without_chains(chains, &self.symbols.arities());
        let place = |chain: &usize| chain - chains.partition_point(|dropped| dropped < chain);
        let left_out = self.left_out.iter().filter(|chain| chains.binary_search(chain).is_err());
        let left_out = left_out.map(place).collect();
        let whole = std::mem::replace(&mut self.chain, Arc::new(kept));
        self.context = Some((whole, std::mem::replace(&mut self.left_out, left_out)));
        let dropped: Vec<Option<&str>> =
            chains.iter().filter_map(|chain| Some(self.features.get(*chain)?.as_deref())).collect();
        self.feature_warnings
            .retain(|warning| warning.feature().is_none() || !dropped.contains(&warning.feature()));
        drop_indices(&mut self.objects, chains);
        drop_indices(&mut self.features, chains);
        self.reported.drop_chains(chains);
        self.source.drop_chains(chains);
        if let Some(rows) = &mut self.rows {
            rows.drop_chains(chains);
        }
        self.modules = self.chain.modules();
    }

    /// Returns all chains for queries, and the indices of the skipped ones.
    pub(crate) fn queried_chains(&self) -> (&Arc<Chain>, &Arc<[usize]>) {
        match &self.context {
            Some((chain, left_out)) => (chain, left_out),
            None => (&self.chain, &self.left_out),
        }
    }

    /// Returns true if no chain came from a feature.
    pub(crate) fn is_featureless(&self) -> bool {
        self.features.iter().all(Option::is_none)
    }

    /// Returns the attributes of the chains' features as a table, in the order of the chains; `None` without
    /// features.
    ///
    /// Attributes of a list from the script are kept only if
    /// [`RunReports::records`](crate::script::RunReports::records) is set.
    pub fn records(&self) -> Option<RecordTable> {
        match &self.rows {
            Some(rows) => Some(rows.table(self.system + 1)),
            None => self.source.table(&self.features, self.system + 1),
        }
    }

    /// Returns the chains as text, one line per chain.
    pub fn chain_text(&self) -> String {
        chain_text(&self.chain, &self.symbols, &self.values)
    }

    /// Returns the chains as text for the script, and marks the chains as read: the script may use any of
    /// their modules.
    pub(crate) fn read_chains(&self) -> String {
        self.note_read();
        self.chain_text()
    }

    /// Marks the chains as read: the script may use any of their modules.
    pub(crate) fn note_read(&self) {
        self.uses.read.store(true, Ordering::Relaxed);
    }

    /// Returns true if the script has read the chains.
    pub(crate) fn is_read(&self) -> bool {
        self.uses.read.load(Ordering::Relaxed)
    }

    /// Writes the chains as text, one line per chain.
    pub fn write_chains(&self, out: &mut impl std::io::Write) -> std::io::Result<()> {
        write_chains(out, &self.chain, &self.symbols, &self.values)
    }

    /// Returns the drawings of all objects as one model, which another system can place.
    ///
    /// A placed system is not shown on its own.
    pub fn model(&self) -> Result<Arc<dyn Object>> {
        self.uses.placed.store(true, Ordering::Relaxed);
        let model = match self.uses.model.get() {
            Some(model) => model,
            None => {
                let mut scene = Scene::default();
                self.add_to(&mut scene)?;
                self.uses.model.get_or_init(|| Arc::new(Model::new(scene)))
            }
        };
        Ok(Arc::clone(model) as Arc<dyn Object>)
    }

    /// Returns the model that others place, if it has been requested.
    pub(crate) fn placed_model(&self) -> Option<&Model> {
        self.uses.model.get().map(Arc::as_ref)
    }

    /// Returns true if another system places this one, or if a function of a rule captures it and reads none of its fields.
    ///
    /// A captured system counts as placed even if the function never places it.
    pub fn is_placed(&self) -> bool {
        let is = |use_of_it: &AtomicBool| use_of_it.load(Ordering::Relaxed);
        is(&self.uses.placed) || is(&self.uses.captured) && !is(&self.uses.read_by_rule)
    }

    /// Records that another system continues the derivation, so that this one is not shown on its own.
    pub(crate) fn note_continued(&self) {
        self.uses.placed.store(true, Ordering::Relaxed);
    }

    /// Reports whether another system has placed it.
    pub(crate) fn has_been_placed(&self) -> bool {
        self.uses.placed.load(Ordering::Relaxed)
    }

    /// Records that a function of a rule can reach the system.
    pub(crate) fn note_captured(&self) {
        self.uses.captured.store(true, Ordering::Relaxed);
    }

    /// Records that a field of the system is read, if a rule reads it.
    pub(crate) fn note_read_by_rule(&self, is_rule: impl FnOnce() -> bool) {
        if !self.uses.read_by_rule.load(Ordering::Relaxed) && is_rule() {
            self.uses.read_by_rule.store(true, Ordering::Relaxed);
        }
    }

    /// Adds the drawings to `scene` as [`DerivedSystem::add_to`] does, but moves the drawings of objects
    /// without other references.
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

    /// Adds the drawings of the objects to `scene`, in the order of the chains.
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

/// Sets the origin of the meshes and instances that were added to `scene` after the counts in `known`.
fn sign(scene: &mut Scene, known: (usize, usize), origin: Origin) {
    for mesh in &mut scene.meshes[known.0..] {
        // A placed mesh keeps its origin.
        mesh.origin.get_or_insert(origin);
    }
    for instance in &mut scene.instances[known.1..] {
        instance.origin = Some(origin);
    }
}
