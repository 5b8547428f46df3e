use std::collections::HashSet;

use burgeon_base::stop::Stop;
use burgeon_scene::{CityClass, Origin, Scene, SurfaceMeaning};
use burgeon_spatial::{Attribute, Crs, ReferenceFrame};
use burgeon_spatial::{Record, RecordTable};
use glam::DVec3;
use serde_json::{Value as Json, json};

use super::super::samples;
use crate::{Export, Files, SceneFacts, SystemFacts};
use burgeon_picture::Picture;

fn write_text(scene: &Scene, facts: SceneFacts<'_>, name: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    let mut files = Files::new(&std::sync::Arc::new(Stop::default()));
    files.export(&Export { scene, picture: &Picture::default(), facts }, &path).unwrap();
    files.publish().unwrap();
    std::fs::read_to_string(path).unwrap()
}

fn write_and_read(scene: &Scene, facts: SceneFacts<'_>) -> Json {
    serde_json::from_str(&write_text(scene, facts, "a town.city.json")).unwrap()
}

/// Returns boundaries with the vertices in the place of their numbers.
fn resolved(boundaries: &Json, vertices: &Json) -> Json {
    match boundaries.as_array() {
        Some(list) => list.iter().map(|inner| resolved(inner, vertices)).collect(),
        None => vertices[boundaries.as_u64().unwrap() as usize].clone(),
    }
}

/// Returns objects whose boundaries do not depend on the numbers of vertices.
fn resolved_objects(file: &Json) -> serde_json::Map<String, Json> {
    let mut objects = file["CityObjects"].as_object().unwrap().clone();
    for object in objects.values_mut() {
        for geometry in object["geometry"].as_array_mut().unwrap() {
            geometry["boundaries"] = resolved(&geometry["boundaries"], &file["vertices"]);
        }
    }
    objects
}

/// Returns the boxes of a row as buildings: each has a separate chain, and its sides are walls, a roof and a ground
/// surface.
fn buildings(count: usize) -> Scene {
    let mut scene = samples::boxes(count);
    let part = &mut scene.meshes[0].parts[0];
    for side in 0..6 {
        let meaning = [SurfaceMeaning::Wall, SurfaceMeaning::Roof, SurfaceMeaning::Ground];
        part.surfaces.mark(2 * side, Some(meaning[if side < 4 { 0 } else { side - 3 }]));
    }
    for (chain, instance) in scene.instances.iter_mut().enumerate() {
        instance.origin = Some(Origin { system: 1, chain, record: Some(chain) });
        instance.feature = Some(if chain == 0 { "a \"b\"\n".into() } else { "same".into() });
    }
    scene
}

fn records(count: usize) -> SystemFacts {
    let record = |number: usize| Record {
        id: number.to_string(),
        geometry: None,
        values: vec![
            (0, Attribute::Number(number as f64 + 0.5)),
            (1, Attribute::Number(f64::NAN)),
            (2, Attribute::Text("x\u{0}".into())),
        ],
    };
    let columns = ["height", "odd", "use"].map(str::to_owned).to_vec();
    SystemFacts {
        system: 1,
        records: RecordTable { name: "houses".into(), columns, records: (0..count).map(record).collect() },
        class: None,
    }
}

/// Returns the vertices (m) of a file.
fn vertices(city: &Json) -> Vec<DVec3> {
    let vector = |value: &Json| DVec3::from([0, 1, 2].map(|axis| value[axis].as_f64().unwrap()));
    let (scale, origin) = (vector(&city["transform"]["scale"]), vector(&city["transform"]["translate"]));
    city["vertices"].as_array().unwrap().iter().map(|at| vector(at) * scale + origin).collect()
}

/// Computes the volume (m³) inside a shell.
fn volume(shell: &Json, vertices: &[DVec3]) -> f64 {
    let mut sum = 0.0;
    for ring in shell.as_array().unwrap().iter().flat_map(|face| face.as_array().unwrap()) {
        let points: Vec<DVec3> =
            ring.as_array().unwrap().iter().map(|at| vertices[at.as_u64().unwrap() as usize]).collect();
        let origin = vertices[0];
        for pair in points[1..].windows(2) {
            sum += (points[0] - origin).dot((pair[0] - origin).cross(pair[1] - origin)) / 6.0;
        }
    }
    sum
}

