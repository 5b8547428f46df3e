//! Checkpoints: chains of earlier runs, from which later runs with the same inputs continue.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use rustc_hash::FxHashMap;

use burgeon_base::locks::LockRecovery;
use burgeon_base::warning::Warning;
use burgeon_kit::{ObjectContent, TableKey, Value, Values};
use burgeon_rewriting::{Chain, ColumnValue, ModuleKey, Symbol, Use};

/// Memory limit (bytes) of a store.
const LIMIT: usize = 256 << 20;

/// Maximum number of derivations in a store.
const MOST: usize = 64;

/// Chains of earlier derivations, by the inputs and the step after which they were stored.
///
/// A run continues from the last stored chain that its number of steps allows. The result is the same as without the
/// store. Only derivations are continued whose objects begin each pass empty, and whose rules neither print nor ask a
/// server.
#[derive(Default)]
pub struct DerivationStore {
    content: Mutex<StoreContent>,
}

/// Derivations of a store; the derivation that was stored last comes last.
#[derive(Default)]
struct StoreContent {
    derivations: Vec<StoredDerivation>,
    /// Memory of all derivations (bytes).
    size: usize,
}

/// Chains of a system's derivation.
struct StoredDerivation {
    inputs: String,
    checkpoints: BTreeMap<usize, Arc<Checkpoint>>,
}

impl StoredDerivation {
    fn size(&self) -> usize {
        self.inputs.len() + self.checkpoints.values().map(|checkpoint| checkpoint.size).sum::<usize>()
    }
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
        let content = self.content.lock().recover();
        let derivation = content.derivations.iter().find(|derivation| derivation.inputs == inputs)?;
        let (step, checkpoint) = derivation.checkpoints.range(..=limit).next_back()?;
        Some((*step, Arc::clone(checkpoint)))
    }

    /// Stores a checkpoint, and drops the oldest derivations while there are too many or the store is too large.
    pub(crate) fn insert(&self, inputs: &str, step: usize, checkpoint: Checkpoint) {
        let mut content = self.content.lock().recover();
        let StoreContent { derivations, size } = &mut *content;
        let mut derivation = match derivations.iter().position(|derivation| derivation.inputs == inputs) {
            Some(index) => derivations.remove(index),
            None => {
                *size += inputs.len();
                StoredDerivation { inputs: inputs.to_owned(), checkpoints: BTreeMap::new() }
            }
        };
        *size += checkpoint.size;
        if let Some(earlier) = derivation.checkpoints.insert(step, Arc::new(checkpoint)) {
            *size -= earlier.size;
        }
        derivations.push(derivation);
        while derivations.len() > 1 && (*size > LIMIT || derivations.len() > MOST) {
            *size -= derivations.remove(0).size();
        }
        if let Some(derivation) = derivations.first_mut() {
            while *size > LIMIT
                && let Some((_, earliest)) = derivation.checkpoints.pop_first()
            {
                *size -= earliest.size;
            }
        }
    }

    /// Returns the number of stored checkpoints.
    pub fn len(&self) -> usize {
        let content = self.content.lock().recover();
        content.derivations.iter().map(|derivation| derivation.checkpoints.len()).sum()
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
        let columns = chain.symbols.len() * size_of::<Symbol>()
            + chain.keys.len() * size_of::<ModuleKey>()
            + chain.params.len() * size_of::<f64>();
        let texts = warnings.iter().map(|warning| warning.message().len()).sum::<usize>()
            + notes.iter().map(String::len).sum::<usize>();
        let uses = (rules.len() + interpretations.len()) * size_of::<Use>();
        Some(Self {
            chain: Arc::clone(chain),
            size: columns + texts + uses + values.values().map(memory_of).sum::<usize>(),
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

/// Returns the approximate memory of a value (bytes).
fn memory_of(value: &Value) -> usize {
    let content = match value {
        Value::Text(text) => text.len(),
        Value::Table(table) => {
            table.entries.iter().map(|(_, value)| size_of::<TableKey>() + memory_of(value)).sum()
        }
        Value::Object(object) => {
            object.capability::<dyn ObjectContent>().map_or(0, |content| content.memory())
        }
        _ => 0,
    };
    size_of::<Value>() + content
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checkpoint(text: usize) -> Checkpoint {
        let values = Values::default();
        let chain = Chain {
            symbols: vec![3, burgeon_rewriting::END],
            params: vec![values.pack(Value::Text("x".repeat(text).into()))],
            ..Chain::default()
        };
        let created = Checkpoint::new(&Arc::new(chain), &values, (&[], &[]), (Vec::new(), Vec::new()));
        created.expect("texts mean the same in every run")
    }

    #[test]
    fn long_texts_count_and_the_oldest_derivations_are_dropped() {
        let store = DerivationStore::default();
        for number in 0..3 * MOST {
            store.insert(&format!("inputs {number}"), 1, checkpoint(10));
        }
        assert_eq!(store.len(), MOST);
        assert!(
            store.find("inputs 0", 9).is_none()
                && store.find(&format!("inputs {}", 3 * MOST - 1), 9).is_some()
        );
        // Each checkpoint takes a quarter of the limit.
        for step in 1..10 {
            store.insert("long", step, checkpoint(LIMIT / 4));
        }
        assert_eq!(store.len(), 3);
        assert_eq!(store.find("long", 20).map(|(step, _)| step), Some(9));
        assert!(store.find("long", 6).is_none());
        let content = store.content.lock().recover();
        assert_eq!(content.size, content.derivations.iter().map(StoredDerivation::size).sum::<usize>());
    }
}
