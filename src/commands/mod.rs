//! The commands: each reads its flags, does its work through the library, and says what came of it.
//!
//! Comes in: the command line. Goes out: files, standard output, and an exit status: 0 done, 1 the script or its
//! data failed, 2 the command line is wrong.

mod check;
mod completions;
mod new;
mod progress;
mod report;
mod run;
mod shared;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

#[derive(Parser)]
#[command(
    name = "burgeon",
    version,
    about = "Procedural modelling by rewriting: rules in Lua, geometry in Rust."
)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Run(run::Run),
    Check(check::Check),
    New(new::New),
    Completions(completions::Completions),
}

/// Runs the command that the command line names.
pub(crate) fn main() -> ExitCode {
    let (json, result) = match Cli::parse().command {
        Command::Run(command) => (command.json(), command.run()),
        Command::Check(command) => (command.json(), command.run()),
        Command::New(command) => (command.json(), command.run()),
        Command::Completions(command) => (false, command.run()),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            report::error(&error, json);
            ExitCode::FAILURE
        }
    }
}
