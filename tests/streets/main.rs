//! Networks grown by the patterns of the library: their invariants for any seed, and their statistics.
//!
//! `cargo bench --bench streets` examines 200 seeds of each pattern.

mod check;
mod cities;
mod ground;
mod looks;
mod words;

use std::path::PathBuf;

use check::{PATTERNS, check, grown};
use cities::{TOWNS, figures};
use looks::{EACH, MEANS, faults, looks, real};

/// Returns the mean of each measure over some seeds of a pattern: degree, fractions of dead ends and of junctions of 3
/// and of 4 streets, circuity, meshedness, orientation order, and spread of block areas.
fn means(pattern: &str, seeds: u64) -> [f64; 8] {
    let mut sums = [0.0; 8];
    for seed in 1..=seeds {
        let grown = grown("roads.lua", seed, &[("pattern", pattern), ("extent", "1000")]);
        let of = grown.network().measures();
        let [ends, three, four] = of.shares;
        let [degree, circuity, meshedness] = [of.degree, of.circuity, of.meshedness];
        let all = [degree, ends, three, four, circuity, meshedness, of.orientation_order, of.block_spread];
        sums = std::array::from_fn(|index| sums[index] + all[index] / seeds as f64);
    }
    sums
}

#[test]
fn every_pattern_keeps_what_networks_promise_with_any_seed() {
    for (pattern, radius) in PATTERNS {
        for seed in 1..=6 {
            let grown = grown("roads.lua", seed, &[("pattern", pattern), ("extent", "250")]);
            check(&grown, radius, &format!("{pattern}, seed {seed}"));
        }
    }
}

#[test]
fn towns_keep_buildings_apart_and_off_the_streets_with_any_seed() {
    for town in &TOWNS {
        for seed in 0..town.seeds {
            let of = figures(town, seed, None);
            assert_eq!(of.fault(), None, "{}, seed {seed}: {of:?}", town.name());
        }
    }
}

#[test]
fn an_exit_that_a_bridge_leads_over_the_rim_ends_there() {
    let of = figures(&TOWNS[0], 41, None);
    assert_eq!(of.fault(), None, "{of:?}");
}

#[test]
fn words_keep_what_networks_promise_with_any_angles() {
    for (seed, (bend, branch, split)) in (1..).zip([
        ("20", "90", "alternate"),
        ("20", "20", "symmetric"),
        ("35", "60", "plain"),
        ("45", "90", "symmetric"),
    ]) {
        let word = if split == "plain" { "F[+X]F-X|F[-X]FX" } else { "F[X]F+X|F[X]F-X|F[X]FX" };
        let set = [("bend", bend), ("branch", branch), ("split", split), ("iterations", "6"), ("word", word)];
        let grown = grown("charroads.lua", seed, &set);
        assert!(grown.network().size() > 10, "{split}: {}", grown.network().size());
        assert_eq!(grown.joinable(Some(120.0), Some(2.0)).expect("a radius"), 0);
        assert_eq!(grown.network().components(), 1);
    }
}

#[test]
fn towns_that_nobody_planned_look_like_real_ones() {
    const SEEDS: u64 = 16;
    let mut sums = [0.0; 16];
    for seed in 1..=SEEDS {
        let of = looks(grown("roads.lua", seed, &[("extent", "1000")]).network());
        assert_eq!(faults(&of, &EACH), [""; 0], "seed {seed}: {of:.3?}");
        sums = std::array::from_fn(|index| sums[index] + of[index] / SEEDS as f64);
    }
    assert_eq!(faults(&sums, &MEANS), [""; 0], "{sums:.3?}");
}

#[test]
fn measures_of_real_towns_are_those_that_other_programs_take() {
    // Computed with Shapely: density, largest block, median block and spread of Helsinki and Monaco.
    for (file, [density, largest, block, spread]) in [
        ("helsinki.gpkg", [23.6, 162_146.0, 7000.0, 0.637]),
        ("monaco.gpkg", [41.7, 163_906.0, 1243.0, 0.738]),
    ] {
        let Some(network) = real(file) else { continue };
        let of = network.measures();
        let near = |value: f64, known: f64| (value / known - 1.0).abs() < 0.03;
        let all =
            [(of.density, density), (of.largest, largest), (of.block, block), (of.block_spread, spread)];
        assert!(all.iter().all(|(value, known)| near(*value, *known)), "{file}: {all:?}");
    }
}

#[test]
fn rasters_and_rings_are_like_the_streets_of_new_cities() {
    // Bounds as in Vancouver for both patterns; the raster's orientation order is as in Chicago.
    for (pattern, ordered) in [("raster", 0.75..=1.0), ("radial", 0.0..=0.2)] {
        let [degree, ends, three, four, circuity, meshedness, order, spread] = means(pattern, 6);
        assert!((3.1..3.4).contains(&degree), "{pattern}: degree {degree}");
        assert!((0.03..0.13).contains(&ends), "{pattern}: dead ends {ends}");
        assert!((0.5..0.64).contains(&three), "{pattern}: 3-way {three}");
        assert!((0.3..0.42).contains(&four), "{pattern}: 4-way {four}");
        assert!((1.0..1.08).contains(&circuity), "{pattern}: circuity {circuity}");
        assert!((0.26..0.36).contains(&meshedness), "{pattern}: meshedness {meshedness}");
        assert!(ordered.contains(&order), "{pattern}: orientation order {order}");
        assert!((0.42..0.65).contains(&spread), "{pattern}: spread of blocks {spread}");
    }
}

