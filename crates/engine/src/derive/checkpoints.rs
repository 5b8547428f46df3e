//! Writes checkpoints of a derivation, and finds the checkpoint from which it continues.

use std::fmt::Write as _;
use std::sync::Arc;

use super::plan::Derivation;
use crate::checkpoints::{Checkpoint, DerivationStore};
use crate::declare::Session;
use crate::results::DerivedSystem;
use burgeon_base::warning::Warning;
use burgeon_rewriting::{Chain, Use};

/// Maximum number of symbols of a chain that is stored between steps. Storing a chain prevents the reuse of its memory,
/// which costs time if the chain is long.
const LONGEST: usize = 1 << 20;

/// Stores the chains of one derivation.
pub(super) struct CheckpointWriter {
    store: Arc<DerivationStore>,
    inputs: String,
    /// State of the run before the derivation.
    prints: usize,
    warnings: Vec<Warning>,
    notes: Vec<String>,
    /// Warnings and report entries of the steps before the checkpoint from which the derivation continues.
    earlier: (Vec<Warning>, Vec<String>),
    /// Set once a chain could not be stored, so that later chains are not stored either.
    ended: bool,
}

impl CheckpointWriter {
    /// Returns the writer for a derivation; `None` if it cannot be continued. `derived` are the systems that were
    /// derived before.
    pub(super) fn new(
        session: &Session,
        derivation: &Derivation,
        derived: &[Arc<DerivedSystem>],
    ) -> Option<Self> {
        let options = &session.options;
        let store = Arc::clone(options.inputs.derivations.as_ref()?);
        let asks_others = options.inputs.rows.is_some() || !options.inputs.databases.is_empty();
        let objects = derivation.plan.objects.as_ref();
        let expands = objects.is_some_and(|objects| objects.read(0, |it| Ok(it.expands())).unwrap_or(true));
        let continues = !expands && (derivation.last_only || derivation.draws_afresh);
        if options.check
            || options.reports.records
            || derivation.traced.is_some()
            || asks_others
            || !continues
            // Their state between steps is not stored.
            || !derivation.hooks.is_empty()
            || derivation.plan.variables().is_some()
            || derivation.plan.environments.is_some()
            || derivation.plan.has_events()
            || session.may_stop()
        {
            return None;
        }
        Some(Self {
            store,
            inputs: inputs(session, derivation, derived)?,
            prints: session.prints(),
            warnings: session.warnings(),
            notes: session.notes(),
            earlier: Default::default(),
            ended: false,
        })
    }

    /// Returns the checkpoint from which the derivation continues, and its step, and reports its warnings.
    pub(super) fn begin(&mut self, session: &Session, limit: usize) -> Option<(usize, Arc<Checkpoint>)> {
        let (step, checkpoint) = self.store.find(&self.inputs, limit)?;
        checkpoint.warnings.iter().for_each(|warning| session.warn(warning.clone()));
        checkpoint.notes.iter().for_each(|note| session.add_note(note.clone()));
        self.earlier = (checkpoint.warnings.clone(), checkpoint.notes.clone());
        self.warnings = session.warnings();
        self.notes = session.notes();
        Some((step, checkpoint))
    }

    /// Stores the chain after `step`, unless it is long and later steps follow. Later chains are not stored if this one
    /// cannot be.
    pub(super) fn store(
        &mut self,
        session: &Session,
        step: usize,
        chain: &Arc<Chain>,
        (failed, is_last): (bool, bool),
        (rules, interpretations): (&[Use], &[Use]),
    ) {
        self.ended |= failed || session.prints() != self.prints;
        if self.ended || (chain.symbols.len() > LONGEST && !is_last) {
            return;
        }
        let mut warnings = self.earlier.0.clone();
        let is_new = |warning: &Warning| !self.warnings.iter().any(|known| known.says_the_same(warning));
        warnings.extend(session.warnings().into_iter().filter(is_new));
        let mut notes = self.earlier.1.clone();
        notes.extend(session.notes().into_iter().filter(|note| !self.notes.contains(note)));
        let Some(checkpoint) =
            Checkpoint::new(chain, &session.values, (rules, interpretations), (warnings, notes))
        else {
            self.ended = true;
            return;
        };
        self.store.insert(&self.inputs, step, checkpoint);
    }
}

/// Describes everything that determines the chains of a derivation, except for the number of steps; `None` if not all is
/// known.
fn inputs(session: &Session, derivation: &Derivation, derived: &[Arc<DerivedSystem>]) -> Option<String> {
    let mut text = format!("system {} {:?}\n", derivation.plan.system, derivation.group);
    let options = &session.options;
    let _ = writeln!(text, "{:?} {:?}", session.script(), options.registry);
    let _ = writeln!(text, "{} {} {:?} {:?}", options.seed, options.lod, options.part, options.choice);
    // A function that reads the number of the step fails in a derivation without a given number of steps.
    if session.reads_step() {
        let _ = writeln!(text, "{}", derivation.plan.bounded);
    }
    for param in session.params() {
        let _ = writeln!(text, "{param:?}");
    }
    // The script may use the result of a system in the next, which then depends on its number of steps.
    for system in derived {
        let _ = writeln!(text, "after system {} {}", system.system, system.steps);
    }
    text += &session.stamps()?;
    Some(text)
}
