//! `burgeon setup`: files for editors, and files that it does not change.

use insta::assert_snapshot;

use super::support::Folder;

#[test]
fn a_folder_gets_what_an_editor_needs_and_nothing_twice() {
    let folder = Folder::new();
    let said = folder.burgeon(&["setup"]).done();
    assert_snapshot!(said.stderr, @r"
    wrote ./.burgeon/burgeon.d.luau
    wrote ./.burgeon/burgeon.docs.json
    wrote ./.vscode/burgeon.code-snippets
    wrote ./.vscode/settings.json
    wrote ./.luaurc
    open the folder in Visual Studio Code, with the extension Luau Language Server
    ");
    assert_eq!(folder.read(".burgeon/burgeon.d.luau"), folder.burgeon(&["api", "--luau"]).done().stdout);
    for file in
        [".burgeon/burgeon.docs.json", ".vscode/burgeon.code-snippets", ".luaurc", ".vscode/settings.json"]
    {
        assert!(serde_json::from_str::<serde_json::Value>(&folder.read(file)).is_ok(), "{file}");
    }
    let files = folder.files();
    let again = folder.burgeon(&["setup", ".", "--json"]).done().json();
    assert_eq!((again["written"].as_array().unwrap().len(), again["kept"].as_array().unwrap().len()), (0, 5));
    assert_eq!(folder.files(), files);
}

#[test]
fn what_people_wrote_stays() {
    let folder = Folder::new()
        .with(".vscode/settings.json", "{ \"editor.tabSize\": 3 }")
        .with(".luaurc", "{ \"languageMode\": \"strict\" }");
    folder.burgeon(&["setup"]).done();
    assert!(folder.read(".vscode/settings.json").contains("\"editor.tabSize\": 3"));
    assert!(folder.read(".luaurc").contains("strict"));
}

#[test]
fn settings_keep_their_comments_and_what_is_no_json_is_not_touched() {
    let folder =
        Folder::new().with(".vscode/settings.json", "{ // mine\n  \"editor.tabSize\": 3, // three\n}");
    folder.burgeon(&["setup"]).done();
    let settings = folder.read(".vscode/settings.json");
    assert!(
        settings.starts_with("{ // mine\n  \"editor.tabSize\": 3, // three\n  \"files.associations\": {"),
        "{settings}"
    );
    folder.burgeon(&["setup"]).done();
    assert_eq!(folder.read(".vscode/settings.json"), settings);
    let folder = Folder::new().with(".luaurc", "{ \"languageMode\" }");
    let said = folder.burgeon(&["setup"]).failed();
    assert!(
        said.starts_with("error: ./.luaurc is not JSON, so nothing was written: line 1 is not JSON"),
        "{said}"
    );
    assert_eq!(folder.files().len(), 1);
    assert_snapshot!(folder.burgeon(&["setup", "nowhere"]).failed(), @r"
    error: folder not found: nowhere
      help: create the folder first
    ");
}

#[test]
fn types_of_scripts_and_packages_are_in_the_definitions_and_packages_have_aliases() {
    let folder = Folder::new()
        .with("s.lua", "local lamp = object(\"lamp\", { extends = extruder, fields = { height = 3 }, state = { lit = 0 },\n\
                        changes = { light = { doc = \"Lights it.\", function(self, reach: number) self.lit += 1 end } } })\n\
                        extend(turtle, { reads = { far = function(self, n: number): number return n end } })\nthis is no script")
        .with("t.lua", "local lamp = object(\"lamp\", { extends = extruder, fields = { height = 3 }, state = { lit = 0 },\n\
                        changes = { light = { doc = \"Lights it.\", function(self, reach: number) self.lit += 1 end } } })\n\
                        extend(turtle, { reads = { far = function(self, n: number): number return n end } })\nerror(\"later\")")
        .with("mods/castle/mod.toml", "name = \"castle\"\nversion = \"1.0.0\"\napi = \"1.0\"\n")
        .with("mods/castle/towers.lua", "return object(\"tower\", { extends = turtle, changes = { raise = function(self, h: number) end } })");
    folder.burgeon(&["setup"]).done();
    let definitions = folder.read(".burgeon/burgeon.d.luau");
    for part in [
        "declare class Lamp extends Object\n  height: number\n  lit: number\n",
        "  --- Lights it.\n  function light(self, reach: number): Lamp\n",
        "  function extrude(self, length: number): Lamp\n",
        "(name: \"lamp\", declaration: any) -> ((options: LampOptions?) -> Lamp)",
        "declare class CastleTower extends Object\n",
        "  function raise(self, h: number): CastleTower\n",
        "  function far(self, n: number): number\n",
    ] {
        assert!(definitions.contains(part), "{part}");
    }
    let luaurc: serde_json::Value = serde_json::from_str(&folder.read(".luaurc")).unwrap();
    assert_eq!(luaurc["aliases"], serde_json::json!({ "castle": "mods/castle" }));
}
