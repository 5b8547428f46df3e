//! Packages that are added, removed, restored and changed while a script is shown: random sequences of
//! actions, each with the expected result.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crate::support::{PATIENCE, Page, Server};

/// Script that needs `size.lua` of castle, which needs `unit.lua` of masonry, and uses `more.lua` of banners
/// if it exists.
const SCRIPT: &str = "local size = require(\"@castle/size\")\nlocal A = module(\"A\")\n\
    local s = lsystem({ object = extruder({ sides = 4, smooth = false }) })\ns:axiom(A())\n\
    s:interpret(\"A\", function(this) for _ = 1, size do this:extrude(1):advance(1) end end)\ns:derive()\n";

/// State of the packages.
#[derive(Debug, Clone, Copy, PartialEq)]
struct There {
    castle: bool,
    masonry: bool,
    banners: bool,
    unit: usize,
    off: bool,
    size: bool,
}

impl There {
    /// Returns the expected number of extrusions; `None` if the script fails.
    fn extrusions(self) -> Option<usize> {
        (self.castle && self.masonry && !self.off && self.size)
            .then_some(self.unit + if self.banners { 3 } else { 0 })
    }

    fn manifest(name: &str) -> String {
        let needs = match name {
            "castle" => "[depends]\nmasonry = \"1\"\n[optional]\nbanners = \"1\"\n",
            _ => "",
        };
        format!("name = \"{name}\"\nversion = \"1.0.0\"\napi = \"1\"\n{needs}")
    }

    fn script(self, name: &str) -> (&'static str, String) {
        match name {
            "castle" => (
                "size.lua",
                "local more = if api.has(\"@banners\") then require(\"@banners/more\") else 0\n\
                 return require(\"@masonry/unit\") + more\n"
                    .to_owned(),
            ),
            "masonry" => ("unit.lua", format!("return {}\n", self.unit)),
            _ => ("more.lua", "return 3\n".to_owned()),
        }
    }

    /// Puts a package into a folder: in one step, or file by file.
    fn put(self, at: &Path, name: &str, whole: bool) {
        let staged = if whole { at.with_file_name(format!(".{name}.new")) } else { at.to_path_buf() };
        fs::create_dir_all(&staged).unwrap();
        let pause = || std::thread::sleep(Duration::from_millis(if whole { 0 } else { 40 }));
        pause();
        fs::write(staged.join("mod.toml"), Self::manifest(name)).unwrap();
        pause();
        let (file, text) = self.script(name);
        if name != "castle" || self.size {
            fs::write(staged.join(file), text).unwrap();
        }
        if whole {
            fs::rename(staged, at).unwrap();
        }
    }
}

/// Waits until a page has received a model with the expected number of extrusions, or an error if the script
/// fails.
fn shows(page: &mut Page, there: There, done: &str, log: &[String]) {
    let end = Instant::now() + PATIENCE;
    let mut last = String::new();
    // Each extrusion has four sides and two caps.
    let expected = there.extrusions().map(|count| count as u64);
    while Instant::now() < end {
        let Some(message) = page.within(end - Instant::now()) else { continue };
        match (message["type"].as_str(), expected) {
            (Some("model"), Some(count)) => {
                last = format!("{} triangles", message["triangles"]);
                if message["triangles"].as_u64().is_some_and(|triangles| triangles == count * 12) {
                    return;
                }
            }
            (Some("error"), None) => return,
            (Some(kind @ ("model" | "error")), _) => last = format!("{kind}: {}", message["text"]),
            _ => {}
        }
    }
    panic!("after {done}, with {there:?}, a page saw {last}\n{}", log.join("\n"));
}

/// Random number generator with a seed, so that a failure can be reproduced.
struct Draw(u64);

impl Draw {
    fn next(&mut self, of: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % of
    }
}

#[test]
fn packages_that_come_and_go_are_noticed() {
    for seed in 0..6 {
        follow(seed, 16);
    }
}

fn follow(seed: u64, steps: usize) {
    let mut draw = Draw(seed * 7919 + 1);
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("s.lua"), SCRIPT).unwrap();
    let mut there = There { castle: true, masonry: true, banners: false, unit: 2, off: false, size: true };
    let mods = |server: &Server, name: &str| -> PathBuf { server.path("mods").join(name) };
    for name in ["castle", "masonry"] {
        there.put(&folder.path().join("mods").join(name), name, true);
    }
    let server = Server::start(folder, &[]);
    let mut page = server.page();
    let mut log = vec![format!("seed {seed}")];
    shows(&mut page, there, "the beginning", &log);
    for _ in 0..steps {
        let before = there;
        let at = |name: &str| mods(&server, name);
        let whole = draw.next(2) == 0;
        let done = match draw.next(8) {
            0 | 1 => {
                let name = ["castle", "masonry", "banners"][draw.next(3) as usize];
                let is_there = match name {
                    "castle" => &mut there.castle,
                    "masonry" => &mut there.masonry,
                    _ => &mut there.banners,
                };
                *is_there = !*is_there;
                let now = *is_there;
                match now {
                    true => there.put(&at(name), name, whole),
                    false if whole => fs::rename(at(name), at(&format!(".{name}.old{}", log.len()))).unwrap(),
                    false => fs::remove_dir_all(at(name)).unwrap(),
                }
                format!("{name} {}, whole: {whole}", if now { "came" } else { "went" })
            }
            2 if there.castle => {
                there.size = !there.size;
                let file = at("castle").join("size.lua");
                match there.size {
                    true => fs::write(file, there.script("castle").1).unwrap(),
                    false => fs::remove_file(file).unwrap(),
                }
                format!("size.lua is there: {}", there.size)
            }
            3 if there.masonry => {
                there.unit = 1 + draw.next(5) as usize;
                fs::write(at("masonry").join("unit.lua"), there.script("masonry").1).unwrap();
                format!("unit is {}", there.unit)
            }
            4 => {
                there.off = !there.off;
                let file = at("disabled.txt");
                fs::create_dir_all(file.parent().unwrap()).unwrap();
                match there.off {
                    true => fs::write(file, "castle\n").unwrap(),
                    false => fs::remove_file(file).unwrap(),
                }
                format!("castle is off: {}", there.off)
            }
            5 => {
                // The whole folder is moved away and back.
                if at("").exists() {
                    let away = server.path("away");
                    fs::rename(server.path("mods"), &away).unwrap();
                    let gone = There { castle: false, ..there };
                    log.push("mods went".to_owned());
                    if before.extrusions().is_some() {
                        shows(&mut page, gone, "mods went", &log);
                    }
                    fs::rename(away, server.path("mods")).unwrap();
                    if before.extrusions().is_some() {
                        shows(&mut page, there, "mods came back", &log);
                    }
                }
                "mods went and came".to_owned()
            }
            6 => {
                // A broken package that no script uses.
                let other = at("other");
                match other.exists() {
                    true => fs::remove_dir_all(other).unwrap(),
                    false => {
                        fs::create_dir_all(&other).unwrap();
                        fs::write(other.join("mod.toml"), "nonsense").unwrap();
                    }
                }
                "a broken package came or went".to_owned()
            }
            #[cfg(unix)]
            7 if there.masonry && !at("masonry").is_symlink() => {
                let place = server.path("checkout");
                let _ = fs::remove_dir_all(&place);
                fs::rename(at("masonry"), &place).unwrap();
                std::os::unix::fs::symlink(&place, at("masonry")).unwrap();
                "masonry is a link".to_owned()
            }
            _ => continue,
        };
        log.push(done.clone());
        if there.extrusions() != before.extrusions() {
            shows(&mut page, there, &done, &log);
        }
    }
}
