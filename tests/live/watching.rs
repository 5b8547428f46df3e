//! Tests of `run --watch`.

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::support::{PATIENCE, SLOW, script, triangles};

struct Watching {
    folder: tempfile::TempDir,
    child: Child,
    lines: Receiver<String>,
}

impl Watching {
    fn new(script: Option<&str>) -> Self {
        let folder = tempfile::tempdir().unwrap();
        if let Some(script) = script {
            std::fs::write(folder.path().join("s.lua"), script).unwrap();
        }
        let mut child = Command::new(env!("CARGO_BIN_EXE_burgeon"))
            .args(["run", "s.lua", "--watch", "--json", "-o", "a.glb", "--chain", "a.txt"])
            .current_dir(folder.path())
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let out = BufReader::new(child.stdout.take().unwrap());
        let (teller, lines) = channel();
        std::thread::spawn(move || out.lines().try_for_each(|line| teller.send(line.unwrap())));
        Self { folder, child, lines }
    }

    #[track_caller]
    fn next(&self) -> Value {
        match self.lines.recv_timeout(PATIENCE) {
            Ok(line) => serde_json::from_str(&line).unwrap(),
            Err(_) => panic!("nothing is said"),
        }
    }

    fn write(&self, text: &str) {
        std::fs::write(self.folder.path().join("s.lua"), text).unwrap();
    }

    fn model(&self) -> Vec<u8> {
        std::fs::read(self.folder.path().join("a.glb")).unwrap()
    }
}

impl Drop for Watching {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[test]
fn the_outputs_follow_the_script_and_stay_when_it_fails() {
    let watching = Watching::new(None);
    assert_eq!(watching.next()["ok"], false);
    watching.write(&script(3));
    assert_eq!(watching.next()["triangles"], triangles(3));
    let model = watching.model();
    watching.write("local = 1");
    let failed = watching.next();
    assert_eq!((&failed["ok"], &failed["errors"][0]["line"]), (&false.into(), &1.into()));
    assert!(watching.model() == model);
    watching.write(&script(4));
    assert_eq!(watching.next()["triangles"], triangles(4));
    assert!(watching.model() != model);
    watching.write(SLOW);
    std::thread::sleep(Duration::from_millis(100));
    watching.write(&script(5));
    assert_eq!(watching.next()["triangles"], triangles(5));
    let mut names: Vec<_> = std::fs::read_dir(watching.folder.path())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(names, ["a.glb", "a.txt", "s.lua"]);
}

#[test]
fn each_run_tells_its_own_warnings() {
    let watching = Watching::new(Some(
        "local s = lsystem({ object = turtle() })\ns:axiom(F(1))\ns:derive(0)\ns:derive(0)\n",
    ));
    assert_eq!(watching.next()["warnings"][0]["kind"], "derived-twice");
    watching.write(&script(3));
    assert_eq!(watching.next()["warnings"].as_array().map(Vec::len), Some(0));
}

#[cfg(unix)]
#[test]
fn an_interrupt_ends_it_at_once() {
    for text in [script(3), SLOW.to_owned()] {
        let mut watching = Watching::new(Some(&text));
        if text != SLOW {
            watching.next();
        } else {
            std::thread::sleep(Duration::from_millis(100));
        }
        let begin = Instant::now();
        Command::new("kill").args(["-INT", &watching.child.id().to_string()]).status().unwrap();
        assert_eq!(watching.child.wait().unwrap().code(), Some(0));
        assert!(begin.elapsed() < Duration::from_secs(2));
    }
}
