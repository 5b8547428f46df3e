//! The readers of foreign bytes and texts: each takes any bytes, and may refuse them, but never panics.
//!
//! A target checks what it is given, too: what was read has finite numbers.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};
use std::time::{Duration, SystemTime};

use burgeon::kit::rules::{Pattern, Signature, Symbols};
use burgeon::kit::{Construct, LoadRequest, Resources, Table};
use burgeon::packages::{Manifest, install, is_name};
use burgeon::presets::Presets;
use burgeon::query::{Cell, Database};
use burgeon::script::{Limits, Print, RunOptions};
use burgeon::sources::elevation::{HeightOptions as WantedHeights, Raster, Relief};
use burgeon::sources::{Cache, Layer, Listing, Source, SourceOptions};
use burgeon::spatial::{BufferOptions, Geometry};
use burgeon::{Budget, Error, Result};
use rusqlite::Connection;

/// A reader.
pub(crate) struct Target {
    /// Its name, which is also that of its folder in `fuzz/corpus`.
    pub(crate) name: &'static str,
    /// Reads bytes; a folder is for files that it needs. Tells whether they were good.
    pub(crate) read: fn(&[u8], &Path) -> bool,
    /// Words that its inputs are made of.
    pub(crate) words: &'static [&'static str],
}

const JSON: &[&str] = &[
    "{",
    "}",
    "[",
    "]",
    ",",
    ":",
    "null",
    "true",
    "1e999",
    "-0",
    "1e-400",
    "\"\\ud800\"",
    "\"\"",
    "\u{feff}",
];

