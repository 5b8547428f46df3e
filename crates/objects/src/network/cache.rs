//! A cache of results: each VM of a run executes the whole script, and therefore requests the same results.

use std::sync::{Arc, Mutex};

use burgeon_base::error::Result;
use burgeon_base::locks::LockRecovery;
use burgeon_base::warning::{Warning, defer_warning};
use burgeon_kit::Value;

/// Maximum number of cached results; the most recent are kept.
const MOST: usize = 32;

/// The values that a result depends on, as numbers; the first is the network's version.
pub(super) type AnswerKey = Vec<u64>;
/// A result with its warnings, once it is computed.
type AnswerSlot = Arc<Mutex<Option<(Value, Vec<Warning>)>>>;

/// The results of a network, by the values that they depend on.
#[derive(Debug, Default)]
pub(super) struct AnswerCache(Mutex<Vec<(AnswerKey, AnswerSlot)>>);

impl Clone for AnswerCache {
    /// Returns an empty cache, because the copy may become a different network.
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl AnswerCache {
    /// Returns the cached result of `key`, or computes it while other threads wait for it. Each call
    /// [defers](defer_warning) the warnings of the result.
    pub(super) fn once(
        &self,
        key: impl FnOnce() -> AnswerKey,
        find: impl FnOnce() -> Result<(Value, Vec<Warning>)>,
    ) -> Result<Value> {
        // A waiting thread of the pool might have to run the task that it waits for, which would deadlock.
        if rayon::current_thread_index().is_some() {
            return find().map(tell);
        }
        let key = key();
        let slot = {
            let mut known = self.0.lock().recover();
            let index = match known.iter().position(|(other, _)| *other == key) {
                Some(index) => index,
                None => {
                    // Results of an earlier version of the network are no longer needed.
                    known.retain(|(other, _)| other.first() == key.first());
                    let surplus = (known.len() + 1).saturating_sub(MOST);
                    known.drain(..surplus);
                    known.push((key, AnswerSlot::default()));
                    known.len() - 1
                }
            };
            Arc::clone(&known[index].1)
        };
        let mut slot = slot.lock().recover();
        let found = match slot.take() {
            Some(found) => found,
            None => find()?,
        };
        *slot = Some(found.clone());
        Ok(tell(found))
    }
}

fn tell((answer, told): (Value, Vec<Warning>)) -> Value {
    told.into_iter().for_each(defer_warning);
    answer
}
