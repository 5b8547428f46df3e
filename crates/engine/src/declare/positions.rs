//! How far the top level of a script has got with its random numbers.

use std::collections::BTreeMap;
use std::sync::Mutex;

use burgeon_base::locks::LockRecovery;
use burgeon_base::random::Stream;

/// The stream of the top level after the axiom of each derivation, in their order: a machine that does not run an
/// axiom's function itself goes on from there.
#[derive(Debug, Default)]
pub(crate) struct RandomPositions(Mutex<BTreeMap<usize, Stream>>);

impl RandomPositions {
    /// Notes the stream after the axiom of derivation `number`.
    pub(crate) fn note(&self, number: usize, stream: &Stream) {
        self.0.lock().recover().insert(number, stream.clone());
    }

    /// The stream after the axiom of derivation `number`, if that has drawn from it.
    pub(crate) fn after(&self, number: usize) -> Option<Stream> {
        self.0.lock().recover().get(&number).cloned()
    }
}