/// All of them.
pub(crate) const TARGETS: [Target; 21] = [
    Target {
        name: "geojson",
        read: |bytes, folder| layer(bytes, &folder.join("a.geojson")),
        words: &[
            "\"type\"",
            "\"Polygon\"",
            "\"MultiPolygon\"",
            "\"GeometryCollection\"",
            "\"coordinates\"",
            "\"crs\"",
            "urn:ogc:def:crs:EPSG::3067",
            "[[[",
            "]]]",
            "1e308",
            "1e999",
            "null",
            "{",
            "}",
        ],
    },
    Target { name: "geopackage", read: |bytes, folder| layer(bytes, &folder.join("a.gpkg")), words: &[] },
    Target {
        name: "flatgeobuf",
        read: |bytes, folder| layer(bytes, &folder.join("a.fgb")),
        words: &["\u{ff}\u{ff}\u{ff}\u{7f}", "\0\0\0\0", "\u{1}\0\0\0"],
    },
    Target {
        name: "gml",
        read: |bytes, folder| layer(bytes, &folder.join("a.gml")),
        words: &[
            "<gml:featureMember>",
            "</gml:featureMember>",
            "<gml:Polygon srsName=\"EPSG:4326\">",
            "<gml:posList srsDimension=\"3\">",
            "</gml:posList>",
            "<gml:interior>",
            "urn:ogc:def:crs:EPSG::4326",
            "<!DOCTYPE a [<!ENTITY a \"a\">]>",
            "&a;",
            "&#0;",
            "<![CDATA[",
            "]]>",
            "<!--",
            "1e999",
            "nan",
            "/>",
        ],
    },
    Target {
        name: "osm",
        read: osm,
        words: &["\u{ff}\u{ff}\u{ff}\u{ff}\u{f}", "OSMData", "building", "\u{1a}"],
    },
    Target {
        name: "wkt",
        read: |bytes, _| {
            Geometry::from_wkt_within(&String::from_utf8_lossy(bytes), &budget())
                .is_ok_and(|it| computed(&it))
        },
        words: &[
            "SRID=4326;",
            "GEOMETRYCOLLECTION (",
            "MULTISURFACE (",
            "CURVEPOLYGON (",
            "COMPOUNDCURVE (",
            "CIRCULARSTRING (0 0, 4 0, 0 0)",
            "POLYGON ((0 0, 9 0, 9 9, 0 0))",
            "MULTIPOINT",
            "LINESTRING Z (0 0 0, 9 9 9)",
            " EMPTY",
            " ZM",
            "POINT (1 2)",
            "1e15",
            "1e-300",
            "nan",
            ",",
            ")",
        ],
    },
    Target {
        name: "geometry",
        read: |bytes, _| Geometry::from_wkb(bytes).is_ok_and(|it| computed(&it)),
        words: &["\u{1}\u{7}\0\0\0\u{1}\0\0\0", "\u{1}\u{6}\0\0\0", "\0\0\0\u{8}", "\u{f0}\u{3f}"],
    },
    Target { name: "wkb", read: wkb, words: &["GP\0", "\0\0\0\u{8}", "\u{1}\u{6}\0\0\0"] },
    Target {
        name: "ascii",
        read: |bytes, _| heights(bytes, "a.asc"),
        words: &["ncols", "nrows", "xllcorner", "cellsize", "nodata_value", "-1", "0", "1e999", "nan", "\n"],
    },
    Target { name: "geotiff", read: |bytes, _| heights(bytes, "a.tif"), words: &[] },
    Target { name: "hgt", read: hgt, words: &["\u{0}\u{80}"] },
    Target {
        name: "zip",
        read: |bytes, _| heights(bytes, "N43E007.zip"),
        words: &["N43E007.hgt", "PK\u{1}\u{2}"],
    },
    Target {
        name: "manifest",
        read: manifest,
        words: &[
            "name",
            "version",
            "api",
            "[depends]",
            "[replaces]",
            "[params.a]",
            "\"@a/b\"",
            " = ",
            "\"1.0.0\"",
            "\n",
            "..",
            "{",
            "[",
        ],
    },
    Target {
        name: "package",
        read: package,
        words: &["mod.toml", "../", "/", "PK\u{1}\u{2}", "PK\u{3}\u{4}", "a.lua"],
    },
    Target {
        name: "png",
        read: |bytes, _| heights(bytes, "a.png"),
        words: &["IHDR", "IDAT", "IEND", "tEXt"],
    },
    Target {
        name: "model",
        read: model,
        words: &[
            "{",
            "}",
            "[",
            "]",
            "\"children\":[0]",
            "\"byteStride\":1",
            "\"sparse\"",
            "4294967295",
            "-1",
            "1e999",
        ],
    },
    Target { name: "presets", read: presets, words: JSON },
    Target {
        name: "query",
        read: query,
        words: &[
            "SELECT ",
            " FROM huts a",
            " JOIN huts b ON ",
            " LEFT JOIN ",
            " WHERE ",
            "ST_Intersects(a.geom, b.geom)",
            " ORDER BY a.geom <-> b.geom",
            " LIMIT 1",
            " NOT EXISTS (",
            "$g",
            " && ",
            "::text",
            " UNION ",
            "WITH n AS (",
            "ST_Buffer(",
            "count(*)",
            " GROUP BY ",
            "'",
            "\"",
            ";",
            "--",
            "/*",
            "(",
            ")",
            ",",
            "[",
            "`",
        ],
    },
    Target {
        name: "message",
        read: |bytes, _| burgeon::live::message::read(&String::from_utf8_lossy(bytes)).is_ok(),
        words: JSON,
    },
    Target {
        name: "pattern",
        read: pattern,
        words: &["A", "(", ")", "<", ">", "[", "]", ",", "x", "S", "Nothing", "\0", "ä"],
    },
    Target {
        name: "script",
        read: script,
        words: &[
            "function(this, n)",
            "end",
            "return",
            "{",
            "}",
            "local",
            "if",
            "then",
            "s:rule(\"A(n)\",",
            "s:derive()",
            "[[",
            "]]",
            "`{",
            "}`",
            "--[[",
            "=",
            "::",
            "continue",
            "A(",
            "nil",
            "\0",
        ],
    },
];

