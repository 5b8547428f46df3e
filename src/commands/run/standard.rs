//! A model on standard output: `burgeon run tree.lua -o - --format glb`.

use std::io::{IsTerminal as _, Write as _};
use std::path::Path;

use burgeon::export::Format;
use burgeon::{Error, Result};

use super::RunCommand;
use crate::commands::report;
use crate::commands::shared::STANDARD;

impl RunCommand {
    /// Returns true if an output is standard output.
    pub(super) fn writes_standard(&self) -> bool {
        self.output.iter().any(|output| output == Path::new(STANDARD))
    }

    /// Runs the command with a file in a temporary folder in place of standard output, and prints this file.
    pub(super) fn run_to_standard(&self) -> Result<()> {
        let extension = self.standard_format()?;
        let folder = tempfile::tempdir().map_err(|error| {
            Error::system(format!("cannot create a temporary folder: {error}"))
                .help("set TMPDIR to a folder with room")
        })?;
        let path = folder.path().join(format!("model.{extension}"));
        let mut command = self.clone();
        command.format = None;
        for output in command.output.iter_mut().filter(|output| *output == Path::new(STANDARD)) {
            output.clone_from(&path);
        }
        command.run()?;
        let content = std::fs::read(&path).map_err(|error| {
            Error::file(&path, format!("cannot read the written model: {error}"))
                .help("write to a file: -o FILE")
        })?;
        report::print_all(|out| out.write_all(&content))
    }

    /// Returns the extension of the format of standard output. Fails if standard output cannot take a model.
    fn standard_format(&self) -> Result<&str> {
        let refuse = |message: &str, help: &str| Err(Error::usage(message).help(help));
        if self.output.iter().filter(|output| *output == Path::new(STANDARD)).count() > 1 {
            return refuse(
                "standard output takes one model, not several",
                "write the others to files: -o FILE",
            );
        }
        let Some(extension) = self.format.as_deref() else {
            return refuse("the model on standard output has no format", "name it: -o - --format glb");
        };
        let is_named = |path: &Option<std::path::PathBuf>| path.as_deref() == Some(Path::new(STANDARD));
        if self.script.json || is_named(&self.chain) || is_named(&self.report) {
            let message = "standard output cannot take both a model and a text";
            return refuse(message, "write one of them to a file: -o FILE, --chain FILE, --report FILE");
        }
        if self.is_watching() || self.parts.is_some() {
            return refuse("standard output takes one model, not several", "write to a file: -o FILE");
        }
        let name = format!("model.{extension}");
        if let Ok(format) = Format::of(Path::new(&name))
            && let Some(second) = format.file.companion(Path::new(&name))
        {
            let second = second.display();
            let message = format!(
                "the format {extension} has a second file, {second}, so standard output cannot take it"
            );
            return refuse(&message, "choose another format: --format glb");
        }
        if std::io::stdout().is_terminal() {
            let help = format!("redirect it: > {name}, or write a file: -o {name}");
            return refuse("standard output is a terminal, which cannot show a model", &help);
        }
        Ok(extension)
    }
}
