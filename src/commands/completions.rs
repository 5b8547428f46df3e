//! `burgeon completions`: completion of the command line for shells.

use burgeon::Result;
use clap::Args;
use clap_complete::Shell;
use serde_json::json;

/// Prints a script that completes the command line in a shell
#[derive(Args)]
pub(crate) struct CompletionsCommand {
    /// Shell for which to print the script
    shell: Shell,

    /// Prints machine-readable JSON instead of text
    #[arg(long)]
    json: bool,
}

impl CompletionsCommand {
    pub(crate) fn json(&self) -> bool {
        self.json
    }

    pub(crate) fn run(&self) -> Result<()> {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut super::command_line::command(), "burgeon", &mut script);
        let script = String::from_utf8_lossy(&script);
        super::report::print(&match self.json {
            true => format!("{}\n", json!({ "ok": true, "script": script })),
            false => script.into_owned(),
        })
    }
}