/// What one reading may take.
/// What a package says of itself.
fn manifest(bytes: &[u8], _: &Path) -> bool {
    let read = String::from_utf8(bytes.to_vec()).map(|text| Manifest::parse(&text, "mod.toml"));
    let Ok(Ok(manifest)) = read else { return false };
    assert!(is_name(&manifest.name));
    for one in &manifest.replaces {
        assert!(!one.target.path.split('/').chain(one.file.split('/')).any(|part| part == ".."));
    }
    true
}

/// A package in a zip: nothing of it is anywhere but in its own folder.
fn package(bytes: &[u8], folder: &Path) -> bool {
    let (zip, into) = (folder.join("a.zip"), folder.join("into"));
    // Without the file it is refused, which is told.
    let _ = fs::remove_dir_all(&into);
    let _ = fs::write(&zip, bytes);
    let made = install(&zip, &into, false);
    let there = fs::read_dir(&into).into_iter().flatten().flatten().count();
    assert_eq!(there, usize::from(made.is_ok()));
    let _ = fs::remove_dir_all(&into);
    made.is_ok()
}

fn budget() -> Arc<Budget> {
    Budget::within(Duration::from_secs(10), 100_000_000)
}

/// Features of a file, as metres and as a listing.
fn layer(bytes: &[u8], path: &Path) -> bool {
    let _ = fs::write(path, bytes);
    let _ = Listing::read(path, &budget()).map(|listing| (listing.text(), listing.to_json()));
    let wanted = SourceOptions { budget: budget(), ..SourceOptions::default() };
    let source = Source::open_within(path, "a", &wanted).and_then(|source| source.read("a", &wanted));
    let layer = source.and_then(|table| Layer::new(table, &mut None));
    let Ok(layer) = layer else { return false };
    let _ = layer.warnings();
    assert!(layer.bounds.iter().flatten().all(|value| value.is_finite()), "{:?}", layer.bounds);
    true
}

/// Layers of an extract of OpenStreetMap, in metres, and as a listing of all.
fn osm(bytes: &[u8], folder: &Path) -> bool {
    let path = folder.join("a.osm.pbf");
    let _ = fs::write(&path, bytes);
    let _ = Listing::read(&path, &budget()).map(|listing| (listing.text(), listing.to_json()));
    let mut good = true;
    for name in ["buildings", "roads", "trees"] {
        let wanted =
            SourceOptions { layer: Some(name.to_owned()), budget: budget(), ..SourceOptions::default() };
        let source = Source::open_within(&path, "a", &wanted).and_then(|source| source.read("a", &wanted));
        let layer = source.and_then(|table| Layer::new(table, &mut None));
        good &= layer.is_ok_and(|layer| {
            let _ = layer.warnings();
            layer.bounds.iter().flatten().all(|value| value.is_finite())
        });
    }
    good
}

/// The bytes as the geometry of a feature in a sound package.
/// Computes with a geometry that was read: all that comes of it has finite numbers, and is written as it is read.
fn computed(geometry: &Geometry) -> bool {
    assert_eq!(Geometry::from_wkt(&geometry.to_wkt()).ok().as_ref(), Some(geometry));
    assert_eq!(Geometry::from_wkb(&geometry.to_wkb()).ok().as_ref(), Some(geometry));
    // What takes long of many points is no subject here.
    if geometry.points().count() > 500 {
        return true;
    }
    let hull = geometry.convex_hull();
    for made in [
        geometry.union(&hull),
        hull.difference(geometry),
        geometry.intersection(&hull.envelope()),
        geometry.make_valid(),
        geometry.simplify(1.0),
        geometry.boundary(),
        geometry.centroid(),
        geometry.point_on_surface(),
        geometry.oriented_envelope(),
        geometry.buffer(1.0, &BufferOptions::default()).unwrap_or_default(),
        geometry.random_point(0.3, 0.7).unwrap_or_default(),
        geometry.nearest_point(&hull),
    ] {
        assert!(made.is_sound(), "{geometry}: {made}");
    }
    let _ = (geometry.relate(&hull), geometry.distance(&hull), geometry.area(), geometry.length());
    true
}

