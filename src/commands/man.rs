//! `burgeon man`: manual pages.

use std::path::PathBuf;

use burgeon::{Error, Result};
use clap::{Args, Command};
use serde_json::json;

use super::{command_line, report};

/// Prints the manual page of the program, or of a command
#[derive(Args)]
pub(crate) struct ManCommand {
    /// Command whose page to print, such as run or tiles plan
    #[arg(value_name = "COMMAND")]
    command: Vec<String>,

    /// Writes the pages of the program and of all commands to this folder
    #[arg(long, value_name = "FOLDER", conflicts_with = "command")]
    folder: Option<PathBuf>,

    /// Prints machine-readable JSON instead of text
    #[arg(long)]
    json: bool,
}

impl ManCommand {
    pub(crate) fn json(&self) -> bool {
        self.json
    }

    pub(crate) fn run(&self) -> Result<()> {
        let mut program = command_line::command();
        // Sets the full names of commands, such as `burgeon run`.
        program.build();
        if let Some(folder) = &self.folder {
            let mut written = Vec::new();
            write_pages(&program, folder, &mut written)?;
            return match self.json {
                true => report::print(&format!("{}\n", json!({ "ok": true, "written": written }))),
                false => {
                    report::eprint(&format!("wrote {} pages to {}\n", written.len(), folder.display()));
                    Ok(())
                }
            };
        }
        let page = page(find(&program, &self.command)?)?;
        report::print(&match self.json {
            true => format!("{}\n", json!({ "ok": true, "page": page })),
            false => page,
        })
    }
}

/// Returns the command at `path`.
fn find<'a>(program: &'a Command, path: &[String]) -> Result<&'a Command> {
    path.iter().try_fold(program, |command, name| {
        command.find_subcommand(name).ok_or_else(|| {
            let known: Vec<&str> = command.get_subcommands().map(Command::get_name).collect();
            let error =
                Error::not_found("command", name, known.iter().copied(), format!("unknown command {name}"));
            match known.as_slice() {
                [] => error.help(format!("{} has no commands", command.get_name())),
                known => error.help(format!("commands are {}", known.join(", "))),
            }
        })
    })
}

/// Returns the page of a command in the format roff.
fn page(command: &Command) -> Result<String> {
    let mut bytes = Vec::new();
    clap_mangen::Man::new(command.clone())
        .render(&mut bytes)
        .map_err(|error| Error::internal(format!("a manual page cannot be written: {error}")))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// Returns the name of a command's page, such as `burgeon-tiles-plan`.
fn page_name(command: &Command) -> String {
    command.get_bin_name().unwrap_or_else(|| command.get_name()).replace(' ', "-")
}

/// Writes the page of `command` and those of its commands.
fn write_pages(command: &Command, folder: &std::path::Path, written: &mut Vec<PathBuf>) -> Result<()> {
    let path = folder.join(format!("{}.1", page_name(command)));
    let page = page(command)?;
    std::fs::create_dir_all(folder).and_then(|()| std::fs::write(&path, page)).map_err(|error| {
        Error::file(&path, format!("cannot write {}: {error}", path.display())).help("choose another folder")
    })?;
    written.push(path);
    let inner = command.get_subcommands().filter(|inner| inner.get_name() != "help");
    inner.into_iter().try_for_each(|inner| write_pages(inner, folder, written))
}
