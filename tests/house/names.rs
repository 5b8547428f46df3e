//! A type name is unique in the tree, and is a noun.

use std::collections::BTreeMap;

use crate::sources::{Source, words};
use crate::{members, root};

/// Type declaration in a file.
struct Declaration {
    name: String,
    /// Path of the file.
    place: String,
}

/// Returns the names of the types that `code` declares, without associated types of traits.
fn declarations(code: &str) -> Vec<String> {
    let mut found = Vec::new();
    for line in code.lines() {
        let mut rest = line.trim_start();
        if let Some(behind) = rest.strip_prefix("pub") {
            rest = behind.trim_start();
            if let Some((_, behind)) = rest.strip_prefix('(').and_then(|within| within.split_once(')')) {
                rest = behind.trim_start();
            }
        }
        rest = rest.strip_prefix("unsafe ").unwrap_or(rest);
        let Some((keyword, rest)) = rest.split_once(' ') else { continue };
        // An indented `type` belongs to a trait.
        let declares = match keyword {
            "struct" | "enum" | "trait" | "union" => true,
            "type" => !line.starts_with(' '),
            _ => false,
        };
        if let Some(name) = words(rest).next().filter(|_| declares) {
            found.push(name.to_owned());
        }
    }
    found
}

/// Returns all types of the program and the crates. A file `absent.rs` or `absent_open.rs` declares the same types as another
/// file, for a build without a feature, so it is skipped.
fn all() -> Vec<Declaration> {
    let folders = members().into_iter().map(|member| root().join("crates").join(member).join("src"));
    let mut found = Vec::new();
    for source in folders.chain([root().join("src")]).flat_map(|folder| Source::all(&folder)) {
        let file = source.path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        if file == "absent.rs" || file == "absent_open.rs" {
            continue;
        }
        for code in [&source.code, &source.tests] {
            found.extend(declarations(code).into_iter().map(|name| {
                let place = source.path.strip_prefix(root()).unwrap().display().to_string();
                Declaration { name, place }
            }));
        }
    }
    assert!(found.len() > 400, "{} types", found.len());
    found
}

#[test]
fn the_name_of_a_type_is_found_once_in_the_tree() {
    let mut places: BTreeMap<String, Vec<Declaration>> = BTreeMap::new();
    for declaration in all() {
        places.entry(declaration.name.clone()).or_default().push(declaration);
    }
    let twice: Vec<String> = places
        .iter()
        .filter(|(_, those)| those.len() > 1)
        .map(|(name, those)| {
            let places: Vec<&str> = those.iter().map(|one| one.place.as_str()).collect();
            format!("{name}: {}", places.join(", "))
        })
        .collect();
    assert!(twice.is_empty(), "a compound of subject and thing tells them apart:\n{}", twice.join("\n"));
}

/// Participles with irregular endings, and other words that are not nouns.
const NO_NOUNS: [&str; 45] = [
    "Above", "Across", "After", "Ahead", "Alone", "Apart", "Around", "Before", "Behind", "Beyond", "Built",
    "Complain", "Drawn", "Due", "Eager", "Found", "Frozen", "Given", "Held", "Hidden", "Holds", "Into",
    "Kept", "Known", "Laid", "Left", "Lost", "Made", "Meant", "Now", "One", "Outward", "Over", "Put", "Ran",
    "Read", "Seen", "Sent", "Shown", "Sold", "Sure", "Taken", "Told", "What", "Which",
];

/// Returns the last word of a name: `Ring` for `NamedRing`.
fn last_word(name: &str) -> &str {
    &name[name.rfind(char::is_uppercase).unwrap_or(0)..]
}

#[test]
fn types_are_called_by_nouns_and_not_by_participles() {
    let mut wrong = Vec::new();
    for Declaration { name, place, .. } in all() {
        let word = last_word(&name);
        // `Expected` is a participle; `Seed` is a noun.
        let is_participle = word.len() > 4 && ["ed", "tten"].iter().any(|end| word.ends_with(end));
        if is_participle || NO_NOUNS.contains(&word) {
            wrong.push(format!("{name}: {place}"));
        }
    }
    assert!(wrong.is_empty(), "a type is a thing, and so is its name:\n{}", wrong.join("\n"));
}

#[test]
fn declarations_are_found_however_widely_they_are_seen() {
    let code = "pub struct A;\n    pub(in crate::b) enum C {}\nunion D {}\npub unsafe trait E<F> {}\n\
                impl G for H {\n    type I = J;\n}\npub(super) type K<'a> = L;\nlet m = \"struct N\";\n";
    let found = declarations(code);
    assert_eq!(found, ["A", "C", "D", "E", "K"]);
    assert_eq!(last_word("NamedRing"), "Ring");
}
