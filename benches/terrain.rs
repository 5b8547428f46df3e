//! Terrain: full expansion, the reference view, a flight over it, queries and meshes.
//!
//! `cargo bench --bench terrain [-- NAME...]` measures all cases or the named ones. Times are wall-clock times, the
//! minimum of several rounds, followed by the CPU time of all threads in brackets.

#![allow(clippy::print_stdout, reason = "a bench prints its figures")]
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    clippy::unwrap_used,
    reason = "numbers of cases are small, and a bench stops at what is wrong"
)]

use std::sync::Arc;
use std::time::{Duration, Instant};

use burgeon::random::Stream;
use burgeon::terrain::{
    Area, DivisionRules, Ground, GroundCuts, GroundMesh, LevelRules, NumberRange, Quadrants, RuleTable,
    Tables, TileRing, View, World,
};
use burgeon_rewriting::ModuleKey;
use cpu_time::ProcessTime;
use glam::DVec2;

fn table(drawn: bool) -> RuleTable {
    let mut stream = Stream::new(8);
    let mut rule = |symbol: u16| {
        let mut change = || {
            let low = stream.uniform() * 2.0 - 1.0;
            NumberRange { low, high: if drawn { low + 0.5 } else { low } }
        };
        Quadrants {
            weight: 1.0,
            change: std::array::from_fn(|_| change()),
            symbols: [symbol, (symbol + 1) % 4, (symbol + 2) % 4, symbol],
            decay: [NumberRange::exactly(0.55); 4],
        }
    };
    RuleTable {
        names: ["A", "B", "C", "D"].map(str::to_owned).to_vec(),
        rules: (0..4).map(|symbol| vec![rule(symbol)]).collect(),
    }
}

fn world(drawn: bool, smooth: bool) -> World {
    World {
        corner: DVec2::ZERO,
        size: 512.0 * 65_536.0,
        layers: vec![LevelRules {
            from: 0,
            rules: DivisionRules::Table(Arc::new(table(drawn))),
            start: 0,
            height: 0.0,
            rest: vec![4000.0],
            names: Arc::default(),
        }],
        smooth,
        key: drawn.then(|| ModuleKey::seed(1)),
        remap: Vec::new(),
        measured: None,
    }
}

fn reference() -> View {
    let ring = |(across, levels)| TileRing { across, levels };
    View { cell: 512.0, rings: [(4, 8), (8, 6), (12, 4), (16, 2)].map(ring).to_vec() }
}

/// Returns the minimum wall-clock time and the minimum CPU time of several rounds.
fn least(rounds: usize, mut work: impl FnMut()) -> (Duration, Duration) {
    let mut best = (Duration::MAX, Duration::MAX);
    for _ in 0..rounds {
        let (clock, cpu) = (Instant::now(), ProcessTime::now());
        work();
        best = (best.0.min(clock.elapsed()), best.1.min(cpu.elapsed()));
    }
    best
}

/// Returns the current memory of the process (MB).
fn held() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmRSS"));
    let number =
        line.and_then(|line| line.split_whitespace().nth(1)).and_then(|number| number.parse::<f64>().ok());
    number.unwrap_or(f64::NAN) / 1000.0
}

fn tell(what: &str, (clock, cpu): (Duration, Duration)) {
    println!("{what:<58} {:8.1} ms ({:.1} ms)", clock.as_secs_f64() * 1e3, cpu.as_secs_f64() * 1e3);
}

fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).filter(|name| !name.starts_with('-')).collect();
    let is_wanted =
        |name: &str| wanted.is_empty() || wanted.iter().any(|wanted| name.contains(wanted.as_str()));
    if is_wanted("view") {
        view();
    }
    if is_wanted("flight") {
        flight();
    }
    if is_wanted("queries") {
        queries();
    }
    if is_wanted("mesh") {
        mesh();
    }
    if is_wanted("full") {
        full();
    }
    if is_wanted("system") {
        system();
    }
    if is_wanted("measured") {
        measure();
    }
    if is_wanted("landscapes") {
        landscape();
    }
}

