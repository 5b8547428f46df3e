//! Runs in parts: the model is written as several files, one after another.

use std::path::{Path, PathBuf};
use std::time::Instant;

use super::RunCommand;
use crate::commands::shared::end_on_interrupt;
use burgeon::Result;

/// Maximum number of parts.
const MOST: u32 = 10_000;

/// Parses the number of parts.
pub(super) fn count(text: &str) -> Result<u32, String> {
    let count = text.parse().ok().filter(|count| (1..=MOST).contains(count));
    count.ok_or_else(|| format!("write a number of parts from 1 to {MOST}"))
}

impl RunCommand {
    /// Runs each of `count` parts and writes its files, before the next part begins.
    pub(super) fn run_parts(&self, count: u32) -> Result<()> {
        (1..=count).try_for_each(|number| self.of_part(number, count).check_files())?;
        end_on_interrupt()?;
        let (options, reach) = (self.options()?, self.script.reach());
        burgeon::each_part(&self.script.script, &options, count as usize, reach, |session| {
            let number = session.options.part.map_or(1, |part| part.number);
            let part = self.of_part(u32::try_from(number).unwrap_or(count), count);
            part.make(session, Instant::now(), &|| false).map(|_| ())
        })
    }

    /// Returns the command with the files of part `number` of `count`.
    fn of_part(&self, number: u32, count: u32) -> Self {
        let mut part = self.clone();
        part.parts = None;
        let texts = [&mut part.chain, &mut part.heights, &mut part.edits, &mut part.tiles, &mut part.report];
        let texts = texts.into_iter().filter_map(Option::as_mut);
        for path in part.output.iter_mut().chain(texts) {
            *path = part_file(path, number, count);
        }
        part
    }
}

/// Returns the name of the file of part `number` of `count`, with the number before the extensions; `-` is standard output.
fn part_file(path: &Path, number: u32, count: u32) -> PathBuf {
    let (Some(name), false) = (path.file_name(), path == Path::new("-")) else { return path.to_owned() };
    let (name, digits) = (name.to_string_lossy(), count.to_string().len());
    // Extensions can have several parts.
    let dot = name.char_indices().skip(1).find(|(_, letter)| *letter == '.');
    let (stem, extensions) = name.split_at(dot.map_or(name.len(), |(at, _)| at));
    path.with_file_name(format!("{stem}-{number:0digits$}{extensions}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_parts_are_numbered_before_their_extensions() {
        let named =
            |text: &str, number, count| part_file(Path::new(text), number, count).display().to_string();
        assert_eq!(named("a/town.glb", 3, 12), "a/town-03.glb");
        assert_eq!(named("town.city.json", 1, 4), "town-1.city.json");
        assert_eq!((named("-", 1, 4), named("tiles", 2, 4)), ("-".to_owned(), "tiles-2".to_owned()));
        assert_eq!(named(".hidden.glb", 2, 4), ".hidden-2.glb");
        assert_eq!(named("\u{e9}.glb", 2, 4), "\u{e9}-2.glb");
    }

    #[test]
    fn the_number_of_parts_is_limited() {
        assert_eq!(count("8"), Ok(8));
        for text in ["0", "-1", "10001", "a", ""] {
            assert!(count(text).is_err(), "{text}");
        }
    }
}
