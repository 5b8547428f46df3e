//! `burgeon open`: shows a model live again, from the recipe in its file.

use std::collections::BTreeSet;
use std::fs::{self, OpenOptions};
use std::io::{ErrorKind, Write as _};
use std::path::{Path, PathBuf};

use burgeon::export::{FORMATS, Need, extension_list, read_recipe};
use burgeon::packages::{FileName, hash_file};
use burgeon::presets::Presets;
use burgeon::scene::Recipe;
use burgeon::{Error, Result, Warning, WarningKind};
use clap::Args;
use serde_json::{Map, json};

use super::live::PageFlags;
use super::report;
use super::shared::ScriptFlags;

/// Name of the preset with the values of a recipe.
const PRESET: &str = "recipe";

/// Maximum number of files of a recipe.
const MOST_FILES: usize = 1000;

/// Maximum number of folders with numbered names that are tried.
const MOST_FOLDERS: usize = 100;

/// Shows a model live again: writes the script of its recipe to a new folder, and says what is missing
#[derive(Args)]
#[command(mut_arg("script", |arg| arg.value_name("MODEL").help(model_help())))]
pub(crate) struct OpenCommand {
    #[command(flatten)]
    script: ScriptFlags,

    /// Folder for the script, which must be new or empty [default: MODEL-recipe, next to the model]
    #[arg(long, value_name = "FOLDER")]
    into: Option<PathBuf>,

    /// Writes the script and says what is missing, without the live page
    #[arg(long)]
    no_live: bool,

    #[command(flatten)]
    page: PageFlags,
}

fn model_help() -> String {
    let formats = FORMATS.iter().filter(|format| format.needs(Need::Recipe));
    format!("Model with a recipe: {}", extension_list(formats, "or"))
}

impl OpenCommand {
    pub(crate) fn json(&self) -> bool {
        self.script.json
    }

    pub(crate) fn run(mut self) -> Result<()> {
        let model = self.script.script.clone();
        let recipe = read_recipe(&model)?;
        check_names(&model, &recipe)?;
        let folder = match &self.into {
            Some(folder) => create(folder)?,
            None => create_beside(&model)?,
        };
        write_files(&folder, &recipe)?;
        let script = folder.join(&recipe.script);
        let preset = write_preset(&script, &recipe)?;
        self.script.follow(script.clone(), &recipe, preset);
        let missing = self.missing(&recipe)?;
        let facts = json!({
            "ok": true,
            "script": script,
            "preset": preset,
            "missing": report::warnings_json(&missing),
        });
        if !self.script.json {
            report::eprint(&format!("wrote the script to {}\n", script.display()));
            report::eprint(&report::warnings(&missing));
        }
        if let (true, Some(first)) = (self.script.is_strict(), missing.first()) {
            return Err(first.clone().into_error());
        }
        if !self.no_live {
            return self.page.serve_script(self.script, &facts);
        }
        match self.script.json {
            true => report::print(&format!("{facts}\n")),
            false => {
                let preset = preset.map_or_else(String::new, |preset| format!(" --preset {preset}"));
                report::eprint(&format!("now: burgeon live {}{preset}\n", script.display()));
                Ok(())
            }
        }
    }

    /// Returns a warning for each part of the recipe that is missing here or differs.
    fn missing(&self, recipe: &Recipe) -> Result<Vec<Warning>> {
        let warning = |text: String| Warning::new(WarningKind::Data, text);
        let mut missing = Vec::new();
        let version = env!("CARGO_PKG_VERSION");
        if recipe.program != version {
            let text = format!("the model was made by Burgeon {}, and this is {version}", recipe.program);
            missing.push(
                warning(text).help("the result may differ; install that version to get the same model"),
            );
        }
        let packages = self.script.packages();
        for wanted in &recipe.packages {
            let (name, version) = (&wanted.name, &wanted.version);
            let Some(known) = packages.get(name) else {
                missing.push(warning(format!("missing package: {name} {version}")).help(format!(
                    "install it, or name its folder: --mods FOLDER; its hash is {}",
                    wanted.hash
                )));
                continue;
            };
            let locked = packages.lock(|it| it == name)?;
            if known.manifest.version.to_string() != *version {
                let text =
                    format!("the package {name} has version {}, not {version}", known.manifest.version);
                missing.push(warning(text).help("the result may differ; install that version"));
            } else if locked.iter().any(|locked| locked.hash != wanted.hash) {
                let text =
                    format!("the package {name} {version} has other files than when the model was made");
                missing
                    .push(warning(text).help(format!("the result may differ; its hash was {}", wanted.hash)));
            }
        }
        for wanted in &recipe.data {
            let name = &wanted.name;
            let found =
                self.script.data_folders().iter().map(|folder| folder.join(name)).find(|path| path.is_file());
            let hash = found.as_deref().and_then(|path| hash_file(path).ok());
            match (found, hash) {
                (_, Some(hash)) if hash == wanted.hash => {}
                (Some(path), _) => missing.push(
                    warning(format!("the data file {} has changed since the model was made", path.display()))
                        .help(format!("the result may differ; its hash was {}", wanted.hash)),
                ),
                _ => missing.push(warning(format!("missing data file: {name}")).help(format!(
                    "name the folder that it is relative to: --data FOLDER; its hash is {}",
                    wanted.hash
                ))),
            }
        }
        if recipe.databases && !self.script.has_databases() {
            missing.push(
                warning("the model was made with a database".to_owned()).help("name it: --database ADDRESS"),
            );
        }
        if let Some(wanted) = &recipe.stdlib {
            let hash = self.script.stdlib().and_then(|path| hash_file(path).ok());
            if hash.as_ref() != Some(wanted) {
                missing.push(
                    warning("the model was made with another standard library".to_owned())
                        .help(format!("name it: --stdlib FILE; its hash is {wanted}")),
                );
            }
        }
        Ok(missing)
    }
}

