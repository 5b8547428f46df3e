//! Tests with real data files, if they exist next to the repository, against results computed with other programs.

#![allow(clippy::unwrap_used, reason = "a test stops at what is wrong")]
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "numbers of cases are small"
)]

use std::path::{Path, PathBuf};
use std::sync::Arc;

use burgeon::objects::Elevation;
use burgeon_data::elevation::{Raster, Relief};
use burgeon_data::{Layer, Source, SourceOptions};
use burgeon_geometry::{Plan, Rings};
use burgeon_spatial::{Geometry, GeometryKind};
use glam::{DVec2, DVec3};

#[path = "terrain/measured.rs"]
mod measured;

#[test]
fn measured_ground_is_exact_at_every_sample_at_any_level_and_so_are_its_triangles() {
    let found: Vec<_> = (0..850).map(measured::check).collect();
    let wrong: Vec<&String> = found.iter().filter_map(|case| case.as_ref().err()).collect();
    assert!(wrong.is_empty(), "{} are wrong: {:#?}", wrong.len(), &wrong[..wrong.len().min(12)]);
    let cases: Vec<measured::Worst> = found.into_iter().flatten().collect();
    let samples: usize = cases.iter().map(|case| case.samples).sum();
    assert!(samples > 50_000, "{samples} in {} cases", cases.len());
}

/// Returns the path of a file in the folder of shared data; prints that the test is skipped if the file is missing.
fn shared(name: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data").join(name);
    let found = path.is_file().then_some(path);
    if found.is_none() {
        eprintln!("skipped: there is no ../shared/data/{name}");
    }
    found
}

fn layer(path: &Path, name: &str, condition: Option<&str>) -> Layer {
    let wanted = SourceOptions {
        layer: Some(name.to_owned()),
        condition: condition.map(str::to_owned),
        ..SourceOptions::default()
    };
    let table = Source::open_within(path, "file", &wanted).unwrap().read("file", &wanted).unwrap();
    Layer::new(table, &mut None).unwrap()
}

/// Returns the area (m²) of a polygon; holes count as negative because of their orientation.
fn area(geometry: &Geometry) -> f64 {
    let Geometry::Polygon(rings) = geometry else { return 0.0 };
    let ring = |ring: &Vec<DVec3>| -> f64 {
        let next = ring.iter().cycle().skip(1);
        ring.iter()
            .zip(next)
            .map(|(a, b)| (a - ring[0]).truncate().perp_dot((b - ring[0]).truncate()))
            .sum::<f64>()
            / 2.0
    };
    rings.iter().map(ring).sum()
}

#[test]
fn the_buildings_of_france_are_all_there_with_their_areas() {
    let Some(path) = shared("france_buildings.gpkg") else { return };
    let france = layer(&path, "buildings", None);
    // 15,608 records, some of several parts; counted with Python's sqlite3 and struct.
    assert_eq!(france.features.len(), 15_617);
    let rings = |feature: &burgeon_data::Feature| match &feature.geometry {
        Geometry::Polygon(rings) => rings.len(),
        _ => 0,
    };
    assert_eq!(france.features.iter().map(|feature| rings(feature) - 1).sum::<usize>(), 919);
    assert_eq!(france.features.iter().flat_map(|feature| feature.geometry.points()).count(), 152_657);
    let total: f64 = france.features.iter().map(|feature| area(&feature.geometry)).sum();
    assert!((total - 3_280_464.638_6).abs() < 0.01, "{total}");
    assert_eq!((france.crs.as_str(), france.origin), ("EPSG:2154", [586_700.0, 6_659_500.0]));
    assert_eq!(france.features[0].id, "BATIMENT0000000049603363-1");
    let high = layer(&path, "buildings", Some("height > 50")).features.len();
    assert!((1..100).contains(&high), "{high}");
}

