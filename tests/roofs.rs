//! Tests of roofs over all buildings of real data files, if these are available next to the repository.

#![allow(clippy::unwrap_used, reason = "a test stops at what is wrong")]

use std::path::{Path, PathBuf};
use std::sync::Arc;

use burgeon::kit::{Call, Object, Parameter, Table, TableKey, Value};
use burgeon::objects::Footprint;
use burgeon_data::{Layer, Source, SourceOptions};
use burgeon_geometry::skeleton::{Pace, Skeleton};
use burgeon_geometry::{Plan, Rings, solid};
use burgeon_spatial::{PolygonArgument, rings};
use glam::DVec3;

const KINDS: [&str; 10] =
    ["flat", "shed", "gable", "gambrel", "shed_gambrel", "hip", "mansard", "pagoda", "porch", "dutch_hip"];
/// Types with one ridge over the whole plan or one apex.
const FIELD_KINDS: [&str; 14] = [
    "bellcast",
    "saltbox",
    "clerestory",
    "sawtooth",
    "butterfly",
    "round",
    "cross_gable",
    "gablet",
    "side_hip",
    "side_dutch_hip",
    "pyramid",
    "cone",
    "dome",
    "onion",
];
const EAVES: [&str; 3] = ["closed", "open", "slab"];

/// Returns a file or folder of shared data, or reports that the test is skipped.
fn shared(name: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data").join(name);
    let found = path.exists().then_some(path);
    if found.is_none() {
        eprintln!("skipped: there is no ../shared/data/{name}");
    }
    found
}

/// Returns the rings of all buildings in a file.
fn buildings(name: &str) -> Option<Vec<Rings>> {
    let wanted = SourceOptions { layer: Some("buildings".into()), ..SourceOptions::default() };
    let table = Source::open(&shared(name)?, "file").unwrap().read("file", &wanted).unwrap();
    let layer = Layer::new(table, &mut None).unwrap();
    Some(layer.features.iter().filter_map(|feature| rings(&feature.geometry).cloned()).collect())
}

fn table(entries: &[(&str, Value)]) -> Table {
    let entries = entries.iter().map(|(name, value)| (TableKey::Name((*name).into()), value.clone()));
    Table { class: None, entries: entries.collect() }
}

fn call(object: &mut dyn Object, method: &str, argument: Value) {
    let Call::Write { values, .. } = object.kind().method(method).unwrap().call.clone() else {
        unreachable!()
    };
    values(object, &[argument]).unwrap_or_else(|error| panic!("{method}: {error}"));
}

/// Creates a building that is not built yet.
fn footprint(rings: &Rings) -> burgeon::error::Result<Box<dyn Object>> {
    let geometry = PolygonArgument(rings.clone()).into_value();
    Footprint::kind().make(&table(&[("geometry", geometry)]))
}

/// Builds a building with walls of 3 m, asserts that it is a closed solid, and returns its report entries.
fn build(rings: &Rings, kind: &str, eaves: &str, overhang: f64) -> Vec<String> {
    let mut house = footprint(rings).unwrap();
    raise(&mut *house, kind, eaves, overhang);
    let check = solid::check(house.drawing_mut().unwrap().parts());
    assert!(check.is_solid(), "{kind} {eaves} {overhang}: {check:?} over {rings:?}");
    house.notes().iter().map(|note| note.message().to_owned()).collect()
}

/// Builds a building with walls of 3 m.
fn raise(house: &mut dyn Object, kind: &str, eaves: &str, overhang: f64) {
    house.begin();
    call(house, "groundwork", Value::Text("extruded".into()));
    call(house, "walls", Value::Table(Arc::new(table(&[("height", Value::Number(3.0))]))));
    let roof = table(&[
        ("kind", Value::Text(kind.into())),
        ("eaves", Value::Text(eaves.into())),
        ("overhang", Value::Number(overhang)),
        ("border", Value::Number(if overhang > 0.0 { 0.0 } else { 0.5 })),
    ]);
    call(house, "roof", Value::Table(Arc::new(roof)));
}

/// Checks the skeletons of all plans, and a roof on each, with all types in turn.
fn check(name: &str, least: usize) {
    let Some(buildings) = buildings(name) else { return };
    let (mut plans, mut failed, mut replaced) = (0, 0, 0);
    for (number, rings) in buildings.iter().enumerate() {
        // Some outlines cross themselves; they are refused with the position.
        let Ok(plan) = Plan::new(rings) else { continue };
        plans += 1;
        let skeleton = Skeleton::new(&plan.flat(), &vec![Pace::default(); plan.polygon().size()]);
        failed += usize::from(skeleton.is_err());
        let (kind, eaves) = (KINDS[number % 10], EAVES[number / 10 % 3]);
        let notes = build(rings, kind, eaves, [0.0, 0.4, 0.8][number / 30 % 3]);
        replaced += usize::from(notes.iter().any(|note| !note.contains("overhang")));
    }
    eprintln!("{name}: {plans} plans, {failed} failed, {replaced} roofs replaced");
    assert!(plans >= least, "{plans} of {}", buildings.len());
    assert!(
        failed == 0 && replaced * 1000 < plans,
        "{failed} skeletons failed, {replaced} roofs were replaced"
    );
}

