//! Runs to execute, with their requests and options.

use std::sync::Arc;

use super::console::Console;
use super::request::{Inputs, Request};
use super::state::{DueRun, ServerState};
use burgeon_engine::script::{ParamValues, RunOptions, RunReports};

/// Maximum number of problems or warnings of a run that pages receive.
pub(super) const PROBLEMS: usize = 50;

/// Run to execute.
pub(super) struct RunJob {
    pub run: u64,
    pub due: DueRun,
    pub request: Request,
    pub inputs: Inputs,
    /// Texts that the run prints.
    pub console: Arc<Console>,
}

/// Returns the options to run the script with these inputs.
pub(super) fn options(state: &ServerState, inputs: &Inputs) -> RunOptions {
    let base = state.options.clone();
    RunOptions {
        params: ParamValues { set: inputs.set.clone(), forgiving: true, ..base.params },
        seed: inputs.seed,
        steps: inputs.steps,
        reports: RunReports { profile: true, ..base.reports },
        ..base
    }
}