#[test]
fn every_layer_of_helsinki_and_monaco_is_read() {
    for (name, counts) in
        [("helsinki.gpkg", [572, 2510, 649, 2046, 105]), ("monaco.gpkg", [1220, 2379, 415, 980, 69])]
    {
        let Some(path) = shared(name) else { return };
        let names = ["buildings", "roads", "trees", "furniture", "green"];
        let kinds = [
            GeometryKind::Polygon,
            GeometryKind::Line,
            GeometryKind::Point,
            GeometryKind::Point,
            GeometryKind::Polygon,
        ];
        for ((layer_name, count), kind) in names.into_iter().zip(counts).zip(kinds) {
            let layer = layer(&path, layer_name, None);
            assert_eq!(layer.features.len(), count, "{name}:{layer_name}");
            assert!(layer.features.iter().all(|feature| feature.geometry.kind() == kind));
            let [low, high] = layer.bounds;
            assert!((0..2).all(|axis| low[axis] > -5000.0 && high[axis] < 5000.0), "{low:?} {high:?}");
            assert!(
                layer
                    .features
                    .iter()
                    .all(|feature| kind != GeometryKind::Polygon || area(&feature.geometry) > 0.0)
            );
        }
    }
}

#[test]
fn monacos_mountains_are_as_high_as_maps_say_under_the_towns_own_frame() {
    let (Some(heights), Some(town)) = (shared("N43E007.hgt.zip"), shared("monaco.gpkg")) else { return };
    let places = [[7.4267, 43.7769], [7.405, 43.731], [7.4265, 43.7345], [7.5, 43.65]];
    let points = places.map(|[x, y]| {
        format!(
            r#"{{"type":"Feature","properties":{{}},"geometry":{{"type":"Point","coordinates":[{x},{y}]}}}}"#
        )
    });
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("places.geojson");
    std::fs::write(&path, format!(r#"{{"type":"FeatureCollection","features":[{}]}}"#, points.join(",")))
        .unwrap();
    let read = |path: &Path, layer: Option<&str>, frame: &mut _| {
        let wanted = SourceOptions { layer: layer.map(str::to_owned), ..SourceOptions::default() };
        Layer::new(Source::open_within(path, "file", &wanted).unwrap().read("file", &wanted).unwrap(), frame)
            .unwrap()
    };
    let raster = Arc::new(
        Raster::open(&heights, "N43E007.hgt.zip", &Default::default(), &Default::default()).unwrap(),
    );
    assert_eq!((raster.columns, raster.rows, raster.filled), (1201, 1201, 1595));
    // The first source determines the frame.
    for heights_first in [true, false] {
        let mut frame = None;
        let relief =
            |frame: &mut _| Elevation::new(Arc::new(Relief::new(Arc::clone(&raster), frame).unwrap()));
        let (ground, buildings) = if heights_first {
            let ground = relief(&mut frame);
            (ground, read(&town, Some("buildings"), &mut frame))
        } else {
            let buildings = read(&town, Some("buildings"), &mut frame);
            (relief(&mut frame), buildings)
        };
        let frame_of = if heights_first { "transverse Mercator around 7.5, 43.5" } else { "EPSG:2154" };
        assert_eq!(buildings.crs, frame_of);
        let found: Vec<f64> = read(&path, None, &mut frame)
            .features
            .iter()
            .flat_map(|feature| {
                feature.geometry.points().map(|at| DVec2::new(at[0], at[1])).collect::<Vec<_>>()
            })
            .map(|place| ground.height_at(place).unwrap())
            .collect();
        // Mont Agel, the slope of the Tete de Chien, the harbour, and the sea; computed with NumPy.
        for (height, expected) in found.iter().zip([1_097.042_4, 364.224, 1.387, 0.0]) {
            assert!((height - expected).abs() < 1e-3, "{found:?}");
        }
        // The town is between the harbour and the mountains.
        let points = buildings.features.iter().flat_map(|feature| feature.geometry.points());
        let under = points.map(|at| ground.height_at(DVec2::new(at[0], at[1])).unwrap());
        let (low, high) =
            under.fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), at| (low.min(at), high.max(at)));
        assert!(low > -12.0 && (100.0..400.0).contains(&high), "{low} {high}");
    }
}

#[test]
fn the_village_has_what_its_script_draws() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/data/village.geojson");
    let village = layer(&path, "village", None);
    let count = |kind| village.features.iter().filter(|feature| feature.geometry.kind() == kind).count();
    assert_eq!(GeometryKind::SINGLE.map(count), [110, 4, 72]);
    assert!(path.metadata().unwrap().len() < 60_000);
}

