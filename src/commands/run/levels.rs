//! Runs in several levels of detail, for one file or for a file of each level.

use std::path::{Path, PathBuf};
use std::time::Instant;

use super::RunCommand;
use crate::commands::progress::ProgressDisplay;
use crate::commands::report;
use crate::commands::shared::end_on_interrupt;
use burgeon::export::{Files, LevelModel, LevelStorage, Need, SceneFacts};
use burgeon::{Error, Result};
use clap::{Args, ValueEnum};

/// Flags of levels of detail.
#[derive(Args, Clone)]
pub(super) struct LevelFlags {
    /// Writes several levels of detail, from the finest on, such as 3,2,1
    #[arg(long, value_name = "LODS", value_delimiter = ',', value_parser = clap::value_parser!(u8).range(0..=3))]
    #[arg(conflicts_with_all = OTHERS)]
    pub(super) levels: Vec<u8>,

    /// Storage of the levels
    #[arg(long, value_name = "KIND", value_enum, default_value_t = LevelsFlag::Names, requires = "levels")]
    level_storage: LevelsFlag,
}

/// Options that runs in several levels do not have.
const OTHERS: [&str; 12] = [
    "lod",
    "watch",
    "parts",
    "save_preset",
    "chain",
    "heights",
    "edits",
    "tiles",
    "metadata",
    "report",
    "frames",
    "turntable",
];

/// Storage of levels of detail
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum LevelsFlag {
    /// Nodes NAME_LOD0, NAME_LOD1 and so on in one file, for game engines
    Names,
    /// MSFT_lod in one file
    Extension,
    /// A file for each level: FILE_LOD0, FILE_LOD1 and so on
    Files,
}

impl RunCommand {
    /// Runs each level of detail and writes the files.
    pub(super) fn run_levels(&self) -> Result<()> {
        let storage = match self.detail.level_storage {
            LevelsFlag::Names => LevelStorage::Names,
            LevelsFlag::Extension => LevelStorage::Extension,
            LevelsFlag::Files => return self.run_level_files(),
        };
        self.check_files()?;
        end_on_interrupt()?;
        let (begin, limit) = (Instant::now(), self.options()?.limits.memory);
        let mut model = LevelModel::new(storage, limit);
        let mut first = None;
        for lod in &self.detail.levels {
            let level = self.of_level(*lod);
            let session = level.session()?;
            let mut run = {
                let _progress = ProgressDisplay::show(&session, !self.script.json);
                burgeon::run_session(&session)?
            };
            level.check_inputs(&session)?;
            run.note_packages(&session)?;
            model.add(std::mem::take(&mut run.scene))?;
            first.get_or_insert((run, session));
        }
        let Some((mut run, session)) = first else { return Err(Error::usage("--levels needs a level")) };
        if run.systems.is_empty() {
            let script = self.script.script.display();
            return Err(Error::script(format!("{script} derives no system, so there is nothing to write"))
                .help("end it with system:derive()"));
        }
        let wanted = !self.no_recipe && self.writes(Need::Recipe);
        let recipe = wanted.then(|| session.recipe(&run.params).complete()).transpose()?;
        let writing = Instant::now();
        let mut files = Files::new(&session.stop);
        for output in &self.output {
            let facts = SceneFacts {
                frame: run.service(),
                instances: self.instances.map(Into::into).unwrap_or_default(),
                is_compressed: self.compress,
                is_quantized: self.quantize,
                recipe: recipe.as_ref(),
                ..SceneFacts::default()
            };
            model.write(&facts, output, &mut files)?;
        }
        run.notes.extend(files.take_notes());
        files.publish()?;
        let (writing, total) = (writing.elapsed(), begin.elapsed());
        if self.script.json {
            report::print(&format!("{}\n", report::summary_json(&run, writing, total)))?;
        } else {
            report::eprint(&report::summary(&run, writing, total, None));
        }
        Ok(())
    }

    /// Runs each level and writes its own files.
    fn run_level_files(&self) -> Result<()> {
        let level = |(number, lod): (usize, &u8)| {
            let mut level = self.of_level(*lod);
            level.output.iter_mut().for_each(|path| *path = level_file(path, number));
            level
        };
        let levels: Vec<Self> = self.detail.levels.iter().enumerate().map(level).collect();
        levels.iter().try_for_each(Self::check_files)?;
        end_on_interrupt()?;
        levels.iter().try_for_each(|level| {
            let (begin, session) = (Instant::now(), level.session()?);
            level.make(&session, begin, &|| false).map(|_| ())
        })
    }

    /// Returns the command for one level.
    fn of_level(&self, lod: u8) -> Self {
        let mut level = self.clone();
        level.detail.levels = Vec::new();
        level.script.set_level(lod);
        level
    }
}

/// Returns the name of the file of level `number`, with the number before the extensions.
fn level_file(path: &Path, number: usize) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    // Extensions can have several parts.
    let dot = name.char_indices().skip(1).find(|(_, letter)| *letter == '.');
    let (stem, extensions) = name.split_at(dot.map_or(name.len(), |(at, _)| at));
    path.with_file_name(format!("{stem}_LOD{number}{extensions}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_levels_are_numbered_before_their_extensions() {
        let named = |text: &str, number| level_file(Path::new(text), number).display().to_string();
        assert_eq!(named("a/town.city.json", 0), "a/town_LOD0.city.json");
        assert_eq!(named("\u{1f331}.glb", 2), "\u{1f331}_LOD2.glb");
    }
}
