//! What each target does with its bytes. What was read is looked at too: it has finite numbers, and is written as it is
//! read.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};
use std::time::{Duration, SystemTime};

use burgeon::kit::{Construct, LoadRequest, Resources, Table};
use burgeon::packages::{Manifest, install, is_name};
use burgeon::presets::Presets;
use burgeon::script::{Limits, Print, RunOptions, RunReports};
use burgeon::sources::sql::postgis::ServerAddress;
use burgeon::sources::sql::{Cell, Database};
use burgeon::terrain::{Edits, World};
use burgeon::{Budget, Error, Result};
use burgeon_data::elevation::{HeightOptions as WantedHeights, Raster, Relief};
use burgeon_data::{Layer, Listing, Source, SourceOptions};
use burgeon_rewriting::{Pattern, Signature, Symbols};
use burgeon_spatial::{BufferOptions, Geometry};
use rusqlite::Connection;

/// What a package says of itself.
pub(crate) fn manifest(bytes: &[u8], _: &Path) -> bool {
    let read = String::from_utf8(bytes.to_vec()).map(|text| Manifest::parse(&text, "mod.toml"));
    let Ok(Ok(manifest)) = read else { return false };
    assert!(is_name(&manifest.name));
    for one in &manifest.replaces {
        assert!(!one.target.path.split('/').chain(one.file.split('/')).any(|part| part == ".."));
    }
    true
}

/// A package in a zip: nothing of it is anywhere but in its own folder.
pub(crate) fn package(bytes: &[u8], folder: &Path) -> bool {
    let (zip, into) = (folder.join("a.zip"), folder.join("into"));
    // Without the file it is refused, which is told.
    let _ = fs::remove_dir_all(&into);
    let _ = fs::write(&zip, bytes);
    let made = install(&zip, &into, false, |_| Ok(()));
    let there = fs::read_dir(&into).into_iter().flatten().flatten().count();
    assert_eq!(there, usize::from(made.is_ok()));
    let _ = fs::remove_dir_all(&into);
    made.is_ok()
}

/// What one reading may take.
pub(crate) fn budget() -> Arc<Budget> {
    Budget::within(Duration::from_secs(10), 100_000_000)
}

