//! Short forms of command lines, standard input and output, suggestions for misspelt names, and manual pages.

use std::io::Write as _;
use std::process::{Command, Stdio};

use insta::assert_snapshot;

use crate::support::{Folder, HEAD};

const SCRIPT: &str = "s:interpret(\"A(x)\", function(this, x) this:forward(x) end)\ns:derive(0)\n";

fn folder() -> Folder {
    Folder::new().with("tree.lua", format!("{HEAD}{SCRIPT}"))
}

/// Runs the program with `input` on standard input.
pub(crate) fn run_with_input(folder: &Folder, arguments: &[&str], input: &[u8]) -> std::process::Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_burgeon"))
        .args(arguments)
        .current_dir(folder.path())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A command that refuses its arguments does not read.
    let _ = child.stdin.take().unwrap().write_all(input);
    child.wait_with_output().unwrap()
}

#[test]
fn a_script_without_a_command_is_run_and_the_outputs_are_hinted_at() {
    for name in ["tree.lua", "tree", "./tree.lua"] {
        let said = folder().burgeon(&[name]).done();
        assert!(said.stderr.starts_with("1 module in 1 chain, 0 steps\n"), "{}", said.stderr);
        let hint = format!(
            "note: no file was written; to write it: burgeon {}",
            name.replace("tree.lua", "tree").replace("tree", "tree.lua")
        );
        assert!(said.stderr.contains(&hint) && said.stderr.contains("burgeon live"), "{}", said.stderr);
    }
    let folder = folder();
    let said = folder.burgeon(&["tree.lua", "-o", "a.glb"]).done();
    assert!(!said.stderr.contains("note:") && folder.files().contains_key("a.glb"), "{}", said.stderr);
}

#[test]
fn misspelt_commands_and_scripts_get_a_suggestion() {
    for (arguments, tip) in [
        (["rnu", "tree.lua"], "a similar subcommand exists: 'run'"),
        (["chekc", "tree.lua"], "'check'"),
        (["tre", "-h"], "a script with a similar name exists: 'tree.lua'"),
        (["oak", "-h"], "'burgeon run oak.lua'"),
    ] {
        let said = folder().burgeon(&arguments);
        assert!(said.status == 2 && said.stderr.contains(tip), "{arguments:?}: {}", said.stderr);
    }
    for name in ["tre.lua", "tree", "Tree.lua"] {
        let text = folder().burgeon(&["run", name]).failed();
        assert!(text.contains("help: did you mean tree.lua?"), "{name}: {text}");
    }
    let text = folder().with("sub/oak.lua", "").burgeon(&["run", "sub/ok.lua"]).failed();
    assert!(text.contains("help: did you mean sub/oak.lua?"), "{text}");
}

#[test]
fn standard_input_and_output_take_scripts_and_models() {
    let folder = Folder::new();
    let script = format!("{HEAD}{SCRIPT}");
    let out = run_with_input(&folder, &["run", "-", "-o", "-", "--format", "glb"], script.as_bytes());
    assert!(
        out.status.success() && out.stdout.starts_with(b"glTF"),
        "{}",
        String::from_utf8_lossy(&out.stderr)
    );
    let out = run_with_input(&folder, &["-", "-o", "-", "--format", ".STL"], script.as_bytes());
    assert!(out.status.success() && out.stdout.len() > 84, "{}", String::from_utf8_lossy(&out.stderr));
    assert!(folder.files().is_empty(), "{:?}", folder.files());
    let out = run_with_input(&folder, &["run", "-"], b"#!/usr/bin/env burgeon\n  print(flors)\n");
    let text = String::from_utf8_lossy(&out.stderr).into_owned();
    assert!(
        text.starts_with("error: -:2:9: unknown name flors\n  | print(flors)\n  |       ^^^^^\n"),
        "{text}"
    );
    let folder = folder.with("parts.lua", "return 7");
    let out = run_with_input(&folder, &["check", "-"], b"print(require(\"parts\"))\n");
    assert!(
        out.status.success() && out.stderr.starts_with(b"7\n"),
        "{}",
        String::from_utf8_lossy(&out.stderr)
    );
}

