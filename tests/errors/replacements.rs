//! Packages that replace files of other packages.

use crate::packages::{SCRIPT, about, castle, prints, refused};
use crate::support::Folder;

#[test]
fn a_later_package_replaces_a_file_and_builds_on_the_one_before() {
    let ruins = "local before = require(\"@castle/towers\")\nreturn { height = before.height / 2, name = \"ruined \" .. before.name }";
    let folder = castle("")
        .with(
            "mods/ruins/mod.toml",
            about("ruins", "[depends]\ncastle = \"1\"\n[replaces]\n\"@castle/towers.lua\" = \"towers.lua\""),
        )
        .with("mods/ruins/towers.lua", ruins);
    assert_eq!(prints(&folder, &[]), "6\truined castle\n");
    // The package's own files get the replacement too.
    let folder = folder.with("mods/castle/init.lua", "return require(\"./towers\")");
    let folder = folder.with("s.lua", "print(require(\"@castle\").name)");
    assert_eq!(prints(&folder, &[]), "ruined castle\n");
    insta::assert_snapshot!(folder.burgeon(&["mods"]).done().stdout, @r"
    castle 1.0.0  mods/castle
      @castle/towers.lua is replaced by ruins
    ruins 1.0.0  mods/ruins
      depends on castle ^1
      replaces @castle/towers.lua with towers.lua
    ");
    insta::assert_snapshot!(folder.burgeon(&["mods", "explain", "castle"]).done().stdout, @r"
    castle 1.0.0 in mods/castle
    found: in mods/ next to the script
    order: 1 of 2
    used by: ruins
    script API: ^1.0
      @castle/towers.lua is replaced by ruins
    ");
    let machine = folder.burgeon(&["mods", "--json"]).done().json();
    assert_eq!(machine["packages"][0]["replaced"]["@castle/towers.lua"], "ruins");
    assert_eq!(machine["packages"][1]["order"], 2);
    let folder = folder.with("mods/ruins/towers.lua", "return require(\"../castle/towers\")");
    insta::assert_snapshot!(refused(&folder), @r#"
    error: mods/ruins/towers.lua:1:17: require("../castle/towers") is outside the package ruins
      | return require("../castle/towers")
      |                 ^^^^^^^^^^^^^^^^
      called at s.lua:1
      help: a file of another package needs the package name: require("@castle/towers")
    "#);
    std::fs::remove_file(folder.path().join("mods/ruins/towers.lua")).unwrap();
    insta::assert_snapshot!(refused(&folder), @r#"
    error: mods/ruins/mod.toml:7:1: the package ruins has no file towers.lua, its replacement for @castle/towers.lua
      | "@castle/towers.lua" = "towers.lua"
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      called at s.lua:1
      help: the expected location is mods/ruins
    "#);
    // A package in the user's folder changes only scripts that require it.
    std::fs::create_dir_all(folder.path().join("user/burgeon/mods")).unwrap();
    std::fs::rename(folder.path().join("mods/ruins"), folder.path().join("user/burgeon/mods/ruins")).unwrap();
    assert_eq!(prints(&folder, &[]), "castle\n");
}

#[test]
fn a_model_names_files_of_its_own_package_also_where_it_replaces_another() {
    let door = |points: usize| {
        let bytes = points * 12;
        format!(
            r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],"buffers":[{{"uri":"door.bin","byteLength":{bytes}}}],
            "bufferViews":[{{"buffer":0,"byteLength":{bytes}}}],
            "accessors":[{{"bufferView":0,"componentType":5126,"count":{points},"type":"VEC3","min":[0,0,0],"max":[1,1,1]}}]}}"#
        )
    };
    let corners = |count: usize| -> Vec<u8> {
        let corners = [[0.0_f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].concat();
        corners.iter().cycle().take(count * 3).flat_map(|number| number.to_le_bytes()).collect()
    };
    let folder = castle("")
        .with("mods/castle/parts/door.gltf", door(3))
        .with("mods/castle/parts/door.bin", corners(3))
        .with(
            "s.lua",
            "local door = model(\"@castle/parts/door.gltf\")\nlocal A = module(\"A\")\nlocal s = lsystem({ object = turtle() })\ns:axiom(A())\n\
             s:interpret(\"A\", function(this) this:place(door) end)\ns:derive()\n",
        );
    let triangles =
        |folder: &Folder| folder.burgeon(&["run", "s.lua", "--json"]).done().json()["triangles"].clone();
    assert_eq!(triangles(&folder), 1);
    let folder = folder
        .with(
            "mods/ruins/mod.toml",
            about(
                "ruins",
                "[depends]\ncastle = \"1\"\n[replaces]\n\"@castle/parts/door.gltf\" = \"door.gltf\"",
            ),
        )
        .with("mods/ruins/door.gltf", door(6))
        .with("mods/ruins/door.bin", corners(6));
    assert_eq!(triangles(&folder), 2);
    let folder = folder.with("mods/ruins/door.gltf", door(6).replace("door.bin", "../castle/parts/door.bin"));
    insta::assert_snapshot!(refused(&folder), @r#"
    error: s.lua:1:1: @ruins/../castle/parts/door.bin is outside the package ruins
      | local door = model("@castle/parts/door.gltf")
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: use a file in its folder or its subfolders: "@ruins/stone.png"
    "#);
}

#[test]
fn two_packages_that_replace_the_same_are_warned_of() {
    let replacing = |folder: Folder, name: &str| {
        folder
            .with(
                &format!("mods/{name}/mod.toml"),
                about(name, "[depends]\ncastle = \"1\"\n[replaces]\n\"@castle/towers.lua\" = \"towers.lua\""),
            )
            .with(&format!("mods/{name}/towers.lua"), format!("return {{ height = 1, name = \"{name}\" }}"))
    };
    let folder = replacing(replacing(castle(""), "snow"), "ruins");
    assert!(prints(&folder, &[]).contains("1\tsnow"));
    let folder = folder.with("s.lua", SCRIPT.replace("print", "local _ = tostring"));
    insta::assert_snapshot!(folder.warned(&["run", "s.lua"]), @r#"
    warning: mods/ruins/mod.toml:7:1: ruins and snow both replace @castle/towers.lua; snow takes precedence
      | "@castle/towers.lua" = "towers.lua"
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: remove one of them, or add ruins to the dependencies of snow if this is intended
    "#);
}
