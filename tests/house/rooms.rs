//! Rooms of a crate, which are the folders and files at the top of its `src`, and the rooms that each one uses.
//!
//! A path through a re-export (`pub use`) leads to the file that defines the item.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use super::sources::{Source, imports};

/// Maximum number of re-exports that a path may lead through.
const DEEPEST: usize = 8;

/// Modules of a crate, and their re-exports.
struct Modules {
    known: BTreeSet<Vec<String>>,
    /// For each module, the re-exported names with their absolute paths; `*` for all names of a module.
    exports: BTreeMap<Vec<String>, Vec<(String, Vec<String>)>>,
}

impl Modules {
    fn new(sources: &[Source]) -> Self {
        let known: BTreeSet<Vec<String>> = sources.iter().map(|source| source.module.clone()).collect();
        let mut modules = Self { known, exports: BTreeMap::new() };
        for source in sources {
            let public = imports(&source.code).into_iter().filter(|import| import.is_public);
            let exports = public.filter_map(|import| {
                Some((import.name.clone(), modules.absolute(&source.module, &import.path)?))
            });
            let exports: Vec<_> = exports.collect();
            modules.exports.insert(source.module.clone(), exports);
        }
        modules
    }

    /// Returns the path from the root of the crate; `None` if the path leads to another crate.
    fn absolute(&self, module: &[String], path: &[String]) -> Option<Vec<String>> {
        let ups = path.iter().take_while(|name| *name == "super").count();
        match path.first()?.as_str() {
            "crate" => Some(path[1..].to_vec()),
            "self" => Some([module, &path[1..]].concat()),
            "super" => Some([&module[..module.len().checked_sub(ups)?], &path[ups..]].concat()),
            first => {
                let inner = [module, &[first.to_owned()]].concat();
                self.known.contains(&inner).then(|| [module, path].concat())
            }
        }
    }

    /// Returns the module that defines the item with an absolute path.
    fn defining(&self, path: &[String], depth: usize) -> Vec<String> {
        let known = (0..=path.len()).rev().find(|count| self.known.contains(&path[..*count])).unwrap_or(0);
        let module = path[..known].to_vec();
        let Some(name) = path.get(known).filter(|_| depth < DEEPEST) else { return module };
        let exports = self.exports.get(&module).map_or(&[][..], Vec::as_slice);
        if let Some((_, path_of)) = exports.iter().find(|(exported, of)| exported == name && **of != *path) {
            return self.defining(&[path_of, &path[known + 1..]].concat(), depth + 1);
        }
        for (_, of) in exports.iter().filter(|(exported, _)| exported == "*") {
            let found = self.defining(&[of, &path[known..]].concat(), depth + 1);
            if found.len() > of.len() || self.defines(&found, name) {
                return found;
            }
        }
        module
    }

    /// Returns true if a module re-exports `name` itself.
    fn defines(&self, module: &[String], name: &str) -> bool {
        self.exports.get(module).is_some_and(|exports| exports.iter().any(|(exported, _)| exported == name))
    }
}

/// Returns which rooms of the crate in `folder` use which others.
pub(crate) fn rooms(folder: &Path) -> BTreeMap<String, BTreeSet<String>> {
    let sources = Source::all(folder);
    let modules = Modules::new(&sources);
    let mut uses = BTreeMap::<String, BTreeSet<String>>::new();
    for source in &sources {
        let Some(room) = source.module.first() else { continue };
        uses.entry(room.clone()).or_default();
        for path in source.inner_paths() {
            let module = modules.defining(&path, 0);
            if let Some(other) = module.first().filter(|other| *other != room) {
                uses.entry(room.clone()).or_default().insert(other.clone());
            }
        }
    }
    uses
}

/// Writes a crate with these files to a temporary folder, and returns the uses of its rooms.
#[cfg(test)]
fn rooms_of(name: &str, files: &[(&str, &str)]) -> BTreeMap<String, BTreeSet<String>> {
    let folder = std::env::temp_dir().join(format!("burgeon-rooms-{name}-{}", std::process::id()));
    for (file, text) in files {
        let path = folder.join(file);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }
    let found = rooms(&folder);
    std::fs::remove_dir_all(&folder).unwrap();
    found
}

#[test]
fn a_planted_circle_is_found_through_a_re_export_of_the_crate() {
    let uses = rooms_of(
        "exports",
        &[
            ("lib.rs", "mod a;\nmod b;\npub use a::Above;\npub use b::{Below, deep::Deep as Renamed};\n"),
            ("a/mod.rs", "mod inner;\npub use inner::Above;\n"),
            ("a/inner.rs", "use crate::Renamed;\npub struct Above(Renamed);\n"),
            ("b/mod.rs", "pub mod deep;\nmod low;\npub use low::*;\n"),
            ("b/deep.rs", "pub struct Deep;\n"),
            ("b/low.rs", "pub struct Below(crate::Above);\n"),
        ],
    );
    assert_eq!(super::circle(&uses).unwrap(), ["a", "b", "a"]);
}

#[test]
fn a_planted_circle_is_found_through_a_file_at_the_top() {
    let uses = rooms_of(
        "top",
        &[
            ("lib.rs", "mod a;\nmod top;\n"),
            ("a/mod.rs", "mod inner;\npub use inner::{One, two};\n"),
            ("a/inner.rs", "use super::super::top::Top;\npub struct One(Top);\npub fn two() {}\n"),
            ("top.rs", "pub struct Top;\nfn call() {\n    crate::a::two();\n}\n"),
        ],
    );
    assert_eq!(super::circle(&uses).unwrap(), ["a", "top", "a"]);
    let without = rooms_of(
        "none",
        &[
            ("lib.rs", "mod a;\nmod top;\npub use a::One;\n"),
            ("a/mod.rs", "mod inner;\npub use inner::One;\n"),
            ("a/inner.rs", "use crate::top::Top;\npub struct One(Top);\n"),
            ("top.rs", "pub struct Top;\n#[cfg(test)]\nmod tests {\n    use crate::One;\n}\n"),
        ],
    );
    assert_eq!(super::circle(&without), None);
}
