//! Output files of `run`: links, pipes, devices, files of other owners, several files, and interrupted runs.

use std::fs::{self, File};
use std::io::Read;
use std::os::unix::fs::{MetadataExt, PermissionsExt, chown, symlink};
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use insta::assert_snapshot;

use crate::support::Folder;

const SCRIPT: &str = r#"local A = module("A", "x")
local s = lsystem({ object = turtle() })
s:axiom(A(1))
s:interpret("A(x)", function(this, x) this:forward(x) end)
s:derive(1)
print("it has run")
"#;

const POINT: &str =
    r#"{"type":"Feature","id":1,"properties":{},"geometry":{"type":"Point","coordinates":[7.4,43.7]}}"#;

fn folder() -> Folder {
    Folder::new().with("s.lua", SCRIPT)
}

/// Returns the names of the files in `folder`, sorted.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    let mut names: Vec<_> = entries.map(|entry| entry.file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

fn command(folder: &Folder, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_burgeon"));
    command.args(arguments).current_dir(folder.path()).stdin(Stdio::null());
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

fn is_model(path: &Path) -> bool {
    fs::read(path).unwrap().starts_with(b"glTF")
}

#[test]
fn a_link_stays_and_what_it_leads_to_keeps_its_mode_and_its_owner() {
    let folder = folder().with("in/a.glb", "old");
    let path = |name: &str| folder.path().join(name);
    fs::set_permissions(path("in/a.glb"), fs::Permissions::from_mode(0o640)).unwrap();
    // Only root may change the owner of a file.
    let given = chown(path("in/a.glb"), Some(4321), Some(1234)).is_ok();
    symlink("in/a.glb", path("middle.glb")).unwrap();
    symlink("middle.glb", path("a.glb")).unwrap();
    symlink("in/new.glb", path("b.glb")).unwrap();
    folder.burgeon(&["run", "s.lua", "-o", "a.glb", "-o", "b.glb"]).done();
    for link in ["a.glb", "b.glb", "middle.glb"] {
        assert!(path(link).is_symlink(), "{link}");
    }
    let known = path("in/a.glb").symlink_metadata().unwrap();
    assert!(known.is_file() && is_model(&path("in/a.glb")) && is_model(&path("in/new.glb")));
    assert_eq!(known.mode() & 0o7777, 0o640);
    if given {
        assert_eq!((known.uid(), known.gid()), (4321, 1234));
    }
    assert_eq!(names(&path("in")), ["a.glb", "new.glb"]);
    assert_eq!(names(folder.path()), ["a.glb", "b.glb", "in", "middle.glb", "s.lua"]);
}

#[test]
fn a_file_with_several_names_has_them_still_and_shows_the_same_under_all() {
    let folder = folder().with("a.glb", "old");
    fs::hard_link(folder.path().join("a.glb"), folder.path().join("other.glb")).unwrap();
    folder.burgeon(&["run", "s.lua", "-o", "a.glb"]).done();
    assert!(is_model(&folder.path().join("other.glb")));
    assert_eq!(folder.path().join("a.glb").metadata().unwrap().nlink(), 2);
    assert_eq!(names(folder.path()), ["a.glb", "other.glb", "s.lua"]);
}

#[test]
fn of_several_files_all_appear_or_none() {
    let folder = folder().with("a.glb", "old");
    symlink("/dev/full", folder.path().join("full.glb")).unwrap();
    let before = names(folder.path());
    for last in [["--edits", "e.json"], ["--heights", "h.asc"], ["--tiles", "new/tiles"], ["-o", "full.glb"]]
    {
        let all = [
            "run",
            "s.lua",
            "-o",
            "a.glb",
            "-o",
            "b.gltf",
            "-o",
            "c.obj",
            "-o",
            "d.svg",
            "-o",
            "f.x3d",
            "-o",
            "f.gpkg",
            "-o",
            "f.city.json",
            "--chain",
            "e.txt",
        ];
        let text = folder.burgeon(&[&all, &last[..]].concat());
        assert_eq!(text.status, 1, "{last:?}: {}", text.stderr);
        assert_eq!(names(folder.path()), before, "{last:?}");
        assert_eq!(folder.read("a.glb"), "old");
    }
}

#[test]
fn what_cannot_be_written_is_told_before_the_script_runs() {
    let folder = folder().with("in/x", "");
    for last in [
        ["-o", "no/b.glb"],
        ["-o", "in"],
        ["--heights", "no/h.asc"],
        ["--edits", "no/e.json"],
        ["--report", "no/r.json"],
        ["--chain", "no/c.txt"],
        ["--tiles", "s.lua"],
        ["--tiles", "s.lua/in"],
        ["--heights", "h.glb"],
    ] {
        let said = folder.burgeon(&[&["run", "s.lua", "-o", "a.glb"][..], &last].concat());
        assert!(said.status == 1 || said.status == 2, "{last:?}: {}", said.stderr);
        assert!(!said.stderr.contains("it has run"), "{last:?}: {}", said.stderr);
    }
    assert_eq!(names(folder.path()), ["in", "s.lua"]);
}

#[test]
fn a_file_is_not_written_twice_whatever_it_is_called() {
    let folder = folder().with("in/x", "").with("a.glb", "old");
    symlink("a.glb", folder.path().join("link.glb")).unwrap();
    symlink("new.glb", folder.path().join("also.glb")).unwrap();
    let twice = |first: [&str; 2], second: [&str; 2]| {
        folder.refuses(&[&["run", "s.lua"][..], &first, &second].concat())
    };
    assert_snapshot!(twice(["-o", "a.glb"], ["-o", "a.glb"]), @r"
    error: a.glb would be written twice
      help: specify different files
    ");
    for (first, second) in [
        (["-o", "a.glb"], ["-o", "./in/../a.glb"]),
        (["-o", "a.glb"], ["-o", "link.glb"]),
        (["-o", "also.glb"], ["-o", "new.glb"]),
        (["-o", "b.gltf"], ["--edits", "b.bin"]),
        (["-o", "b.obj"], ["--chain", "b.mtl"]),
        (["--chain", "c"], ["--report", "in/../c"]),
    ] {
        let text = twice(first, second);
        assert!(text.contains("would be written twice") && !text.contains("it has run"), "{text}");
    }
}

#[test]
fn what_the_script_reads_is_not_overwritten() {
    let mut brick = Vec::new();
    let image = image::RgbaImage::from_pixel(2, 2, image::Rgba([200, 90, 60, 255]));
    image.write_to(&mut std::io::Cursor::new(&mut brick), image::ImageFormat::Png).unwrap();
    let textured = "this:material({ texture = \"in/brick.png\" }):forward(x)";
    let script = SCRIPT.replace("this:forward(x)", textured).replace("print(\"it has run\")\n", "");
    let folder = Folder::new().with("s.lua", script).with("in/brick.png", &brick);
    assert_snapshot!(folder.refuses(&["run", "s.lua", "-o", "a.glb", "-o", "in/brick.png"]), @r"
    error: cannot write in/brick.png: the script reads it
      help: specify another file
    ");
    // A copy of a texture gets another name if its name is that of an image output.
    let all = ["run", "s.lua", "-o", "a.obj", "-o", "a.gltf", "-o", "a_brick.png", "--size", "8x6"];
    folder.burgeon(&all).done();
    assert_eq!(fs::read(folder.path().join("a_brick_2.png")).unwrap(), brick);
    assert_eq!(fs::read(folder.path().join("in/brick.png")).unwrap(), brick);
    assert_eq!(
        names(folder.path()),
        ["a.bin", "a.gltf", "a.mtl", "a.obj", "a_brick.png", "a_brick_2.png", "in", "s.lua"]
    );
}

fn make_pipe(folder: &Folder, name: &str) {
    assert!(Command::new("mkfifo").arg(folder.path().join(name)).status().unwrap().success());
}

#[test]
fn a_pipe_is_given_the_model_and_stays() {
    let folder = folder();
    make_pipe(&folder, "pipe.glb");
    let path = folder.path().join("pipe.glb");
    let reader = std::thread::spawn(move || fs::read(path).unwrap());
    folder.burgeon(&["run", "s.lua", "-o", "pipe.glb", "-o", "a.glb"]).done();
    assert_eq!(reader.join().unwrap(), fs::read(folder.path().join("a.glb")).unwrap());
    folder.burgeon(&["run", "s.lua", "-o", "a.svg", "--chain", "/dev/null"]).done();
    assert_eq!(names(folder.path()), ["a.glb", "a.svg", "pipe.glb", "s.lua"]);
}

/// Waits until `folder` contains a file with a temporary name.
fn wait_for_part(folder: &Path, child: &mut Child) {
    let begin = Instant::now();
    while !names(folder).iter().any(|name| name.ends_with(".part")) {
        assert!(begin.elapsed() < Duration::from_secs(60), "nothing is written");
        assert!(child.try_wait().unwrap().is_none(), "it has ended");
        std::thread::sleep(Duration::from_millis(5));
    }
}

#[test]
fn the_end_in_between_leaves_nothing_half_written() {
    for signal in ["TERM", "INT", "HUP"] {
        let folder = folder().with("a.glb", "old").with("tmp/x", "");
        // The pipe has no reader, so writing blocks.
        make_pipe(&folder, "pipe.glb");
        let before = names(folder.path());
        let mut command =
            command(&folder, &["run", "s.lua", "-o", "a.glb", "-o", "b.gltf", "-o", "pipe.glb"]);
        let mut child = command.env("TMPDIR", folder.path().join("tmp")).spawn().unwrap();
        wait_for_part(&folder.path().join("tmp"), &mut child);
        std::thread::sleep(Duration::from_millis(50));
        let kill = Command::new("kill").args([format!("-{signal}"), child.id().to_string()]).status();
        assert!(kill.unwrap().success());
        let Output { status, stderr, .. } = child.wait_with_output().unwrap();
        let stderr = String::from_utf8(stderr).unwrap();
        assert_eq!((status.code(), status.signal()), (Some(130), None), "{signal}: {stderr}");
        assert_eq!(names(folder.path()), before, "{signal}");
        assert_eq!(names(&folder.path().join("tmp")), ["x"], "{signal}");
        assert_eq!(folder.read("a.glb"), "old");
    }
}

#[test]
fn what_cannot_be_printed_is_an_error() {
    let folder = folder();
    fs::write(folder.path().join("p.geojson"), POINT).unwrap();
    for arguments in [
        &["run", "s.lua", "--chain", "-"][..],
        &["run", "s.lua", "--json"],
        &["run", "s.lua", "--report", "-"],
        &["run", "none.lua", "--json"],
        &["check", "s.lua", "--json"],
        &["sources", "p.geojson"],
        &["sources", "p.geojson", "--json"],
        &["completions", "bash"],
        &["--help"],
        &["--version"],
    ] {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let out = command(&folder, arguments).stdout(full).output().unwrap();
        let stderr = String::from_utf8(out.stderr).unwrap();
        assert_eq!(out.status.code(), Some(1), "{arguments:?}: {stderr}");
        assert!(stderr.contains("error: "), "{arguments:?}: {stderr}");
    }
    let full = File::options().write(true).open("/dev/full").unwrap();
    let out = command(&folder, &["run", "s.lua", "--chain", "-", "-o", "a.glb"]).stdout(full).output();
    assert_snapshot!(String::from_utf8(out.unwrap().stderr).unwrap(), @r"
    it has run
    error: cannot write to standard output: No space left on device (os error 28)
      help: check whether the disk is full and the file can be written
    ");
    assert!(!folder.path().join("a.glb").exists());
}

#[test]
fn a_reader_that_goes_away_is_told_nothing() {
    let folder = folder();
    for arguments in [
        &["run", "s.lua", "--chain", "-"][..],
        &["run", "s.lua", "--json"],
        &["check", "s.lua", "--json"],
        &["completions", "bash"],
        &["--help"],
    ] {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let out = command(&folder, arguments).stdout(writer).output().unwrap();
        let stderr = String::from_utf8(out.stderr).unwrap();
        assert_eq!(out.status.code(), Some(1), "{arguments:?}: {stderr}");
        assert!(!stderr.contains("error"), "{arguments:?}: {stderr}");
    }
    // The model is written completely although the reader of standard output is gone.
    let (mut reader, writer) = std::io::pipe().unwrap();
    let arguments = ["run", "s.lua", "--chain", "-", "-o", "a.glb"];
    let child = command(&folder, &arguments).stdout(writer).spawn().unwrap();
    let mut some = [0; 1];
    reader.read_exact(&mut some).unwrap();
    drop(reader);
    child.wait_with_output().unwrap();
    assert!(is_model(&folder.path().join("a.glb")));
}

#[test]
fn integers_and_compression_are_refused_before_the_run_if_no_output_has_them() {
    let folder = folder();
    for (option, output) in [("--quantize", "a.obj"), ("--compress", "a.gltf")] {
        let error = folder.refuses(&["run", "s.lua", option, "-o", output]);
        assert!(error.contains(&format!("error: {option} applies to ")), "{error}");
        assert!(!error.contains("it has run") && names(folder.path()) == ["s.lua"], "{error}");
    }
    folder.burgeon(&["run", "s.lua", "--quantize", "--compress", "-o", "a.glb", "-o", "b.gltf"]).done();
    assert!(is_model(&folder.path().join("a.glb")));
    let film = folder.burgeon(&["run", "s.lua", "--quantize", "--turntable", "2", "-o", "c.glb"]);
    assert!(film.status == 2 && film.stderr.contains("cannot be used with"), "{}", film.stderr);
}

#[test]
fn places_stand_before_printed_texts_if_they_are_wanted() {
    let folder = folder();
    let text = folder.burgeon(&["run", "s.lua", "--places"]).done().stderr;
    assert!(text.starts_with("s.lua:6: it has run\n"), "{text}");
    let text = folder.burgeon(&["run", "s.lua"]).done().stderr;
    assert!(text.starts_with("it has run\n"), "{text}");
}
