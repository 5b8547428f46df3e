//! `burgeon new`: creates a starter script.

use std::fs::OpenOptions;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use burgeon::export::GLB;
use burgeon::{Error, Result};
use clap::{Args, ValueEnum};
use serde_json::json;

use super::report;
use super::shared::shell_word;

/// Data file of the starting point `town`, next to its script.
const TOWN_DATA: (&str, &str) = ("town.geojson", include_str!("starters/town.geojson"));

/// Creates a starter script
#[derive(Args)]
pub(crate) struct NewCommand {
    /// File to create; .lua is added if it has no extension
    path: PathBuf,

    /// Starting point
    #[arg(long, value_enum, value_name = "KIND", default_value_t)]
    from: StartingPoint,

    /// Prints machine-readable JSON instead of text
    #[arg(long)]
    json: bool,
}

/// Starting point of a script.
#[derive(Clone, Copy, Default, ValueEnum)]
enum StartingPoint {
    /// A young tree: a turtle, branches, leaves
    #[default]
    Plant,
    /// A house with windows, a door and a roof
    Building,
    /// A twisted tower: an extruder and a rule for each storey
    Tower,
    /// Hills with a lake, rocks and trees
    Terrain,
    /// Houses and streets from a data file, town.geojson, which is created too
    Town,
    /// One module, one rule and one interpretation
    Empty,
}

impl StartingPoint {
    /// Returns the script.
    fn script(self) -> &'static str {
        match self {
            StartingPoint::Plant => include_str!("starters/plant.lua"),
            StartingPoint::Building => include_str!("starters/building.lua"),
            StartingPoint::Tower => include_str!("starters/tower.lua"),
            StartingPoint::Terrain => include_str!("starters/terrain.lua"),
            StartingPoint::Town => include_str!("starters/town.lua"),
            StartingPoint::Empty => include_str!("starters/empty.lua"),
        }
    }

    /// Returns the name and the content of the data file.
    fn data(self) -> Option<(&'static str, &'static str)> {
        matches!(self, StartingPoint::Town).then_some(TOWN_DATA)
    }
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
        let mut files = vec![path.clone()];
        create(path, self.from.script())?;
        if let Some((name, content)) = self.from.data() {
            let data = path.with_file_name(name);
            // A second script may use the data of the first one.
            if std::fs::read_to_string(&data).ok().as_deref() != Some(content) {
                create(&data, content).inspect_err(|_| {
                    // A script without its data would only be in the way.
                    let _ = std::fs::remove_file(path);
                })?;
                files.push(data);
            }
        }
        if self.json {
            return report::print(&format!("{}\n", json!({ "ok": true, "path": path, "files": files })));
        }
        let created: Vec<String> = files.iter().map(|file| file.display().to_string()).collect();
        let (script, model) = (shell_word(path), shell_word(&path.with_extension(GLB.extension())));
        let live = if cfg!(feature = "live") {
            format!("to see it: burgeon live {script}\n")
        } else {
            String::new()
        };
        let created = created.join(" and ");
        report::eprint(&format!("created {created}\n{live}to write it: burgeon run {script} -o {model}\n"));
        Ok(())
    }
}

/// Creates a file. Fails if it exists.
fn create(path: &Path, content: &str) -> Result<()> {
    let shown = path.display();
    let mut file =
        OpenOptions::new().write(true).create_new(true).open(path).map_err(|error| match error.kind() {
            ErrorKind::AlreadyExists => {
                Error::file(path, format!("{shown} already exists")).help("choose another name or folder")
            }
            ErrorKind::NotFound | ErrorKind::NotADirectory => {
                let folder = path.parent().map_or_else(|| ".".into(), |folder| folder.display().to_string());
                Error::file(path, format!("cannot create {shown}: folder not found: {folder}"))
                    .help("create the folder first")
            }
            _ => Error::file(path, format!("cannot create {shown}: {error}")).help("choose another folder"),
        })?;
    file.write_all(content.as_bytes()).map_err(|error| {
        // An incomplete file would only be in the way.
        let _ = std::fs::remove_file(path);
        Error::file(path, format!("cannot write {shown}: {error}")).help("write to another folder or disk")
    })
}
