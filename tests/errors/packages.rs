//! Packages: errors and warnings in scripts.

use crate::support::{Folder, assert_decent, without_columns};

/// Script that draws a value from a package.
pub(crate) const SCRIPT: &str = "local towers = require(\"@castle/towers\")\n\
                      local s = lsystem({ object = extruder() })\n\
                      local A = module(\"A\")\n\
                      s:axiom(A())\n\
                      s:interpret(\"A\", function(this) this:extrude(towers.height) end)\n\
                      s:derive()\n\
                      print(towers.height, towers.name)\n";

/// Returns the `mod.toml` of a package.
pub(crate) fn about(name: &str, more: &str) -> String {
    format!("name = \"{name}\"\nversion = \"1.0.0\"\napi = \"1.0\"\n{more}")
}

/// Returns a folder with a script and a package that it uses; `more` is added to the manifest.
pub(crate) fn castle(more: &str) -> Folder {
    Folder::new()
        .with("s.lua", SCRIPT)
        .with("mods/castle/mod.toml", about("castle", more))
        .with("mods/castle/towers.lua", "return { height = 12, name = \"castle\" }\n")
}

pub(crate) fn prints(folder: &Folder, flags: &[&str]) -> String {
    folder.burgeon(&[&["run", "s.lua", "--json"], flags].concat()).done().stderr
}

/// Returns the error message of a run that must fail.
pub(crate) fn refused(folder: &Folder) -> String {
    folder.refuses(&["run", "s.lua"])
}

#[test]
fn a_script_uses_a_package_beside_it_in_a_folder_that_is_given_or_of_the_user() {
    assert_eq!(prints(&castle(""), &[]), "12\tcastle\n");
    let moved = |to: &str| {
        Folder::new()
            .with("s.lua", SCRIPT)
            .with(&format!("{to}/mod.toml"), about("castle", ""))
            .with(&format!("{to}/towers.lua"), "return { height = 7, name = \"other\" }\n")
    };
    assert_eq!(prints(&moved("given/castle"), &["--mods", "given"]), "7\tother\n");
    assert_eq!(prints(&moved("given/castle"), &["--mods", "given/castle"]), "7\tother\n");
    assert_eq!(prints(&moved("user/burgeon/mods/castle"), &[]), "7\tother\n");
}

