//! What `burgeon api` prints for people.

use std::fmt::Write as _;

use super::entry::{Entry, Group, Member, What};

/// The longest line of a doc.
const WIDTH: usize = 100;

/// All names, each with the first sentence of its doc.
pub(super) fn list(entries: &[&Entry]) -> String {
    let mut text = String::new();
    for (group, title) in [
        (Group::Type, "Types of objects"),
        (Group::Global, "Functions and values"),
        (Group::Module, "Modules that come with a meaning"),
        (Group::Given, "What these give and take"),
        (Group::Luau, "Luau itself"),
    ] {
        let of_group = || entries.iter().filter(|entry| entry.group == group);
        let widest = of_group().map(|entry| entry.name.chars().count()).max().unwrap_or(0);
        // Writing into a string cannot fail.
        let _ = writeln!(text, "{title}");
        for entry in of_group() {
            let _ = writeln!(text, "  {:widest$}  {}", entry.name, summary(&entry.doc));
        }
        text.push('\n');
    }
    text.push_str("burgeon api NAME tells more of one, such as extruder or extruder:extrude\n");
    text
}

/// All of one name.
pub(super) fn entry(entry: &Entry) -> String {
    let mut text = String::new();
    let _ = writeln!(text, "{}", if entry.usage.is_empty() { &entry.name } else { &entry.usage });
    wrap(&mut text, &entry.doc, 2);
    for (what, title) in [
        (What::Field, "Fields"),
        (What::Declares, "Methods"),
        (What::Reads, "Methods that read: rules and interpretations may call them"),
        (What::Changes, "Methods that change it: only interpretations may call them"),
    ] {
        for (index, member) in entry.members(what).enumerate() {
            if index == 0 {
                let _ = writeln!(text, "\n{title}");
            }
            let _ = writeln!(text, "  {}", member.usage());
            wrap(&mut text, &member.doc, 6);
        }
    }
    if !entry.example.is_empty() {
        text.push_str("\nExample\n");
        for line in entry.example.trim_end().lines() {
            let _ = writeln!(text, "  {line}");
        }
    }
    text
}

/// A field or a method by itself.
pub(super) fn member(owner: &Entry, member: &Member) -> String {
    let separator = if member.what == What::Field { '.' } else { ':' };
    let mut text = format!("{}{separator}{}\n", owner.name, member.usage());
    wrap(&mut text, &member.doc, 2);
    let may = match member.what {
        What::Field | What::Declares => return text,
        What::Reads => "It only reads: rules and interpretations may call it.",
        What::Changes => "It changes the object: only interpretations may call it.",
    };
    wrap(&mut text, may, 2);
    text
}

/// The first sentence of a doc.
fn summary(doc: &str) -> String {
    let text = doc.lines().map(str::trim).collect::<Vec<_>>().join(" ");
    text.split_once(". ").map_or(text.clone(), |(first, _)| format!("{first}."))
}

/// Adds a doc in lines that begin with `indent` spaces.
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