#[path = "../tests/terrain/measured.rs"]
mod measured;

/// Checks thousands of terrains with measured heights, of which the tests check some.
fn measure() {
    let begin = Instant::now();
    let (mut worst, mut wrong) = (measured::Worst::default(), 0);
    for seed in 0..20_000 {
        match measured::check(seed) {
            Ok(case) => {
                worst.ground = worst.ground.max(case.ground);
                worst.triangles = worst.triangles.max(case.triangles);
                worst.samples += case.samples;
            }
            Err(what) => {
                println!("{what}");
                wrong += 1;
            }
        }
    }
    println!(
        "{:<58} {wrong} wrong, {} samples, off by {:.2e} m, triangles by {:.2e} m; {:.1} s",
        "20,000 grounds over measured heights",
        worst.samples,
        worst.ground,
        worst.triangles,
        begin.elapsed().as_secs_f64()
    );
}

#[path = "../tests/terrain/landscapes.rs"]
mod landscapes;

/// Checks landscapes of all types and sizes for 100 seeds, of which the tests check some.
fn landscape() {
    let (mut count, mut wrong) = (0, 0);
    for (kind, _) in landscapes::KINDS {
        for size in landscapes::SIZES {
            for seed in 1..=100 {
                count += 1;
                if let Err(what) = landscapes::check(kind, size, seed) {
                    println!("{what}");
                    wrong += 1;
                }
            }
        }
    }
    println!("{:<58} {wrong} of {count} wrong", "landscapes of all kinds and sizes, seeds 1 to 100");
}

fn view() {
    let before = held();
    let mut ground = Ground::new(Arc::new(world(true, true)));
    ground.focus(DVec2::new(16_123_456.0, 9_876_543.0), &reference(), &Tables).expect("a view");
    println!(
        "{:<58} {:8.1} MB of tiles; the process holds {:.1} MB, {before:.1} MB at its start",
        "memory of the reference view",
        ground.bytes() as f64 / 1e6,
        held()
    );
    drop(ground);
    for (name, drawn, smooth) in [("plain", false, false), ("drawn and smooth", true, true)] {
        let world = Arc::new(world(drawn, smooth));
        let eye = DVec2::new(16_123_456.0, 9_876_543.0);
        let time = least(5, || {
            let mut ground = Ground::new(Arc::clone(&world));
            ground.focus(eye, &reference(), &Tables).expect("a view");
            assert_eq!(ground.heights(), 1_267_456);
        });
        tell(&format!("reference view, 1,267,456 heights, {name}"), time);
        let mut ground = Ground::new(Arc::clone(&world));
        ground.focus(eye, &reference(), &Tables).expect("a view");
        let mut at = eye;
        let step = least(40, || {
            at.x += 512.0;
            ground.focus(at, &reference(), &Tables).expect("a view");
        });
        tell(&format!("moving by one cell, {name}"), step);
    }
}

fn flight() {
    let world = Arc::new(world(true, true));
    let mut ground = Ground::new(world);
    let mut stream = Stream::new(3);
    let mut at = DVec2::new(16_123_456.0, 9_876_543.0);
    let mut way = 0.0f64;
    let begin = Instant::now();
    let mut after = Vec::new();
    for step in 0..10_000 {
        way += stream.uniform() - 0.5;
        at += DVec2::from_angle(way) * 512.0;
        ground.focus(at, &reference(), &Tables).expect("a view");
        if step % 2000 == 1999 {
            after.push(format!("{:.1}", held()));
        }
    }
    println!(
        "{:<58} {:8.2} ms a step; MB after every 2,000: {}",
        "flight of 10,000 steps of 512 m",
        begin.elapsed().as_secs_f64() / 10.0,
        after.join(", ")
    );
}

