//! Answers that are asked for again with the same words: every machine that runs a script asks all of its questions.

use std::sync::{Arc, Mutex};

use burgeon_base::error::Result;
use burgeon_base::locks::LockRecovery;
use burgeon_base::warning::{Warning, defer_warning};
use burgeon_kit::Value;

/// How many answers are kept at most: those that were asked for last.
const MOST: usize = 32;

/// What an answer depends on, number by number; the first is the network's version.
pub(super) type AnswerKey = Vec<u64>;
/// An answer with what was told of it, once there is one.
type AnswerSlot = Arc<Mutex<Option<(Value, Vec<Warning>)>>>;

/// The answers of a network, by what they depend on.
#[derive(Debug, Default)]
pub(super) struct AnswerCache(Mutex<Vec<(AnswerKey, AnswerSlot)>>);

impl Clone for AnswerCache {
    /// An empty one: the copy may become another network.
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl AnswerCache {
    /// The answer to a question, which one asks while others wait for it; what is to be told of it is [deferred](defer_warning)
    /// each time.
    pub(super) fn once(
        &self,
        key: impl FnOnce() -> AnswerKey,
        find: impl FnOnce() -> Result<(Value, Vec<Warning>)>,
    ) -> Result<Value> {
        // A thread of the pool that waits might have to finish, meanwhile, what it waits for.
        if rayon::current_thread_index().is_some() {
            return find().map(tell);
        }
        let key = key();
        let slot = {
            let mut known = self.0.lock().recover();
            match known.iter().find(|(other, _)| *other == key) {
                Some((_, slot)) => Arc::clone(slot),
                None => {
                    // Nobody asks for what an earlier network would have answered.
                    known.retain(|(other, _)| other.first() == key.first());
                    let surplus = (known.len() + 1).saturating_sub(MOST);
                    known.drain(..surplus);
                    let slot = AnswerSlot::default();
                    known.push((key, Arc::clone(&slot)));
                    slot
                }
            }
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
