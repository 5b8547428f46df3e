//! Tests with a reader of features and their properties in `.glb` files.

use std::collections::HashSet;

use burgeon_base::stop::Stop;
use burgeon_scene::{Origin, Scene};
use burgeon_spatial::Attribute;
use burgeon_spatial::{Record, RecordTable};
use proptest::prelude::*;
use serde_json::{Value as Json, json};

use super::super::samples;
use crate::{Export, Files, SceneFacts, SystemFacts};
use burgeon_picture::Picture;

/// Description and body of a file.
struct Binary {
    json: Json,
    body: Vec<u8>,
}

fn write_and_read(scene: &Scene, systems: &[SystemFacts], metadata: bool) -> Binary {
    let folder = std::env::var_os("BURGEON_SAMPLES").filter(|_| metadata);
    let temporary = tempfile::tempdir().unwrap();
    let path = folder.map_or(temporary.path().to_path_buf(), Into::into).join("features.glb");
    let mut files = Files::new(&std::sync::Arc::new(Stop::default()));
    let columns = systems.iter().flat_map(|system| system.records.columns.clone());
    let columns: Vec<String> = columns.collect();
    let facts =
        SceneFacts { systems, metadata: metadata.then_some(columns.as_slice()), ..SceneFacts::default() };
    files.export(&Export { scene, picture: &Picture::default(), facts }, &path).unwrap();
    files.publish().unwrap();
    let bytes = std::fs::read(path).unwrap();
    let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    Binary {
        json: serde_json::from_slice(&bytes[20..20 + length]).unwrap(),
        body: bytes[28 + length..].to_vec(),
    }
}

impl Binary {
    /// Returns the bytes of a view, which begins at a multiple of 8.
    fn view(&self, index: &Json) -> &[u8] {
        let view = &self.json["bufferViews"][index.as_u64().unwrap() as usize];
        let from = view["byteOffset"].as_u64().unwrap_or(0) as usize;
        assert!(from.is_multiple_of(8));
        &self.body[from..from + view["byteLength"].as_u64().unwrap() as usize]
    }

