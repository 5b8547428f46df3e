//! Benchmark of layers in all formats: time to read, and memory for a million features. `cargo bench -p burgeon-data
//! --bench sources`.

#![allow(clippy::print_stdout, reason = "a bench prints its figures")]
#![allow(clippy::unwrap_used, reason = "a bench stops at what is wrong")]

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use burgeon_data::{Layer, Source, SourceOptions};
use burgeon_spatial::Geometry;
use flatgeobuf::{ColumnType, FgbCrs, FgbWriter, FgbWriterOptions, GeometryType};
use geozero::wkb::Wkb;
use geozero::{ColumnValue, PropertyProcessor};

/// The same allocator as in the program.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Number of features: one million.
const COUNT: usize = 1_000_000;

/// Parts of each file to read: a name, and the options.
fn parts(layer: Option<&str>) -> [(&'static str, SourceOptions); 3] {
    let all = SourceOptions { layer: layer.map(str::to_owned), ..SourceOptions::default() };
    let few = SourceOptions { limit: Some(1000), ..all.clone() };
    let place =
        SourceOptions { within: Some([380_000.0, 6_670_000.0, 380_999.0, 6_670_999.0]), ..all.clone() };
    [("all", all), ("limit = 1000", few), ("within a box", place)]
}

/// Returns the position (m, EPSG:3067) of a feature, as if in a city of a thousand streets.
fn place(number: usize) -> [f64; 2] {
    #[allow(clippy::cast_precision_loss, reason = "below 2^53")]
    let [x, y] = [number % 1000, number / 1000].map(|at| at as f64 * 10.0);
    [380_000.0 + x, 6_670_000.0 + y]
}

fn shape(number: usize, polygons: bool) -> String {
    let [x, y] = place(number);
    match polygons {
        false => format!("POINT ({x} {y})"),
        true => {
            let [east, north] = [x + 5.0, y + 5.0];
            format!("POLYGON (({x} {y}, {east} {y}, {east} {north}, {x} {north}, {x} {y}))")
        }
    }
}

const KINDS: [&str; 4] = ["house", "garage", "apartments", "shed"];

fn geojson(path: &Path, polygons: bool) {
    let mut text = String::new();
    for number in 0..COUNT {
        let [x, y] = place(number);
        let [east, north] = [x + 5.0, y + 5.0];
        let geometry = match polygons {
            false => format!(r#"{{"type":"Point","coordinates":[{x},{y}]}}"#),
            true => format!(
                r#"{{"type":"Polygon","coordinates":[[[{x},{y}],[{east},{y}],[{east},{north}],[{x},{north}],[{x},{y}]]]}}"#
            ),
        };
        let crs = if number == 0 { r#""crs":{"properties":{"name":"EPSG:3067"}},"# } else { "" };
        let (kind, height) = (KINDS[number % 4], number % 30);
        let _ = writeln!(
            text,
            r#"{{"type":"Feature",{crs}"id":{number},"properties":{{"kind":"{kind}","height":{height},"levels":3}},"geometry":{geometry}}}"#
        );
    }
    std::fs::write(path, text).unwrap();
}

fn geopackage(path: &Path, polygons: bool) {
    let mut connection = rusqlite::Connection::open(path).unwrap();
    connection
        .execute_batch(
            "CREATE TABLE gpkg_contents(table_name TEXT PRIMARY KEY, data_type TEXT);
             CREATE TABLE gpkg_geometry_columns(table_name TEXT, column_name TEXT, srs_id INT);
             CREATE TABLE gpkg_spatial_ref_sys(srs_name TEXT, srs_id INT, organization TEXT, organization_coordsys_id INT);
             INSERT INTO gpkg_spatial_ref_sys VALUES ('a', 3067, 'EPSG', 3067);
             INSERT INTO gpkg_contents VALUES ('a', 'features');
             INSERT INTO gpkg_geometry_columns VALUES ('a', 'geom', 3067);
             CREATE TABLE a(fid INTEGER PRIMARY KEY, geom BLOB, kind TEXT, height REAL, levels REAL);",
        )
        .unwrap();
    let transaction = connection.transaction().unwrap();
    {
        let mut insert = transaction.prepare("INSERT INTO a VALUES (?1, ?2, ?3, ?4, 3)").unwrap();
        for number in 0..COUNT {
            let mut blob = b"GP\0\x01\xfb\x0b\0\0".to_vec();
            blob.extend(Geometry::from_wkt(&shape(number, polygons)).unwrap().to_wkb());
            let height = u32::try_from(number % 30).unwrap();
            insert.execute((i64::try_from(number).unwrap(), blob, KINDS[number % 4], height)).unwrap();
        }
    }
    transaction.commit().unwrap();
}

fn flatgeobuf(path: &Path, polygons: bool) {
    let kind = if polygons { GeometryType::Polygon } else { GeometryType::Point };
    let options = FgbWriterOptions {
        crs: FgbCrs { code: 3067, ..FgbCrs::default() },
        promote_to_multi: false,
        ..FgbWriterOptions::default()
    };
    let mut writer = FgbWriter::create_with_options("a", kind, options).unwrap();
    writer.add_column("kind", ColumnType::String, |_, _| {});
    writer.add_column("height", ColumnType::Double, |_, _| {});
    writer.add_column("levels", ColumnType::Double, |_, _| {});
    for number in 0..COUNT {
        let bytes = Geometry::from_wkt(&shape(number, polygons)).unwrap().to_wkb();
        let height = f64::from(u32::try_from(number % 30).unwrap());
        writer
            .add_feature_geom(Wkb(bytes), |feature| {
                feature.property(0, "kind", &ColumnValue::String(KINDS[number % 4])).unwrap();
                feature.property(1, "height", &ColumnValue::Double(height)).unwrap();
                feature.property(2, "levels", &ColumnValue::Double(3.0)).unwrap();
            })
            .unwrap();
    }
    writer.write(std::io::BufWriter::new(std::fs::File::create(path).unwrap())).unwrap();
}

/// Returns the peak memory (MiB) of this process.
fn peak() -> usize {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    line.and_then(|line| line.split_whitespace().next()?.parse::<usize>().ok()).unwrap_or_default() / 1024
}

/// Reads a part of a file, alone in a process.
fn read(path: &Path, part: usize) {
    let (_, wanted) = &parts(None)[part];
    let begin = Instant::now();
    let table = Source::open_within(path, "a", wanted).and_then(|source| source.read("a", wanted)).unwrap();
    let layer = Layer::new(table, &mut None).unwrap();
    let (count, seconds) = (layer.features.len(), begin.elapsed().as_secs_f64());
    println!("{count:9} features {seconds:6.2} s {:5} MiB at most", peak());
}

/// Reads the extracts in the folder of shared data, if it exists.
fn extracts() {
    let shared = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    for file in ["Helsinki.osm.pbf", "monaco-latest.osm.pbf"] {
        let path = shared.join(file);
        if !path.is_file() {
            println!("skipped: there is no ../shared/data/{file}");
            continue;
        }
        for layer in ["buildings", "roads", "trees", "furniture"] {
            let wanted = SourceOptions { layer: Some(layer.to_owned()), ..SourceOptions::default() };
            let mut count = 0;
            let times = (0..9).map(|_| {
                let begin = Instant::now();
                let table = Source::open_within(&path, file, &wanted).unwrap().read(file, &wanted).unwrap();
                count = table.records;
                begin.elapsed().as_secs_f64() * 1e3
            });
            let mut times: Vec<f64> = times.collect();
            times.sort_by(f64::total_cmp);
            println!(
                "{file}:{layer}: {count} records, {:.1} ms (the median of 9; {:.1} at best)",
                times[4], times[0]
            );
        }
    }
}

/// Writer of a million points or small polygons.
type Writer = fn(&Path, bool);

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    if let [_, command, path, part] = &arguments[..]
        && command == "read"
    {
        return read(Path::new(path), part.parse().unwrap());
    }
    extracts();
    let folder = tempfile::tempdir().unwrap();
    let program = std::env::current_exe().unwrap();
    let writers: [(&str, Writer); 3] =
        [("a.geojsonl", geojson), ("a.gpkg", geopackage), ("a.fgb", flatgeobuf)];
    for polygons in [false, true] {
        for (name, write) in writers {
            let path: PathBuf = folder.path().join(name);
            write(&path, polygons);
            let size = path.metadata().unwrap().len() / 1_000_000;
            println!("{COUNT} {} in {name} of {size} MB", if polygons { "polygons" } else { "points" });
            for (number, (part, _)) in parts(None).iter().enumerate() {
                let output =
                    Command::new(&program).arg("read").arg(&path).arg(number.to_string()).output().unwrap();
                print!(
                    "  {part:13}{}{}",
                    String::from_utf8_lossy(&output.stdout),
                    String::from_utf8_lossy(&output.stderr)
                );
            }
            std::fs::remove_file(&path).unwrap();
        }
    }
}