fn wkb(bytes: &[u8], folder: &Path) -> bool {
    let path = folder.join("wkb.gpkg");
    let made = || -> rusqlite::Result<()> {
        let is_new = !path.exists();
        let connection = Connection::open(&path)?;
        connection.execute_batch("PRAGMA synchronous = OFF; PRAGMA journal_mode = MEMORY;")?;
        if is_new {
            connection.execute_batch(
                "CREATE TABLE gpkg_contents(table_name TEXT PRIMARY KEY, data_type TEXT);
                 CREATE TABLE gpkg_geometry_columns(table_name TEXT, column_name TEXT, srs_id INT);
                 CREATE TABLE gpkg_spatial_ref_sys(srs_name TEXT, srs_id INT, organization TEXT, organization_coordsys_id INT);
                 INSERT INTO gpkg_spatial_ref_sys VALUES ('a', 3067, 'EPSG', 3067);
                 INSERT INTO gpkg_contents VALUES ('a', 'features');
                 INSERT INTO gpkg_geometry_columns VALUES ('a', 'geom', 3067);
                 CREATE TABLE a(fid INTEGER PRIMARY KEY, geom BLOB);",
            )?;
        }
        connection.execute("INSERT OR REPLACE INTO a VALUES (1, ?1)", [bytes])?;
        Ok(())
    };
    if made().is_err() {
        return false;
    }
    let wanted = SourceOptions { budget: budget(), ..SourceOptions::default() };
    let table = Source::open_within(&path, "a", &wanted).and_then(|source| source.read("a", &wanted));
    table.and_then(|table| Layer::new(table, &mut None)).is_ok()
}

/// Heights, in the file's places and in metres.
fn heights(bytes: &[u8], name: &str) -> bool {
    let place = Some([0.0, 0.0, 100.0, 100.0]);
    let png = name.ends_with("png");
    let range = |height| png.then_some(height);
    let colors = bytes.first().is_some_and(|byte| byte % 2 == 1);
    let plain = WantedHeights::default();
    let told = WantedHeights { low: range(0.0), high: range(9.0), bounds: place, ..plain.clone() };
    let colors =
        WantedHeights { terrain_rgb: png && colors, bounds: place, crs: Some(3067), ..plain.clone() };
    let mut good = false;
    for wanted in [plain, told, colors] {
        let Ok(raster) = Raster::read(bytes, name, &wanted, &budget()) else { continue };
        assert!(raster.heights.iter().all(|height| height.is_finite()), "a height is no number");
        let _ = (raster.warnings(), raster.filled_warning(), raster.range(), raster.bounds());
        let Ok(relief) = Relief::new(Arc::new(raster), &mut None) else { continue };
        let middle = (relief.low() + relief.high()) / 2.0;
        let _ = relief.ground(middle.truncate(), true);
        good |= relief.height(middle.truncate()).is_none_or(f64::is_finite);
    }
    good
}

/// The bytes as often as a tile of heights needs them.
fn hgt(bytes: &[u8], _: &Path) -> bool {
    let tile: Vec<u8> = bytes.iter().copied().cycle().take(1201 * 1201 * 2).collect();
    heights(&tile, "N43E007.hgt") | heights(bytes, "N43E007.hgt")
}

/// A run that has nothing but the file.
struct Alone;

impl Resources for Alone {
    fn find(&self, _: &'static str, name: &str) -> Result<PathBuf> {
        Err(Error::argument(format!("there is no {name}")))
    }

    fn cache(&self) -> Option<&Cache> {
        None
    }
}

fn model(bytes: &[u8], folder: &Path) -> bool {
    let path = folder.join("a.glb");
    let _ = fs::write(&path, bytes);
    let registry = burgeon::objects::registry();
    let Some(Construct::File(loader)) = registry.get("model").map(|kind| &kind.construct) else {
        return false;
    };
    let mut loading = LoadRequest {
        name: "a.glb",
        path: &path,
        budget: &budget(),
        triangles: 100_000,
        frame: &mut None,
        resources: &Alone,
    };
    let Ok(loaded) = (loader.load)(&mut loading, &Table::default()) else { return false };
    assert!(loaded.object.triangles() <= 100_000, "more triangles than it may have");
    let mut scene = burgeon::scene::Scene::default();
    let shown = loaded.object.show(&mut scene, "a", None);
    shown.is_ok() && scene.bounds().is_none_or(|(low, high)| low.is_finite() && high.is_finite())
}

