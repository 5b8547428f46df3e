//! Spatial questions on footprints, roads and furniture, here and put to PostGIS, in one table.
//!
//! `cargo bench -p burgeon-query`, with BURGEON_SHARED for the folder of `france_buildings.gpkg` and `helsinki.gpkg`
//! (`../shared/data` unless it says otherwise), and BURGEON_POSTGIS for the address of a server that may be filled.
#![allow(
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "a bench shows figures, and ends where they cannot be had"
)]

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use burgeon_base::Budget;
use burgeon_query::{Cell, Database, QueryAnswer};

/// A question: what it is about, the files that it needs, how it is written, and how many milliseconds it may take.
struct Question {
    about: &'static str,
    tables: &'static [(&'static str, &'static str)],
    sql: &'static str,
    most: Option<f64>,
}

const FRANCE: &[(&str, &str)] = &[("france_buildings.gpkg", "buildings")];
const HELSINKI: &[(&str, &str)] =
    &[("helsinki.gpkg", "buildings"), ("helsinki.gpkg", "roads"), ("helsinki.gpkg", "furniture")];

const QUESTIONS: [Question; 7] = [
    Question {
        about: "footprints that meet (self-join)",
        tables: FRANCE,
        sql: "SELECT a.fid, b.fid AS other FROM buildings a JOIN buildings b ON a.fid < b.fid AND ST_Intersects(a.geom, b.geom)",
        most: Some(250.0),
    },
    Question {
        about: "the same, of one town",
        tables: FRANCE,
        sql: "SELECT a.fid, b.fid AS other FROM buildings a, buildings b WHERE ST_Intersects(a.geom, b.geom) AND a.fid < b.fid AND b.city = a.city",
        most: Some(250.0),
    },
    Question {
        about: "footprints without neighbours",
        tables: FRANCE,
        sql: "SELECT a.fid FROM buildings a WHERE NOT EXISTS (SELECT 1 FROM buildings b WHERE a.fid <> b.fid AND ST_DWithin(a.geom, b.geom, 3))",
        most: None,
    },
    Question {
        about: "footprints that overlap",
        tables: FRANCE,
        sql: "SELECT a.fid, b.fid AS other FROM buildings a JOIN buildings b ON a.fid < b.fid AND ST_Overlaps(a.geom, b.geom)",
        most: None,
    },
    Question {
        about: "furniture in a buffer of roads",
        tables: HELSINKI,
        sql: "SELECT r.fid, count(f.fid) AS n FROM roads r LEFT JOIN furniture f ON ST_Intersects(ST_Buffer(r.geom, 5), f.geom) GROUP BY r.fid",
        most: None,
    },
    Question {
        about: "the nearest road of buildings",
        tables: HELSINKI,
        sql: "SELECT b.fid, (SELECT r.fid FROM roads r ORDER BY r.geom <-> b.geom LIMIT 1) AS road FROM buildings b",
        most: Some(15.0),
    },
    Question {
        about: "the nearest road of furniture",
        tables: HELSINKI,
        sql: "SELECT f.fid, (SELECT r.fid FROM roads r ORDER BY r.geom <-> f.geom LIMIT 1) AS road FROM furniture f",
        most: Some(15.0),
    },
];

fn folder() -> PathBuf {
    std::env::var_os("BURGEON_SHARED")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"), PathBuf::from)
}

/// The best of so many times (ms), and what came of it.
fn best(times: usize, mut work: impl FnMut() -> Arc<QueryAnswer>) -> (f64, Arc<QueryAnswer>) {
    let mut least = f64::INFINITY;
    let mut answer = work();
    for _ in 0..times {
        let begin = Instant::now();
        answer = work();
        least = least.min(begin.elapsed().as_secs_f64() * 1000.0);
    }
    (least, answer)
}

fn main() {
    let folder = folder();
    if !folder.join("france_buildings.gpkg").exists() {
        println!("no data in {}: name the folder in BURGEON_SHARED", folder.display());
        return;
    }
    let budget = Arc::new(Budget::default());
    println!("{:34} {:>8} {:>10} {:>10} {:>10}", "question", "rows", "first ms", "best ms", "at most");
    let mut over = Vec::new();
    for Question { about, tables, sql, most } in &QUESTIONS {
        let database = Database::new(None).unwrap();
        for (file, layer) in *tables {
            database.add_geopackage(layer, &folder.join(file), file, layer, &budget).unwrap();
        }
        let begin = Instant::now();
        database.query(sql, &[], &budget).unwrap();
        let first = begin.elapsed().as_secs_f64() * 1000.0;
        let (least, answer) = best(5, || database.query(sql, &[], &budget).unwrap());
        let most_shown = most.map_or_else(String::new, |most| format!("{most:.0}"));
        println!("{about:34} {:>8} {first:>10.1} {least:>10.1} {most_shown:>10}", answer.rows.len());
        if most.is_some_and(|most| least > most) {
            over.push(*about);
        }
    }
    let database = Database::new(None).unwrap();
    for (file, layer) in HELSINKI {
        database.add_geopackage(layer, &folder.join(file), file, layer, &budget).unwrap();
    }
    let items = database.query("SELECT geom FROM furniture", &[], &budget).unwrap();
    let (least, _) = best(5, || {
        let mut last = Arc::default();
        for row in &items.rows {
            let at: [(&str, Cell); 1] = [("g", row[0].clone())];
            last = database
                .query("SELECT fid FROM roads ORDER BY ST_Distance(geom, $g) LIMIT 1", &at, &budget)
                .unwrap();
        }
        last
    });
    println!("{:34} {:>8} {:>10} {least:>10.1}", "furniture, a question for each", items.rows.len(), "");
    assert!(over.is_empty(), "over the limit: {}", over.join(", "));
}