/// Fails unless all files of a recipe are scripts below its folder.
fn check_names(model: &Path, recipe: &Recipe) -> Result<()> {
    let refuse = |what: String| {
        Error::file(model, format!("the recipe of {} {what}", model.display()))
            .help("Burgeon writes no such recipe; do not trust the file")
    };
    if recipe.files.len() > MOST_FILES {
        return Err(refuse(format!(
            "has {} files, and at most {MOST_FILES} are allowed",
            recipe.files.len()
        )));
    }
    let is_sound = |name: &str| {
        let parts = name.split('/');
        name.ends_with(".lua")
            && FileName::parse(&format!("@own/{name}")).is_ok_and(|parsed| parsed.path == name)
            && parts.into_iter().all(|part| {
                part.len() <= 200
                    && !part.starts_with('.')
                    && !part.ends_with(['.', ' '])
                    && !part.contains(|letter: char| letter.is_control())
            })
            && name.len() <= 1000
    };
    // Some file systems do not distinguish these.
    let names: BTreeSet<String> = recipe.files.iter().map(|file| file.name.to_lowercase()).collect();
    if names.len() < recipe.files.len() {
        return Err(refuse("has several files with the same name".to_owned()));
    }
    match recipe.files.iter().find(|file| !is_sound(&file.name)) {
        Some(file) => {
            let name = burgeon::text::shown(&file.name).chars().take(100).collect::<String>();
            Err(refuse(format!("has a file with the name {name:?}, which is no Lua file in its folder")))
        }
        None => Ok(()),
    }
}

/// Creates `folder` unless it is an empty folder. Fails if it has any content.
fn create(folder: &Path) -> Result<PathBuf> {
    let shown = folder.display();
    let is_empty = || fs::read_dir(folder).is_ok_and(|mut entries| entries.next().is_none());
    match fs::create_dir(folder) {
        Ok(()) => Ok(folder.to_owned()),
        Err(error) if error.kind() == ErrorKind::AlreadyExists && is_empty() => Ok(folder.to_owned()),
        Err(error) if error.kind() == ErrorKind::AlreadyExists => {
            Err(Error::file(folder, format!("{shown} exists and is no empty folder"))
                .help("name a new folder; open overwrites no files: --into FOLDER"))
        }
        Err(error) => Err(Error::file(folder, format!("cannot create {shown}: {error}"))
            .help("name a folder that can be created: --into FOLDER")),
    }
}

/// Creates a new folder next to `model`, with a number if there are others.
fn create_beside(model: &Path) -> Result<PathBuf> {
    let stem = model.file_stem().unwrap_or_default().to_string_lossy();
    let name = |number: usize| match number {
        1 => format!("{stem}-recipe"),
        number => format!("{stem}-recipe-{number}"),
    };
    for number in 1..=MOST_FOLDERS {
        let folder = model.with_file_name(name(number));
        match fs::create_dir(&folder) {
            Ok(()) => return Ok(folder),
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            Err(error) => {
                return Err(Error::file(&folder, format!("cannot create {}: {error}", folder.display()))
                    .help("name a folder that can be created: --into FOLDER"));
            }
        }
    }
    Err(Error::file(
        model,
        format!("there are {MOST_FOLDERS} folders for recipes next to {}", model.display()),
    )
    .help("remove some, or name another folder: --into FOLDER"))
}

/// Writes the files of a recipe to the new `folder`.
fn write_files(folder: &Path, recipe: &Recipe) -> Result<()> {
    for file in &recipe.files {
        write_new(&folder.join(&file.name), &file.text)?;
    }
    Ok(())
}

/// Writes the values and the seed of a recipe as a preset next to `script`, and returns its name; `None` if all are defaults.
fn write_preset(script: &Path, recipe: &Recipe) -> Result<Option<&'static str>> {
    let changed = recipe.values.iter().filter(|value| value.default.is_some());
    let params: Map<String, serde_json::Value> =
        changed.map(|value| (value.name.clone(), value.value.clone())).collect();
    if params.is_empty() && recipe.seed == 0 {
        return Ok(None);
    }
    let presets = json!({ PRESET: { "seed": recipe.seed, "params": params } });
    let path = Presets::path_of(script);
    write_new(&path, &format!("{presets:#}\n"))?;
    // A recipe can have values that no preset has.
    Presets::read_file(&path)?;
    Ok(Some(PRESET))
}

/// Writes a new file and the folders that it needs. Fails if the file exists.
fn write_new(path: &Path, text: &str) -> Result<()> {
    let shown = path.display();
    let cannot = |error: std::io::Error| {
        Error::file(path, format!("cannot write {shown}: {error}")).help("name another folder: --into FOLDER")
    };
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(cannot)?;
    }
    let mut file = OpenOptions::new().write(true).create_new(true).open(path).map_err(cannot)?;
    file.write_all(text.as_bytes()).map_err(cannot)
}
