//! `burgeon setup`: what it writes for editors, and what it leaves alone.

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
    wrote ./.luaurc
    wrote ./.vscode/settings.json
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
fn settings_with_comments_are_not_touched() {
    let folder = Folder::new().with(".vscode/settings.json", "{ // mine\n}");
    let said = folder.burgeon(&["setup"]).failed();
    assert!(
        said.starts_with("error: ./.vscode/settings.json is no plain JSON, so nothing was written"),
        "{said}"
    );
    assert_eq!(folder.files().len(), 1);
    assert_snapshot!(folder.burgeon(&["setup", "nowhere"]).failed(), @r"
    error: there is no folder nowhere
      help: make the folder first
    ");
}