#[test]
fn buildings_are_solids_with_walls_roofs_and_ground_and_the_attributes_of_their_features() {
    let scene = buildings(3);
    let systems = [records(3)];
    let city = write_and_read(&scene, SceneFacts { systems: &systems, ..SceneFacts::default() });
    let objects = city["CityObjects"].as_object().unwrap();
    assert_eq!(
        objects.keys().map(String::as_str).collect::<HashSet<_>>(),
        HashSet::from(["a \"b\"\n", "same", "same.2"])
    );
    let vertices = vertices(&city);
    let mut sum = 0.0;
    for object in objects.values() {
        assert_eq!(object["type"], "Building");
        let geometry = &object["geometry"][0];
        assert_eq!((&geometry["type"], &geometry["lod"]), (&json!("Solid"), &json!("3")));
        let shell = &geometry["boundaries"][0];
        assert_eq!(shell.as_array().unwrap().len(), 6);
        assert!(shell.as_array().unwrap().iter().all(|face| face[0].as_array().unwrap().len() == 4));
        assert_eq!(
            geometry["semantics"]["surfaces"],
            json!([{"type": "WallSurface"}, {"type": "RoofSurface"}, {"type": "GroundSurface"}])
        );
        assert_eq!(geometry["semantics"]["values"], json!([[0, 0, 0, 0, 1, 2]]));
        sum += volume(shell, &vertices);
    }
    assert!((sum - samples::volume(&scene)).abs() < 1e-2, "{sum}");
    assert_eq!(objects["same.2"]["attributes"], json!({ "height": 2.5, "use": "x\u{0}" }));
    assert_eq!(city["metadata"]["title"], "a town");
    assert_eq!(city["metadata"].get("referenceSystem"), None);
}

#[test]
fn coordinates_are_those_of_the_data_or_of_a_zone_of_its_middle() {
    let of =
        |code: u32, at: [f64; 2]| ReferenceFrame::around(&Crs::epsg(code).unwrap(), at, "a place").unwrap();
    let scene = buildings(2);
    let frame = of(3067, [385_423.0, 6_671_463.0]);
    let city = write_and_read(&scene, SceneFacts { frame: Some(&frame), ..SceneFacts::default() });
    assert_eq!(city["metadata"]["referenceSystem"], "https://www.opengis.net/def/crs/EPSG/0/3067");
    let low = vertices(&city).into_iter().reduce(DVec3::min).unwrap();
    assert!((low.x - frame.origin[0] + 0.5).abs() < 2e-3 && (low.y - frame.origin[1]).abs() < 1.0, "{low}");
    let frame = of(4326, [7.42, 43.73]);
    let city = write_and_read(&scene, SceneFacts { frame: Some(&frame), ..SceneFacts::default() });
    assert_eq!(city["metadata"]["referenceSystem"], "https://www.opengis.net/def/crs/EPSG/0/32632");
    let low = vertices(&city).into_iter().reduce(DVec3::min).unwrap();
    assert!((370_000.0..375_000.0).contains(&low.x) && (4_840_000.0..4_850_000.0).contains(&low.y), "{low}");
    // Feet have no EPSG code in metres. A box of 1 m keeps its volume to a hundredth.
    let frame = of(2264, [1_450_000.0, 540_000.0]);
    let city = write_and_read(&scene, SceneFacts { frame: Some(&frame), ..SceneFacts::default() });
    assert_eq!(city["metadata"]["referenceSystem"], "https://www.opengis.net/def/crs/EPSG/0/32617");
    let vertices = vertices(&city);
    let [low, high] = [DVec3::min, DVec3::max].map(|choose| vertices.iter().copied().reduce(choose).unwrap());
    let size = scene.bounds().map(|(low, high)| high - low).unwrap();
    assert!((high - low - size).abs().max_element() < 0.1, "{low} {high}");
}

