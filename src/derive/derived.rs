//! A system that has been derived.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::Duration;

use crate::error::Result;
use crate::objects::{Model, Object};
use crate::rules::{Chain, Symbols, Values, chain_text, write_chains};
use crate::scene::Scene;

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

/// The chains and objects that a system ended with.
pub struct Derived {
    /// The system's place in the script, from 0.
    pub system: usize,
    /// The chains.
    pub chain: Chain,
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
    modules: usize,
    model: OnceLock<Arc<Model>>,
    placed: AtomicBool,
}

impl Derived {
    #[allow(clippy::too_many_arguments, reason = "called once, with everything that a derivation knows")]
    pub(crate) fn new(
        system: usize,
        chain: Chain,
        symbols: Arc<Symbols>,
        values: Arc<Values>,
        objects: Vec<Arc<dyn Object>>,
        features: Vec<Option<String>>,
        steps: usize,
        times: Times,
    ) -> Self {
        let modules = chain.modules();
        Self {
            system,
            chain,
            symbols,
            values,
            objects,
            features,
            steps,
            times,
            modules,
            model: OnceLock::new(),
            placed: AtomicBool::new(false),
        }
    }

    /// The number of modules in all chains, without brackets.
    pub fn modules(&self) -> usize {
        self.modules
    }

    /// The chains as text, a line for each.
    pub fn chain_text(&self) -> String {
        chain_text(&self.chain, &self.symbols, &self.values)
    }

    /// Writes the chains as text, a line for each.
    pub fn write_chains(&self, out: &mut impl std::io::Write) -> std::io::Result<()> {
        write_chains(out, &self.chain, &self.symbols, &self.values)
    }

    /// What its objects have drawn, as one model that another system can place.
    ///
    /// A system that is placed somewhere is not shown by itself.
    pub fn model(&self) -> Result<Arc<dyn Object>> {
        self.placed.store(true, Ordering::Relaxed);
        if let Some(model) = self.model.get() {
            return Ok(Arc::clone(model) as Arc<dyn Object>);
        }
        let mut scene = Scene::default();
        self.add_to(&mut scene)?;
        let model = Arc::clone(self.model.get_or_init(|| Arc::new(Model::new(scene))));
        Ok(model as Arc<dyn Object>)
    }

    /// Whether another system has placed it.
    pub fn is_placed(&self) -> bool {
        self.placed.load(Ordering::Relaxed)
    }

    /// As [`Derived::add_to`], but the objects that nobody else holds give away what they have drawn.
    pub(crate) fn hand_over(&mut self, scene: &mut Scene) -> Result<()> {
        let name = self.name();
        for (object, feature) in self.objects.iter_mut().zip(&self.features) {
            match Arc::get_mut(object) {
                Some(object) => object.hand_over(scene, &name, feature.as_deref())?,
                None => object.show(scene, &name, feature.as_deref())?,
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
        for (object, feature) in self.objects.iter().zip(&self.features) {
            object.show(scene, &name, feature.as_deref())?;
        }
        Ok(())
    }
}
