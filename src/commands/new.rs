//! `burgeon new`: creates a starter script.

use std::fs::OpenOptions;
use std::io::{ErrorKind, Write};
use std::path::PathBuf;

use burgeon::export::GLB;
use burgeon::{Error, Result};
use clap::Args;
use serde_json::json;

use super::report;
use super::shared::shell_word;

/// Content of a new script.
const STARTER: &str = include_str!("starter.lua");

/// Makes a script to start from
#[derive(Args)]
pub(crate) struct NewCommand {
    /// File to create; .lua is added if it has no extension
    path: PathBuf,

    /// Prints machine-readable JSON instead of text
    #[arg(long)]
    json: bool,
}

impl NewCommand {
    pub(crate) fn json(&self) -> bool {
        self.json
    }

    pub(crate) fn run(&self) -> Result<()> {
        let path = match self.path.extension() {
            Some(_) => &self.path,
            None => &self.path.with_extension("lua"),
        };
        let shown = path.display();
        let mut file =
            OpenOptions::new().write(true).create_new(true).open(path).map_err(|error| {
                match error.kind() {
                    ErrorKind::AlreadyExists => {
                        Error::file(path, format!("{shown} already exists")).help("choose another name")
                    }
                    ErrorKind::NotFound | ErrorKind::NotADirectory => {
                        let folder =
                            path.parent().map_or_else(|| ".".into(), |folder| folder.display().to_string());
                        Error::file(path, format!("cannot create {shown}: folder not found: {folder}"))
                            .help("create the folder first")
                    }
                    _ => Error::file(path, format!("cannot create {shown}: {error}"))
                        .help("choose another folder"),
                }
            })?;
        file.write_all(STARTER.as_bytes()).map_err(|error| {
            // An incomplete script would only be in the way.
            let _ = std::fs::remove_file(path);
            Error::file(path, format!("cannot write {shown}: {error}"))
                .help("write to another folder or disk")
        })?;
        if self.json {
            report::print(&format!("{}\n", json!({ "ok": true, "path": path })))?;
        } else {
            let (script, model) = (shell_word(path), shell_word(&path.with_extension(GLB.extension())));
            let live = if cfg!(feature = "live") {
                format!("to see it: burgeon live {script}\n")
            } else {
                String::new()
            };
            report::eprint(&format!("created {shown}\n{live}to write it: burgeon run {script} -o {model}\n"));
        }
        Ok(())
    }
}
