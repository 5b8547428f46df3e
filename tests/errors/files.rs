//! Scripts and required files; models and output folders.

use insta::assert_snapshot;

use crate::support::{Folder, HEAD, refused};

/// Returns the error message for a script of one line, next to valid and faulty files.
fn required(line: &str) -> String {
    let folder = Folder::new()
        .with("outside.lua", "return 1\n")
        .with("in/s.lua", format!("local a = 1\n{line}\n"))
        .with("in/fine.lua", "return { double = function(n) return n * 2 end }\n")
        .with("in/one.lua", "\nreturn require(\"two\")\n")
        .with("in/two.lua", "return require(\"one\")\n")
        .with("in/broken.lua", "local a = 1\nlocal b = = 2\n")
        .with("in/unknown.lua", "local a = 1\nprint(aa)\nreturn {}\n")
        .with("in/late.lua", "return function(t)\n  return t.x.y\nend\n")
        .with("in/binary.lua", [0xff, 0xfe, 0, 1])
        .with("in/folder/inner.lua", "return require(\"../fine\")\n")
        .with("in/folder/escape.lua", "return require(\"../../outside\")\n");
    std::os::unix::fs::symlink("../outside.lua", folder.path().join("in/link.lua")).unwrap();
    std::os::unix::fs::symlink("..", folder.path().join("in/up")).unwrap();
    folder.refuses(&["run", "in/s.lua"])
}