#[test]
fn placed_models_are_instances_of_a_template_for_each_meaning() {
    let mut scene = buildings(1);
    let own = scene.instances[0].clone();
    scene.meshes.push(samples::cube("window", 0));
    for placement in 0..6 {
        let mut window = own.clone();
        (window.mesh, window.placement) = (1, Some(placement));
        window.meaning = Some(if placement == 5 { SurfaceMeaning::Door } else { SurfaceMeaning::Window });
        window.transform.translation.x += placement as f64;
        scene.instances.push(window);
    }
    let city = write_and_read(&scene, SceneFacts::default());
    let objects = city["CityObjects"].as_object().unwrap();
    assert_eq!(objects.len(), 2);
    let fixed = &objects["a \"b\"\n installation"];
    assert_eq!((&fixed["type"], &fixed["parents"]), (&json!("BuildingInstallation"), &json!(["a \"b\"\n"])));
    assert_eq!(objects["a \"b\"\n"]["children"], json!(["a \"b\"\n installation"]));
    let instances = fixed["geometry"].as_array().unwrap();
    assert_eq!(instances.len(), 6);
    assert_eq!(instances[5]["template"], 1);
    let templates = city["geometry-templates"]["templates"].as_array().unwrap();
    assert_eq!(templates.len(), 2);
    assert_eq!(
        templates[1]["semantics"],
        json!({ "surfaces": [{ "type": "Door" }], "values": [0, 0, 0, 0, 0, 0] })
    );
    assert_eq!(templates[1]["boundaries"][0][0][0], 8);
    let vertices = vertices(&city);
    let at = vertices[instances[3]["boundaries"][0].as_u64().unwrap() as usize];
    assert!(at.distance(scene.instances[4].transform.translation) < 1e-3);
}

#[test]
fn levels_of_detail_and_classes_are_as_they_were_asked_for() {
    let scene = buildings(1);
    let city = write_and_read(&scene, SceneFacts { detail: 0, ..SceneFacts::default() });
    let geometry = &city["CityObjects"]["a \"b\"\n"]["geometry"][0];
    assert_eq!((&geometry["type"], &geometry["lod"]), (&json!("MultiSurface"), &json!("0")));
    let systems = [SystemFacts { class: Some(CityClass::of("Road").unwrap()), ..records(1) }];
    let city = write_and_read(&scene, SceneFacts { systems: &systems, ..SceneFacts::default() });
    let road = &city["CityObjects"]["a \"b\"\n"];
    assert_eq!(road["type"], "Road");
    assert_eq!(road["geometry"][0]["type"], "MultiSurface");
    assert_eq!(road["geometry"][0].get("semantics"), None);
}

/// Samples are kept in the folder `BURGEON_SAMPLES` if it is set, so that validators can check them.
#[test]
fn every_sample_is_written_and_nothing_is_lost_in_rounding() {
    let folder = tempfile::tempdir().unwrap();
    let mut solids = 0;
    for (name, scene) in samples::all(folder.path()) {
        let city = write_and_read(&scene, SceneFacts::default());
        let vertices = vertices(&city);
        let mut sum = 0.0;
        for object in city["CityObjects"].as_object().unwrap().values() {
            for geometry in object["geometry"].as_array().unwrap() {
                if geometry["type"] == "Solid" {
                    solids += 1;
                    sum += volume(&geometry["boundaries"][0], &vertices);
                }
            }
        }
        if ["box", "boxes", "twisted", "far"].contains(&name) {
            let real = samples::volume(&scene);
            assert!((sum - real).abs() < 1e-2 * real, "{name}: {sum} is not {real}");
        }
    }
    assert!(solids >= 4, "{solids}");
}

#[test]
fn a_sequence_has_the_objects_of_the_document_each_in_a_line_with_its_own_vertices() {
    let mut scene = buildings(700);
    // The last box is a placed model, whose template is in the first line.
    let placed = scene.instances.last_mut().unwrap();
    placed.placement = Some(0);
    let systems = [records(700)];
    let facts = || SceneFacts { systems: &systems, ..SceneFacts::default() };
    let document = write_and_read(&scene, facts());
    let text = write_text(&scene, facts(), "a town.city.jsonl");
    let mut lines = text.lines().map(|line| serde_json::from_str::<Json>(line).unwrap());
    let first = lines.next().unwrap();
    assert_eq!((&first["type"], &first["CityObjects"]), (&json!("CityJSON"), &json!({})));
    for shared in ["transform", "metadata", "geometry-templates"] {
        assert_eq!(first[shared], document[shared], "{shared}");
    }
    let mut objects = serde_json::Map::new();
    let mut count = 0;
    for line in lines {
        assert_eq!(line["type"], "CityJSONFeature");
        assert!(line["CityObjects"].get(line["id"].as_str().unwrap()).is_some(), "{line}");
        assert!(line["vertices"].as_array().unwrap().len() <= 8);
        objects.extend(resolved_objects(&line));
        count += 1;
    }
    assert_eq!((objects, count), (resolved_objects(&document), 700));
}
