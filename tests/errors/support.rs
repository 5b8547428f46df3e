//! Runs the real binary in a temporary folder, and checks its output and its files.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;

/// Two modules and a system, in two lines, for scripts with errors in later lines.
pub(crate) const HEAD: &str = r#"local A, B = module("A", "x"), module("B")
local s = lsystem({ object = turtle() }) s:axiom(A(1))
"#;

/// Output and exit status of the binary.
pub(crate) struct Said {
    pub status: i32,
    pub stdout: String,
    pub stderr: String,
}

impl Said {
    /// Returns standard output parsed as one JSON document.
    pub(crate) fn json(&self) -> Value {
        serde_json::from_str(&self.stdout).unwrap_or_else(|error| panic!("{error}: {}", self.stdout))
    }

    /// Asserts that the run succeeded.
    pub(crate) fn done(self) -> Self {
        assert_eq!(self.status, 0, "{}", self.stderr);
        self
    }

    /// Asserts that the run failed with a clear message, and returns standard error.
    pub(crate) fn failed(self) -> String {
        assert_eq!(self.status, 1, "{}\n{}", self.stdout, self.stderr);
        assert_eq!(self.stdout, "");
        assert_decent(&self.stderr);
        self.stderr
    }
}

/// Asserts that a message is about the script, not about the program that runs it.
pub(crate) fn assert_decent(text: &str) {
    let indecent = [
        "panicked",
        "RUST_BACKTRACE",
        "backtrace",
        "traceback",
        "burgeon:",
        "[C]",
        "\u{1}",
        "0x0000",
        "0x55",
        "0x56",
        "0x7f",
        "mlua",
        "Handle",
        "C stack",
    ];
    for word in indecent {
        assert!(!text.contains(word), "{word:?} in: {text}");
    }
}

/// Temporary folder; its path is never shown.
pub(crate) struct Folder(tempfile::TempDir);

impl Folder {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub(crate) fn with(self, name: &str, content: impl AsRef<[u8]>) -> Self {
        let path = self.0.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, content).unwrap();
        self
    }

    /// Adds the library of roads, where scripts require it.
    pub(crate) fn with_roads(self) -> Self {
        let templates = Path::new(env!("CARGO_MANIFEST_DIR")).join("scripts/templates");
        let parts = std::fs::read_dir(templates.join("roads")).unwrap().map(|entry| entry.unwrap().path());
        [templates.join("roads.lua")].into_iter().chain(parts).fold(self, |folder, path| {
            let name = path.strip_prefix(&templates).unwrap().to_str().unwrap();
            folder.with(&format!("templates/{name}"), std::fs::read(&path).unwrap())
        })
    }

    pub(crate) fn path(&self) -> &Path {
        self.0.path()
    }

    pub(crate) fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.0.path().join(name)).unwrap()
    }

    pub(crate) fn read_bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.0.path().join(name)).unwrap()
    }

    /// Returns the names and sizes of all files, including files in subfolders.
    pub(crate) fn files(&self) -> BTreeMap<String, u64> {
        let mut files = BTreeMap::new();
        let mut folders = vec![self.0.path().to_path_buf()];
        while let Some(folder) = folders.pop() {
            for entry in std::fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                let known = path.symlink_metadata().unwrap();
                if known.is_dir() {
                    folders.push(path);
                } else {
                    let name = path.strip_prefix(self.0.path()).unwrap().display().to_string();
                    files.insert(name, known.len());
                }
            }
        }
        files
    }

    /// Runs `burgeon` in this folder with these arguments.
    pub(crate) fn burgeon(&self, arguments: &[&str]) -> Said {
        let out = Command::new(env!("CARGO_BIN_EXE_burgeon"))
            .args(arguments)
            .current_dir(self.0.path())
            .stdin(Stdio::null())
            .env("RUST_BACKTRACE", "1")
            .env("XDG_DATA_HOME", self.0.path().join("user"))
            .output()
            .unwrap();
        let here = self.0.path().display().to_string();
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap().replace(&here, "FOLDER");
        Said { status: out.status.code().unwrap_or(-1), stdout: text(out.stdout), stderr: text(out.stderr) }
    }

    /// Runs `burgeon` and returns its warnings. Asserts that it succeeds with equal warnings in JSON, and
    /// that a strict run fails with these warnings as errors and changes no file.
    pub(crate) fn warned(&self, arguments: &[&str]) -> String {
        let document = self.burgeon(&[arguments, &["--json"]].concat()).done().json();
        let text = self.burgeon(arguments).done().stderr;
        let first = text.find("warning: ").unwrap_or_else(|| panic!("no warning in: {text}"));
        let of_warning = |line: &&str| line.starts_with("warning: ") || line.starts_with("  ");
        let text: String =
            text[first..].lines().take_while(of_warning).map(|line| format!("{line}\n")).collect();
        assert_decent(&text);
        let warnings = document["warnings"].as_array().unwrap();
        assert_eq!(warnings.len(), text.matches("warning: ").count(), "{text}\n{document}");
        for warning in warnings {
            for part in ["message", "file", "rule", "module", "help"] {
                let part = warning[part].as_str().unwrap_or_default();
                assert!(text.contains(part), "{part:?} is not in: {text}");
            }
        }
        let strict = self.refuses(&[arguments, &["--strict"]].concat());
        for warning in warnings {
            let message = warning["message"].as_str().unwrap();
            assert!(strict.contains(message), "{message:?} is not in: {strict}");
        }
        text
    }

    /// Runs `burgeon` and returns its error message. Asserts that it fails with an equal message in JSON, and
    /// changes no file.
    pub(crate) fn refuses(&self, arguments: &[&str]) -> String {
        let before = self.files();
        let text = self.burgeon(arguments).failed();
        let machine = self.burgeon(&[arguments, &["--json"]].concat());
        assert_eq!((machine.status, machine.stderr.as_str()), (1, ""));
        let document = machine.json();
        assert_eq!(document["ok"], false);
        let errors = document["errors"].as_array().unwrap();
        assert_eq!(errors.len(), text.matches("error: ").count(), "{text}\n{document}");
        for error in errors {
            for part in ["message", "file", "rule", "module", "help"] {
                let part = error[part].as_str().unwrap_or_default();
                assert!(text.contains(part), "{part:?} is not in: {text}");
            }
        }
        assert_eq!(self.files(), before);
        text
    }
}

