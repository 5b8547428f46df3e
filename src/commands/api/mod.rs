//! `burgeon api`: what scripts can use, from the same declarations that install it.

mod entry;
mod text;

use burgeon::kit::Registry;
use burgeon::{Error, Result, script};
use clap::Args;
use serde_json::json;

use super::report;
use entry::{Entry, Member};

/// Tells what scripts can use: types of objects with their fields and methods, functions and modules
#[derive(Args)]
pub(crate) struct Api {
    /// One of them, such as extruder, extruder:extrude or extruder.sides; a list of all if left out
    name: Option<String>,

    /// Prints one JSON document, for machines, in place of text for people
    #[arg(long)]
    json: bool,
}

impl Api {
    pub(crate) fn json(&self) -> bool {
        self.json
    }

    pub(crate) fn run(&self) -> Result<()> {
        let entries = entries(&burgeon::objects::registry());
        let (shown, member) = match &self.name {
            None => (entries.iter().collect(), None),
            Some(name) => {
                let (entry, member) = find(&entries, name)?;
                (vec![entry], member)
            }
        };
        report::print(&if self.json {
            let documents: Vec<_> = match member {
                Some(member) => shown.iter().map(|entry| member.to_json(entry)).collect(),
                None => shown.iter().map(|entry| entry.to_json()).collect(),
            };
            format!("{}\n", json!({ "ok": true, "entries": documents }))
        } else {
            match (shown.as_slice(), member) {
                ([entry], Some(member)) => text::member(entry, member),
                ([entry], None) => text::entry(entry),
                (all, _) => text::list(all),
            }
        })
    }
}

/// All that scripts can use, by name.
fn entries(registry: &Registry) -> Vec<Entry> {
    let types = registry.kinds().map(|kind| Entry::of_kind(kind));
    let names = script::names();
    let mut entries: Vec<Entry> =
        types.chain(names.iter().map(|name| Entry::of_name(name, registry))).collect();
    entries.sort_by_cached_key(|entry| (entry.group, entry.name.to_lowercase()));
    entries
}

/// The entry called `name`, or the one that has it as a field or a method.
fn find<'a>(entries: &'a [Entry], name: &str) -> Result<(&'a Entry, Option<&'a Member>)> {
    if let Some(entry) = entries.iter().find(|entry| entry.name == name) {
        return Ok((entry, None));
    }
    if let Some((owner, inner)) = name.split_once([':', '.'])
        && let Some(entry) = entries.iter().find(|entry| entry.name == owner)
    {
        let known = || entry.members.iter().map(|member| member.name.as_str());
        let mut called = entry.members.iter().filter(|member| member.name == inner);
        // A field and a method may have one name; one of them alone is meant, whatever stands before it.
        let found = called.clone().find(|member| member.full_name(entry) == name).or_else(|| called.next());
        return found.map(|member| (entry, Some(member))).ok_or_else(|| {
            let message = format!("{owner} has no field or method called {inner}");
            let mut names: Vec<&str> = known().collect();
            names.sort_unstable();
            names.dedup();
            let help = if names.is_empty() {
                "it has none".to_owned()
            } else {
                format!("it has {}", names.join(", "))
            };
            Error::not_found("name", inner, known(), message).help(help)
        });
    }
    let message = format!("scripts have nothing called {name}");
    // Whoever gives a method's name alone wants to know whose it is.
    let owners: Vec<String> = entries
        .iter()
        .flat_map(|entry| entry.members.iter().map(move |member| (entry, member)))
        .filter(|(_, member)| member.name == name)
        .map(|(entry, member)| member.full_name(entry))
        .collect();
    if !owners.is_empty() {
        return Err(
            Error::not_found("name", name, [], message).help(format!("there is {}", owners.join(", ")))
        );
    }
    let full: Vec<String> =
        entries.iter().flat_map(|entry| entry.members.iter().map(|member| member.full_name(entry))).collect();
    let known = entries.iter().map(|entry| entry.name.as_str()).chain(full.iter().map(String::as_str));
    Err(Error::not_found("name", name, known, message).help("burgeon api lists all names"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_that_is_told_of_has_a_doc() {
        let entries = entries(&burgeon::objects::registry());
        assert!(entries.len() > 80, "{}", entries.len());
        let mut members = 0;
        for entry in &entries {
            let has_example = entry.usage.is_empty() || !entry.example.is_empty();
            assert!(has_example || entry.group != entry::Group::Type, "{}", entry.name);
            assert!(entry.doc.ends_with('.') && entry.doc.len() > 15, "{}: {}", entry.name, entry.doc);
            for member in &entry.members {
                members += 1;
                let name = member.full_name(entry);
                assert!(member.doc.ends_with('.') && member.doc.len() > 8, "{name}: {}", member.doc);
                assert!(!member.arguments.iter().any(|argument| argument.luau.is_empty()), "{name}");
                let found = find(&entries, &name).unwrap().1.unwrap();
                assert!(std::ptr::eq(found, member), "{name}");
            }
        }
        assert!(members > 200, "{members}");
    }
}