#[test]
fn standard_output_takes_one_model_of_a_known_format() {
    let refused = |arguments: &[&str]| {
        let said = folder().burgeon(&[&["run", "tree.lua"], arguments].concat());
        assert!(said.status > 0 && said.stdout.is_empty(), "{}", said.stderr);
        said.stderr
    };
    assert_snapshot!(refused(&["-o", "-"]), @r"
    error: the model on standard output has no format
      help: name it: -o - --format glb
    ");
    assert_snapshot!(refused(&["-o", "-", "--format", "obj"]), @r"
    error: the format obj has a second file, model.mtl, so standard output cannot take it
      help: choose another format: --format glb
    ");
    assert_snapshot!(refused(&["-o", "-", "--format", "glb", "--chain", "-"]), @r"
    error: standard output cannot take both a model and a text
      help: write one of them to a file: -o FILE, --chain FILE, --report FILE
    ");
    assert_snapshot!(refused(&["-o", "a.glb", "--format", "glb"]), @r"
    error: --format is the format of standard output; the extension selects that of a file
      help: leave it out, or write to standard output: -o - --format glb
    ");
}

#[test]
fn formats_that_are_not_written_name_a_way_to_them() {
    for (name, way) in [
        ("a.fbx", "Blender"),
        ("a.usdz", ".usda"),
        ("a.JPG", "magick"),
        ("a.mp4", "ffmpeg"),
        ("a.ifc", ".city.json"),
        ("a.pdf", ".svg"),
    ] {
        let said = folder().burgeon(&["run", "tree.lua", "-o", name]);
        assert!(said.status == 2 && said.stderr.contains(way), "{name}: {}", said.stderr);
    }
}

#[test]
fn a_check_of_several_scripts_reports_each() {
    let folder = folder().with("bad.lua", "local x = flors\n").with("worse.lua", "local = 3\nx(\n");
    let said = folder.burgeon(&["check", "tree.lua", "bad.lua", "worse.lua"]);
    assert_eq!(said.status, 1);
    for part in
        ["tree.lua: no problems", "bad.lua:1:11: ", "worse.lua has 1 error", "2 of 3 scripts have errors"]
    {
        assert!(said.stderr.contains(part), "{part} is not in: {}", said.stderr);
    }
    let document = folder.burgeon(&["check", "tree.lua", "bad.lua", "--json"]);
    assert_eq!((document.status, document.stderr.as_str()), (1, ""));
    let document = document.json();
    assert_eq!((&document["ok"], &document["scripts"][0]["ok"]), (&false.into(), &true.into()));
    assert_eq!(document["scripts"][1]["errors"][0]["column"], 11);
    assert_eq!(document["scripts"][1]["script"], "bad.lua");
    folder.burgeon(&["check", "tree.lua", "tree.lua"]).done();
}

#[test]
fn a_check_describes_parameters_with_their_bounds_and_choices() {
    let script = "param(\"n\", { default = 3, min = 1, max = 9, step = 2 })\nparam(\"k\", { default = \"a\", choices = { \"a\", \"b\" } })\nparam(\"on\", { default = true })\n";
    let document = Folder::new()
        .with("s.lua", script)
        .burgeon(&["check", "s.lua", "--json", "--set", "n=5"])
        .done()
        .json();
    let params = &document["params"];
    let number = ["value", "default", "min", "max", "step", "type"].map(|key| params[0][key].to_string());
    assert_eq!(number, ["5.0", "3.0", "1.0", "9.0", "2.0", "\"number\""]);
    assert_eq!(
        (params[1]["type"].as_str(), params[1]["choices"].to_string()),
        (Some("choice"), "[\"a\",\"b\"]".to_owned())
    );
    assert_eq!(params[2]["type"], "boolean");
}

#[test]
fn messages_have_colours_only_if_the_environment_asks_for_them() {
    let folder = Folder::new().with("s.lua", "print(flors)");
    let said = |set: &[(&str, &str)]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_burgeon"));
        command.args(["run", "s.lua"]).current_dir(folder.path()).env_remove("NO_COLOR");
        command.envs(set.iter().copied());
        String::from_utf8(command.output().unwrap().stderr).unwrap()
    };
    let plain = said(&[]);
    assert!(!plain.contains('\u{1b}') && plain.starts_with("error: s.lua:1:7: "), "{plain}");
    assert!(said(&[("CLICOLOR_FORCE", "1")]).starts_with("\u{1b}[1;31merror:\u{1b}[0m s.lua:1:7: "));
    assert_eq!(said(&[("CLICOLOR_FORCE", "1"), ("NO_COLOR", "1")]), plain);
}

#[test]
fn manual_pages_describe_the_program_and_each_command() {
    let page = Folder::new().burgeon(&["man"]).done().stdout;
    assert!(
        page.starts_with(".ie") && page.contains(".TH burgeon 1") && page.contains("burgeon\\-run(1)"),
        "{page}"
    );
    let page = Folder::new().burgeon(&["man", "tiles", "plan"]).done().stdout;
    assert!(page.contains("burgeon\\-tiles\\-plan") && page.contains("Examples"), "{page}");
    let text = Folder::new().burgeon(&["man", "rnu"]).failed();
    assert!(text.contains("did you mean run?"), "{text}");
    let folder = Folder::new();
    folder.burgeon(&["man", "--folder", "man1"]).done();
    let files = folder.files();
    assert!(
        files.contains_key("man1/burgeon.1") && files.contains_key("man1/burgeon-tiles-plan.1"),
        "{files:?}"
    );
}

#[test]
fn every_long_help_has_examples() {
    for command in ["run", "live", "check", "new", "tiles", "man", "mods"] {
        let help = Folder::new().burgeon(&[command, "--help"]).done().stdout;
        assert!(help.contains("\nExamples:\n  burgeon "), "{command}: {help}");
    }
}

#[test]
fn names_with_quotes_and_spaces_are_quoted_for_the_shell() {
    let folder = Folder::new();
    let said = folder.burgeon(&["new", "my 'old' tree"]).done();
    assert!(said.stderr.contains("burgeon live 'my '\\''old'\\'' tree.lua'\n"), "{}", said.stderr);
    let said = folder.burgeon(&["new", "--", "-x"]).done();
    assert!(said.stderr.contains("burgeon run ./-x.lua"), "{}", said.stderr);
}

#[test]
fn files_that_are_no_scripts_are_refused_with_a_reason() {
    let folder = folder()
        .with("a.bin", b"\x7fELF\x00\xff\xfe")
        .with("empty.lua", "")
        .with("bom.lua", "\u{feff}print(1)\r\n  print(flors)\r\n")
        .with("sub/x.lua", "")
        .with("shell.lua", "#!/usr/bin/env burgeon\nprint(1)\n");
    let text = folder.burgeon(&["run", "a.bin"]).failed();
    assert!(text.contains("a.bin is not a text file"), "{text}");
    let text = folder.burgeon(&["run", "sub"]).failed();
    assert!(text.contains("sub is a folder") && text.contains("sub/x.lua"), "{text}");
    let text = folder.burgeon(&["run", "bom.lua"]).failed();
    assert!(
        text.contains("error: bom.lua:2:9: unknown name flors\n  | print(flors)\n  |       ^^^^^\n"),
        "{text}"
    );
    assert!(folder.burgeon(&["run", "shell.lua"]).done().stderr.starts_with("1\n"));
    assert!(folder.burgeon(&["check", "empty.lua"]).done().stderr.contains("no problems"));
    let text = folder.burgeon(&["run", "empty.lua", "-o", "a.glb"]).failed();
    assert!(text.contains("derives no system"), "{text}");
}
