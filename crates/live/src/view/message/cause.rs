//! Causes of runs.

use serde::Serialize;

/// Cause of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Cause {
    /// Start of the server.
    Start,
    /// Change of a file.
    Save,
    /// Change of a parameter.
    Parameters,
    /// Change of the seed.
    Seed,
    /// Change of the step limit.
    Steps,
    /// Loading of a preset.
    Preset,
}
