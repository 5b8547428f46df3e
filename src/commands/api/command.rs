//! Command `api`.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::entry::{Entry, Member};
use super::{book, pictures, text};
use crate::commands::report;
use crate::commands::shared::user_mods;
use burgeon::kit::{Kind, Registry};
use burgeon::language::{definitions, names, with_types};
use burgeon::script::{RunInputs, RunOptions};
use burgeon::{Error, Result};
use clap::Args;
use serde_json::json;

/// Shows the scripting API: types of objects with their fields and methods, functions and modules
#[derive(Args)]
pub(crate) struct ApiCommand {
    /// Item to describe, such as extruder, extruder:extrude or extruder.sides [default: list all]
    name: Option<String>,

    /// Includes the object types that this script declares, and the methods that it adds to others
    #[arg(long, value_name = "FILE")]
    script: Option<PathBuf>,

    /// Adds a folder of packages, or one package; may be repeated
    #[arg(long, value_name = "FOLDER", requires = "script")]
    mods: Vec<PathBuf>,

    /// Prints the definition file for luau-lsp, for editors
    #[arg(long, conflicts_with_all = ["name", "json"])]
    luau: bool,

    /// Writes the pages of the reference into the sources of this mdBook, such as docs/book
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["name", "json", "luau", "script"])]
    book: Option<PathBuf>,

    /// Also draws the pictures of the reference whose examples have changed
    #[arg(long, requires = "book")]
    pictures: bool,

    /// Prints machine-readable JSON instead of text
    #[arg(long)]
    json: bool,
}

impl ApiCommand {
    pub(crate) fn json(&self) -> bool {
        self.json
    }

    pub(crate) fn run(&self) -> Result<()> {
        if self.luau {
            let own = self.script.as_deref().map(|script| self.declared(script)).transpose()?;
            let registry = with_types(&burgeon::registry(), own.unwrap_or_default());
            return report::print(&definitions(&registry).luau);
        }
        let registry = burgeon::registry();
        let own = self.script.as_deref().map(|script| self.declared(script)).transpose()?;
        let with_own = |own: &[Arc<Kind>]| -> Registry {
            let others = registry.kinds().filter(|kind| !own.iter().any(|it| it.name == kind.name));
            others.chain(own).map(Arc::clone).collect()
        };
        let entries = match (&own, &self.name) {
            (None, _) => entries(&registry),
            (Some(own), Some(_)) => entries(&with_own(own)),
            (Some(own), None) => own.iter().map(|kind| Entry::of_kind(kind)).collect(),
        };
        if let Some(folder) = &self.book {
            write_book(folder, &entries)?;
            return match self.pictures {
                true => pictures::draw(&folder.join("src/reference")),
                false => Ok(()),
            };
        }
        let found = self.name.as_deref().map(|name| find(&entries, name)).transpose()?;
        report::print(&if self.json {
            let documents: Vec<_> = match &found {
                None => entries.iter().map(Entry::to_json).collect(),
                Some(ApiSubject::Entry(entry)) => vec![entry.to_json()],
                Some(ApiSubject::Member((owner, member))) => vec![member.to_json(owner)],
            };
            format!("{}\n", json!({ "ok": true, "entries": documents }))
        } else {
            match &found {
                None => text::list(&entries, self.script.as_deref()),
                Some(ApiSubject::Entry(entry)) => text::entry(entry),
                Some(ApiSubject::Member((owner, member))) => text::member(owner, member),
            }
        })
    }
}

impl ApiCommand {
    /// Returns the object types that `script` declares, and the types that it extends.
    fn declared(&self, script: &Path) -> Result<Vec<Arc<Kind>>> {
        let inputs = RunInputs { mods: self.mods.clone(), user_mods: user_mods(), ..RunInputs::default() };
        let options = RunOptions { inputs, ..burgeon::options() };
        Ok(burgeon::check(script, options)?.types)
    }
}

/// Writes the pages of the reference that have changed.
fn write_book(folder: &Path, entries: &[Entry]) -> Result<()> {
    for (file, text) in book::pages(entries) {
        let path = folder.join("src").join(file);
        if std::fs::read_to_string(&path).is_ok_and(|known| known == text) {
            continue;
        }
        let refuse = |error: std::io::Error| {
            Error::file(&path, format!("cannot write {}: {error}", path.display()))
                .help("choose another folder")
        };
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).map_err(refuse)?;
        }
        std::fs::write(&path, text).map_err(refuse)?;
        report::eprint(&format!("wrote {}\n", path.display()));
    }
    Ok(())
}

/// Returns all names and members for the editor of the live page as JSON: a list of `{ name, owner, usage, doc }`.
#[cfg(feature = "live")]
pub(crate) fn names_json() -> String {
    let described = |name: &str, owner: &str, usage: &str, doc: &str| json!({ "name": name, "owner": owner, "usage": usage, "doc": doc });
    let registry = burgeon::registry();
    let all = entries(&registry).into_iter().flat_map(|entry| {
        let members = entry.members.iter().map(|member| {
            let owner = format!("{}{}", entry.name, member.what.separator());
            described(&member.name, &owner, &member.usage(), &member.doc)
        });
        let members: Vec<_> = members.collect();
        std::iter::once(described(&entry.name, "", &entry.usage, &entry.doc)).chain(members)
    });
    serde_json::Value::Array(all.collect()).to_string()
}

