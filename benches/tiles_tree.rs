//! Tree of the tiles of a country with synthetic footprints: plan and join of the tree, with the content of a sample.
//! `cargo bench --bench tiles_tree`, or `-- 10000000 870` for that number of features, and of features of a tile. A third number makes
//! one of so many shares of the tiles: `-- 46286334 500 100` makes a hundredth of the tiles of a country like France.

#![allow(clippy::print_stdout, clippy::cast_precision_loss, reason = "a bench prints its figures")]

use std::error::Error;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use burgeon::tiles::make::{TileFile, TileManifest};
use burgeon::tiles::plan::{PLAN_VERSION, PlannedTile};
use burgeon::tiles::{EarthMap, TileFolder, TilePlan, Tiling, join_tiles};
use rusqlite::Connection;

type Outcome<T> = Result<T, Box<dyn Error>>;

/// Number of features without an argument.
const FEATURES: u64 = 1_000_000;

/// Number of features of a tile without an argument. With [`FEATURES`], there are about as many tiles as other programs make of
/// the 46,286,334 buildings of France: 117,745.
const TARGET: u64 = 12;

/// Script whose tiles are planned.
const SCRIPT: &str = r#"local Walls = module("Walls")
local s = lsystem({ object = footprint })
s:axiom(source("country.gpkg:buildings"), function(feature) return footprint(feature.geometry), Walls() end)
s:interpret("Walls", function(this) this:walls({ height = 6 }) end)
s:derive(0)
"#;

/// Script whose tiles are made: houses with simple facades.
const HOUSES: &str = include_str!("tiles.lua");

/// Stream of pseudo-random numbers from 0 to 1 (splitmix64).
struct Stream(u64);

