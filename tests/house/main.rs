//! Architecture tests: dependencies between crates, entries in each Cargo.toml, names that crates may use,
//! crates that may print, and tables that are the only place of their facts.

#![allow(clippy::unwrap_used, reason = "a test stops at what is wrong")]

mod formats;
mod front_pages;
mod names;
mod rooms;
mod sources;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use burgeon::kit::Construct;
use rooms::rooms;
use sources::{Source, paths, words};

type Uses = BTreeMap<String, BTreeSet<String>>;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn text(path: impl AsRef<Path>) -> String {
    let path = root().join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Returns the crates under `crates/`.
fn members() -> Vec<String> {
    let entries = fs::read_dir(root().join("crates")).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    assert!(names.len() > 10, "{names:?}");
    names
}

/// Returns the dependency map in the documentation of the main crate: the crates in order, and the
/// dependencies of each.
fn drawn() -> (Vec<String>, Uses) {
    let front = text("src/lib.rs");
    let lines = front.lines().filter_map(|line| line.strip_prefix("//! ")?.split_once(" uses ──►"));
    let mut order = Vec::new();
    let uses = lines.map(|(name, uses)| {
        order.push(name.trim().to_owned());
        let uses = uses.split(',').map(|name| name.trim().to_owned()).filter(|name| name != "nothing");
        (name.trim().to_owned(), uses.collect())
    });
    let uses = uses.collect();
    (order, uses)
}

/// Returns the names in a section of a Cargo.toml.
fn section(manifest: &str, title: &str) -> BTreeSet<String> {
    let lines = manifest.lines().skip_while(|line| *line != format!("[{title}]")).skip(1);
    let lines = lines.take_while(|line| !line.starts_with('['));
    let names = lines.filter_map(|line| Some(line.split(['.', ' ', '=']).next()?.trim().to_owned()));
    names.filter(|name| !name.is_empty() && !name.starts_with('#')).collect()
}

/// Returns the crates of the workspace among `names`, without their common prefix.
fn of_the_house(names: &BTreeSet<String>) -> BTreeSet<String> {
    names.iter().filter_map(|name| member_called(name, "burgeon-")).map(str::to_owned).collect()
}

/// Returns the member of a crate's name: the main crate, or the name behind the common prefix.
fn member_called<'a>(name: &'a str, prefix: &str) -> Option<&'a str> {
    if name == "burgeon" { Some(name) } else { name.strip_prefix(prefix) }
}

/// Returns a dependency cycle, if there is one.
fn circle(uses: &Uses) -> Option<Vec<String>> {
    fn walk<'a>(uses: &'a Uses, way: &mut Vec<&'a str>, done: &mut BTreeSet<&'a str>) -> bool {
        let last = way[way.len() - 1];
        for next in uses.get(last).into_iter().flatten() {
            if way.contains(&next.as_str()) {
                way.push(next);
                return true;
            }
            if !done.contains(next.as_str()) {
                way.push(next);
                if walk(uses, way, done) {
                    return true;
                }
                way.pop();
            }
        }
        done.insert(last);
        false
    }
    let mut done = BTreeSet::new();
    uses.keys().find_map(|name| {
        let mut way = vec![name.as_str()];
        walk(uses, &mut way, &mut done).then(|| way.into_iter().map(str::to_owned).collect())
    })
}

/// Returns which folders of a crate's `src` use which others.
fn folders(member: &str) -> Uses {
    let folder = root().join("crates").join(member).join("src");
    let sources = Source::all(&folder);
    let names = fs::read_dir(&folder).unwrap().filter_map(|entry| {
        let path = entry.unwrap().path();
        path.is_dir().then(|| path.file_name().unwrap().to_string_lossy().into_owned())
    });
    let mut uses: Uses = names.map(|name| (name, BTreeSet::new())).collect();
    for source in sources {
        let Some(own) = source.module.first().filter(|own| uses.contains_key(*own)) else { continue };
        for path in source.inner_paths() {
            if let Some(other) = path.first().filter(|other| *other != own && uses.contains_key(*other)) {
                uses.get_mut(own).unwrap().insert(other.clone());
            }
        }
    }
    uses
}

#[test]
fn members_use_those_that_stand_before_them_in_the_drawn_map() {
    let (order, drawn) = drawn();
    let known: BTreeSet<String> = members().into_iter().chain(["burgeon".to_owned()]).collect();
    assert_eq!(order.iter().cloned().collect::<BTreeSet<_>>(), known, "the map and crates/ differ");
    for (place, member) in order.iter().enumerate() {
        let folder = if member == "burgeon" { root() } else { root().join("crates").join(member) };
        let built = of_the_house(&section(&text(folder.join("Cargo.toml")), "dependencies"));
        assert_eq!(drawn[member], built, "{member}: the map in src/lib.rs and its Cargo.toml differ");
        for used in &drawn[member] {
            assert!(order[..place].contains(used), "{member} uses {used}, which does not stand before it");
        }
        let named: BTreeSet<String> = Source::all(&folder.join("src"))
            .iter()
            .flat_map(|source| paths(&source.code))
            .filter_map(|path| Some(member_called(&path[0], "burgeon_")?.to_owned()))
            // The main crate uses its own API by its name, and texts for users mention it.
            .filter(|name| name != "burgeon" || built.contains(name))
            .collect();
        assert_eq!(drawn[member], named, "{member}: the map in src/lib.rs and its `use` lines differ");
    }
    assert_eq!(circle(&drawn), None);
}