fn queries() {
    let mut ground = Ground::new(Arc::new(world(true, true)));
    let eye = DVec2::new(16_123_456.0, 9_876_543.0);
    ground.focus(eye, &reference(), &Tables).expect("a view");
    let mut stream = Stream::new(3);
    let mut place = || eye + (DVec2::new(stream.uniform(), stream.uniform()) - 0.5) * 6000.0;
    let places: Vec<DVec2> = (0..1_000_000).map(|_| place()).collect();
    let mut sum = 0.0;
    let (_, time) = least(5, || sum = places.iter().filter_map(|place| ground.height(*place)).sum());
    println!(
        "{:<58} {:8.1} M/s of one processor ({sum:.0})",
        "heights at random places",
        1.0 / time.as_secs_f64()
    );
    let (_, time) =
        least(5, || sum = places.iter().filter_map(|place| ground.way_up(*place)).map(|up| up.z).sum());
    println!(
        "{:<58} {:8.1} M/s of one processor ({sum:.0})",
        "normals at random places",
        1.0 / time.as_secs_f64()
    );
}

fn mesh() {
    let mut ground = Ground::new(Arc::new(world(true, true)));
    let eye = DVec2::new(16_123_456.0, 9_876_543.0);
    ground.focus(eye, &reference(), &Tables).expect("a view");
    for error in [0.1, 1.0, 5.0] {
        let mut triangles = 0;
        let time = least(3, || {
            let mesh = GroundMesh::new(&ground, error);
            triangles = 0;
            for number in 0..ground.tiles().len() {
                let mut part = burgeon::scene::Part::default();
                mesh.write(number, glam::DVec3::ZERO, 0.0, &GroundCuts::default(), &mut part);
                triangles += part.triangles.len();
            }
        });
        tell(&format!("mesh within {error} m, {triangles} triangles"), time);
    }
}

fn full() {
    for (name, drawn, smooth) in
        [("plain", false, false), ("drawn", true, false), ("drawn and smooth", true, true)]
    {
        let world = world(drawn, smooth);
        let area = Area { x: 0, y: 0, columns: 4096, rows: 4096 };
        let time = least(3, || {
            let cells = world.descend(&world.root(), 12, area, true, &Tables).expect("cells");
            assert_eq!(cells.heights.len(), 1 << 24);
        });
        tell(&format!("4096 x 4096 heights by a rule table, {name}"), time);
    }
}

/// Terrain that the rules of a system divide, with one triangle for each half of it.
const SYSTEM: &str = r#"
local Hill = module("Hill", "height", "step")
local Vale = module("Vale", "height", "step")
local cells = lsystem()
cells:axiom(Hill(0, 400))
cells:rule("Hill(h, d)", function(this, h, d)
  local e = d * 0.55
  return Hill(h + 0.4 * d, e), Vale(h - 0.3 * d, e), Hill(h + 0.2 * d, e), Vale(h - 0.1 * d, e)
end)
cells:rule("Vale(h, d)", function(this, h, d)
  local e = d * 0.5
  return Vale(h - 0.2 * d, e), Vale(h + 0.3 * d, e), Hill(h + 0.1 * d, e), Vale(h, e)
end)
lsystem({ object = terrain({ levels = LEVELS, rules = cells, smooth = false, error = 1e9 }) }):derive()
"#;

fn system() {
    let folder = std::env::temp_dir().join(format!("burgeon-terrain-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let path = folder.join("cells.lua");
    let run = |levels: u32| {
        std::fs::write(&path, SYSTEM.replace("LEVELS", &levels.to_string())).expect("a script");
        least(3, || {
            burgeon::run(&path, burgeon::options()).expect("a run");
        })
    };
    let (small, large) = (run(1), run(12));
    let both = (large.0.saturating_sub(small.0), large.1.saturating_sub(small.1));
    tell("4096 x 4096 heights by the rules of a system, in a run", both);
    tell("the same run with 2 x 2 heights", small);
    std::fs::remove_dir_all(&folder).expect("an end");
}