    /// Returns the numbers of an accessor of `f32`.
    fn numbers(&self, accessor: &Json) -> Vec<f32> {
        let accessor = &self.json["accessors"][accessor.as_u64().unwrap() as usize];
        assert_eq!((&accessor["componentType"], &accessor["type"]), (&json!(5126), &json!("SCALAR")));
        let view = &self.json["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
        let from = view["byteOffset"].as_u64().unwrap_or(0) + accessor["byteOffset"].as_u64().unwrap_or(0);
        let count = accessor["count"].as_u64().unwrap() as usize;
        let bytes = &self.body[from as usize..from as usize + 4 * count];
        bytes.chunks(4).map(|it| f32::from_le_bytes(it.try_into().unwrap())).collect()
    }

    fn metadata(&self) -> &Json {
        &self.json["extensions"]["EXT_structural_metadata"]
    }

    /// Returns the values of a property of a table; `None` for missing ones.
    fn column(&self, table: usize, name: &str) -> Vec<Option<Attribute>> {
        let table = &self.metadata()["propertyTables"][table];
        let class = &self.metadata()["schema"]["classes"][table["class"].as_str().unwrap()];
        let (property, place) = (&class["properties"][name], &table["properties"][name]);
        let count = table["count"].as_u64().unwrap() as usize;
        let values = self.view(&place["values"]);
        let present =
            |value: Json, attribute: Attribute| (property.get("noData") != Some(&value)).then_some(attribute);
        match property["type"].as_str().unwrap() {
            "STRING" => {
                assert_eq!(place["stringOffsetType"], "UINT32");
                let offsets = self.view(&place["stringOffsets"]).chunks(4);
                let offsets: Vec<usize> =
                    offsets.map(|it| u32::from_le_bytes(it.try_into().unwrap()) as usize).collect();
                assert_eq!(offsets.len(), count + 1);
                assert!(offsets[count] == values.len() || values.len() == 1);
                let text = |ends: &[usize]| std::str::from_utf8(&values[ends[0]..ends[1]]).unwrap();
                offsets
                    .windows(2)
                    .map(|ends| present(text(ends).into(), Attribute::Text(text(ends).into())))
                    .collect()
            }
            "BOOLEAN" => {
                assert_eq!(values.len(), count.div_ceil(8));
                (0..count)
                    .map(|row| Some(Attribute::Boolean(values[row / 8] >> (row % 8) & 1 == 1)))
                    .collect()
            }
            "SCALAR" if property["componentType"] == "FLOAT64" => {
                assert_eq!(values.len(), count * 8);
                let number = |it: &[u8]| f64::from_le_bytes(it.try_into().unwrap());
                values.chunks(8).map(|it| present(number(it).into(), Attribute::Number(number(it)))).collect()
            }
            "SCALAR" => {
                assert_eq!((&property["componentType"], values.len()), (&json!("UINT8"), count));
                values.iter().map(|it| present((*it).into(), Attribute::Boolean(*it == 1))).collect()
            }
            other => panic!("{other}"),
        }
    }
}

fn facts(system: usize, columns: &[&str], rows: Vec<Vec<Option<Attribute>>>) -> SystemFacts {
    let record = |(number, row): (usize, Vec<Option<Attribute>>)| Record {
        id: format!("way/{number}"),
        geometry: None,
        values: row.into_iter().enumerate().filter_map(|(column, value)| Some((column, value?))).collect(),
    };
    let columns = columns.iter().map(|name| (*name).to_owned()).collect();
    let records = rows.into_iter().enumerate().map(record).collect();
    SystemFacts { system, records: RecordTable { name: "1 häuser".into(), columns, records }, class: None }
}

/// Assigns each instance of `scene` to a separate chain of system 0. Placed models share a mesh.
fn with_features(mut scene: Scene) -> Scene {
    for (chain, instance) in scene.instances.iter_mut().enumerate() {
        instance.origin = Some(Origin { system: 0, chain, record: Some(chain) });
        instance.feature = Some(format!("way/{chain}"));
    }
    scene
}

#[test]
fn without_being_asked_files_stay_as_they_were() {
    let scene = with_features(samples::many(40));
    let systems = [facts(0, &["height"], vec![vec![Some(Attribute::Number(1.0))]; 40])];
    let [plain, known] = [&[][..], &systems[..]].map(|systems| write_and_read(&scene, systems, false));
    assert!(plain.json == known.json && plain.body == known.body);
    assert!(write_and_read(&scene, &[], true).json == plain.json);
}

#[test]
fn each_instance_of_a_shared_mesh_and_each_vertex_of_one_of_its_own_knows_its_feature() {
    // Six boxes with one mesh, one of them sheared, and one box with a separate mesh.
    let mut scene = samples::many(6);
    scene.instances[5].transform.matrix3.x_axis.y += 0.7;
    scene.meshes.push(samples::cube("own", 0));
    let mut own = scene.instances[0].clone();
    own.mesh = 1;
    scene.instances.push(own);
    let scene = with_features(scene);
    let rows = (0..7).map(|row| vec![Some(Attribute::Number(f64::from(row)))]).collect();
    let file = write_and_read(&scene, &[facts(0, &["height"], rows)], true);
    let used: HashSet<&str> =
        file.json["extensionsUsed"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
    for name in
        ["EXT_structural_metadata", "EXT_mesh_features", "EXT_instance_features", "EXT_mesh_gpu_instancing"]
    {
        assert!(used.contains(name), "{name}");
    }
    let mut instances = Vec::new();
    for node in file.json["nodes"].as_array().unwrap() {
        let Some(features) = node["extensions"].get("EXT_instance_features") else { continue };
        let numbers =
            file.numbers(&node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["_FEATURE_ID_0"]);
        let ids = &features["featureIds"][0];
        assert_eq!(ids["featureCount"], numbers.len());
        assert_eq!((&ids["attribute"], &ids["propertyTable"]), (&json!(0), &json!(0)));
        instances.extend(numbers);
    }
    instances.sort_by(f32::total_cmp);
    assert_eq!(instances, [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
    let mut told = 0;
    for primitive in
        file.json["meshes"].as_array().unwrap().iter().flat_map(|mesh| mesh["primitives"].as_array().unwrap())
    {
        let Some(features) = primitive["extensions"].get("EXT_mesh_features") else { continue };
        assert_eq!(
            features["featureIds"],
            json!([{ "featureCount": 1, "attribute": 0, "propertyTable": 0 }])
        );
        let numbers = file.numbers(&primitive["attributes"]["_FEATURE_ID_0"]);
        let positions =
            &file.json["accessors"][primitive["attributes"]["POSITION"].as_u64().unwrap() as usize];
        assert!(positions["count"] == numbers.len() && numbers.iter().all(|number| *number == 6.0));
        told += 1;
    }
    assert_eq!(told, 1);
    let heights: Vec<_> = (0..7).map(|row| Some(Attribute::Number(f64::from(row)))).collect();
    assert_eq!(file.column(0, "height"), heights);
    assert_eq!(file.column(0, "id")[3], Some(Attribute::Text("way/3".into())));
    assert_eq!(file.metadata()["schema"]["classes"]["_1_h_user"]["name"], "1 häuser");
}

fn attribute() -> impl Strategy<Value = Option<Attribute>> {
    prop_oneof![
        1 => Just(None),
        3 => any::<f64>().prop_map(|number| Some(Attribute::Number(number))),
    ]
}

fn rows() -> impl Strategy<Value = Vec<Vec<Option<Attribute>>>> {
    let text = prop::option::weighted(0.8, "\\PC{0,5}".prop_map(|text| Attribute::Text(text.into())));
    let yes = prop::option::weighted(0.9, any::<bool>().prop_map(Attribute::Boolean));
    let sure = any::<bool>().prop_map(|value| Some(Attribute::Boolean(value)));
    let mixed = prop_oneof![
        Just(Some(Attribute::Boolean(true))),
        "[a-c]".prop_map(|text| Some(Attribute::Text(text.into()))),
        Just(Some(Attribute::Number(2.5))),
        Just(Some(Attribute::Nested(std::sync::Arc::new(json!([1, null]))))),
    ];
    let row = (attribute(), text, yes, sure, mixed).prop_map(|(a, b, c, d, e)| vec![a, b, c, d, e]);
    prop::collection::vec(row, 1..12)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]
    #[test]
    fn what_features_know_reads_back(rows in rows()) {
        let scene = with_features(samples::boxes(rows.len()));
        let file = write_and_read(&scene, &[facts(0, &["id", "a b", "yes", "sure", "1"], rows.clone())], true);
        for (column, name) in ["id_2", "a_b", "yes", "sure", "_1"].into_iter().enumerate() {
            let texts = name == "_1" && rows.iter().any(|row| !matches!(row[column], Some(Attribute::Number(_))));
            let booleans = name == "_1" && rows.iter().all(|row| matches!(row[column], Some(Attribute::Boolean(_))));
            for (row, read) in rows.iter().zip(file.column(0, name)) {
                let given = row[column].clone().filter(|it| !matches!(it, Attribute::Number(number) if !number.is_finite()));
                // A column of several types contains strings.
                let given = given.map(|it| if texts && !booleans { Attribute::Text(it.text().into()) } else { it });
                prop_assert_eq!(read, given, "{}", name);
            }
        }
    }
}