/// Returns everything that scripts can use, sorted by group and name.
pub(super) fn entries(registry: &Registry) -> Vec<Entry> {
    let types = registry.kinds().map(|kind| Entry::of_kind(kind));
    let mut entries: Vec<Entry> =
        types.chain(names().iter().map(|name| Entry::of_name(name, registry))).collect();
    entries.sort_by_cached_key(|entry| (entry.group, entry.name.to_lowercase()));
    entries
}

/// Item to describe.
enum ApiSubject<'a> {
    Entry(&'a Entry),
    /// Field or method, with the full name of its owner.
    Member((String, &'a Member)),
}

/// Finds the item called `name`.
fn find<'a>(entries: &'a [Entry], name: &str) -> Result<ApiSubject<'a>> {
    if let Some(entry) = entries.iter().find(|entry| entry.name == name) {
        return Ok(ApiSubject::Entry(entry));
    }
    // The name of a package's type also contains a dot.
    let ends = name.match_indices([':', '.']).map(|(end, _)| end);
    for end in ends {
        if let Some(entry) = entries.iter().find(|entry| entry.name == name[..end]) {
            return within(&entry.name, &entry.members, &name[end..]).map(ApiSubject::Member);
        }
    }
    let message = format!("unknown name `{name}`");
    // A user who enters only the name of a method wants to know its owner.
    let owners: Vec<String> = entries
        .iter()
        .flat_map(|entry| entry.members.iter().map(move |member| (entry, member)))
        .filter(|(_, member)| member.name == name)
        .map(|(entry, member)| member.full_name(&entry.name))
        .collect();
    if !owners.is_empty() {
        return Err(
            Error::not_found("name", name, [], message).help(format!("there is {}", owners.join(", ")))
        );
    }
    let full: Vec<String> = entries
        .iter()
        .flat_map(|entry| entry.members.iter().map(|member| member.full_name(&entry.name)))
        .collect();
    let known = entries.iter().map(|entry| entry.name.as_str()).chain(full.iter().map(String::as_str));
    Err(Error::not_found("name", name, known, message).help("run burgeon api to list all names"))
}

/// Finds the member of `members` at `path`, such as `:roof.details`, and the full name of its owner.
fn within<'a>(owner: &str, members: &'a [Member], path: &str) -> Result<(String, &'a Member)> {
    let (separator, path) = path.split_at(1);
    let (inner, rest) = path.split_at(path.find([':', '.']).unwrap_or(path.len()));
    let full = format!("{owner}{separator}{inner}");
    // A field and a method may have the same name. If there is only one of them, the separator is ignored.
    let is_meant = |member: &&Member| member.name == inner && member.full_name(owner) == full;
    let found = members.iter().find(is_meant).or_else(|| members.iter().find(|member| member.name == inner));
    match found {
        Some(member) if rest.is_empty() => Ok((owner.to_owned(), member)),
        Some(member) => within(&member.full_name(owner), &member.fields, rest),
        None => {
            let mut names: Vec<&str> = members.iter().map(|member| member.name.as_str()).collect();
            names.sort_unstable();
            names.dedup();
            let help = match names.as_slice() {
                [] => "no fields or methods",
                names => &names.join(", "),
            };
            let help = format!("it has {help}");
            let message = format!("unknown field or method `{inner}` of {owner}");
            Err(Error::not_found("name", inner, names, message).help(help))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::entry;
    use super::*;

    /// Counts the members, including nested ones.
    fn check(entries: &[Entry], owner: &str, members: &[Member]) -> usize {
        let mut count = 0;
        for member in members {
            let name = member.full_name(owner);
            assert!(member.doc.ends_with('.') && member.doc.len() > 8, "{name}: {}", member.doc);
            let mut arguments = member.forms.iter().flat_map(|form| &form.arguments);
            assert!(!arguments.any(|argument| argument.luau.is_empty()), "{name}");
            let ApiSubject::Member((has, found)) = find(entries, &name).unwrap() else { panic!("{name}") };
            assert!(std::ptr::eq(found, member) && has == owner, "{name}");
            count += 1 + check(entries, &name, &member.fields);
        }
        count
    }

    #[test]
    fn every_name_that_is_told_of_has_a_doc() {
        let entries = entries(&burgeon::registry());
        assert!(entries.len() > 80, "{}", entries.len());
        let mut members = 0;
        for entry in &entries {
            let is_luau = entry.group == entry::EntryGroup::Luau;
            let is_part = entry.group == entry::EntryGroup::Type && entry.usage.is_empty();
            assert!(is_luau || is_part || !entry.example.is_empty(), "{} has no example", entry.name);
            for member in entry.members.iter().filter(|member| member.what != entry::MemberKind::Field) {
                let name = member.full_name(&entry.name);
                assert!(is_luau || !member.example.is_empty(), "{name} has no example");
            }
            assert!(entry.doc.ends_with('.') && entry.doc.len() > 15, "{}: {}", entry.name, entry.doc);
            members += check(&entries, &entry.name, &entry.members);
        }
        assert!(members > 400, "{members}");
    }
}
