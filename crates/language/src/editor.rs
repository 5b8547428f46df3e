//! Setup of a script folder for Visual Studio Code with luau-lsp: definitions, settings and snippets.

use burgeon_kit::Registry;
use serde_json::{Map, Value, json};

use crate::definitions::definitions;
use crate::jsonc::{add_missing, is_comments};

/// A file for an editor.
#[derive(Debug, Clone)]
pub struct EditorFile {
    /// Path relative to the script folder.
    pub path: &'static str,
    /// Content of the file.
    pub text: String,
    /// Set if the program generates the file and overwrites it each time; other files keep the changes of users.
    pub generated: bool,
}

/// Path of the settings, relative to the script folder.
pub const SETTINGS: &str = ".vscode/settings.json";

/// Path of Luau's own settings, relative to the script folder.
pub const LUAURC: &str = ".luaurc";

/// Returns the files for the editor, except for its settings and [`LUAURC`]. `registry` can include types that scripts
/// declare.
pub fn editor_files(registry: &Registry) -> Vec<EditorFile> {
    let definitions = definitions(registry);
    let docs: Map<String, Value> =
        definitions.docs.into_iter().map(|(symbol, doc)| (symbol, json!({ "documentation": doc }))).collect();
    let file = |path, text, generated| EditorFile { path, text, generated };
    vec![
        file(".burgeon/burgeon.d.luau", definitions.luau, true),
        file(".burgeon/burgeon.docs.json", format_json(&Value::Object(docs)), true),
        file(".vscode/burgeon.code-snippets", format_json(&snippets()), false),
    ]
}

/// Adds the settings that Burgeon needs to the settings of an editor. Existing settings and comments are kept. `None`
/// if nothing is missing.
///
/// `there` is the content of the file, if it exists. Fails with a message if it is not valid JSON with optional
/// comments.
///
/// ```
/// use burgeon_language::merged_settings;
///
/// let old = "{\n  // Two spaces.\n  \"editor.tabSize\": 2\n}\n";
/// let merged = merged_settings(Some(old))?.expect("the file associations are missing");
/// assert!(merged.contains("// Two spaces.") && merged.contains("luau-lsp"));
/// assert_eq!(merged_settings(Some(&merged))?, None);
/// # Ok::<(), String>(())
/// ```
pub fn merged_settings(there: Option<&str>) -> Result<Option<String>, String> {
    merge(there, &settings())
}

/// Adds to a `.luaurc` an alias for each of `packages`, a name and a folder, so that `require("@castle/towers")` is
/// resolved. Existing settings are kept. `None` if nothing is missing. Fails like [`merged_settings`].
pub fn merged_luaurc(there: Option<&str>, packages: Vec<(&str, String)>) -> Result<Option<String>, String> {
    let mut wanted = json!({});
    if there.is_none_or(|there| there.trim().is_empty()) {
        wanted["languageMode"] = json!("nonstrict");
    }
    if !packages.is_empty() {
        wanted["aliases"] = packages.into_iter().collect();
    }
    merge(there, &wanted)
}

fn merge(there: Option<&str>, wanted: &Value) -> Result<Option<String>, String> {
    match (there.filter(|text| !text.trim_start_matches('\u{feff}').trim().is_empty()), wanted) {
        (Some(text), Value::Object(wanted)) if !is_comments(text) => add_missing(text, wanted),
        (Some(text), _) => Ok(Some(format!("{}\n{}", text.trim_end(), format_json(wanted)))),
        (None, _) => Ok(Some(format_json(wanted))),
    }
}

fn settings() -> Value {
    json!({
        "files.associations": { "*.lua": "luau" },
        "luau-lsp.platform.type": "standard",
        "luau-lsp.fflags.enableNewSolver": true,
        "luau-lsp.types.definitionFiles": { "@burgeon": ".burgeon/burgeon.d.luau" },
        "luau-lsp.types.documentationFiles": [".burgeon/burgeon.docs.json"],
    })
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
        "Burgeon: a rule": snippet("rule", "The successor of a module", &[
            "${1:plant}:rule(\"${2:A(x)}\", function(this, ${3:x}: number)",
            "  return $0",
            "end)",
        ]),
        "Burgeon: a stochastic rule": snippet("weighted", "One of several rules of a module", &[
            "${1:plant}:rule(\"${2:A}\", { weight = ${3:1} }, function(this)",
            "  return $0",
            "end)",
        ]),
        "Burgeon: an interpretation": snippet("interpret", "The drawing of a module", &[
            "${1:plant}:interpret(\"${2:A(x)}\", function(this, ${3:x})",
            "  this:$0",
            "end)",
        ]),
        "Burgeon: a parameter": snippet("param", "A value that users can change", &[
            "local ${1:size} = param(\"${1:size}\", { default = ${2:1}, min = ${3:0}, max = ${4:10}, doc = \"$0\" })",
        ]),
    })
}

/// Formats JSON with indentation.
fn format_json(value: &Value) -> String {
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
    fn settings_keep_their_comments() {
        let there = "{\n  // mine\n  \"editor.tabSize\": 2, // two\n}\n";
        let merged = merged_settings(Some(there)).expect("JSON").expect("something new");
        assert!(
            merged.starts_with("{\n  // mine\n  \"editor.tabSize\": 2, // two\n  \"files.associations\""),
            "{merged}"
        );
        assert_eq!(merged_settings(Some(&merged)).expect("JSON"), None);
        assert!(merged_settings(Some("[]")).is_err() && merged_settings(Some("{ \"a\" }")).is_err());
    }

    #[test]
    fn packages_have_aliases_and_what_somebody_chose_stays() {
        let packages = || vec![("castle", "mods/castle".to_owned())];
        let made = merged_luaurc(None, packages()).expect("nothing there").expect("all of it");
        let read: Value = serde_json::from_str(&made).expect("JSON");
        assert_eq!(read, json!({ "languageMode": "nonstrict", "aliases": { "castle": "mods/castle" } }));
        let there = "{ \"languageMode\": \"strict\", // mine\n  \"aliases\": { \"castle\": \"elsewhere\" } }";
        assert_eq!(merged_luaurc(Some(there), packages()).expect("JSON"), None);
        assert_eq!(merged_luaurc(Some("{}"), Vec::new()).expect("JSON"), None);
    }
}
