//! Positions in the random stream of a script's top level.

use std::collections::BTreeMap;
use std::sync::Mutex;

use burgeon_base::locks::LockRecovery;
use burgeon_base::random::Stream;

/// Random stream of the top level after the axiom of each derivation, by the number of the derivation. A
/// machine that does not run the axiom's function continues from this position.
#[derive(Debug, Default)]
pub(crate) struct RandomPositions(Mutex<BTreeMap<usize, Stream>>);

impl RandomPositions {
    /// Records the stream after the axiom of derivation `number`.
    pub(crate) fn note(&self, number: usize, stream: &Stream) {
        self.0.lock().recover().insert(number, stream.clone());
    }

    /// Returns the stream after the axiom of derivation `number`, if that axiom has drawn random numbers.
    pub(crate) fn after(&self, number: usize) -> Option<Stream> {
        self.0.lock().recover().get(&number).cloned()
    }
}
