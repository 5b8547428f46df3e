//! Functions of rules, which are called for batches of modules.

use crate::dependents::{DependentModules, apply_one_by_one};
use crate::step_number::StepNumber;
use crate::successors::Successors;
use crate::text::{PlainNumbers, ShowParameters};
use burgeon_base::ModuleKey;
use burgeon_base::error::{Error, Result};

/// Modules to which one rule is applied in one call.
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
    /// Random key of each application; empty if no rule uses random numbers.
    pub keys: &'a [ModuleKey],
    /// Index of each application's module in the chain; empty unless
    /// [`StepPlan::notes_places`](crate::StepPlan::notes_places) is set.
    pub places: &'a [u32],
    /// Set if the choice among weighted rules has consumed the first number of each stream.
    pub weighted: bool,
    /// Number of the step that is running.
    pub step: &'a StepNumber,
    /// Time of each chain; empty unless an event of a rule with a propensity occurs.
    pub times: &'a [f64],
}

/// Failure of a function.
#[derive(Debug)]
pub struct RuleFailure {
    /// Index of the application that failed.
    pub at: usize,
    /// Reason.
    pub error: Error,
}

impl From<Error> for RuleFailure {
    fn from(error: Error) -> Self {
        Self { at: 0, error }
    }
}

/// Caller of the successors and guards of a system's rules, in one thread.
///
/// Virtual machines and [closures](crate::ClosureSystem) are two implementations. The grammar determines which rule is
/// applied to which module; an implementation only calls functions, and never sees the chain.
pub trait Rules {
    /// Calls the successor of a rule for each application, in order, and adds the resulting modules to `successors`.
    fn apply(&self, applications: &Applications<'_>, successors: &mut Successors) -> Result<(), RuleFailure>;

    /// Calls the guard of a rule for each application, in order, and adds a number for each to `holds`: 0 if the guard
    /// does not hold. After a failure, `holds` contains the numbers of the applications before it.
    fn guard(&self, applications: &Applications<'_>, holds: &mut Vec<u32>) -> Result<(), RuleFailure>;

    /// Calls the propensity of a rule for each application, in order, and adds each result to `propensities`. After a failure,
    /// it contains the results of the applications before it.
    ///
    /// Only called for rules with [`Propensity::Computed`](crate::Propensity::Computed). The default fails.
    fn propensity(
        &self,
        applications: &Applications<'_>,
        propensities: &mut Vec<f64>,
    ) -> Result<(), RuleFailure> {
        let _ = (applications, propensities);
        Err(Error::argument("these rules compute no propensities").help("use constant propensities").into())
    }

    /// Chooses and applies the rules of modules of which each can depend on those before it. For each module, adds its successor
    /// to `successors`, and to `chosen` the number of the rule or [`NO_RULE`](crate::NO_RULE), with an application that keeps
    /// its module.
    ///
    /// After a failure, the last number of `chosen` is that of the rule whose function has failed. Only called if
    /// [`accepts_dependents`](Self::accepts_dependents) returns true. The default calls each function for one module at a time.
    fn apply_dependents(
        &self,
        modules: &DependentModules<'_>,
        successors: &mut Successors,
        chosen: &mut Vec<u32>,
    ) -> Result<(), RuleFailure> {
        apply_one_by_one(self, modules, successors, chosen)
    }

    /// Returns true if the functions can be called in another order than by rules: they have no visible effects. The default
    /// returns true.
    fn accepts_dependents(&self) -> bool {
        true
    }

    /// Returns the formatter of module parameters in errors.
    fn parameters(&self) -> &dyn ShowParameters {
        &PlainNumbers
    }
}
