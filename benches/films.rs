//! Measures a film: 100 frames of a tree of 200,000 segments, 800 by 600 pixels.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a bench prints and stops at what is wrong")]

use std::sync::Arc;
use std::time::Instant;

use burgeon::export::films::{FilmSettings, FilmWriter};
use burgeon::films::Film;
use burgeon::picture::Picture;

/// Binary tree whose branches thicken and stretch with the time.
const TREE: &str = r#"
local time = param("time", { default = 99, min = 0, max = 99 })
local Apex, Segment = module("Apex", "n", "l", "w"), module("Segment", "l", "w")
local tree = lsystem({ object = turtle({ sides = 6 }), interpret = "last" })
tree:axiom(Apex(16, 1, 0.3))
tree:rule("Apex(n, l, w)", function(this, n: number, l: number, w: number)
  if n == 0 then return Segment(l, w), Segment(l, w) end
  return Segment(l, w), { Turn(25), Roll(90), Apex(n - 1, l * 0.85, w * 0.72) },
    Turn(-20), Roll(80), Apex(n - 1, l * 0.88, w * 0.75)
end)
tree:interpret("Segment(l, w)", function(this, l, w)
  local grown = 0.5 + time / 200
  this:width(w * grown):forward(l * grown)
end)
tree:derive()
"#;

fn main() {
    let folder = std::env::temp_dir().join(format!("burgeon-films-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let script = folder.join("tree.lua");
    std::fs::write(&script, TREE).unwrap();
    let frames = if std::env::args().any(|argument| argument == "--bench") { 100 } else { 2 };
    let axis = format!("0:{}", frames - 1).parse().unwrap();
    let film = Film::new(&script, burgeon::options(), &axis, 100).unwrap();
    let settings = FilmSettings { frames, fps: 25.0, size: (800, 600), transparent: false };
    let begin = Instant::now();
    let paths = [folder.join("tree.gif")];
    let mut writer = FilmWriter::new(&paths, settings, 4 << 30, &Arc::default()).unwrap();
    let picture = Picture { width: 800, height: 600, ..Picture::default() };
    film.make(writer.needs(), &picture, |frame| writer.add(frame)).unwrap();
    writer.finish().unwrap();
    let seconds = begin.elapsed().as_secs_f64();
    let (modules, triangles) = film.largest();
    let size = std::fs::metadata(&paths[0]).unwrap().len() / 1_000_000;
    println!(
        "{frames} frames of {modules} modules and {triangles} triangles: {seconds:.1} s, {:.2} s a frame, {size} MB",
        seconds / f64::from(frames)
    );
    std::fs::remove_dir_all(&folder).unwrap();
}
