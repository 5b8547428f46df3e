//! Interface between a machine and its driver.

use std::sync::Arc;

use super::Machine;
use crate::results::DerivedSystem;
use burgeon_base::error::Result;
use burgeon_kit::Prefetch;

/// Request for the derivation of a system.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct DerivationRequest<'a> {
    /// Maximum number of steps; without it, the derivation ends when nothing changes.
    pub steps: Option<usize>,
    /// Group of rules with which the derivation begins; `None` for the rules without a group.
    pub group: Option<&'a str>,
    /// Time at which a derivation by events ends.
    pub time: Option<f64>,
}

/// Driver of a machine: derives the systems of its script with the help of other threads.
pub(crate) trait Driver {
    /// Derives system `index` of the machine's script.
    fn derive(
        &self,
        machine: &Machine,
        index: usize,
        request: DerivationRequest<'_>,
    ) -> Result<Arc<DerivedSystem>>;

    /// Returns the results of the derivations so far, in order.
    fn derived(&self) -> Vec<Result<Arc<DerivedSystem>>>;

    /// Returns the number of derivations so far.
    fn count(&self) -> usize;

    /// Returns true if the result of this machine counts. The other machines run the same script to help it.
    fn leads(&self) -> bool;

    /// Lets a helper thread, if there is one, prepare results that will be requested.
    fn prefetch(&self, machine: &Machine, prefetch: &Arc<dyn Prefetch>) -> Result<()>;
}
