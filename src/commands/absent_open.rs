//! Stub of `burgeon open`, for builds without the live view.

use burgeon::{Error, Result};
use clap::Args;

/// Shows a model live again from its recipe (this program was built without it)
#[derive(Args)]
pub(crate) struct OpenCommand {
    /// Ignored arguments of the command
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
    given: Vec<String>,
}

impl OpenCommand {
    pub(crate) fn json(&self) -> bool {
        self.given.iter().any(|given| given == "--json")
    }

    #[allow(clippy::unused_self, reason = "every command has the same methods")]
    pub(crate) fn run(&self) -> Result<()> {
        Err(Error::left_out("the live page", "live"))
    }
}