#[test]
fn the_same_features_are_read_from_every_format_that_another_program_writes() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus");
    let expected = [
        "a 3.5 1 POLYGON ((385400 6671500, 385440 6671500, 385440 6671540, 385400 6671540, 385400 6671500), (385410 6671510, 385410 6671520, 385420 6671520, 385410 6671510))",
        "b 7 2 POLYGON ((385540 6671500, 385540 6671540, 385500 6671540, 385500 6671500, 385540 6671500))",
        "b 7 2 POLYGON ((385640 6671500, 385640 6671540, 385600 6671540, 385600 6671500, 385640 6671500))",
    ];
    let mut files = 0;
    for name in [
        "flatgeobuf/good-index.fgb",
        "flatgeobuf/good-row.fgb",
        "gml/good-32.gml",
        "gml/good-31.gml",
        "gml/good-2.gml",
    ] {
        let table = Source::open_within(&corpus.join(name), name, &SourceOptions::default())
            .unwrap()
            .read(name, &SourceOptions::default())
            .unwrap();
        let mut found: Vec<String> = table
            .features
            .iter()
            .map(|feature| {
                let of = |name: &str| {
                    let column = table.names.iter().position(|known| known == name).unwrap();
                    let found = feature.attributes.iter().find(|(number, _)| *number == column).unwrap();
                    match &found.1 {
                        burgeon_data::Attribute::Number(number) => number.to_string(),
                        burgeon_data::Attribute::Text(text) => text.to_string(),
                        other => format!("{other:?}"),
                    }
                };
                format!("{} {} {} {}", of("name"), of("height"), of("levels"), feature.geometry.to_wkt())
            })
            .collect();
        found.sort();
        assert_eq!(found, expected, "{name}");
        assert_eq!(table.crs.unwrap().code, Some(3067), "{name}");
        files += 1;
    }
    assert_eq!(files, 5);
    let degrees = corpus.join("gml/good-degrees.gml");
    let table = Source::open_within(&degrees, "a", &SourceOptions::default())
        .unwrap()
        .read("a", &SourceOptions::default())
        .unwrap();
    assert!(table.features[0].geometry.points().all(|at| at.x < 30.0 && at.y > 60.0));
}

/// Returns the rings of one of the polygons used as tests of triangulators.
fn rings(text: &str) -> Rings {
    let rings: Vec<Vec<Vec<f64>>> = serde_json::from_str(text).unwrap();
    let point = |at: &Vec<f64>| DVec3::new(at[0], at[1], 0.0);
    rings.iter().map(|ring| ring.iter().map(point).collect()).collect()
}

#[test]
fn bad_polygons_become_valid_plans_or_are_refused_with_a_reason() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/bad_polygons");
    let Ok(entries) = std::fs::read_dir(&folder) else {
        eprintln!("skipped: there is no ../shared/data/bad_polygons");
        return;
    };
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.retain(|name| !name.starts_with('_'));
    names.sort();
    let (mut clean, mut repaired, mut refused) = (0, Vec::new(), Vec::new());
    for name in &names {
        match Plan::new(&rings(&std::fs::read_to_string(folder.join(name)).unwrap())) {
            Ok(plan) => {
                let again = Plan::new(&plan.polygon().into()).unwrap();
                assert!(again.repairs().0.is_empty() && plan.polygon().area() > 0.0, "{name}");
                assert_eq!(plan.given_edges().len(), plan.polygon().size(), "{name}");
                if plan.repairs().0.is_empty() {
                    clean += 1;
                } else {
                    repaired.push(name.as_str());
                }
            }
            Err(error) => {
                assert!(error.remedy().is_some() && error.message().contains("footprint"), "{name}: {error}");
                refused.push(name.as_str());
            }
        }
    }
    // Triangulators reject these, too.
    let nothing = ["degenerate", "empty-square", "infinite-loop-jhl", "issue107", "issue83"];
    assert_eq!(refused, nothing.map(|name| format!("{name}.json")));
    assert_eq!((names.len(), clean, repaired.len()), (56, 13, 38), "{repaired:?}");
}