impl Stream {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ bits >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ bits >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((bits ^ bits >> 31) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Writes a GeoPackage of `count` rectangles in towns of very different sizes over 950 km, in Lambert-93. `is_indexed` adds a spatial
/// index.
fn write_country(path: &Path, count: u64, is_indexed: bool) -> Outcome<()> {
    let connection = Connection::open(path)?;
    connection.execute_batch(
        "PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF; PRAGMA page_size = 65536; VACUUM;
         CREATE TABLE gpkg_contents(table_name TEXT PRIMARY KEY, data_type TEXT);
         CREATE TABLE gpkg_geometry_columns(table_name TEXT, column_name TEXT, srs_id INT);
         CREATE TABLE gpkg_spatial_ref_sys(srs_name TEXT, srs_id INT, organization TEXT, organization_coordsys_id INT);
         INSERT INTO gpkg_spatial_ref_sys VALUES ('a', 2154, 'EPSG', 2154);
         INSERT INTO gpkg_contents VALUES ('buildings', 'features');
         INSERT INTO gpkg_geometry_columns VALUES ('buildings', 'geom', 2154);
         CREATE TABLE gpkg_extensions(table_name TEXT, column_name TEXT, extension_name TEXT);
         CREATE TABLE buildings(fid INTEGER PRIMARY KEY, geom BLOB, levels INTEGER);
         CREATE VIRTUAL TABLE rtree_buildings_geom USING rtree(id, minx, maxx, miny, maxy);
         BEGIN",
    )?;
    if is_indexed {
        connection
            .execute("INSERT INTO gpkg_extensions VALUES ('buildings', 'geom', 'gpkg_rtree_index')", ())?;
    }
    let mut index = connection.prepare("INSERT INTO rtree_buildings_geom VALUES (?1, ?2, ?3, ?4, ?5)")?;
    let mut insert = connection.prepare("INSERT INTO buildings VALUES (?1, ?2, ?3)")?;
    let mut stream = Stream(7);
    let (mut number, mut left, mut place, mut columns) = (0_u64, 0_u64, [0.0; 2], 1_u64);
    let mut blob = b"GP\0\x01\0\0\0\0\x01".to_vec();
    blob.extend([3_u32, 1, 5].into_iter().flat_map(u32::to_le_bytes));
    let head = blob.len();
    while number < count {
        if left == 0 {
            // The sizes of towns follow a power law.
            left = (60.0 / stream.next().max(1e-4)) as u64;
            columns = (left as f64).sqrt().ceil() as u64;
            place = [120_000.0 + stream.next() * 950_000.0, 6_100_000.0 + stream.next() * 950_000.0];
        }
        left -= 1;
        let (column, row) = (left % columns, left / columns);
        let (west, south) = (place[0] + column as f64 * 22.0, place[1] + row as f64 * 31.0);
        let (east, north) = (west + 7.0 + 9.0 * stream.next(), south + 8.0 + 9.0 * stream.next());
        blob.truncate(head);
        for value in [west, south, east, south, east, north, west, north, west, south] {
            blob.extend(value.to_le_bytes());
        }
        number += 1;
        let id = i64::try_from(number)?;
        insert.execute((id, &blob, 1 + (number % 4) as i64))?;
        if is_indexed {
            index.execute((id, west, east, south, north))?;
        }
    }
    drop((insert, index));
    connection.execute_batch("COMMIT")?;
    Ok(())
}

/// Writes a manifest and a content of one byte for each tile that has not been made.
fn write_manifests(folder: &TileFolder, plan: &TilePlan) -> Outcome<()> {
    let frame = plan.frame.reference()?;
    let map = EarthMap::new(&frame, plan.frame.geoid_height)?;
    for tile in plan.tiles.iter().filter(|tile| !folder.manifest(tile.id).exists()) {
        let PlannedTile { region: [west, south, east, north], .. } = *tile;
        let axes = map.axes(tile.origin())?;
        let middle = [west.midpoint(east) - tile.origin()[0], south.midpoint(north) - tile.origin()[1]];
        let (x, y) = ((east - west) / 2.0, (north - south) / 2.0);
        let file = TileFile {
            bytes: 1,
            hash: String::new(),
            degrees: axes.degrees,
            bounds: [middle[0], middle[1], 5.0, x, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, 5.0],
            triangles: 1,
            instances: 1,
            primitives: 1,
        };
        let manifest = TileManifest {
            version: PLAN_VERSION,
            tile: tile.id,
            hash: tile.hash.clone(),
            content: Some(file),
            tables: Vec::new(),
            features: tile.features,
            missing: Vec::new(),
            error: None,
            errors: Vec::new(),
            warnings: Vec::new(),
        };
        let path = folder.content(tile.id);
        path.parent().map_or(Ok(()), fs::create_dir_all)?;
        fs::write(path, "a")?;
        fs::write(folder.manifest(tile.id), serde_json::to_string_pretty(&manifest)?)?;
    }
    Ok(())
}

/// Runs a command of `burgeon tiles` in a folder, and prints its time and its report.
fn run(folder: &Path, name: &str, arguments: &[&str]) -> Outcome<()> {
    let begin = Instant::now();
    let mut command = Command::new(env!("CARGO_BIN_EXE_burgeon"));
    command.args(["tiles", name]).args(arguments).arg("--json").current_dir(folder);
    let output = command.output()?;
    let (text, problem) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    let time = begin.elapsed().as_secs_f64();
    println!("{name}: {time:.1} s, {:.1} s of CPU time so far; {}{problem}", children_cpu(), text.trim());
    if output.status.success() { Ok(()) } else { Err(format!("{name} failed").into()) }
}

/// Makes one of `shares` shares of the tiles of a plan, and prints its features and its size.
fn make_sample(folder: &TileFolder, plan: &TilePlan, shares: &str) -> Outcome<()> {
    let share = format!("1/{shares}");
    run(folder.path(), "make", &[".", "--threads", "1", "--share", &share])?;
    let (mut tiles, mut features, mut bytes) = (0, 0, 0);
    for tile in &plan.tiles {
        if let Some(TileManifest { content: Some(file), .. }) = TileManifest::read(folder, tile.id)? {
            tiles += 1;
            features += tile.features;
            bytes += file.bytes;
        }
    }
    println!("sample: {tiles} tiles with {features} features and {:.1} MB", bytes as f64 / 1e6);
    Ok(())
}

fn main() -> Outcome<()> {
    let mut numbers = std::env::args().filter_map(|argument| argument.parse::<u64>().ok());
    let count = numbers.next().unwrap_or(FEATURES);
    let target = numbers.next().unwrap_or(TARGET).to_string();
    let shares = numbers.next().map(|shares| shares.to_string());
    let folder = tempfile::tempdir()?;
    let path = |name: &str| folder.path().join(name);
    let begin = Instant::now();
    write_country(&path("country.gpkg"), count, shares.is_some())?;
    let script =
        if shares.is_some() { HOUSES.replace("city.gpkg", "country.gpkg") } else { SCRIPT.to_owned() };
    fs::write(path("country.lua"), script)?;
    let size = fs::metadata(path("country.gpkg"))?.len() / 1_000_000;
    println!("{count} features with {size} MB written in {:.1} s", begin.elapsed().as_secs_f64());
    let options =
        ["--reach", "2", "--geoid-height", "44", "--compress", "meshopt", "--target-features", &target];
    run(folder.path(), "plan", &[&["country.lua", "-o", "out"][..], &options].concat())?;
    let out = TileFolder(path("out"));
    let begin = Instant::now();
    let plan = TilePlan::read(&out.plan())?;
    let size = fs::metadata(out.plan())?.len() / 1_000_000;
    println!(
        "plan of {} tiles and {size} MB read in {:.2} s",
        plan.tiles.len(),
        begin.elapsed().as_secs_f64()
    );
    let begin = Instant::now();
    let mut again = plan.clone();
    again.set_hashes()?;
    let hashed = begin.elapsed().as_secs_f64();
    println!(
        "hashes: {hashed:.2} s; text: {} bytes in {:.2} s",
        again.text()?.len(),
        begin.elapsed().as_secs_f64() - hashed
    );
    let begin = Instant::now();
    again.reach = 20.0;
    again.set_hashes()?;
    println!("hashes with a reach: {:.2} s", begin.elapsed().as_secs_f64());
    if let Some(shares) = &shares {
        make_sample(&out, &plan, shares)?;
    }
    let begin = Instant::now();
    write_manifests(&out, &plan)?;
    println!("manifests written in {:.1} s", begin.elapsed().as_secs_f64());
    for tiling in [Tiling::Explicit, Tiling::Implicit] {
        let begin = Instant::now();
        let joined = join_tiles(&out, &plan, tiling)?;
        let time = begin.elapsed().as_secs_f64();
        println!(
            "{tiling:?}: {} tiles joined in {time:.2} s, {} + {} files",
            joined.tiles, joined.tilesets, joined.subtrees
        );
    }
    Ok(())
}

/// Returns the CPU time (s) of all child processes that have ended; only on Linux.
fn children_cpu() -> f64 {
    let stat = fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields: Vec<&str> = stat.rsplit(')').next().unwrap_or_default().split_whitespace().collect();
    let ticks = |index: usize| fields.get(index).and_then(|field| field.parse::<f64>().ok());
    // Fields 16 and 17 of proc_pid_stat(5), in hundredths of a second, counted without the fields up to the process name.
    ticks(13).zip(ticks(14)).map_or(f64::NAN, |(user, system)| (user + system) / 100.0)
}
