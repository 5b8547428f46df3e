//! Set operations and buffers on families of hard cases, near the origin and far from it: the number of results that
//! are invalid or of the wrong size, and the time.
//!
//! `cargo bench -p burgeon-sources --bench overlay -- [CASES]`, with 100,000 cases per family by default (a fiftieth for
//! unions of many polygons). BURGEON_SHARED is the folder of `france_buildings.gpkg` and `helsinki.gpkg` (default
//! `../shared/data`), whose neighbouring houses are joined.
#![allow(
    clippy::print_stdout,
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a bench shows figures, and ends where they cannot be had"
)]

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use burgeon_base::Budget;
use burgeon_sources::sql::{Cell, Database};
use burgeon_spatial::{Geometry, union_all};
use glam::DVec2;

#[path = "../../spatial/tests/families/mod.rs"]
mod families;

use families::{Dice, FAMILIES, PLACES, all_operations};

/// Counts wrong cases, and prints the first.
fn show(name: &str, place: &str, cases: impl Iterator<Item = Option<String>>) {
    let begin = Instant::now();
    let (mut count, mut wrong, mut first) = (0_usize, 0_usize, None);
    for case in cases {
        count += 1;
        if let Some(case) = case {
            wrong += 1;
            first.get_or_insert(case);
        }
    }
    println!("{name:32} {place:10} {count:>8} {wrong:>8} {:>8.1}", begin.elapsed().as_secs_f64());
    if let Some(first) = first {
        println!("    {first}");
    }
}

fn moved(geometry: &Geometry, by: DVec2) -> Geometry {
    let mut moved = geometry.clone();
    moved.points_mut().for_each(|point| *point += by.extend(0.0));
    moved
}

/// Returns the pairs of valid areas of a layer that intersect.
fn neighbours(folder: &Path, file: &str) -> Vec<[Geometry; 2]> {
    let database = Database::new(None).unwrap();
    let budget = Arc::new(Budget::default());
    database.add_geopackage("buildings", &folder.join(file), file, "buildings", &budget).unwrap();
    let sql = "SELECT a.geom AS one, b.geom AS other FROM buildings a JOIN buildings b ON a.fid < b.fid AND ST_Intersects(a.geom, b.geom)";
    let answer = database.query(sql, &[], &budget).unwrap();
    let geometry = |cell: &Cell| match cell {
        Cell::Geometry(geometry) => geometry.as_ref().clone(),
        other => panic!("{other} is no geometry"),
    };
    let pairs = answer.iter().map(|row| [&row[0], &row[1]].map(geometry));
    pairs.filter(|pair| pair.iter().all(Geometry::is_valid)).collect()
}

fn main() {
    let cases = std::env::args().skip(1).find_map(|it| it.parse().ok()).unwrap_or(100_000);
    println!("{:32} {:10} {:>8} {:>8} {:>8}", "family", "place", "cases", "wrong", "s");
    for (number, (name, check)) in (0..).zip(FAMILIES) {
        let cases = if name == "nearly equal polygons" { cases / 50 } else { cases };
        for (place, origin) in PLACES {
            let mut dice = Dice(number);
            show(name, place, (0..cases).map(|_| check(&mut dice, origin)));
        }
    }
    let folder = std::env::var_os("BURGEON_SHARED")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"), PathBuf::from);
    for file in ["france_buildings.gpkg", "helsinki.gpkg"] {
        if !folder.join(file).exists() {
            println!("no {file} in {}: name the folder in BURGEON_SHARED", folder.display());
            continue;
        }
        let pairs = neighbours(&folder, file);
        let low =
            pairs.first().and_then(|[one, _]| one.bounds()).map_or(DVec2::ZERO, |bounds| bounds[0].floor());
        for (place, by) in [("origin", -low), ("given", DVec2::ZERO), ("far", DVec2::splat(1e7) - low)] {
            show(
                file,
                place,
                pairs.iter().map(|pair| {
                    let [one, other] = pair.each_ref().map(|it| moved(it, by));
                    if one.is_valid() && other.is_valid() { all_operations(&one, &other) } else { None }
                }),
            );
        }
        let all: Vec<Geometry> = pairs.into_iter().flatten().collect();
        show(file, "all", std::iter::once_with(|| union_all(&all).validity_reason()));
    }
}
