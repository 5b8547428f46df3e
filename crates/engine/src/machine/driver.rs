//! What a machine asks of whoever drives it.

use std::sync::Arc;

use super::Machine;
use crate::results::DerivedSystem;
use burgeon_base::error::Result;
use burgeon_kit::Prefetch;

/// Derives the systems that a machine's script declares, and has other threads help.
pub(crate) trait Driver {
    /// Derives system `index` of the machine's script by at most `steps` steps, or to the end.
    fn derive(&self, machine: &Machine, index: usize, steps: Option<usize>) -> Result<Arc<DerivedSystem>>;

    /// What each derivation has given so far, in order.
    fn derived(&self) -> Vec<Result<Arc<DerivedSystem>>>;

    /// How many derivations there have been.
    fn count(&self) -> usize;

    /// Whether the machine is the one whose result counts; the others run the same script to help it.
    fn leads(&self) -> bool;

    /// Has a thread that helps prepare what will be asked for, if there is one.
    fn prefetch(&self, machine: &Machine, prefetch: &Arc<dyn Prefetch>) -> Result<()>;
}
