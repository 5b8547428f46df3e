//! Human-readable output of `burgeon api`.

use std::fmt::Write as _;
use std::path::Path;

use super::entry::{Entry, EntryGroup, Member, MemberKind};

/// Maximum length of a line.
const WIDTH: usize = 100;

/// Lists all names, each with the first sentence of its doc; with a `script`, the names that it declares.
pub(super) fn list(entries: &[Entry], script: Option<&Path>) -> String {
    let mut text = String::new();
    for (group, title) in [
        (EntryGroup::Type, "Object types"),
        (EntryGroup::Global, "Functions and values"),
        (EntryGroup::Module, "Built-in modules"),
        (EntryGroup::Given, "Data types"),
        (EntryGroup::Luau, "Luau built-ins"),
    ] {
        let of_group = || entries.iter().filter(|entry| entry.group == group);
        if of_group().next().is_none() {
            continue;
        }
        let widest = of_group().map(|entry| entry.name.chars().count()).max().unwrap_or(0);
        // Writing into a string cannot fail.
        let _ = writeln!(text, "{title}");
        for entry in of_group() {
            let _ = writeln!(text, "  {:widest$}  {}", entry.name, summary(&entry.doc));
        }
        text.push('\n');
    }
    let flag = script.map_or_else(String::new, |script| format!(" --script {}", script.display()));
    match (script, entries.first()) {
        (Some(script), None) => {
            let _ = writeln!(text, "{} neither declares nor extends an object type", script.display());
        }
        (Some(_), Some(Entry { name, .. })) => {
            let _ = writeln!(text, "Run burgeon api{flag} NAME for details, such as {name}");
        }
        (None, _) => {
            text.push_str("Run burgeon api NAME for details, such as extruder or extruder:extrude\n")
        }
    }
    text
}

/// Describes one name completely.
pub(super) fn entry(entry: &Entry) -> String {
    let mut text = String::new();
    let _ = writeln!(text, "{}", if entry.usage.is_empty() { &entry.name } else { &entry.usage });
    wrap(&mut text, &entry.doc, 2);
    for (what, title) in [
        (MemberKind::Field, "Fields"),
        (MemberKind::Declares, "Methods"),
        (MemberKind::Function, "Functions"),
        (MemberKind::Reads, "Read methods: rules and interpretations can call them"),
        (MemberKind::Changes, "Write methods: only interpretations can call them"),
    ] {
        for (index, member) in entry.members(what).enumerate() {
            if index == 0 {
                let _ = writeln!(text, "\n{title}");
            }
            brief(&mut text, &entry.name, member);
        }
    }
    example(&mut text, &entry.example);
    text
}

/// Writes an example script, if there is one.
fn example(text: &mut String, script: &str) {
    if !script.is_empty() {
        text.push_str("\nExample\n");
    }
    for line in script.trim_end().lines() {
        // Writing into a string cannot fail.
        let _ = writeln!(text, "  {line}");
    }
}

/// Describes a field or a method; `owner` is the name of its owner.
pub(super) fn member(owner: &str, member: &Member) -> String {
    let separator = member.what.separator();
    let usage = member.usage();
    let mut text: String = usage.lines().map(|line| format!("{owner}{separator}{line}\n")).collect();
    wrap(&mut text, &member.doc, 2);
    match member.what {
        MemberKind::Field | MemberKind::Declares | MemberKind::Function => {}
        MemberKind::Reads => wrap(&mut text, "Read method: rules and interpretations can call it.", 2),
        MemberKind::Changes => wrap(&mut text, "Write method: only interpretations can call it.", 2),
    }
    example(&mut text, &member.example);
    for (index, field) in member.fields.iter().enumerate() {
        if index == 0 {
            text.push_str("\nFields of its table\n");
        }
        brief(&mut text, &member.full_name(owner), field);
    }
    text
}

/// Writes a member in a list, with a command that describes the fields of its table.
fn brief(text: &mut String, owner: &str, member: &Member) {
    for line in member.usage().lines() {
        let _ = writeln!(text, "  {line}");
    }
    wrap(text, &member.doc, 6);
    if !member.fields.is_empty() {
        let _ = writeln!(text, "      Its fields: burgeon api {}", member.full_name(owner));
    }
}

/// Returns the first sentence of a doc.
fn summary(doc: &str) -> String {
    let text = doc.lines().map(str::trim).collect::<Vec<_>>().join(" ");
    match text.split_once(". ") {
        Some((first, _)) => format!("{first}."),
        None => text,
    }
}

/// Appends a doc, wrapped into lines that begin with `indent` spaces.
fn wrap(text: &mut String, doc: &str, indent: usize) {
    let mut line = String::new();
    for word in doc.split_whitespace() {
        if !line.is_empty() && indent + line.chars().count() + 1 + word.chars().count() > WIDTH {
            let _ = writeln!(text, "{:indent$}{line}", "");
            line.clear();
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
    }
    let _ = writeln!(text, "{:indent$}{line}", "");
}
