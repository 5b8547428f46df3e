//! `burgeon setup`: what an editor needs in a folder of scripts.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use burgeon::language::{SETTINGS, editor_files, merged_settings};
use burgeon::{Error, Result};
use clap::Args;
use serde_json::json;

use super::report;

/// Writes into a folder what Visual Studio Code with luau-lsp needs to complete and check scripts
#[derive(Args)]
pub(crate) struct SetupCommand {
    /// The folder with the scripts, which the editor opens
    #[arg(default_value = ".")]
    folder: PathBuf,

    /// Prints one JSON document, for machines, in place of text for people
    #[arg(long)]
    json: bool,
}

impl SetupCommand {
    pub(crate) fn json(&self) -> bool {
        self.json
    }

    pub(crate) fn run(&self) -> Result<()> {
        if !self.folder.is_dir() {
            let message = format!("there is no folder {}", self.folder.display());
            return Err(Error::file(&self.folder, message).help("make the folder first"));
        }
        // Looked at first, so that nothing is written where it cannot be merged.
        let there = read(&self.folder.join(SETTINGS))?;
        let settings = merged_settings(there.as_deref()).map_err(|wanted| {
            let path = self.folder.join(SETTINGS);
            let message = format!("{} is no plain JSON, so nothing was written", path.display());
            let wanted: Vec<&str> = wanted.lines().map(str::trim).collect();
            Error::file(&path, message)
                .help(format!("take its comments out for once, or add these yourself: {}", wanted.join(" ")))
        })?;
        let (mut written, mut kept) = (Vec::new(), Vec::new());
        for file in editor_files(&burgeon::objects::registry()) {
            let known = read(&self.folder.join(file.path))?;
            if known.as_deref() == Some(&file.text) || known.is_some() && !file.generated {
                kept.push(file.path);
            } else {
                write(&self.folder.join(file.path), &file.text)?;
                written.push(file.path);
            }
        }
        match settings {
            Some(settings) => {
                write(&self.folder.join(SETTINGS), &settings)?;
                written.push(SETTINGS);
            }
            None => kept.push(SETTINGS),
        }
        if self.json {
            return report::print(&format!("{}\n", json!({ "ok": true, "written": written, "kept": kept })));
        }
        for path in &written {
            report::eprint(&format!("wrote {}\n", self.folder.join(path).display()));
        }
        for path in &kept {
            report::eprint(&format!("kept {}\n", self.folder.join(path).display()));
        }
        report::eprint("open the folder in Visual Studio Code, with the extension Luau Language Server\n");
        Ok(())
    }
}

/// What is in a file; nothing if there is none.
fn read(path: &Path) -> Result<Option<String>> {
    match std::fs::read_to_string(path) {
        Ok(text) => Ok(Some(text)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(Error::file(path, format!("cannot read {}: {error}", path.display()))
            .help("choose another folder, or take the file away")),
    }
}

/// Writes a file so that it appears whole or not at all.
fn write(path: &Path, text: &str) -> Result<()> {
    let refuse = |error: std::io::Error| {
        Error::file(path, format!("cannot write {}: {error}", path.display())).help("choose another folder")
    };
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(refuse)?;
    }
    let mut part = path.as_os_str().to_owned();
    part.push(".part");
    std::fs::write(&part, text).and_then(|()| std::fs::rename(&part, path)).map_err(|error| {
        let _ = std::fs::remove_file(&part);
        refuse(error)
    })
}
