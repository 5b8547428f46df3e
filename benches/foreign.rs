//! Thousands of hostile files: none may cause a panic, a hang or excessive memory use. Also the growth of time with
//! size.
//! `cargo bench --bench foreign`.

#![allow(clippy::print_stdout, reason = "a bench prints its figures")]
#![allow(clippy::unwrap_used, reason = "a bench stops at what is wrong")]

use std::path::Path;
use std::time::{Duration, Instant};

use burgeon::Budget;
use burgeon::picture::Picture;
use burgeon::random::Stream;
use burgeon::script::{Limits, RunOptions};
use burgeon_data::{Layer, Source, SourceOptions};
use burgeon_geometry::{Plan, Rings};
use glam::DVec3;

const VILLAGE: &str = include_str!("../examples/data/village.geojson");

/// Random numbers that are the same in each run.
struct Dice(Stream);

impl Dice {
    fn roll(&mut self, sides: usize) -> usize {
        self.0.below(sides)
    }

    /// Changes, repeats, moves or removes some of `bytes`.
    fn damage(&mut self, bytes: &mut Vec<u8>) {
        for _ in 0..=self.roll(4) {
            let (from, length) = (self.roll(bytes.len()), self.roll(40));
            let piece = bytes[from..(from + length).min(bytes.len())].to_vec();
            let at = self.roll(bytes.len());
            match self.roll(6) {
                0 => drop(bytes.splice(at..at, piece)),
                1 => drop(bytes.drain(from..from + piece.len())),
                2 => bytes[at] = b"[]{}\",:0-e9"[self.roll(11)],
                3 => bytes[at] = u8::try_from(self.roll(256)).unwrap(),
                4 => bytes[at] ^= 1 << self.roll(8),
                _ => drop(bytes.splice(at..at, std::iter::repeat_n(b'[', self.roll(3000)))),
            }
            if bytes.is_empty() {
                bytes.push(0);
            }
        }
    }
}

/// Calls `read` for `count` damaged copies of `whole`; it returns true if it accepted the copy.
fn damaged(what: &str, whole: &[u8], count: usize, read: impl Fn(&[u8]) -> bool) {
    let (mut dice, mut good, mut longest) = (Dice(Stream::new(1)), 0, Duration::ZERO);
    for _ in 0..count {
        let mut bytes = whole.to_vec();
        dice.damage(&mut bytes);
        let begin = Instant::now();
        good += usize::from(read(&bytes));
        longest = longest.max(begin.elapsed());
    }
    println!("{count} damaged {what}: {good} read, the longest {:.1} ms", longest.as_secs_f64() * 1e3);
    assert!(longest.as_secs() < 20);
}

fn layer(path: &Path) -> bool {
    let wanted = SourceOptions {
        budget: Budget::within(Duration::from_secs(20), 200_000_000),
        ..SourceOptions::default()
    };
    let layer = Source::open_within(path, "a", &wanted)
        .and_then(|source| source.read("a", &wanted))
        .and_then(|table| Layer::new(table, &mut None));
    layer.is_ok_and(|layer| layer.bounds.iter().flatten().all(|value| value.is_finite()))
}

fn main() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    damaged("GeoJSON files", VILLAGE.as_bytes(), 5000, |bytes| {
        std::fs::write(path("a.geojson"), bytes).unwrap();
        layer(&path("a.geojson"))
    });

    std::fs::write(
        path("make.lua"),
        "local s = lsystem({ object = turtle() })\ns:axiom(F(1), F(2))\ns:derive()\n",
    )
    .unwrap();
    std::fs::write(path("read.lua"), "model(\"a.glb\")\n").unwrap();
    let made = burgeon::run(&path("make.lua"), burgeon::options()).unwrap();
    burgeon::export::write(&made.scene, &path("made.glb"), &Picture::default()).unwrap();
    damaged("models", &std::fs::read(path("made.glb")).unwrap(), 2000, |bytes| {
        std::fs::write(path("a.glb"), bytes).unwrap();
        let limits = Limits { time: Duration::from_secs(20), triangles: 100_000, ..Limits::default() };
        burgeon::run(&path("read.lua"), RunOptions { limits, ..burgeon::options() }).is_ok()
    });

    for count in [10_000, 40_000, 160_000] {
        let feature = r#"{"type":"Feature","id":"same","properties":{},"geometry":{"type":"Point","coordinates":[1,2]}}"#;
        let text = vec![feature; count].join("\n");
        std::fs::write(path("a.geojsonl"), text).unwrap();
        let begin = Instant::now();
        assert!(layer(&path("a.geojsonl")));
        println!("{count} equal ids: {:.0} ms", begin.elapsed().as_secs_f64() * 1e3);
    }

    for count in [1000, 3000, 10_000] {
        let place = |at: f64| DVec3::new((at * 78.233).sin() * 50.0, (at * 12.9898).cos() * 50.0, 0.0);
        let scribble: Vec<DVec3> = (0..count).map(|at| place(f64::from(at))).collect();
        let begin = Instant::now();
        let plan = Plan::new(&Rings(vec![scribble]));
        println!(
            "a scribble of {count} points: {:.1} ms, {}",
            begin.elapsed().as_secs_f64() * 1e3,
            plan.is_ok()
        );
    }
}