#[test]
fn files_of_a_package_find_one_another_and_not_the_scripts() {
    let folder = castle("")
        .with(
            "mods/castle/towers.lua",
            "local inner = require(\"./parts/wall\")\nreturn { height = inner, name = \"castle\" }",
        )
        .with(
            "mods/castle/parts/wall.lua",
            "return require(\"stone\") + require(\"../size\") + require(\"@castle/size\")",
        )
        .with("mods/castle/parts/stone.lua", "return 1")
        .with("mods/castle/size.lua", "return 10")
        .with("own.lua", "return 5");
    assert_eq!(prints(&folder, &[]), "21\tcastle\n");
    let folder = folder.with("mods/castle/parts/wall.lua", "return require(\"own\")");
    insta::assert_snapshot!(refused(&folder), @r#"
    error: mods/castle/parts/wall.lua:1:1: the package castle has no file parts/own.lua
      | return require("own")
      | ^^^^^^^^^^^^^^^^^^^^^
      called at s.lua:1
      help: the expected location is mods/castle
    "#);
    let folder = folder.with("mods/castle/parts/wall.lua", "return require(\"../../../own\")");
    insta::assert_snapshot!(refused(&folder), @r#"
    error: mods/castle/parts/wall.lua:1:17: require("../../../own") is outside the package castle
      | return require("../../../own")
      |                 ^^^^^^^^^^^^
      called at s.lua:1
      help: a file of another package needs the package name: require("@castle/towers")
    "#);
    let folder = folder.with("s.lua", "require(\"stone\")").with("mods/castle/stone.lua", "return 1");
    insta::assert_snapshot!(refused(&folder), @r#"
    error: s.lua:1:10: require("stone"): file not found: stone.lua
      | require("stone")
      |          ^^^^^
      help: a package file needs the name of its package: @castle/stone.lua
    "#);
}

#[test]
fn a_package_begins_with_its_init_file() {
    let folder =
        castle("").with("s.lua", "print(require(\"@castle\"))").with("mods/castle/init.lua", "return 3");
    assert_eq!(prints(&folder, &[]), "3\n");
    insta::assert_snapshot!(refused(&castle("").with("s.lua", "print(require(\"@castle\"))")), @r#"
    error: s.lua:1:1: the package castle has no file init.lua
      | print(require("@castle"))
      | ^^^^^^^^^^^^^^^^^^^^^^^^^
      help: the expected location is mods/castle
    "#);
}

#[test]
fn what_leads_out_of_a_package_is_refused() {
    let tried = |call: &str| refused(&castle("").with("s.lua", call).with("secret.lua", "return 1"));
    insta::assert_snapshot!(tried("require(\"@castle/../../secret\")"), @r#"
    error: s.lua:1:1: @castle/../../secret is outside the package castle
      | require("@castle/../../secret")
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: use a file in its folder or its subfolders: "@castle/stone.png"
    "#);
    insta::assert_snapshot!(tried("require(\"@castle//etc/passwd\")"), @r#"
    error: s.lua:1:1: @castle//etc/passwd is outside the package castle
      | require("@castle//etc/passwd")
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: use a file in its folder or its subfolders: "@castle/stone.png"
    "#);
    insta::assert_snapshot!(tried("require(\"@../secret\")"), @r#"
    error: s.lua:1:10: "@../secret" is not a file of a package
      | require("@../secret")
      |          ^^^^^^^^^^
      help: write "@castle/stone.png" for stone.png of the package castle
    "#);
    insta::assert_snapshot!(tried("model(\"@castle/../secret.glb\")"), @r#"
    error: s.lua:1:1: @castle/../secret.glb is outside the package castle
      | model("@castle/../secret.glb")
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: use a file in its folder or its subfolders: "@castle/stone.png"
    "#);
    insta::assert_snapshot!(tried("source(\"@castle/../secret.geojson:lots\")"), @r#"
    error: s.lua:1:1: @castle/../secret.geojson is outside the package castle
      | source("@castle/../secret.geojson:lots")
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: use a file in its folder or its subfolders: "@castle/stone.png"
    "#);
    insta::assert_snapshot!(
        tried("local s = lsystem({ object = extruder({ sides = 4 }) }) local A = module(\"A\") s:axiom(A()) s:interpret(\"A\", function(this) this:material({ texture = \"@castle/../a.png\", texture_size = { 1, 1 } }):extrude(1) end) s:derive()"),
        @r#"
    error: @castle/../a.png is outside the package castle
      help: use a file in its folder or its subfolders: "@castle/stone.png"
    "#
    );
}

#[cfg(unix)]
#[test]
fn a_link_out_of_a_package_is_refused() {
    let folder = castle("").with("secret.lua", "return 1");
    std::os::unix::fs::symlink("../../secret.lua", folder.path().join("mods/castle/gate.lua")).unwrap();
    let folder = folder.with("s.lua", "require(\"@castle/gate\")");
    insta::assert_snapshot!(refused(&folder), @r#"
    error: s.lua:1:1: mods/castle/gate.lua is a link to a file outside the package castle
      | require("@castle/gate")
      | ^^^^^^^^^^^^^^^^^^^^^^^
      help: a package can use only files in its own folder
    "#);
}

#[test]
fn files_that_are_missing_are_told_with_the_line_that_asks() {
    let tried = |call: &str| refused(&castle("").with("s.lua", call).with("mods/castle/stone.png", "x"));
    insta::assert_snapshot!(tried("require(\"@castle/tower\")"), @r#"
    error: s.lua:1:1: the package castle has no file tower.lua
      | require("@castle/tower")
      | ^^^^^^^^^^^^^^^^^^^^^^^^
      help: did you mean towers.lua?
    "#);
    insta::assert_snapshot!(tried("require(\"@castel/towers\")"), @r#"
    error: s.lua:1:11: unknown package `castel`
      | require("@castel/towers")
      |           ^^^^^^
      help: did you mean castle?
    "#);
    insta::assert_snapshot!(tried("require(\"@banners\")"), @r#"
    error: s.lua:1:11: unknown package `banners`
      | require("@banners")
      |           ^^^^^^^
      help: put its folder into mods/ next to the script, or specify its parent folder: --mods FOLDER
    "#);
    insta::assert_snapshot!(tried("model(\"@castle/door.glb\")"), @r#"
    error: s.lua:1:1: the package castle has no model door.glb
      | model("@castle/door.glb")
      | ^^^^^
      help: the expected location is mods/castle
    "#);
    insta::assert_snapshot!(tried("source(\"@castle/lots.geojson:lots\")"), @r#"
    error: s.lua:1:1: the package castle has no data file lots.geojson
      | source("@castle/lots.geojson:lots")
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: the expected location is mods/castle
    "#);
    insta::assert_snapshot!(
        tried("local s = lsystem({ object = extruder() }) local A = module(\"A\") s:axiom(A()) s:interpret(\"A\", function(this) this:material({ texture = \"stone.png\", texture_size = { 1, 1 } }):extrude(1) end) s:derive()"),
        @r#"
    error: s.lua:1:138: texture not found: "stone.png"
      | ...rpret("A", function(this) this:material({ texture = "stone.png", texture_size = { 1, 1 } }):extrude(1) end) s:derive()
      |                                                         ^^^^^^^^^
      help: a package file needs the name of its package: @castle/stone.png
    "#
    );
}

#[test]
fn a_package_uses_only_those_that_it_depends_on() {
    let masonry = |more: &str, content: &str| {
        castle(more)
            .with("mods/castle/towers.lua", content)
            .with("mods/masonry/mod.toml", about("masonry", ""))
            .with("mods/masonry/init.lua", "return { height = 2, name = \"masonry\" }")
            .with("mods/masonry/stone.png", "x")
    };
    let uses = "return require(\"@masonry\")";
    assert_eq!(prints(&masonry("[depends]\nmasonry = \"1\"", uses), &[]), "2\tmasonry\n");
    assert_eq!(prints(&masonry("[optional]\nmasonry = \"1\"", uses), &[]), "2\tmasonry\n");
    insta::assert_snapshot!(refused(&masonry("", uses)), @r#"
    error: mods/castle/towers.lua:1:1: the package castle does not depend on masonry
      | return require("@masonry")
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: add to its mod.toml, below [depends]: masonry = "*"
    "#);
    // A computed name is checked when it is used, a texture name at its line in the script.
    insta::assert_snapshot!(refused(&masonry("", "return require(\"@\" .. \"masonry\")")), @r#"
    error: mods/castle/towers.lua:1:1: the package castle does not depend on masonry
      | return require("@" .. "masonry")
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      called at s.lua:1
      help: add to its mod.toml, below [depends]: masonry = "*"
    "#);
    insta::assert_snapshot!(refused(&masonry("", "return { height = 1, texture = \"@masonry/stone.png\" }")), @r#"
    error: mods/castle/towers.lua:1:1: the package castle does not depend on masonry
      | return { height = 1, texture = "@masonry/stone.png" }
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: add to its mod.toml, below [depends]: masonry = "*"
    "#);
    // A script can test whether a package exists.
    let asks = "return if api.has(\"@masonry\") then require(\"@\" .. \"masonry\") else { height = 3, name = \"alone\" }";
    assert_eq!(
        prints(&castle("[optional]\nmasonry = \"1\"").with("mods/castle/towers.lua", asks), &[]),
        "3\talone\n"
    );
}

#[test]
fn packages_that_cannot_be_used_end_a_run_that_uses_them() {
    insta::assert_snapshot!(refused(&castle("[depends]\nmasonry = \"1.2\"\nmortar = \"1\"")), @r#"
    error: mods/castle/mod.toml:5:1: the package castle needs masonry ^1.2, which is not installed
      | masonry = "1.2"
      | ^^^^^^^
      help: install it next to the other packages: burgeon mods add FOLDER
    error: mods/castle/mod.toml:6:1: the package castle needs mortar ^1, which is not installed
      | mortar = "1"
      | ^^^^^^
      help: install it next to the other packages: burgeon mods add FOLDER
    "#);
    let masonry =
        |more: &str, other: &str| castle(more).with("mods/masonry/mod.toml", about("masonry", other));
    insta::assert_snapshot!(refused(&masonry("[depends]\nmasonry = \"1.2\"", "")), @r#"
    error: mods/castle/mod.toml:5:1: the package castle needs masonry ^1.2, but 1.0.0 is in mods/masonry
      | masonry = "1.2"
      | ^^^^^^^
      help: install a masonry of that version
    "#);
    insta::assert_snapshot!(refused(&masonry("[depends]\nmasonry = \"1\"", "[depends]\ncastle = \"1\"")), @r#"
    error: mods/castle/mod.toml:5:1: circular package dependency: castle -> masonry -> castle
      | masonry = "1"
      | ^^^^^^^
      help: move the common part into a third package
    "#);
    let both = |folder: Folder| {
        folder
            .with("mods/masonry/init.lua", "return 1")
            .with("s.lua", format!("require(\"@masonry\")\n{SCRIPT}"))
    };
    // An unused package causes no conflict.
    assert_eq!(prints(&masonry("[conflicts]\nmasonry = \"*\"", ""), &[]), "12\tcastle\n");
    insta::assert_snapshot!(refused(&both(masonry("[conflicts]\nmasonry = \"*\"", ""))), @r#"
    error: mods/castle/mod.toml:5:1: the package castle conflicts with masonry 1.0.0
      | masonry = "*"
      | ^^^^^^^
      help: remove one of mods/castle and mods/masonry
    "#);
    insta::assert_snapshot!(refused(&castle("").with("mods/castle/mod.toml", "name = \"castle\"\nversion = \"1.0.0\"\napi = \"1.99\"")), @r#"
    error: mods/castle/mod.toml:3:1: the package castle needs version ^1.99 of the script API, but this is 1.1.0
      | api = "1.99"
      | ^^^^^^^^^^^^
      help: use a Burgeon with that version, or a castle for this version
    "#);
    insta::assert_snapshot!(refused(&castle("").with("mods/castle-2/mod.toml", "name = \"castle\"\nversion = \"2.0.0\"\napi = \"1.0\"")), @r#"
    error: mods/castle-2/mod.toml:1:1: duplicate package castle: castle 1.0.0 in mods/castle, and 2.0.0 in mods/castle-2
      | name = "castle"
      | ^^^^^^^^^^^^^^^
      help: remove one of them
    "#);
    insta::assert_snapshot!(refused(&castle("").with("mods/castle/mod.toml", "nmae = \"castle\"\nversion = \"1.0.0\"\napi = \"1\"")), @r#"
    error: mods/castle/mod.toml:1:1: unknown field `nmae` in mod.toml
      | nmae = "castle"
      | ^^^^
      help: did you mean name?
    "#);
    insta::assert_snapshot!(castle("").refuses(&["run", "s.lua", "--mods", "nowhere"]), @r"
    error: folder not found: nowhere
      help: --mods needs a folder of packages
    ");
}

#[test]
fn packages_of_the_user_that_cannot_be_used_together_are_refused_when_they_are() {
    let folder = Folder::new()
        .with("s.lua", "require(\"@a\")\nrequire(\"@b\")")
        .with("user/burgeon/mods/a/mod.toml", about("a", "[conflicts]\nb = \"*\""))
        .with("user/burgeon/mods/a/init.lua", "return 1")
        .with("user/burgeon/mods/b/mod.toml", about("b", ""))
        .with("user/burgeon/mods/b/init.lua", "return 1")
        .with("user/burgeon/mods/c/mod.toml", "nonsense");
    insta::assert_snapshot!(refused(&folder), @r#"
    error: FOLDER/user/burgeon/mods/a/mod.toml:5:1: the package a conflicts with b 1.0.0
      | b = "*"
      | ^
      help: remove one of FOLDER/user/burgeon/mods/a and FOLDER/user/burgeon/mods/b
    "#);
    assert_eq!(prints(&folder.with("s.lua", "print(require(\"@b\"))"), &[]), "1\n");
}

#[test]
fn a_package_sets_other_defaults_of_another_ones_parameters() {
    let declares = "local height = param(\"height\", { default = 12, min = 3, max = 40 })\nreturn { height = height, name = \"castle\" }";
    let with = |value: &str| {
        castle("").with("mods/castle/towers.lua", declares).with(
            "mods/ruins/mod.toml",
            about("ruins", &format!("[depends]\ncastle = \"1\"\n[params.castle]\n{value}")),
        )
    };
    assert_eq!(prints(&with("height = 5"), &[]), "5\tcastle\n");
    assert_eq!(prints(&with("height = 5"), &["--set", "height=9"]), "9\tcastle\n");
    insta::assert_snapshot!(refused(&with("height = 50")), @r"
    error: mods/ruins/mod.toml:7:1: the default set by the package ruins: param height is 50, out of its range
      | height = 50
      | ^^^^^^
      called at s.lua:1
      help: the allowed values are 3 to 40
    ");
    insta::assert_snapshot!(refused(&with("height = true")), @r#"
    error: mods/ruins/mod.toml:7:10: the default set by the package ruins: param height must be a number, not "true"
      | height = true
      |          ^^^^
      called at s.lua:1
      help: its default is 12
    "#);
    // A manifest does not change the defaults of the script's own parameters.
    let own = "print(param(\"height\", { default = 12 }))";
    assert_eq!(prints(&with("height = 5").with("s.lua", own), &[]), "12\n");
    insta::assert_snapshot!(with("heigth = 5").refuses(&["mods", "check"]), @r"
    error: mods/ruins/mod.toml:7:1: unknown parameter of the package castle: `heigth`
      | heigth = 5
      | ^^^^^^
      help: did you mean height?
    ");
}

#[test]
fn a_package_brings_presets() {
    let declares =
        "local height = param(\"height\", { default = 12 })\nreturn { height = height, name = \"castle\" }";
    let folder = castle("")
        .with("mods/castle/towers.lua", declares)
        .with("mods/castle/presets.json", "{ \"grand\": { \"seed\": 3, \"params\": { \"height\": 30 } } }");
    assert_eq!(prints(&folder, &["--preset", "@castle/grand"]), "30\tcastle\n");
    insta::assert_snapshot!(folder.refuses(&["run", "s.lua", "--preset", "@castle/small"]), @r"
    error: unknown preset `small` in mods/castle/presets.json
      help: it has grand
    ");
    insta::assert_snapshot!(castle("").refuses(&["run", "s.lua", "--preset", "@castle/small"]), @r"
    error: the package castle has no presets file presets.json
      help: the expected location is mods/castle
    ");
}

#[test]
fn scripts_ask_what_there_is() {
    let asks = "print(api.version)\n\
                for _, name in { \"lsystem\", \"extruder\", \"extruder.bend\", \"extruder:bend\", \"turtle.step\", \"math.floor\", \"system.rule\", \"@castle\", \"extruder.bnd\", \"nothing\", \"@nothing\", \"math.random\" } do print(name, api.has(name)) end";
    insta::assert_snapshot!(prints(&castle("").with("s.lua", asks), &[]), @r"
    1.1.0
    lsystem	true
    extruder	true
    extruder.bend	true
    extruder:bend	true
    turtle.step	true
    math.floor	true
    system.rule	true
    @castle	true
    extruder.bnd	false
    nothing	false
    @nothing	false
    math.random	false
    ");
    let said = refused(&castle("").with("s.lua", "api.has(3)"));
    assert_decent(&said);
    insta::assert_snapshot!(said, @r#"
    error: s.lua:1:5: the argument of api.has must be a name
      | api.has(3)
      |     ^^^
      help: write api.has("extruder.bend")
    "#);
}

#[test]
fn what_a_package_gives_is_changed_by_nobody() {
    for (assignment, key) in [("towers.height = 3", "height"), ("towers.parts.x = 3", "x")] {
        let script = format!("local towers = require(\"@castle/towers\")\n{assignment}\n");
        let folder = castle("")
            .with("mods/castle/towers.lua", "return { height = 12, parts = { x = 1 } }\n")
            .with("s.lua", script);
        let text = refused(&folder);
        assert!(
            without_columns(&text).starts_with("error: s.lua:2: attempt to modify a readonly table"),
            "{key}: {text}"
        );
    }
}

#[test]
fn a_package_brings_a_type_of_object_which_another_extends() {
    let folder = castle("")
        .with(
            "mods/castle/towers.lua",
            "return object(\"tower\", { extends = extruder, state = { n = 0 }, reads = { count = function(self) return self.n end },\n\
             changes = { raise = function(self, h) self.n += 1 self:extrude(h) end } })\n",
        )
        .with(
            "s.lua",
            "local tower = require(\"@castle/towers\")\n\
             local keep = object(\"keep\", { extends = tower, changes = { raise = function(self, h) self.n += 2 self:extrude(2 * h) end } })\n\
             local A = module(\"A\")\n\
             local function count(constructor)\n\
             local s = lsystem({ object = constructor() })\n\
             s:axiom(A(), A())\n\
             s:interpret(\"A\", function(this) this:raise(3) end)\n\
             return s:derive(0).objects[1]:count()\n\
             end\n\
             print(count(tower), count(keep))\n",
        );
    assert_eq!(prints(&folder, &[]), "2\t4\n");
}