fn presets(bytes: &[u8], folder: &Path) -> bool {
    let script = folder.join("a.lua");
    let path = Presets::path_of(&script);
    let _ = fs::write(&path, bytes);
    // A file that was just written may be half of what it will be, so that a reader waits.
    let old = SystemTime::now() - Duration::from_secs(3600);
    let _ = fs::File::options().write(true).open(&path).and_then(|file| file.set_modified(old));
    let read = Presets::read(&script);
    read.is_ok_and(|presets| presets.names().all(|name| presets.get(name).is_ok()))
}

/// A question that is put to two huts.
fn query(bytes: &[u8], folder: &Path) -> bool {
    static TABLES: OnceLock<Database> = OnceLock::new();
    let tables = TABLES.get_or_init(|| huts(folder).unwrap_or_else(|error| panic!("{error}")));
    let sql = String::from_utf8_lossy(bytes);
    let budget = Budget::within(Duration::from_secs(2), 20_000_000);
    let place = Geometry::from_wkt("POINT(1 2)").map_or(Cell::Null, |place| Cell::Geometry(Arc::new(place)));
    let _ = tables.plan(&sql, &budget);
    let answer = tables.query(&sql, &[("g", place), ("n", Cell::Number(1.0))], &budget);
    let Ok(answer) = answer else { return false };
    assert!(answer.rows.iter().all(|row| row.len() == answer.names.len()));
    true
}

/// A table with two huts.
fn huts(folder: &Path) -> Result<Database> {
    let path = folder.join("huts.geojson");
    let hut = |id: usize| {
        format!(
            r#"{{"type":"Feature","id":"{id}","properties":{{"name":"hut"}},"geometry":{{"type":"Polygon","coordinates":[[[0,0],[0.00{id},0],[0,0.00{id}],[0,0]]]}}}}"#
        )
    };
    let text = format!(r#"{{"type":"FeatureCollection","features":[{},{}]}}"#, hut(1), hut(2));
    // Without the file it is refused, which is told.
    let _ = fs::write(&path, text);
    let wanted = SourceOptions { budget: budget(), ..SourceOptions::default() };
    let mut frame = None;
    let layer = Layer::new(Source::open_within(&path, "huts", &wanted)?.read("huts", &wanted)?, &mut frame)?;
    let tables = Database::new(frame)?;
    tables.add_layer("huts", &layer, &budget())?;
    Ok(tables)
}

fn pattern(bytes: &[u8], _: &Path) -> bool {
    let mut symbols = Symbols::default();
    for (name, parameters) in [("A", &["x", "y"][..]), ("B", &[]), ("S", &["s"])] {
        let parameters: Vec<String> = parameters.iter().map(|name| (*name).to_owned()).collect();
        let _ = Signature::new(name, &parameters).and_then(|signature| symbols.declare(signature));
    }
    let text = String::from_utf8_lossy(bytes);
    let Ok(pattern) = Pattern::parse(&text, &symbols) else { return false };
    // It means the same when it is read again as it shows itself.
    let again = Pattern::parse(&pattern.text, &symbols);
    assert!(again.is_ok_and(|again| again.text == pattern.text), "{:?} is read otherwise", pattern.text);
    true
}

/// A script, with everything that is known of it before it runs, and its declarations.
fn script(bytes: &[u8], folder: &Path) -> bool {
    let path = folder.join("a.lua");
    let _ = fs::write(&path, bytes);
    let limits =
        Limits { time: Duration::from_secs(1), memory: 100_000_000, modules: 10_000, triangles: 10_000 };
    let options =
        RunOptions { limits, threads: Some(1), print: Some(Print::new(|_: &str| {})), ..burgeon::options() };
    burgeon::check(&path, options).is_ok()
}
