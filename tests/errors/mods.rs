//! Tests of `burgeon mods`.

use crate::packages::{SCRIPT, about, castle, prints};
use crate::support::Folder;

#[test]
fn packages_are_checked() {
    let checked = castle("").burgeon(&["mods", "check"]).done();
    insta::assert_snapshot!(checked.stderr, @"castle 1.0.0: no problems in 1 script");
    let folder = castle("[replaces]\n\"@castle/gate.lua\" = \"gat.lua\"\n")
        .with("mods/castle/towers.lua", "local a = unknown\nreturn {")
        .with(
            "mods/castle/gate.lua",
            "local stone = \"@castle/ston.png\"\nlocal a = lenght(3)\nrequire(\"./wall\")\nreturn stone",
        )
        .with("mods/castle/stone.png", "x");
    insta::assert_snapshot!(folder.refuses(&["mods", "check", "mods/castle"]), @r#"
    error: mods/castle/mod.toml:5:1: the package castle replaces a file of castle, but does not depend on it
      | "@castle/gate.lua" = "gat.lua"
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: write below [depends]: castle = "*"
    "#);
    insta::assert_snapshot!(castle("").with("mods/castle/gate.lua", "local stone = \"@castle/ston.png\"\nlocal a = lenght(3)\nrequire(\"./wall\")\nreturn stone, a").refuses(&["mods", "check", "mods/castle"]), @r#"
    error: mods/castle/gate.lua:1:1: the package castle has no file ston.png
      | local stone = "@castle/ston.png"
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: the expected location is mods/castle
    error: mods/castle/gate.lua:2:11: unknown name lenght
      | local a = lenght(3)
      |           ^^^^^^
      help: declare it: local lenght = ...
    "#);
    insta::assert_snapshot!(castle("").refuses(&["mods", "check", "nowhere"]), @r"
    error: folder not found: nowhere
      help: --mods needs a folder of packages
    ");
    insta::assert_snapshot!(castle("").refuses(&["mods", "explain", "castel"]), @r"
    error: unknown package `castel`
      help: did you mean castle?
    ");
    insta::assert_snapshot!(castle("").refuses(&["mods", "--script", "t.lua"]), @r"
    error: script not found: t.lua
      help: --script needs the script whose packages to use
    ");
    insta::assert_snapshot!(Folder::new().burgeon(&["mods"]).done().stdout, @"no packages; create one with burgeon mods new NAME, or install one with burgeon mods add FOLDER");
}

#[test]
fn packages_are_added_and_replaced_only_if_asked() {
    let folder = Folder::new()
        .with("s.lua", SCRIPT)
        .with("work/mod.toml", about("castle", ""))
        .with("work/towers.lua", "return { height = 1, name = \"added\" }");
    let said = folder.burgeon(&["mods", "add", "work"]).done();
    insta::assert_snapshot!(said.stderr, @r#"added castle 1.0.0 to mods/castle; scripts use it with require("@castle")"#);
    assert_eq!(prints(&folder, &[]), "1\tadded\n");
    insta::assert_snapshot!(folder.refuses(&["mods", "add", "work"]), @r"
    error: a package castle 1.0.0 already exists in mods/castle
      help: replace it by castle 1.0.0: --replace
    ");
    let said = folder.burgeon(&["mods", "add", "work", "--replace", "--json"]).done();
    assert_eq!(said.json()["replaced"], "1.0.0");
    let said = folder.burgeon(&["mods", "add", "work", "--into", "user/burgeon/mods"]).done();
    insta::assert_snapshot!(said.stderr, @r#"added castle 1.0.0 to user/burgeon/mods/castle; scripts use it with require("@castle")"#);
    insta::assert_snapshot!(folder.refuses(&["mods", "add", "s.lua"]), @r"
    error: s.lua cannot be unpacked
      help: specify a zip, or the folder that contains the mod.toml; if the zip is damaged, download it again
    ");
    insta::assert_snapshot!(folder.refuses(&["mods", "add", "nowhere.zip"]), @r"
    error: folder or zip not found: nowhere.zip
      help: specify the folder that contains the mod.toml, or a zip of it
    ");
    insta::assert_snapshot!(folder.refuses(&["mods", "add", "user"]), @r"
    error: user has no mod.toml
      help: a package is a folder with a mod.toml, or a zip of one
    ");
}

#[test]
fn a_package_to_begin_with_is_made_and_is_fine() {
    let folder = Folder::new().with("s.lua", "print(next(require(\"@lights\")))");
    let said = folder.burgeon(&["mods", "new", "lights"]).done();
    insta::assert_snapshot!(said.stderr, @r#"created mods/lights; now: require("@lights")"#);
    folder.burgeon(&["mods", "check"]).done();
    assert_eq!(folder.burgeon(&["run", "s.lua"]).done().stderr.lines().next(), Some("nil"));
    insta::assert_snapshot!(folder.burgeon(&["mods", "new", "lights"]).failed(), @r"
    error: mods/lights already exists
      help: choose another name
    ");
    insta::assert_snapshot!(folder.burgeon(&["mods", "new", "../Lights"]).failed(), @r#"
    error: invalid package name "../Lights"
      help: use lowercase letters, digits, - and _, such as "street-lamps"
    "#);
    let machine = folder.burgeon(&["mods", "new", "lamps", "--json"]).done().json();
    assert_eq!(machine["folder"], "mods/lamps");
}

#[test]
fn two_packages_of_one_name_in_the_users_folder_are_told_to_whoever_uses_them() {
    let about = |version: &str| format!("name = \"lights\"\nversion = \"{version}\"\napi = \"1.0\"\n");
    let folder = Folder::new()
        .with("s.lua", "require(\"@lights\")")
        .with("other.lua", "print(1)")
        .with("user/burgeon/mods/one/mod.toml", about("1.0.0"))
        .with("user/burgeon/mods/one/init.lua", "return {}")
        .with("user/burgeon/mods/two/mod.toml", about("2.0.0"))
        .with("user/burgeon/mods/two/init.lua", "return {}");
    let text = folder.burgeon(&["run", "s.lua"]).failed();
    insta::assert_snapshot!(text, @r#"
    error: FOLDER/user/burgeon/mods/two/mod.toml:1:1: duplicate package lights: lights 1.0.0 in FOLDER/user/burgeon/mods/one, and 2.0.0 in FOLDER/user/burgeon/mods/two
      | name = "lights"
      | ^^^^^^^^^^^^^^^
      help: remove one of them
    "#);
    assert_eq!(folder.burgeon(&["check", "s.lua"]).failed(), text);
    assert_eq!(folder.burgeon(&["mods", "check"]).failed(), text);
    folder.burgeon(&["run", "other.lua"]).done();
}
