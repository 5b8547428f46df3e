//! `burgeon completions`: completion of the command line for shells.

use burgeon::Result;
use clap::{Args, CommandFactory};
use clap_complete::Shell;

/// Prints a script that completes the command line in a shell
#[derive(Args)]
pub(crate) struct CompletionsCommand {
    /// The shell
    shell: Shell,
}

impl CompletionsCommand {
    pub(crate) fn run(&self) -> Result<()> {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut super::command_line::Cli::command(), "burgeon", &mut script);
        super::report::print(&String::from_utf8_lossy(&script))
    }
}
