//! Checkpoints: chains of earlier runs, from which later runs with the same inputs continue.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use rustc_hash::FxHashMap;

use burgeon_base::locks::LockRecovery;
use burgeon_base::warning::Warning;
use burgeon_kit::{ObjectContent, Value, Values};
use burgeon_rewriting::{Chain, ColumnValue, Use};

/// Memory limit (bytes) of a store.
const LIMIT: usize = 256 << 20;

/// Chains of earlier derivations, by the inputs and the step after which they were stored.
///
/// A run continues from the last stored chain that its number of steps allows. The result is the same as without the
/// store. Only derivations are continued whose objects begin each pass empty, and whose rules neither print nor ask a
/// server.
#[derive(Default)]
pub struct DerivationStore {
    stored: Mutex<Vec<StoredDerivation>>,
}

/// Chains of a system's derivation.
struct StoredDerivation {
    inputs: String,
    checkpoints: BTreeMap<usize, Arc<Checkpoint>>,
}

/// State of a derivation after a step, before the interpretation of its chain.
pub(crate) struct Checkpoint {
    chain: Arc<Chain>,
    /// Values that the chain's parameters refer to, by their handles in the run that stored it.
    values: FxHashMap<u32, Value>,
    /// Work of the rules and the interpretation rules up to the step.
    pub rules: Vec<Use>,
    pub interpretations: Vec<Use>,
    /// Warnings and report entries of the steps.
    pub warnings: Vec<Warning>,
    pub notes: Vec<String>,
    size: usize,
}

impl std::fmt::Debug for DerivationStore {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("DerivationStore")
    }
}

impl DerivationStore {
    /// Returns the last checkpoint of a derivation with these inputs after at most `limit` steps, and its step.
    pub(crate) fn find(&self, inputs: &str, limit: usize) -> Option<(usize, Arc<Checkpoint>)> {
        let stored = self.stored.lock().recover();
        let derivation = stored.iter().find(|derivation| derivation.inputs == inputs)?;
        let (step, checkpoint) = derivation.checkpoints.range(..=limit).next_back()?;
        Some((*step, Arc::clone(checkpoint)))
    }

    /// Stores a checkpoint, and drops the checkpoints of the oldest derivations while the store is too large.
    pub(crate) fn insert(&self, inputs: &str, step: usize, checkpoint: Checkpoint) {
        let mut stored = self.stored.lock().recover();
        let index = stored.iter().position(|derivation| derivation.inputs == inputs);
        // The derivation that was stored last comes last.
        let mut derivation = match index {
            Some(index) => stored.remove(index),
            None => StoredDerivation { inputs: inputs.to_owned(), checkpoints: BTreeMap::new() },
        };
        derivation.checkpoints.insert(step, Arc::new(checkpoint));
        stored.push(derivation);
        let size = |stored: &[StoredDerivation]| {
            let checkpoints = stored.iter().flat_map(|derivation| derivation.checkpoints.values());
            checkpoints.map(|checkpoint| checkpoint.size).sum::<usize>()
        };
        while size(&stored) > LIMIT {
            if stored.len() > 1 {
                stored.remove(0);
            } else if stored[0].checkpoints.pop_first().is_none() {
                return;
            }
        }
    }

    /// Returns the number of stored checkpoints.
    pub fn len(&self) -> usize {
        self.stored.lock().recover().iter().map(|derivation| derivation.checkpoints.len()).sum()
    }

    /// Returns true if nothing is stored.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl Checkpoint {
    /// Creates a checkpoint of `chain`, whose parameters refer to `values`; `None` if another run cannot use one of the
    /// values.
    pub(crate) fn new(
        chain: &Arc<Chain>,
        values: &Values,
        (rules, interpretations): (&[Use], &[Use]),
        (warnings, notes): (Vec<Warning>, Vec<String>),
    ) -> Option<Self> {
        let values = values_of(chain, values)?;
        let size = chain.symbols.len() * (size_of::<u16>() + size_of::<u64>()) + chain.params.len() * 8;
        Some(Self {
            chain: Arc::clone(chain),
            size: size + values.len() * 64,
            values,
            rules: rules.to_vec(),
            interpretations: interpretations.to_vec(),
            warnings,
            notes,
        })
    }

    /// Returns the chain with the handles of `values`.
    pub(crate) fn chain(&self, values: &Values) -> Chain {
        let mut chain = (*self.chain).clone();
        if !self.values.is_empty() {
            let handles: FxHashMap<u32, f64> =
                self.values.iter().map(|(handle, value)| (*handle, values.pack(value.clone()))).collect();
            for stored in chain.params.iter_mut().filter(|stored| stored.is_nan()) {
                if let ColumnValue::Handle(handle) = ColumnValue::unpack(*stored)
                    && let Some(packed) = handles.get(&handle)
                {
                    *stored = *packed;
                }
            }
        }
        chain
    }
}

/// Returns the values that a chain refers to, by their handles; `None` if another run cannot use one of them.
fn values_of(chain: &Chain, values: &Values) -> Option<FxHashMap<u32, Value>> {
    let mut found = FxHashMap::default();
    for stored in chain.params.iter().filter(|stored| stored.is_nan()) {
        if let ColumnValue::Handle(handle) = ColumnValue::unpack(*stored)
            && !found.contains_key(&handle)
        {
            let value = values.get(handle)?;
            if !has_content(&value) {
                return None;
            }
            found.insert(handle, value);
        }
    }
    Some(found)
}

/// Returns true if a value means the same in every run. An object without content, such as a derived system, does not.
fn has_content(value: &Value) -> bool {
    match value {
        Value::Object(object) => object.kind().has_capability::<dyn ObjectContent>(),
        Value::Table(table) => table.entries.iter().all(|(_, value)| has_content(value)),
        _ => true,
    }
}
