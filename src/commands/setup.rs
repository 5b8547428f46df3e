//! `burgeon setup`: sets up an editor for a folder of scripts.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use burgeon::kit::Kind;
use burgeon::language::{LUAURC, SETTINGS, editor_files, merged_luaurc, merged_settings, with_types};
use burgeon::packages::{Package, PackageOrigin, PackageSearch, Packages};
use burgeon::script::{Limits, RunInputs, RunOptions, api_version};
use burgeon::{Error, Result};
use clap::Args;
use serde_json::json;

use super::report;
use super::shared::user_mods;

/// Writes into a folder what Visual Studio Code with luau-lsp needs to complete and check scripts, with the types of objects
/// that they declare
#[derive(Args)]
pub(crate) struct SetupCommand {
    /// Folder of the scripts, which the editor opens
    #[arg(default_value = ".")]
    folder: PathBuf,

    /// Prints machine-readable JSON instead of text
    #[arg(long)]
    json: bool,
}

impl SetupCommand {
    pub(crate) fn json(&self) -> bool {
        self.json
    }

    pub(crate) fn run(&self) -> Result<()> {
        if !self.folder.is_dir() {
            let message = format!("folder not found: {}", self.folder.display());
            return Err(Error::file(&self.folder, message).help("create the folder first"));
        }
        let packages = self.packages();
        // Merge the files first, so that nothing is written if one of them cannot be merged.
        let merged = [
            (SETTINGS, merged_settings(read(&self.folder.join(SETTINGS))?.as_deref())),
            (LUAURC, merged_luaurc(read(&self.folder.join(LUAURC))?.as_deref(), self.aliases(&packages))),
        ];
        let mut texts = Vec::new();
        for (file, merged) in merged {
            texts.push((
                file,
                merged.map_err(|why| {
                    let path = self.folder.join(file);
                    let message = format!("{} is not JSON, so nothing was written: {why}", path.display());
                    Error::file(&path, message).help("fix it, or move it away")
                })?,
            ));
        }
        let registry = with_types(&burgeon::registry(), self.types(&packages));
        let (mut written, mut kept) = (Vec::new(), Vec::new());
        for file in editor_files(&registry) {
            let known = read(&self.folder.join(file.path))?;
            if known.as_deref() == Some(&file.text) || known.is_some() && !file.generated {
                kept.push(file.path);
            } else {
                write(&self.folder.join(file.path), &file.text)?;
                written.push(file.path);
            }
        }
        for (file, text) in texts {
            match text {
                Some(text) => {
                    write(&self.folder.join(file), &text)?;
                    written.push(file);
                }
                None => kept.push(file),
            }
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

impl SetupCommand {
    /// Returns the packages that scripts of the folder can use.
    fn packages(&self) -> Packages {
        let user = user_mods();
        let search = PackageSearch { script: Some(&self.folder), given: &[], user: user.as_deref() };
        Packages::find(search, &api_version())
    }

    /// Returns the name and the path of each package; paths inside the folder are relative.
    fn aliases<'a>(&self, packages: &'a Packages) -> Vec<(&'a str, String)> {
        let alias = |package: &'a Package| {
            let folder = match package.origin {
                PackageOrigin::Beside => package.shown.strip_prefix(&self.folder).unwrap_or(&package.shown),
                _ => package.folder.as_path(),
            };
            let parts: Vec<_> = folder.iter().map(|part| part.to_string_lossy()).collect();
            (&*package.manifest.name, parts.join("/").replace("//", "/"))
        };
        packages.order().iter().map(alias).collect()
    }

    /// Returns the object types that the scripts of the folder and its packages declare, as far as the scripts run.
    fn types(&self, packages: &Packages) -> Vec<Arc<Kind>> {
        let options = |mods: Vec<PathBuf>| {
            let inputs = RunInputs { mods, user_mods: user_mods(), ..RunInputs::default() };
            let limits = Limits { time: LONGEST, ..Limits::default() };
            RunOptions { inputs, limits, ..burgeon::options() }
        };
        let entries = std::fs::read_dir(&self.folder).into_iter().flatten().flatten();
        let mut scripts: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
        scripts.retain(|path| path.extension().is_some_and(|extension| extension == "lua") && path.is_file());
        scripts.sort();
        scripts.truncate(MOST);
        let of_scripts =
            scripts.iter().flat_map(|script| burgeon::declared_types(script, options(Vec::new())));
        let beside = self.folder.join("mods");
        let of_packages = packages.order().iter().flat_map(|package| {
            // The displayed path of a package determines how its files are named.
            let mods = std::iter::once(&package.shown).chain(beside.is_dir().then_some(&beside));
            burgeon::declared_types_of_package(&package.shown, options(mods.cloned().collect()))
        });
        of_scripts.chain(of_packages).collect()
    }
}

/// Maximum number of scripts of a folder that are searched for object types.
const MOST: usize = 200;

/// Time limit of one of these scripts.
const LONGEST: Duration = Duration::from_secs(10);

/// Reads a file; `None` if it does not exist.
fn read(path: &Path) -> Result<Option<String>> {
    match std::fs::read_to_string(path) {
        Ok(text) => Ok(Some(text)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(Error::file(path, format!("cannot read {}: {error}", path.display()))
            .help("choose another folder, or remove the file")),
    }
}

/// Writes a file completely or not at all.
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