#[test]
fn a_circle_is_found() {
    let uses = |pairs: &[(&str, &str)]| -> Uses {
        let mut uses = Uses::new();
        for (user, used) in pairs {
            uses.entry((*user).to_owned()).or_default().insert((*used).to_owned());
        }
        uses
    };
    assert_eq!(circle(&uses(&[("a", "b"), ("a", "c"), ("b", "c")])), None);
    assert_eq!(circle(&uses(&[("a", "b"), ("b", "c"), ("c", "b")])).unwrap(), ["a", "b", "c", "b"]);
}

#[test]
fn folders_of_the_engine_use_only_those_that_stand_before_them_in_the_page_for_contributors() {
    let page = text("CONTRIBUTING.md");
    let (_, stated) = page.split_once("folders use only those before them: ").unwrap();
    let (stated, _) = stated.split_once("\n\n").unwrap();
    let uses = folders("engine");
    let order: Vec<String> = quoted(stated).into_iter().filter(|name| !name.contains('/')).collect();
    assert_eq!(order.iter().collect::<BTreeSet<_>>(), uses.keys().collect::<BTreeSet<_>>(), "{stated}");
    for (place, folder) in order.iter().enumerate() {
        for used in &uses[folder] {
            assert!(order[..place].contains(used), "{folder} uses {used}, which does not stand before it");
        }
    }
}

#[test]
fn no_circle_leads_through_the_rooms_of_a_member() {
    for member in members() {
        let rooms = rooms(&root().join("crates").join(&member).join("src"));
        assert!(!rooms.is_empty(), "{member}");
        assert_eq!(circle(&rooms), None, "{member}");
    }
}

#[test]
fn a_member_names_the_crates_that_it_uses_and_no_others() {
    let own = members().into_iter().map(|member| Path::new("crates").join(member));
    for folder in own.chain([PathBuf::new()]) {
        let manifest = text(folder.join("Cargo.toml"));
        let sources = Source::all(&root().join(&folder).join("src"));
        let own: BTreeSet<&String> = sources.iter().filter_map(|source| source.module.first()).collect();
        let code: Vec<Vec<String>> = sources
            .iter()
            .flat_map(|source| {
                let mut paths = paths(&source.code);
                // In the root of a crate, its own modules take precedence over crates of the same name.
                paths.retain(|path| !source.module.is_empty() || !own.contains(&path[0]));
                paths
            })
            .collect();
        let mut tests: String =
            sources.iter().flat_map(|source| [source.tests.as_str(), &source.comments]).collect();
        let mut files = Vec::new();
        let folders = ["tests", "benches", "examples"].map(|name| root().join(&folder).join(name));
        folders
            .iter()
            .filter(|folder| folder.is_dir())
            .for_each(|folder| sources::collect(folder, "rs", &mut files));
        files.iter().for_each(|file| tests += &text(file));
        let tests = paths(&tests);
        let used = |paths: &[Vec<String>], name: &str| {
            let name = name.replace('-', "_");
            paths.iter().any(|path| path[0] == name)
        };
        let dependencies = section(&manifest, "dependencies");
        let none = |what: &str, wrong: Vec<&String>| {
            assert_eq!(wrong, [""; 0], "{}: {what}", folder.join("Cargo.toml").display());
        };
        let unused = dependencies.iter().filter(|name| !used(&code, name));
        none("dependencies that nobody uses, or only tests", unused.collect());
        let of_tests = section(&manifest, "dev-dependencies");
        none("dependencies twice", of_tests.intersection(&dependencies).collect());
        none("no test uses", of_tests.iter().filter(|name| !used(&tests, name)).collect());
    }
}

