//! Files that a plan names.

use serde::{Deserialize, Serialize};

/// File on which all tiles depend.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct PlannedFile {
    /// Path, relative to the folder of the plan.
    pub path: String,
    /// Hash of the content; empty for a file that a script looked for and that must not exist.
    pub hash: String,
}