/// Returns a message without columns and without rows of carets.
pub(crate) fn without_columns(text: &str) -> String {
    let mut plain = String::new();
    for line in text.split_inclusive('\n') {
        let row = line.trim_end().strip_prefix("  | ").unwrap_or_default();
        if !row.is_empty() && row.trim_matches([' ', '^']).is_empty() {
            continue;
        }
        let is_digits = |part: &str| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
        let parts: Vec<&str> = line.split(':').collect();
        let follows_line = |index: usize| {
            index > 1
                && is_digits(parts[index])
                && is_digits(parts[index - 1])
                && parts[index - 2].ends_with(".lua")
        };
        let kept: Vec<&str> =
            (0..parts.len()).filter(|index| !follows_line(*index)).map(|index| parts[index]).collect();
        plain.push_str(&kept.join(":"));
    }
    plain
}

/// Returns the error message for a script that fails and leaves an older model unchanged.
pub(crate) fn refused(script: &str) -> String {
    refused_with(script, &[])
}

pub(crate) fn refused_with(script: &str, flags: &[&str]) -> String {
    let folder = Folder::new().with("s.lua", script).with("model.glb", "old");
    let before = folder.files();
    let text = folder.burgeon(&[&["run", "s.lua", "-o", "model.glb"], flags].concat()).failed();
    assert_eq!((folder.files(), folder.read("model.glb").as_str()), (before, "old"));
    text
}

/// Returns the error message for rules of the system in [`HEAD`], derived by one step; they begin in line 3.
pub(crate) fn refused_rules(rules: &str) -> String {
    refused(&format!("{HEAD}{rules}\ns:derive(1)\n"))
}

/// Returns the error message for a script that must be cancelled without delay.
pub(crate) fn stopped(script: &str, flags: &[&str]) -> String {
    let folder = Folder::new().with("s.lua", script).with("model.glb", "old");
    let before = folder.files();
    let begin = Instant::now();
    let text = folder.burgeon(&[&["run", "s.lua", "-o", "model.glb"], flags].concat()).failed();
    assert!(begin.elapsed() < Duration::from_secs(10), "{:?}: {text}", begin.elapsed());
    assert_eq!(folder.files(), before);
    text
}

/// Returns the output of a script that succeeds, line by line.
pub(crate) fn printed(script: &str) -> Vec<String> {
    let said = Folder::new().with("s.lua", script).burgeon(&["run", "s.lua", "--json"]).done();
    assert_eq!(said.json()["ok"], true);
    said.stderr.lines().map(str::to_owned).collect()
}

/// Returns the final chain of a script that succeeds.
pub(crate) fn chain(script: &str, flags: &[&str]) -> String {
    let folder = Folder::new().with("s.lua", script);
    folder.burgeon(&[&["run", "s.lua", "--chain", "-"], flags].concat()).done().stdout
}