#[test]
fn every_building_of_a_french_town_is_a_closed_solid_under_roofs_of_all_kinds() {
    check("france_buildings.gpkg", 15_500);
}

#[test]
fn every_building_of_helsinki_and_monaco_is_a_closed_solid_under_roofs_of_all_kinds() {
    check("helsinki.gpkg", 560);
    check("monaco.gpkg", 1_200);
}

#[test]
fn every_building_of_helsinki_and_monaco_is_a_closed_solid_under_one_ridge_or_apex() {
    for (name, least) in [("helsinki.gpkg", 560), ("monaco.gpkg", 1_200)] {
        let Some(buildings) = buildings(name) else { return };
        let (mut plans, mut replaced) = (0, 0);
        for (number, rings) in buildings.iter().enumerate() {
            if Plan::new(rings).is_err() {
                continue;
            }
            plans += 1;
            let kind = FIELD_KINDS[number % 14];
            let overhang = if kind == "onion" { 0.0 } else { [0.0, 0.4][number / 14 % 2] };
            let notes = build(rings, kind, "open", overhang);
            let is_replaced = |note: &String| !note.contains("overhang") && !note.contains("adapted");
            replaced += usize::from(notes.iter().any(is_replaced));
        }
        assert!(plans >= least && replaced * 200 < plans, "{name}: {replaced} of {plans} were replaced");
    }
}

/// Builds all buildings of a file next to one another, with party gables, and checks that none intersects
/// itself.
fn check_beside_neighbours(name: &str, kinds: &[&str], eaves: &str) {
    let Some(buildings) = buildings(name) else { return };
    let mut houses: Vec<Box<dyn Object>> =
        buildings.iter().filter_map(|rings| footprint(rings).ok()).collect();
    let gather = houses.first().and_then(|house| house.kind().gather).unwrap();
    gather(&mut houses);
    let mut faults = Vec::new();
    for (number, house) in houses.iter_mut().enumerate() {
        let kind = kinds[number % kinds.len()];
        raise(&mut **house, kind, eaves, [0.3, 0.5, 0.8][number / 5 % 3]);
        let parts = house.drawing_mut().unwrap().parts();
        let (check, clashes) = (solid::check(parts), solid::clashes(parts, 5e-3));
        if !check.is_solid() || !clashes.is_empty() {
            faults.push(format!("{number} {kind} {eaves}: {check:?} {clashes:?}"));
        }
    }
    let shown = &faults[..faults.len().min(5)];
    assert!(faults.is_empty(), "{name}: {} of {}: {shown:#?}", faults.len(), houses.len());
}

#[test]
fn every_building_of_helsinki_and_monaco_is_sound_beside_its_neighbours() {
    for name in ["monaco.gpkg", "helsinki.gpkg"] {
        check_beside_neighbours(name, &["gable", "hip", "mansard", "gambrel", "dutch_hip", "shed"], "open");
        check_beside_neighbours(name, &["gable", "dutch_hip"], "slab");
    }
}

#[test]
fn every_plan_that_is_made_to_be_bad_is_refused_or_roofed() {
    let Some(folder) = shared("bad_polygons") else { return };
    let mut names: Vec<PathBuf> = folder.read_dir().unwrap().map(|entry| entry.unwrap().path()).collect();
    names.sort();
    let mut roofed = 0;
    for path in names.iter().filter(|path| path.extension().is_some_and(|extension| extension == "json")) {
        let text = std::fs::read_to_string(path).unwrap();
        let Ok(rings) = serde_json::from_str::<Vec<Vec<Vec<f64>>>>(&text) else { continue };
        let point = |at: &Vec<f64>| DVec3::new(at[0], at[1], 0.0);
        let rings: Rings = rings.iter().map(|ring| ring.iter().map(point).collect()).collect();
        let Ok(plan) = Plan::new(&rings) else { continue };
        let skeleton = Skeleton::new(&plan.flat(), &vec![Pace::default(); plan.polygon().size()]);
        assert!(skeleton.is_ok(), "{}", path.display());
        // Meshes have no millimetre precision so far from the origin.
        let near = plan.polygon().points().all(|point| point.abs().max_element() < 10_000.0);
        for kind in KINDS.iter().filter(|_| near) {
            build(&rings, kind, "closed", 0.0);
        }
        roofed += 1;
    }
    assert!(roofed >= 10, "{roofed}");
}
