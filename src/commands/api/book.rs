//! Pages of the reference in the format of mdBook.

use std::fmt::Write as _;

use super::entry::{Entry, EntryGroup, Member, MemberKind};
use super::pictures::{example_of, file_of};
use burgeon::kit::ScriptExample;
use burgeon::objects::PLAIN_EXAMPLES;

/// Types whose pictures show the axes.
const AXES: [&str; 2] = ["extruder", "turtle"];

/// Page: its file, relative to the book's sources, and its text.
pub(super) type Page = (String, String);

/// Chapters that are written by hand: their titles and files.
const CHAPTERS: [(&str, &str); 29] = [
    ("Contexts and features", "rules"),
    ("Phases, hooks and variables", "phases"),
    ("Environments", "environments"),
    ("Curves and surfaces", "curves"),
    ("Shapes", "shapes"),
    ("Coming from other programs", "coming_from"),
    ("Burgeon for those who know lpfg, L-Py, XL or Houdini", "comparison"),
    ("Drawing, time and files compared", "drawing"),
    ("Porting an lpfg model", "porting"),
    ("Data and heights", "data"),
    ("OpenStreetMap as tagged", "osm"),
    ("SQL queries", "queries"),
    ("SQL", "sql"),
    ("Terrain and planets", "terrain"),
    ("API reference", "objects"),
    ("Street networks", "networks"),
    ("Running scripts", "running"),
    ("Python", "python"),
    ("Pictures", "renders"),
    ("Export formats", "formats"),
    ("Recipes and shared pages", "sharing"),
    ("3D Tiles", "tiles"),
    ("Live view", "live"),
    ("Custom object types", "types"),
    ("Packages", "packages"),
    ("Security", "security"),
    ("Editors", "editors"),
    ("Speed", "speed"),
    ("Code walkthrough", "walkthrough"),
];

/// Page with its subpages: their titles, and their files in the folder of the page.
type BookSection = (&'static str, &'static str, &'static [(&'static str, &'static str)]);

/// Pages for beginners.
const LEARNING: [BookSection; 2] = [
    (
        "Course",
        "course",
        &[
            ("A box", "01_box"),
            ("A column", "02_column"),
            ("A tower", "03_tower"),
            ("A fern", "04_fern"),
            ("A cherry tree", "05_cherry"),
            ("A foxglove", "06_foxglove"),
            ("A house", "07_house"),
            ("A street", "08_street"),
            ("A valley", "09_terrain"),
            ("A city", "10_city"),
        ],
    ),
    (
        "Cookbook",
        "cookbook",
        &[
            ("Rules and randomness", "rules"),
            ("Shapes and materials", "shapes"),
            ("Plants and growth", "plants"),
            ("Buildings", "buildings"),
            ("Land and data", "land"),
        ],
    ),
];

/// Returns the generated pages of the scripting API, and the list of all pages.
pub(super) fn pages(entries: &[Entry]) -> Vec<Page> {
    let mut summary = "# Summary\n\n[Introduction](introduction.md)\n\n# Learning\n\n".to_owned();
    // Writing into a string cannot fail.
    for (title, folder, subpages) in LEARNING {
        let _ = writeln!(summary, "- [{title}]({folder}/README.md)");
        for (title, file) in subpages {
            let _ = writeln!(summary, "  - [{title}]({folder}/{file}.md)");
        }
    }
    summary.push_str("\n# Guide\n\n");
    for (title, file) in CHAPTERS {
        let _ = writeln!(summary, "- [{title}]({file}.md)");
    }
    summary.push_str("\n# Object types\n\n");
    let mut pages = Vec::new();
    for entry in entries.iter().filter(|entry| entry.group == EntryGroup::Type) {
        let _ = writeln!(summary, "- [{0}](reference/{0}.md)", entry.name);
        pages.push((format!("reference/{}.md", entry.name), page(entry)));
    }
    summary.push_str("\n# The language\n\n");
    for (group, file, title) in [
        (EntryGroup::Global, "functions", "Functions and values"),
        (EntryGroup::Module, "modules", "Built-in modules"),
        (EntryGroup::Given, "given", "Data types"),
        (EntryGroup::Luau, "luau", "Luau built-ins"),
    ] {
        let _ = writeln!(summary, "- [{title}](reference/{file}.md)");
        let mut text = format!("{MADE}# {title}\n");
        for entry in entries.iter().filter(|entry| entry.group == group) {
            let _ = writeln!(text, "\n## {}\n", entry.name);
            body(&mut text, entry, 3);
        }
        pages.push((format!("reference/{file}.md"), text));
    }
    pages.push(("SUMMARY.md".to_owned(), summary));
    pages
}

/// Header of each page.
const MADE: &str = "<!-- Written by burgeon api --book: change the declaration in Rust instead. -->\n\n";

fn page(entry: &Entry) -> String {
    let mut text = format!("{MADE}# {}\n\n", entry.name);
    body(&mut text, entry, 2);
    text
}

fn body(text: &mut String, entry: &Entry, level: usize) {
    if !entry.usage.is_empty() {
        let _ = writeln!(text, "```text\n{}\n```\n", entry.usage);
    }
    let _ = writeln!(text, "{}", plain(&entry.doc));
    if !entry.example.is_empty() {
        let _ = writeln!(text, "\n```{}\n{}\n```", language_of(entry), entry.example.trim_end());
    }
    if let Some(example) = example_of(&entry.name) {
        let _ = writeln!(text, "\n![Example]({})", file_of(example));
        if AXES.contains(&&*entry.name) {
            text.push_str("\nIn pictures, the arrows at the origin are the axes, each 1 m long: x red, y green, z blue.\n");
        }
    }
    let heading = "#".repeat(level);
    for (what, title) in [
        (MemberKind::Field, "Fields"),
        (MemberKind::Declares, "Methods"),
        (MemberKind::Function, "Functions"),
        (MemberKind::Reads, "Read methods"),
        (MemberKind::Changes, "Write methods"),
    ] {
        let members: Vec<&Member> = entry.members(what).collect();
        if members.is_empty() {
            continue;
        }
        let _ = writeln!(text, "\n{heading} {title}\n");
        if what == MemberKind::Field {
            fields(text, &entry.name, &members, "");
        } else {
            members.into_iter().for_each(|member| method(text, entry, member));
        }
    }
}

/// Returns the language of an entry's example for mdBook. Scripts that need a file cannot run there.
fn language_of(entry: &Entry) -> &'static str {
    if entry.usage.contains("(file") || entry.name == "require" { "text" } else { "lua" }
}