/// Features of a file, as metres and as a listing.
pub(crate) fn layer(bytes: &[u8], path: &Path) -> bool {
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

/// A shapefile and its table, one behind the other: the length of the first stands before them.
pub(crate) fn shapefile(bytes: &[u8], folder: &Path) -> bool {
    let (length, rest) = bytes.split_at(bytes.len().min(4));
    let length = length.try_into().map_or(0, u32::from_le_bytes) as usize;
    let (shapes, table) = rest.split_at(length.min(rest.len()));
    let _ = fs::write(folder.join("a.dbf"), table);
    let _ = fs::write(folder.join("a.prj"), "PROJCS[\"a\",AUTHORITY[\"EPSG\",\"3067\"]]");
    layer(shapes, &folder.join("a.shp"))
}

/// Layers of an extract of OpenStreetMap, in metres, and as a listing of all.
pub(crate) fn osm(bytes: &[u8], path: &Path) -> bool {
    let _ = fs::write(path, bytes);
    let _ = Listing::read(path, &budget()).map(|listing| (listing.text(), listing.to_json()));
    let mut good = true;
    for name in ["buildings", "roads", "trees"] {
        let wanted =
            SourceOptions { layer: Some(name.to_owned()), budget: budget(), ..SourceOptions::default() };
        let source = Source::open_within(path, "a", &wanted).and_then(|source| source.read("a", &wanted));
        let layer = source.and_then(|table| Layer::new(table, &mut None));
        good &= layer.is_ok_and(|layer| {
            let _ = layer.warnings();
            layer.bounds.iter().flatten().all(|value| value.is_finite())
        });
    }
    good
}

/// Computes with a geometry that was read: all that comes of it has finite numbers, and is written as it is read.
pub(crate) fn computed(geometry: &Geometry) -> bool {
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

/// The bytes as the geometry of a feature in a sound package.
pub(crate) fn wkb(bytes: &[u8], folder: &Path) -> bool {
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
pub(crate) fn heights(bytes: &[u8], name: &str) -> bool {
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
        let _ = (raster.warnings(), raster.missing_warnings(), raster.range(), raster.bounds());
        let Ok(relief) = Relief::new(Arc::new(raster), &mut None) else { continue };
        let middle = (relief.low() + relief.high()) / 2.0;
        let _ = relief.ground(middle.truncate(), true);
        good |= relief.height(middle.truncate()).is_none_or(f64::is_finite);
    }
    good
}

/// The bytes as often as a tile of heights needs them.
pub(crate) fn hgt(bytes: &[u8], _: &Path) -> bool {
    let tile: Vec<u8> = bytes.iter().copied().cycle().take(1201 * 1201 * 2).collect();
    heights(&tile, "N43E007.hgt") | heights(bytes, "N43E007.hgt")
}

/// The bytes as a square of floats of either size, as large as they fill.
pub(crate) fn raw(bytes: &[u8], _: &Path) -> bool {
    let square = |size: usize| {
        let side = (bytes.len() / size).isqrt();
        &bytes[..side * side * size]
    };
    // As they are, most inputs are no square, and are refused.
    let whole = heights(bytes, "a.r32") | heights(bytes, "a.r64");
    heights(square(4), "a.r32") | heights(square(8), "a.r64") | whole
}

/// A texture: its pixels are as many as it says.
pub(crate) fn image(bytes: &[u8], _: &Path) -> bool {
    let has_alpha = burgeon::scene::image::has_alpha(bytes);
    let Ok(image) = burgeon::scene::image::decode(bytes) else { return false };
    assert_eq!(image.pixels().len(), image.width() as usize * image.height() as usize);
    let is_opaque = image.pixels().iter().all(|pixel| pixel[3] == u8::MAX);
    assert!(is_opaque || has_alpha.is_ok_and(|has_alpha| has_alpha), "an opacity that nobody knows of");
    true
}

/// Changes of the ground of a world: what is read is written as it is read again.
pub(crate) fn edits(bytes: &[u8], _: &Path) -> bool {
    let world = World {
        corner: [0.0, 0.0].into(),
        size: 1000.0,
        layers: Vec::new(),
        smooth: false,
        key: None,
        remap: Vec::new(),
        measured: None,
    };
    let Ok(edits) = Edits::from_json(&String::from_utf8_lossy(bytes), "a.json", &world) else { return false };
    let text = edits.to_json(&world);
    let again = Edits::from_json(&text, "a.json", &world);
    assert!(again.is_ok_and(|again| again.to_json(&world) == text), "{text} is read otherwise");
    true
}

/// A run that has nothing but the file.
struct Alone;

impl Resources for Alone {
    fn find(&self, _: &'static str, name: &str) -> Result<PathBuf> {
        Err(Error::argument(format!("there is no {name}")))
    }

    fn seek(&self, _: &Path, _: bool) {}

    fn warn(&self, _: burgeon::Warning) {}

    fn check(&self) -> Result<(), Error> {
        Ok(())
    }
}

pub(crate) fn model(bytes: &[u8], folder: &Path) -> bool {
    let path = folder.join("a.glb");
    let _ = fs::write(&path, bytes);
    let registry = burgeon::registry();
    let Some(Construct::File(loader)) = registry.get("model").map(|kind| &kind.construct) else {
        return false;
    };
    let files = [("a.glb".to_owned(), path.clone())];
    let mut loading = LoadRequest {
        name: "a.glb",
        path: &path,
        files: &files,
        budget: &budget(),
        triangles: 100_000,
        services: &mut (),
        resources: &Alone,
    };
    let Ok(loaded) = (loader.load)(&mut loading, &Table::default()) else { return false };
    assert!(loaded.object.triangles() <= 100_000, "more triangles than it may have");
    let mut scene = burgeon::scene::Scene::default();
    let shown = loaded.object.show(&mut scene, "a", None);
    shown.is_ok() && scene.bounds().is_none_or(|(low, high)| low.is_finite() && high.is_finite())
}

pub(crate) fn presets(bytes: &[u8], folder: &Path) -> bool {
    let script = folder.join("a.lua");
    let path = Presets::path_of(&script);
    let _ = fs::write(&path, bytes);
    // A file that was just written may be half of what it will be, so that a reader waits.
    let old = SystemTime::now() - Duration::from_secs(3600);
    let _ = fs::File::options().write(true).open(&path).and_then(|file| file.set_modified(old));
    let read = Presets::read(&script);
    read.is_ok_and(|presets| presets.names().all(|name| presets.get(name).is_ok()))
}

/// A condition that features meet, or none does.
pub(crate) fn condition(bytes: &[u8], folder: &Path) -> bool {
    let path = folder.join("condition.geojson");
    if !path.exists() {
        // Without the file it is refused, which is told.
        let _ = fs::write(&path, HUTS);
    }
    let budget = Budget::within(Duration::from_secs(2), 20_000_000);
    let condition = Some(String::from_utf8_lossy(bytes).into_owned());
    let wanted = SourceOptions { condition, budget, ..SourceOptions::default() };
    let table = Source::open_within(&path, "huts", &wanted).and_then(|source| source.read("huts", &wanted));
    table.is_ok_and(|table| table.features.len() <= 2)
}

/// The address of a server, and the layer behind it; a password is never shown.
pub(crate) fn address(bytes: &[u8], _: &Path) -> bool {
    let text = String::from_utf8_lossy(bytes);
    let Ok((address, layer)) = ServerAddress::split(&text) else { return false };
    assert!(ServerAddress::is_address(&address.to_string()));
    assert_eq!(ServerAddress::parse(&text).is_ok(), layer.is_none());
    assert!(address.find_allowed(std::slice::from_ref(&address)).is_ok());
    true
}

/// A question that is put to two huts.
pub(crate) fn query(bytes: &[u8], folder: &Path) -> bool {
    static TABLES: OnceLock<Database> = OnceLock::new();
    let tables = TABLES.get_or_init(|| huts(folder).unwrap_or_else(|error| panic!("{error}")));
    let sql = String::from_utf8_lossy(bytes);
    let budget = Budget::within(Duration::from_secs(2), 20_000_000);
    let place = Geometry::from_wkt("POINT(1 2)").map_or(Cell::Null, |place| Cell::Geometry(Arc::new(place)));
    let _ = tables.plan(&sql, &budget);
    let answer = tables.query(&sql, &[("g", place), ("n", Cell::Number(1.0))], &budget);
    let Ok(answer) = answer else { return false };
    assert!(answer.iter().all(|row| row.len() == answer.names.len()));
    true
}

/// Two huts.
const HUTS: &str = r#"{"type":"FeatureCollection","features":[
{"type":"Feature","id":"1","properties":{"name":"hut"},"geometry":{"type":"Polygon","coordinates":[[[0,0],[0.001,0],[0,0.001],[0,0]]]}},
{"type":"Feature","id":"2","properties":{"name":"hut"},"geometry":{"type":"Polygon","coordinates":[[[0,0],[0.002,0],[0,0.002],[0,0]]]}}]}"#;

/// A table of them.
fn huts(folder: &Path) -> Result<Database> {
    let path = folder.join("huts.geojson");
    // Without the file it is refused, which is told.
    let _ = fs::write(&path, HUTS);
    let wanted = SourceOptions { budget: budget(), ..SourceOptions::default() };
    let mut frame = None;
    let layer = Layer::new(Source::open_within(&path, "huts", &wanted)?.read("huts", &wanted)?, &mut frame)?;
    let tables = Database::new(frame)?;
    tables.add_layer("huts", &layer, &budget())?;
    Ok(tables)
}

pub(crate) fn pattern(bytes: &[u8], _: &Path) -> bool {
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
pub(crate) fn script(bytes: &[u8], folder: &Path) -> bool {
    let path = folder.join("a.lua");
    let _ = fs::write(&path, bytes);
    let limits = Limits {
        time: Duration::from_secs(1),
        memory: 100_000_000,
        modules: 10_000,
        triangles: 10_000,
        ..Limits::default()
    };
    let reports = RunReports { print: Some(Print::new(|_: &str| {})), ..RunReports::default() };
    let options = RunOptions { limits, threads: Some(1), reports, ..burgeon::options() };
    burgeon::check(&path, options).is_ok()
}
