//! Functions of rules, which are run for batches of modules.

use crate::key::ModuleKey;
use crate::successors::Successors;
use crate::text::{PlainNumbers, ShowParameters};
use burgeon_base::error::{Error, Result};

/// Modules that one rule is applied to in one call.
#[derive(Debug)]
pub struct Applications<'a> {
    /// Number of the rule in the [`Grammar`](crate::Grammar).
    pub rule: u16,
    /// Number of applications.
    pub count: usize,
    /// Arguments of all applications, one application after the other.
    pub arguments: &'a [f64],
    /// Chain of each application; empty if there is only one chain.
    pub chains: &'a [u32],
    /// Random key of each application; empty if no rule draws random numbers.
    pub keys: &'a [ModuleKey],
    /// Place of each application in the chain; empty unless [`StepPlan::notes_places`](crate::StepPlan::notes_places).
    pub places: &'a [u32],
    /// Set if the choice among weighted rules has taken the first number of each stream.
    pub weighted: bool,
}

/// Failure of a function.
#[derive(Debug)]
pub struct RuleFailure {
    /// Application that failed.
    pub at: usize,
    /// Reason.
    pub error: Error,
}

impl From<Error> for RuleFailure {
    fn from(error: Error) -> Self {
        Self { at: 0, error }
    }
}

/// Runs the successors and guards of the rules of a system, in one thread.
///
/// Virtual machines and [closures](crate::ClosureSystem) are two implementations. The grammar says which rule is applied to which
/// module; an implementation only runs functions, and never sees the chain.
pub trait Rules {
    /// Runs the successor of a rule for each application, in order, and adds what it makes to `successors`.
    fn apply(&self, applications: &Applications<'_>, successors: &mut Successors) -> Result<(), RuleFailure>;

    /// Runs the guard of a rule for each application, in order, and adds a number for each to `holds`: 0 if the guard does not
    /// hold. After a failure `holds` has the numbers of the applications before it.
    fn guard(&self, applications: &Applications<'_>, holds: &mut Vec<u32>) -> Result<(), RuleFailure>;

    /// Returns how errors show the parameters of a module.
    fn parameters(&self) -> &dyn ShowParameters {
        &PlainNumbers
    }
}
