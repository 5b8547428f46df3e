//! `burgeon examples`: writes the example scripts and their data, which the program contains.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use burgeon::{Error, Result};
use clap::Args;
use serde_json::json;

use super::report;
use super::shared::shell_word;

/// Path within the folder and content of each file, sorted by path.
const FILES: &[(&str, &[u8])] = &include!(concat!(env!("OUT_DIR"), "/examples.rs"));

/// Script to begin with.
const FIRST: &str = "examples/course/01_box.lua";

/// Writes the example scripts into a folder: the course, the cookbook, the gallery, the published models, and their data
#[derive(Args)]
pub(crate) struct ExamplesCommand {
    /// Folder to create; an empty folder is accepted too
    folder: PathBuf,

    /// Prints machine-readable JSON instead of text
    #[arg(long)]
    json: bool,
}

impl ExamplesCommand {
    pub(crate) fn json(&self) -> bool {
        self.json
    }

    pub(crate) fn run(&self) -> Result<()> {
        let shown = self.folder.display();
        let is_new = self.refuse_occupied()?;
        if let Err((path, error)) = write_all(&self.folder) {
            // Part of the files would look like all of them.
            let _ = if is_new { fs::remove_dir_all(&self.folder) } else { clear(&self.folder) };
            let message = format!("cannot write {}: {error}", path.display());
            return Err(Error::file(&path, message).help("write to another folder or disk"));
        }
        if self.json {
            let paths: Vec<&str> = FILES.iter().map(|(path, _)| *path).collect();
            return report::print(&format!(
                "{}\n",
                json!({ "ok": true, "folder": self.folder, "files": paths })
            ));
        }
        let first = shell_word(&self.folder.join(FIRST));
        report::eprint(&format!("wrote {} files to {shown}; now: burgeon live {first}\n", FILES.len()));
        Ok(())
    }

    /// Returns true if the folder does not exist. Fails if it contains files, or if the path is a file.
    fn refuse_occupied(&self) -> Result<bool> {
        let shown = self.folder.display();
        let problem = match fs::read_dir(&self.folder).map(|mut entries| entries.next().is_none()) {
            Ok(true) => return Ok(false),
            Ok(false) => format!("{shown} is not empty"),
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(true),
            Err(error) if error.kind() == ErrorKind::NotADirectory => format!("{shown} is not a folder"),
            Err(error) => format!("cannot read {shown}: {error}"),
        };
        Err(Error::file(&self.folder, problem).help("name a new folder: burgeon examples burgeon-examples"))
    }
}

/// Writes all files into a folder. Fails with the path that could not be written.
fn write_all(folder: &Path) -> std::result::Result<(), (PathBuf, std::io::Error)> {
    for (name, content) in FILES {
        let path = folder.join(name);
        let written =
            path.parent().map_or(Ok(()), fs::create_dir_all).and_then(|()| fs::write(&path, content));
        written.map_err(|error| (path, error))?;
    }
    Ok(())
}

/// Removes the content of a folder that was empty.
fn clear(folder: &Path) -> std::io::Result<()> {
    for entry in fs::read_dir(folder)? {
        fs::remove_dir_all(entry?.path())?;
    }
    Ok(())
}