#[test]
fn ten_seeds_are_ten_towns() {
    for (pattern, _) in PATTERNS {
        let mut towns: Vec<String> = (1..=10)
            .map(|seed| {
                let grown = grown("roads.lua", seed, &[("pattern", pattern), ("extent", "200")]);
                let of = grown.network().measures();
                format!("{} {:.0} {:.3} {:.0}", grown.network().size(), of.length, of.degree, of.block)
            })
            .collect();
        towns.sort();
        towns.dedup();
        assert!(towns.len() >= 9, "{pattern}: {towns:?}");
    }
}

/// Returns the error for a line of a script that uses the library.
fn refused(line: &str) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    let library = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("scripts/templates");
    let templates = folder.path().join("templates");
    std::fs::create_dir_all(templates.join("roads")).expect("a folder");
    let rooms = std::fs::read_dir(library.join("roads")).expect("the library");
    let rooms = rooms.map(|room| PathBuf::from("roads").join(room.expect("a file").file_name()));
    for file in rooms.chain(["roads.lua".into()]) {
        std::fs::copy(library.join(&file), templates.join(file)).expect("the library");
    }
    let path = folder.path().join("s.lua");
    std::fs::write(&path, format!("local roads = require(\"templates/roads\")\n{line}")).expect("room");
    let Err(error) = burgeon::run(&path, burgeon::options()) else { panic!("{line} is refused") };
    let text = error.to_string().replace(&*folder.path().to_string_lossy(), "");
    text.lines().next().unwrap_or_default().trim_start_matches('/').to_owned()
}

#[test]
fn grammars_that_cannot_be_are_refused_in_the_line_that_gives_them() {
    let cases = [
        ("roads.word({ axiom = 'F[+F' })", "the axiom \"F[+F\" has 1 [ without a ]"),
        ("roads.word({ axiom = 'F+F]' })", "has a ] at 4 that closes no ["),
        (
            "roads.word({ productions = { X = { 3 } } })",
            "the production of X, must be a word of characters, not 3",
        ),
        ("roads.word({ branch = 180 })", "a branch of 180 degrees leads a road onto itself"),
        ("roads.word({ bend = 0 })", "a bend of 0 degrees leads a road onto itself"),
        ("roads.word({ bend = 0 / 0 })", "roads.word: bend must be a number from -360 to 360, not nan"),
        (
            "roads.word({ productions = { X = 'XXXX' }, iterations = 30 })",
            "after 10 of 30 iterations the word may have 1048576",
        ),
        ("roads.word({ productions = { ['['] = 'F' } })", "a production of [ cannot be"),
        ("roads.word({ lengths = { 0 } })", "the length for depth 0 must be a number from 1 to 10000, not 0"),
        ("roads.word({ split = 'no' })", "split is \"symmetric\", \"alternate\" or \"plain\", not \"no\""),
        (
            "roads.system({ patern = 3 })",
            "roads.system has no option patern; it has allowed, centres, dead_ends",
        ),
        ("roads.organic({ block = 2 })", "roads.organic: block must be a number from 20 to 500, not 2"),
        ("roads.districts({})", "roads.districts takes one district or more"),
        ("roads.districts({ { at = { 0, 0 } } })", "the pattern of district 1 must be a pattern"),
        ("roads.districts({ { pattern = roads.organic() } })", "at of district 1 must be a place (m)"),
        ("roads.contours()", "roads.contours: height must be a function of a place"),
        ("roads.radial({ middle = { 'a' } })", "roads.radial: middle must be a place (m)"),
        ("roads.grow({ extent = 0 })", "roads.grow: extent must be a number from 1 to 500000, not 0"),
        ("roads.grow({ extent = 0 / 0 })", "extent must be a number from 1 to 500000, not nan"),
        ("roads.grow({ pattern = {} })", "roads.grow: pattern has no function called toward"),
        ("roads.grow({ headings = {} })", "centres and headings say where streets begin"),
        ("roads.grow({ headings = { 0 / 0 } })", "roads.grow: heading 1 must be a number"),
        ("roads.grow({ onto = true })", "onto = true takes streets that are there"),
        ("roads.grow({ join = 0 / 0 })", "roads.grow: join must be a number from 0 to 2000, not nan"),
    ];
    for (line, expected) in cases {
        let text = refused(line);
        assert!(text.contains(expected) && text.contains("s.lua:2"), "{line}: {text}");
    }
}