/// Writes a list of fields, each followed by the fields of its table. Each line begins with `indent`.
fn fields(text: &mut String, owner: &str, members: &[&Member], indent: &str) {
    let mut rows = Vec::new();
    members.iter().for_each(|member| collect(&mut rows, "", member));
    for (name, member) in rows {
        let _ = writeln!(text, "{indent}- `{}`  ", member.usage_as(&name));
        let mut doc = plain(&member.doc);
        if let Some(example) = example_of(&format!("{owner}.{name}")) {
            let _ = write!(doc, " [Picture]({}).", file_of(example));
        }
        let _ = writeln!(text, "{indent}  {doc}");
    }
}

fn collect<'a>(rows: &mut Vec<(String, &'a Member)>, owner: &str, member: &'a Member) {
    let name = format!("{owner}{}", member.name);
    let within = format!("{name}.");
    rows.push((name, member));
    member.fields.iter().for_each(|field| collect(rows, &within, field));
}

fn method(text: &mut String, entry: &Entry, member: &Member) {
    for line in member.usage().lines() {
        let _ = writeln!(text, "- `{line}`  ");
    }
    let _ = writeln!(text, "  {}", plain(&member.doc));
    let full = member.full_name(&entry.name);
    let shows_first = |example: &&ScriptExample| example.shows.first() == Some(&&*full);
    match example_of(&full) {
        Some(example) if shows_first(&example) => picture(text, &full, example),
        Some(example) => {
            let _ = writeln!(text, "  ([Picture]({}).)", file_of(example));
        }
        // A script that shows several methods is printed with the first of them.
        None if PLAIN_EXAMPLES.iter().any(|example| shows_first(&example)) => {
            text.push('\n');
            script(text, language_of(entry), &member.example);
        }
        None => {}
    }
    if !member.fields.is_empty() {
        let members: Vec<&Member> = member.fields.iter().collect();
        fields(text, &full, &members, "  ");
    }
}

/// Writes the picture of an example and its script, within a list item.
fn picture(text: &mut String, name: &str, example: &ScriptExample) {
    let _ = writeln!(text, "\n  ![{name}]({})  ", file_of(example));
    // The first line of the script describes the picture.
    if let Some(caption) = example.script.strip_prefix("-- ").and_then(|rest| rest.lines().next()) {
        let _ = writeln!(text, "  *{}*", plain(caption));
    }
    text.push('\n');
    script(text, "lua", example.script);
}

/// Writes a script within a list item.
fn script(text: &mut String, language: &str, script: &str) {
    let _ = writeln!(text, "  <details><summary>Script</summary>\n\n  ```{language}");
    for line in script.trim_end().lines() {
        let indent = if line.is_empty() { "" } else { "  " };
        let _ = writeln!(text, "{indent}{line}");
    }
    text.push_str("  ```\n\n  </details>\n\n");
}

/// Converts a doc to one line.
fn plain(doc: &str) -> String {
    let text = doc.split_whitespace().collect::<Vec<_>>().join(" ");
    // Angle brackets are not HTML, and square brackets are not links.
    text.replace('<', "&lt;").replace('[', "\\[")
}