#[test]
fn the_engine_knows_no_type_of_object_by_name() {
    let registry = burgeon::registry();
    let kinds: BTreeSet<&str> = registry
        .kinds()
        .filter(|kind| !matches!(kind.construct, Construct::Given))
        .map(|kind| &*kind.name)
        .collect();
    let exported = text("crates/objects/src/lib.rs");
    let structs: BTreeSet<&str> = exported
        .lines()
        .filter_map(|line| line.strip_prefix("pub use "))
        .flat_map(words)
        .filter(|word| word.starts_with(char::is_uppercase))
        .collect();
    for name in ["Extruder", "Turtle", "Footprint", "Facade", "Terrain", "Planet", "Elevation", "Universe"] {
        assert!(structs.contains(name) && kinds.contains(&*name.to_lowercase()), "{name} is found");
    }
    let mut prelude = Vec::new();
    sources::collect(&root().join("crates/engine/src"), "luau", &mut prelude);
    assert!(!prelude.is_empty());
    let lua = prelude.into_iter().map(|path| {
        let text = text(&path);
        let code: Vec<String> =
            text.lines().map(|line| line.split("--").next().unwrap_or_default().to_owned()).collect();
        (path, code.join("\n"))
    });
    let rust = Source::all(&root().join("crates/engine/src")).into_iter().map(|it| (it.path, it.code));
    for (path, code) in rust.chain(lua) {
        let named: Vec<&str> = words(&code).filter(|word| structs.contains(word)).collect();
        assert_eq!(named, [""; 0], "{}", path.display());
        // A type name can be an ordinary word; in quotes it refers to the type.
        let meant = kinds.iter().filter(|kind| code.contains(&format!("\"{kind}\"")));
        assert_eq!(meant.collect::<Vec<_>>(), [&""; 0], "{}", path.display());
    }
}

#[test]
fn members_print_nothing() {
    for member in members() {
        for source in Source::all(&root().join("crates").join(&member).join("src")) {
            for printing in ["print!", "println!", "eprint!", "eprintln!", "dbg!"] {
                let mut found = source.code.match_indices(printing).map(|(at, _)| &source.code[..at]);
                let whole = |before: &str| !before.ends_with(|c: char| c.is_alphanumeric() || c == '_');
                assert!(!found.any(whole), "{}: {printing}", source.path.display());
            }
        }
    }
}

#[test]
fn each_member_has_a_front_page_that_says_what_comes_in_what_goes_out_and_what_it_never_does() {
    for member in members() {
        let front = text(format!("crates/{member}/src/lib.rs"));
        let page: String = front.lines().map_while(|line| line.strip_prefix("//!")).collect();
        for words in ["Input: ", "Output: ", " never "] {
            assert!(page.contains(words), "crates/{member}/src/lib.rs does not say what {words:?}");
        }
    }
}

#[test]
fn the_oldest_rust_is_the_same_wherever_it_is_stated() {
    let manifest = text("Cargo.toml");
    let oldest =
        manifest.lines().find_map(|line| line.strip_prefix("rust-version = ")).unwrap().trim_matches('"');
    for file in ["README.md", ".ci/run"] {
        assert!(text(file).contains(&format!("Rust {oldest}")), "{file} does not name Rust {oldest}");
    }
    for member in members() {
        let member = format!("crates/{member}");
        let manifest = text(format!("{member}/Cargo.toml"));
        for inherited in
            ["rust-version.workspace = true", "license.workspace = true", "[lints]\nworkspace = true"]
        {
            assert!(manifest.contains(inherited), "{member}/Cargo.toml has not {inherited:?}");
        }
    }
}

/// Returns the text between backquotes in a page, without code blocks.
fn quoted(page: &str) -> Vec<String> {
    let plain: String = page.split("```").step_by(2).collect();
    plain.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

#[test]
fn the_page_for_those_who_change_burgeon_names_what_is_there() {
    let page = text("CONTRIBUTING.md");
    let (order, drawn) = drawn();
    let rows = page.lines().filter_map(|line| line.strip_prefix("| `")?.split_once("` | "));
    let rows: Vec<(&str, BTreeSet<String>)> = rows
        .map(|(name, rest)| {
            let uses = rest.split(" | ").next().unwrap_or_default().split(", ").map(str::to_owned);
            (name, uses.filter(|name| name != "nothing").collect())
        })
        .collect();
    let expected = order.iter().filter(|name| *name != "burgeon");
    assert_eq!(rows, expected.map(|name| (name.as_str(), drawn[name].clone())).collect::<Vec<_>>());

    let mut files = Vec::new();
    for folder in ["src", "crates", "tests", "benches", "examples", "fuzz"] {
        sources::collect(&root().join(folder), "rs", &mut files);
    }
    let code: String = files.iter().map(text).collect();
    let known: BTreeSet<&str> = words(&code).collect();
    let members: Vec<PathBuf> =
        members().into_iter().map(|member| Path::new("crates").join(member)).collect();
    for name in quoted(&page) {
        if name.contains(['"', ' ', '=']) || name.contains("NAME") {
            continue;
        }
        if name.contains('/') {
            // Long paths are relative to the root or to `crates`; short paths are relative to the sources of
            // a crate.
            let inner = members.iter().map(|member| member.join("src").join(&name));
            let mut all = inner.chain([PathBuf::from(&name), Path::new("crates").join(&name)]);
            assert!(all.any(|path| root().join(path).exists()), "there is no {name}");
        } else if !name.contains('.') && name.contains(|c: char| c.is_ascii_uppercase() || "_:".contains(c)) {
            for word in words(&name) {
                assert!(known.contains(word), "{name} is nowhere in the code");
            }
        }
    }
}
