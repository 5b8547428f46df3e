//! Parses the command line and runs its command.

use std::ffi::OsString;
use std::io::{ErrorKind, Write as _};
use std::process::ExitCode;

use super::help_examples::with_examples;
use super::short_forms::{suggest, with_command};
use super::{
    api, check, completions, examples, fit, live, man, mods, new, open, report, run, setup, sources, tiles,
    variations,
};
use burgeon::Error;
use clap::{CommandFactory as _, FromArgMatches as _, Parser, Subcommand};

#[derive(Parser)]
#[command(
    name = "burgeon",
    version,
    about = "Procedural modelling by rewriting: rules in Lua, geometry in Rust.",
    after_help = "Getting started:\n  burgeon new tree\n  burgeon live tree.lua\n  burgeon run tree.lua -o tree.glb\n\n\
                  burgeon tree.lua runs a script and shows its model; burgeon COMMAND --help has examples."
)]
pub(super) struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Run(Box<run::RunCommand>),
    Live(Box<live::LiveCommand>),
    Check(Box<check::CheckCommand>),
    Api(api::ApiCommand),
    Variations(Box<variations::VariationsCommand>),
    Fit(fit::FitCommand),
    Mods(mods::ModsCommand),
    New(new::NewCommand),
    Open(Box<open::OpenCommand>),
    Examples(examples::ExamplesCommand),
    Setup(setup::SetupCommand),
    Sources(sources::SourcesCommand),
    Tiles(tiles::TilesCommand),
    Completions(completions::CompletionsCommand),
    Man(man::ManCommand),
}

/// Returns the command line with the examples of all commands.
pub(super) fn command() -> clap::Command {
    with_examples(Cli::command())
}

/// Runs the command that `arguments` describe, as the program does; the first argument is the name of the program.
///
/// It prints, and it may end the process.
pub fn run_command(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let program = command();
    let given: Vec<OsString> = arguments.into_iter().collect();
    let (arguments, is_short) = with_command(&program, given.clone());
    let matches = program.clone().try_get_matches_from(arguments);
    let cli = match matches.and_then(|matches| Cli::from_arg_matches(&matches)) {
        Ok(cli) => cli,
        Err(error) => return refuse_command_line(&suggest(&program, error), &given),
    };
    let (json, result) = match cli.command {
        Command::Run(command) => (command.json(), command.run().map(|()| command.hint_at_outputs(is_short))),
        Command::Live(command) => (command.json(), command.run()),
        Command::Api(command) => (command.json(), command.run()),
        Command::Check(command) => return check(&command),
        Command::Man(command) => (command.json(), command.run()),
        Command::Variations(command) => (command.json(), command.run()),
        Command::Fit(command) => (command.json(), command.run()),
        Command::Mods(command) => (command.json(), command.run()),
        Command::New(command) => (command.json(), command.run()),
        Command::Open(command) => (command.json(), command.run()),
        Command::Examples(command) => (command.json(), command.run()),
        Command::Setup(command) => (command.json(), command.run()),
        Command::Sources(command) => (command.json(), command.run()),
        Command::Tiles(command) => return tiles(&command),
        Command::Completions(command) => (command.json(), command.run()),
    };
    match result {
        // A reader that closed the pipe needs no message, but the exit status shows that the output is incomplete.
        Ok(()) if report::is_closed() => ExitCode::FAILURE,
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            report::error(&error, json);
            ExitCode::FAILURE
        }
    }
}

/// Runs `burgeon check`, which reports the problems of several scripts itself.
fn check(command: &check::CheckCommand) -> ExitCode {
    match command.run() {
        Ok(true) if !report::is_closed() => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(error) => {
            report::error(&error, command.json());
            ExitCode::FAILURE
        }
    }
}

/// Runs `burgeon tiles`, whose exit status tells schedulers whether to repeat it.
fn tiles(command: &tiles::TilesCommand) -> ExitCode {
    match command.run() {
        Ok(()) if report::is_closed() => ExitCode::FAILURE,
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            report::error(&error, command.json());
            command.status(&error)
        }
    }
}

/// Prints the requested help or version.
fn print_help(error: &clap::Error) -> ExitCode {
    // clap detects whether the terminal supports colours.
    let printed = error.print().and_then(|()| std::io::stdout().flush());
    match printed {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) if error.kind() == ErrorKind::BrokenPipe => ExitCode::FAILURE,
        Err(error) => {
            report::error(&Error::system(format!("cannot write to standard output: {error}")), false);
            ExitCode::FAILURE
        }
    }
}

/// Prints the error of the command line, or the requested help or version.
fn refuse_command_line(error: &clap::Error, arguments: &[OsString]) -> ExitCode {
    let mut flags = arguments.iter().skip(1).take_while(|argument| *argument != "--");
    let wants_json = flags.any(|argument| argument == "--json");
    if !error.use_stderr() {
        return print_help(error);
    }
    if !wants_json {
        error.exit();
    }
    let text = error.to_string();
    let text = text.trim_start_matches("error: ");
    let (message, help) = text.split_once("\n\n").unwrap_or((text, ""));
    report::error(&Error::usage(message.trim()).help(help.trim()), true);
    ExitCode::from(2)
}
