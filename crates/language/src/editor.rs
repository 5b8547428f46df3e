//! What Visual Studio Code with luau-lsp needs in a folder of scripts: definitions, settings, snippets.

use burgeon_kit::Registry;
use serde_json::{Map, Value, json};

use crate::definitions::definitions;

/// A file that an editor reads.
#[derive(Debug, Clone)]
pub struct EditorFile {
    /// Where it is, from the folder of the scripts.
    pub path: &'static str,
    /// What is in it.
    pub text: String,
    /// Whether it follows from the program, and is written anew each time; others stay as people made them.
    pub generated: bool,
}

/// Where the settings are, from the folder of the scripts.
pub const SETTINGS: &str = ".vscode/settings.json";

/// The files that an editor reads, without its settings.
pub fn editor_files(registry: &Registry) -> Vec<EditorFile> {
    let definitions = definitions(registry);
    let docs: Map<String, Value> =
        definitions.docs.into_iter().map(|(symbol, doc)| (symbol, json!({ "documentation": doc }))).collect();
    let file = |path, text, generated| EditorFile { path, text, generated };
    vec![
        file(".burgeon/burgeon.d.luau", definitions.luau, true),
        file(".burgeon/burgeon.docs.json", written(&Value::Object(docs)), true),
        file(".vscode/burgeon.code-snippets", written(&snippets()), false),
        file(".luaurc", written(&json!({ "languageMode": "nonstrict" })), false),
    ]
}

/// The settings of an editor with what Burgeon needs: what stands in them stays. None if it all stands there already.
///
/// `there` is the content of the file, if there is one. Fails with what is to be added, where that is no plain JSON.
pub fn merged_settings(there: Option<&str>) -> Result<Option<String>, String> {
    let wanted = settings();
    let mut merged = match there.map(str::trim).filter(|text| !text.is_empty()) {
        None => Map::new(),
        Some(text) => match serde_json::from_str(text) {
            Ok(Value::Object(known)) => known,
            _ => return Err(written(&Value::Object(wanted))),
        },
    };
    let mut changed = there.is_none();
    for (name, value) in wanted {
        match (merged.get_mut(&name), value) {
            (None, value) => {
                merged.insert(name, value);
                changed = true;
            }
            (Some(Value::Object(known)), Value::Object(more)) => {
                for (name, value) in more {
                    if !known.contains_key(&name) {
                        known.insert(name, value);
                        changed = true;
                    }
                }
            }
            (Some(Value::Array(known)), Value::Array(more)) => {
                for value in more {
                    if !known.contains(&value) {
                        known.push(value);
                        changed = true;
                    }
                }
            }
            // What somebody chose stays.
            (Some(_), _) => {}
        }
    }
    Ok(changed.then(|| written(&Value::Object(merged))))
}

fn settings() -> Map<String, Value> {
    let settings = json!({
        "files.associations": { "*.lua": "luau" },
        "luau-lsp.platform.type": "standard",
        "luau-lsp.fflags.enableNewSolver": true,
        "luau-lsp.types.definitionFiles": { "@burgeon": ".burgeon/burgeon.d.luau" },
        "luau-lsp.types.documentationFiles": [".burgeon/burgeon.docs.json"],
    });
    match settings {
        Value::Object(settings) => settings,
        _ => Map::new(),
    }
}

fn snippets() -> Value {
    let snippet = |prefix: &str, description: &str, body: &[&str]| json!({ "scope": "lua,luau", "prefix": prefix, "description": description, "body": body });
    json!({
        "Burgeon: a system": snippet("system", "A system with an axiom, a rule and an interpretation", &[
            "local ${1:A} = module(\"${1:A}\", \"${2:size}\")",
            "local ${3:plant} = lsystem({ object = ${4|extruder,turtle,footprint|}() })",
            "${3:plant}:axiom(${1:A}(${5:1}))",
            "${3:plant}:rule(\"${1:A}(${2:size})\", function(this, ${2:size}: number)",
            "  return ${1:A}(${2:size} - 1)",
            "end)",
            "${3:plant}:interpret(\"${1:A}(${2:size})\", function(this, ${2:size})",
            "  $0",
            "end)",
            "${3:plant}:derive(${6:5})",
        ]),
        "Burgeon: a rule": snippet("rule", "What replaces a module", &[
            "${1:plant}:rule(\"${2:A(x)}\", function(this, ${3:x}: number)",
            "  return $0",
            "end)",
        ]),
        "Burgeon: a rule by chance": snippet("weighted", "One of several rules of a module", &[
            "${1:plant}:rule(\"${2:A}\", { weight = ${3:1} }, function(this)",
            "  return $0",
            "end)",
        ]),
        "Burgeon: an interpretation": snippet("interpret", "What is drawn for a module", &[
            "${1:plant}:interpret(\"${2:A(x)}\", function(this, ${3:x})",
            "  this:$0",
            "end)",
        ]),
        "Burgeon: a parameter": snippet("param", "A value that people may change", &[
            "local ${1:size} = param(\"${1:size}\", { default = ${2:1}, min = ${3:0}, max = ${4:10}, text = \"$0\" })",
        ]),
    })
}

/// JSON for people.
fn written(value: &Value) -> String {
    format!("{value:#}\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_that_stand_there_stay() {
        let there = r#"{ "editor.tabSize": 2, "luau-lsp.platform.type": "roblox", "files.associations": { "*.x": "y" } }"#;
        let merged = merged_settings(Some(there)).expect("plain JSON").expect("something new");
        let merged: Value = serde_json::from_str(&merged).expect("JSON");
        assert_eq!(merged["editor.tabSize"], 2);
        assert_eq!(merged["luau-lsp.platform.type"], "roblox");
        assert_eq!(merged["files.associations"], json!({ "*.x": "y", "*.lua": "luau" }));
        assert_eq!(merged["luau-lsp.types.definitionFiles"]["@burgeon"], ".burgeon/burgeon.d.luau");
    }

    #[test]
    fn settings_that_are_complete_are_not_written_again() {
        let first = merged_settings(None).expect("plain JSON").expect("all of it");
        assert_eq!(merged_settings(Some(&first)).expect("plain JSON"), None);
        assert!(merged_settings(Some("")).expect("nothing").is_some());
    }

    #[test]
    fn settings_with_comments_are_left_to_people() {
        let wanted = merged_settings(Some("{ // mine\n}")).expect_err("no plain JSON");
        assert!(wanted.contains("enableNewSolver"), "{wanted}");
        assert!(merged_settings(Some("[]")).is_err());
    }
}
