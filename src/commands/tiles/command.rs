//! Command `tiles` and its subcommands.

use std::process::ExitCode;

use burgeon::tiles::make::is_retriable;
use burgeon::{Error, Result};
use clap::{Args, Subcommand};

use super::{check, join, make, plan, status};

/// Makes 3D Tiles of the features of a country, with any number of processes
#[derive(Args)]
pub(crate) struct TilesCommand {
    #[command(subcommand)]
    action: TilesAction,
}

#[derive(Subcommand)]
enum TilesAction {
    Plan(Box<plan::PlanCommand>),
    Make(make::MakeCommand),
    Join(join::JoinCommand),
    Check(check::CheckTilesCommand),
    Status(status::StatusCommand),
}

/// Exit status of a failure that may not occur again (`EX_TEMPFAIL` of sysexits.h).
const RETRY: u8 = 75;

impl TilesCommand {
    pub(crate) fn json(&self) -> bool {
        match &self.action {
            TilesAction::Plan(command) => command.json(),
            TilesAction::Make(command) => command.json,
            TilesAction::Join(command) => command.json,
            TilesAction::Check(command) => command.json,
            TilesAction::Status(command) => command.json,
        }
    }

    pub(crate) fn run(&self) -> Result<()> {
        match &self.action {
            TilesAction::Plan(command) => command.run(),
            TilesAction::Make(command) => command.run(),
            TilesAction::Join(command) => command.run(),
            TilesAction::Check(command) => command.run(),
            TilesAction::Status(command) => command.run(),
        }
    }

    /// Returns the exit status of a failed command.
    pub(crate) fn status(&self, error: &Error) -> ExitCode {
        match is_retriable(error) {
            true => ExitCode::from(RETRY),
            false => ExitCode::FAILURE,
        }
    }
}