#[test]
fn a_required_file_that_is_missing_is_told() {
    assert_snapshot!(required("require(\"nothing\")"), @r#"
    error: in/s.lua:2:10: require("nothing"): file not found: nothing.lua
      | require("nothing")
      |          ^^^^^^^
      help: the name is a path relative to the requiring file or to the script's folder
    "#);
    assert_snapshot!(required("require()"), @r#"
    error: in/s.lua:2:1: require needs a file name
      | require()
      | ^^^^^^^
      help: write require("facade") for facade.lua
    "#);
}

#[test]
fn files_that_require_each_other_are_told_in_order() {
    assert_snapshot!(required("require(\"one\")"), @r#"
    error: in/two.lua:1:8: circular require: one.lua -> two.lua -> one.lua
      | return require("one")
      |        ^^^^^^^
      called at in/s.lua:2
      help: move the common part into a third file
    "#);
    assert_snapshot!(required("require(\"s\")"), @r#"
    error: in/s.lua:2:1: circular require: s.lua -> s.lua
      | require("s")
      | ^^^^^^^
      help: move the common part into a third file
    "#);
}

#[test]
fn a_file_outside_the_folder_is_refused() {
    assert_snapshot!(required("require(\"../outside\")"), @r#"
    error: in/s.lua:2:10: require("../outside") is outside the script's folder
      | require("../outside")
      |          ^^^^^^^^^^
      help: a script can read only files in its own folder and its subfolders
    "#);
    for name in [
        "/etc/passwd",
        "/tmp/x.lua",
        "folder/../../outside",
        "link",
        "up/outside",
        "folder/escape",
        "..",
        "../in/../outside",
        "\\\\server/x",
    ] {
        let said = required(&format!("require({name:?})"));
        let refused = ["is outside the script's folder", "file not found", "needs a file name"]
            .iter()
            .any(|text| said.contains(text));
        assert!(refused && said.contains("help: "), "{name}: {said}");
        assert!(!said.contains("root:"), "{name}: {said}");
    }
    assert!(!required("require(\"up/outside\") require(\"link\")").contains("return 1"));
}

#[test]
fn an_error_in_a_required_file_names_that_file() {
    assert_snapshot!(required("require(\"broken\")"), @r"
    error: in/broken.lua:2:1: Expected identifier when parsing expression, got '='
      | local b = = 2
      | ^^^^^^^^^^^^^
      help: complete the code before '=', or remove '='
    ");
    assert_snapshot!(required("require(\"unknown\")"), @r"
    error: in/unknown.lua:2:7: unknown name aa
      | print(aa)
      |       ^^
      help: did you mean a?
    ");
    assert_snapshot!(required("require(\"late\")({})"), @r"
    error: in/late.lua:2:14: attempt to index nil with 'y'
      | return t.x.y
      |            ^
      called at in/s.lua:2
      help: check that the value exists before one of its fields is read: nothing was assigned to it, or a list is shorter
    ");
    assert_snapshot!(required("require(\"binary\")"), @r#"
    error: in/s.lua:2:1: in/binary.lua is not a text file
      | require("binary")
      | ^^^^^^^^^^^^^^^^^
      help: scripts are UTF-8 text; check the file's name
    "#);
    assert_snapshot!(required("require(\"folder\")"), @r#"
    error: in/s.lua:2:10: require("folder"): file not found: folder.lua
      | require("folder")
      |          ^^^^^^
      help: the name is a path relative to the requiring file or to the script's folder
    "#);
}

#[test]
fn a_rule_in_a_required_file_is_bound_by_the_same_laws() {
    let folder = Folder::new()
        .with("s.lua", format!("{HEAD}require(\"rules\")(s, A)\ns:derive(1)\n"))
        .with("rules.lua", "return function(s, A)\n  local n = 0\n  s:rule(\"A(x)\", function(this, x)\n    n = n + 1\n    return A(n)\n  end)\nend\n");
    assert_snapshot!(folder.refuses(&["run", "s.lua"]), @r"
    error: rules.lua:4:5: rule A(x): a rule assigns n, a variable declared outside
      | n = n + 1
      | ^
      help: pass it in a parameter of a module; to change the object, use an interpretation rule
    ");
    let folder = Folder::new()
        .with("s.lua", format!("{HEAD}local make = require(\"rules\")\ns:rule(\"A(x)\", function(this, x) return make(A, x) end)\ns:derive(1)\n"))
        .with("rules.lua", "local n = 0\nreturn function(A, x)\n  n = n + 1\n  return A(n)\nend\n");
    assert_snapshot!(folder.refuses(&["run", "s.lua"]), @r"
    error: rules.lua:3:3: rule A(x): a rule assigns n, a variable declared outside
      | n = n + 1
      | ^^^^^^^^^
      called at s.lua:2
      module: A(1), step 1
      help: a rule can assign only its own locals; pass it in a parameter of a module
    ");
    let folder = Folder::new()
        .with("s.lua", format!("{HEAD}local make = require(\"rules\")\ns:rule(\"A(x)\", function(this, x) return make(A, x) end)\ns:derive(1)\n"))
        .with("rules.lua", "return function(A, x)\n  return A(x, 1)\nend\n");
    assert_snapshot!(folder.refuses(&["run", "s.lua"]), @r"
    error: rules.lua:2:10: rule A(x): A has 1 parameter, not 2
      | return A(x, 1)
      |        ^
      called at s.lua:2
      module: A(1), step 1
      help: it was declared as A(x)
    ");
}

#[test]
fn requiring_works_from_folders_within_and_runs_a_file_once() {
    let folder = Folder::new()
        .with("in/s.lua", "local a, b = require(\"parts/one\"), require(\"fine\")\nprint(a == b, b.n, require(\"fine.lua\") == b, require(\"./parts/../fine\") == b)\n")
        .with("in/fine.lua", "print(\"once\")\nreturn { n = 3 }\n")
        .with("in/parts/one.lua", "return require(\"../fine\")\n");
    assert_eq!(folder.burgeon(&["run", "in/s.lua", "--json"]).done().stderr, "once\ntrue\t3\ttrue\ttrue\n");
}

#[test]
fn a_name_with_a_dot_means_its_own_file() {
    let folder = Folder::new()
        .with("s.lua", "print(require(\"lib.v2\"))\n")
        .with("lib.lua", "return 1\n")
        .with("lib.v2.lua", "return 2\n");
    assert_eq!(folder.burgeon(&["run", "s.lua", "--json"]).done().stderr, "2\n");
}

#[test]
fn a_script_that_is_missing_or_no_text_or_a_folder_is_told() {
    let folder = Folder::new().with("binary.lua", [0xff, 0xfe, 0, 1]).with("folder/a.lua", "");
    assert_snapshot!(folder.refuses(&["run", "nothing.lua"]), @r"
    error: script not found: nothing.lua
      help: check the path, or create a script: burgeon new NAME
    ");
    assert_snapshot!(folder.refuses(&["run", "binary.lua"]), @r"
    error: binary.lua is not a text file
      help: scripts are UTF-8 text; check the file's name
    ");
    assert_snapshot!(folder.refuses(&["run", "folder"]), @r"
    error: folder is a folder
      help: specify a script in the folder, such as folder/a.lua
    ");
    assert_snapshot!(folder.refuses(&["check", "nothing.lua"]), @r"
    error: script not found: nothing.lua
      help: check the path, or create a script: burgeon new NAME
    ");
}

#[test]
fn a_script_that_derives_nothing_writes_nothing() {
    assert_snapshot!(refused(""), @r"
    error: s.lua derives no system, so there is nothing to write
      help: end it with system:derive()
    ");
    assert_snapshot!(refused(HEAD), @r"
    error: s.lua derives no system, so there is nothing to write
      help: end it with system:derive()
    ");
    let said = Folder::new().with("s.lua", "").burgeon(&["run", "s.lua"]).done();
    assert!(said.stderr.contains("0 modules"), "{}", said.stderr);
}

#[test]
fn an_output_that_cannot_be_written_is_told_before_the_run() {
    let folder = Folder::new().with("s.lua", "print(\"it ran\")\n").with("model.glb/x", "").with("file", "");
    assert_snapshot!(folder.refuses(&["run", "s.lua", "-o", "no/model.glb"]), @r"
    error: cannot write no/model.glb: folder not found: no
      help: create the folder first, or write to an existing folder
    ");
    assert_snapshot!(folder.refuses(&["run", "s.lua", "-o", "model.glb"]), @r"
    error: cannot write model.glb: it is a folder
      help: specify a file in it, such as model.glb/model.glb
    ");
    assert_snapshot!(folder.refuses(&["run", "s.lua", "-o", "a.glb", "-o", "file/model.glb"]), @r"
    error: cannot write file/model.glb: folder not found: file
      help: create the folder first, or write to an existing folder
    ");
    assert_snapshot!(folder.refuses(&["run", "s.lua", "--chain", "no/chain.txt"]), @r"
    error: cannot write no/chain.txt: folder not found: no
      help: create the folder first, or write to an existing folder
    ");
    assert_snapshot!(folder.refuses(&["run", "s.lua", "--chain", "model.glb"]), @r"
    error: cannot write model.glb: it is a folder
      help: specify a file in it, such as model.glb/chains.txt
    ");
    assert_snapshot!(folder.refuses(&["run", "s.lua", "--chain", "s.lua"]), @r"
    error: the chains would overwrite the script s.lua
      help: specify another file: --chain chains.txt, or - for standard output
    ");
    assert_snapshot!(folder.refuses(&["run", "s.lua", "-o", "/proc/model.glb"]), @r"
    error: cannot write /proc/model.glb: No such file or directory (os error 2)
      help: create the folder first, or write to an existing folder
    ");
}

#[test]
fn a_failed_run_leaves_every_older_file_as_it_was() {
    let script = format!(
        "{HEAD}s:interpret(\"A(x)\", function(this, x) this:forward(x) end)\ns:derive(1)\nerror(\"late\")\n"
    );
    let folder = Folder::new().with("s.lua", script);
    let names = ["a.glb", "a.gltf", "a.bin", "a.obj", "a.mtl", "a.png", "a.svg", "a.txt"];
    for name in names {
        std::fs::write(folder.path().join(name), "old").unwrap();
    }
    folder.refuses(&[
        "run", "s.lua", "-o", "a.glb", "-o", "a.gltf", "-o", "a.obj", "-o", "a.png", "-o", "a.svg",
        "--chain", "a.txt",
    ]);
    for name in names {
        assert_eq!(folder.read(name), "old");
    }
}
