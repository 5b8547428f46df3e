//! Spatial queries on footprints, roads and furniture, run by Burgeon and by PostGIS, in one table.
//!
//! `cargo bench -p burgeon-sources`. BURGEON_SHARED is the folder of `france_buildings.gpkg` and `helsinki.gpkg` (default
//! `../shared/data`), and BURGEON_POSTGIS is the address of a server to which data may be written: `tests/postgis.sh
//! cargo bench -p burgeon-sources`.
#![allow(
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "a bench shows figures, and ends where they cannot be had"
)]

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use burgeon_base::Budget;
use burgeon_kit::QueryRows;
use burgeon_sources::sql::{Cell, Database};

/// Allocator of the program.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// A query: its description, the files that it needs, its SQL, and its time limit (ms), alone or together with other
/// queries of the same group.
struct Question {
    about: &'static str,
    tables: &'static [(&'static str, &'static str)],
    sql: &'static str,
    most: Option<(&'static str, f64)>,
}

const FRANCE: &[(&str, &str)] = &[("france_buildings.gpkg", "buildings")];
const HELSINKI: &[(&str, &str)] =
    &[("helsinki.gpkg", "buildings"), ("helsinki.gpkg", "roads"), ("helsinki.gpkg", "furniture")];

const QUESTIONS: [Question; 7] = [
    Question {
        about: "footprints that meet (self-join)",
        tables: FRANCE,
        sql: "SELECT a.fid, b.fid AS other FROM buildings a JOIN buildings b ON a.fid < b.fid AND ST_Intersects(a.geom, b.geom)",
        most: Some(("footprints that meet", 250.0)),
    },
    Question {
        about: "the same, of one town",
        tables: FRANCE,
        sql: "SELECT a.fid, b.fid AS other FROM buildings a, buildings b WHERE ST_Intersects(a.geom, b.geom) AND a.fid < b.fid AND b.city = a.city",
        most: Some(("footprints of one town", 250.0)),
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
        most: Some(("the nearest road, all of them", 15.0)),
    },
    Question {
        about: "the nearest road of furniture",
        tables: HELSINKI,
        sql: "SELECT f.fid, (SELECT r.fid FROM roads r ORDER BY r.geom <-> f.geom LIMIT 1) AS road FROM furniture f",
        most: Some(("the nearest road, all of them", 15.0)),
    },
];

fn folder() -> PathBuf {
    std::env::var_os("BURGEON_SHARED")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"), PathBuf::from)
}

/// Returns the best time (ms) of `times` runs, and the last result.
fn best(times: usize, mut work: impl FnMut() -> QueryRows<Cell>) -> (f64, QueryRows<Cell>) {
    let mut least = f64::INFINITY;
    let mut answer = work();
    for _ in 0..times {
        let begin = Instant::now();
        answer = work();
        least = least.min(begin.elapsed().as_secs_f64() * 1000.0);
    }
    (least, answer)
}

/// Writes the layers of a file to a server, in separate schemas.
#[cfg(feature = "postgis")]
fn fill(address: &str, folder: &Path) {
    let mut client = postgres::Client::connect(address, postgres::NoTls).unwrap();
    for (file, layer, schema) in [
        ("france_buildings.gpkg", "buildings", "france"),
        ("helsinki.gpkg", "buildings", "helsinki"),
        ("helsinki.gpkg", "roads", "helsinki"),
        ("helsinki.gpkg", "furniture", "helsinki"),
    ] {
        let begin = format!(
            "CREATE SCHEMA IF NOT EXISTS burgeon_{schema}; DROP TABLE IF EXISTS burgeon_{schema}.{layer}"
        );
        client.batch_execute(&begin).unwrap();
        let table = format!("burgeon_{schema}.{layer}");
        let create = format!("CREATE TABLE {table} (fid int PRIMARY KEY, geom geometry, city text)");
        client.batch_execute(&create).unwrap();
        let database = Database::new(None).unwrap();
        let budget = Arc::new(Budget::default());
        database.add_geopackage(layer, &folder.join(file), file, layer, &budget).unwrap();
        let city = if schema == "france" { "city" } else { "''" };
        let sql = format!("SELECT fid, ST_AsText(geom), {city} AS city FROM {layer}");
        let mut batch = String::new();
        for row in database.query(&sql, &[], &budget).unwrap().iter() {
            let text = |cell: &Cell| match cell {
                Cell::Text(text) => format!("'{}'", text.replace('\'', "''")),
                _ => "NULL".to_owned(),
            };
            batch +=
                &format!("INSERT INTO {table} VALUES ({}, {}, {});", row[0], text(&row[1]), text(&row[2]));
        }
        client.batch_execute(&batch).unwrap();
        client.batch_execute(&format!("CREATE INDEX ON {table} USING gist (geom); ANALYZE {table}")).unwrap();
    }
}

/// Returns the best time (ms) of three runs of a query on a server, with all rows fetched, and the number of rows.
#[cfg(feature = "postgis")]
fn server(address: &str, file: &str, sql: &str) -> (f64, usize) {
    let mut client = postgres::Client::connect(address, postgres::NoTls).unwrap();
    let schema = if file.starts_with("france") { "france" } else { "helsinki" };
    client.batch_execute(&format!("SET search_path = burgeon_{schema}, public")).unwrap();
    let statement = client.prepare(sql).unwrap();
    let (mut least, mut rows) = (f64::INFINITY, 0);
    for _ in 0..3 {
        let begin = Instant::now();
        rows = client.query(&statement, &[]).unwrap().len();
        least = least.min(begin.elapsed().as_secs_f64() * 1000.0);
    }
    (least, rows)
}

/// Returns the time on a server, or an empty string without a server.
fn beside(file: &str, sql: &str, rows: usize) -> String {
    #[cfg(feature = "postgis")]
    if let Ok(address) = std::env::var("BURGEON_POSTGIS") {
        let (least, found) = server(&address, file, sql);
        let other = if found == rows { String::new() } else { format!(" ({found} rows)") };
        return format!("{least:.1}{other}");
    }
    let _ = (file, sql, rows);
    String::new()
}

fn main() {
    let folder = folder();
    if !folder.join("france_buildings.gpkg").exists() {
        println!("no data in {}: name the folder in BURGEON_SHARED", folder.display());
        return;
    }
    #[cfg(feature = "postgis")]
    if let Ok(address) = std::env::var("BURGEON_POSTGIS") {
        fill(&address, &folder);
    }
    let budget = Arc::new(Budget::default());
    println!("{:34} {:>8} {:>10} {:>10} {:>11}", "question", "rows", "first ms", "best ms", "PostGIS ms");
    let mut groups: Vec<(&str, f64, f64)> = Vec::new();
    for Question { about, tables, sql, most } in &QUESTIONS {
        let database = Database::new(None).unwrap();
        for (file, layer) in *tables {
            database.add_geopackage(layer, &folder.join(file), file, layer, &budget).unwrap();
        }
        let begin = Instant::now();
        database.query(sql, &[], &budget).unwrap();
        let first = begin.elapsed().as_secs_f64() * 1000.0;
        let (least, answer) = best(5, || database.query(sql, &[], &budget).unwrap());
        let there = beside(tables[0].0, sql, answer.len());
        println!("{about:34} {:>8} {first:>10.1} {least:>10.1} {there:>11}", answer.len());
        if let Some((group, most)) = most {
            match groups.iter_mut().find(|(known, ..)| known == group) {
                Some((_, taken, _)) => *taken += least,
                None => groups.push((group, least, *most)),
            }
        }
    }
    let database = Database::new(None).unwrap();
    for (file, layer) in HELSINKI {
        database.add_geopackage(layer, &folder.join(file), file, layer, &budget).unwrap();
    }
    let items = database.query("SELECT geom FROM furniture", &[], &budget).unwrap();
    let (least, _) = best(5, || {
        let mut last = QueryRows::default();
        for row in items.iter() {
            let at: [(&str, Cell); 1] = [("g", row[0].clone())];
            last = database
                .query("SELECT fid FROM roads ORDER BY ST_Distance(geom, $g) LIMIT 1", &at, &budget)
                .unwrap();
        }
        last
    });
    println!("{:34} {:>8} {:>10} {least:>10.1}", "furniture, a question for each", items.len(), "");
    for (group, taken, most) in &groups {
        let verdict = if taken <= most { "met" } else { "missed" };
        println!("{group}: {taken:.1} ms, of at most {most:.0}: {verdict}");
    }
}
