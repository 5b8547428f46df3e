//! Tests that read models of tiles back with a reader of their own.

use std::sync::Arc;

use burgeon_base::stop::Stop;
use burgeon_scene::{Origin, Scene};
use burgeon_spatial::{Record, RecordTable};
use glam::{DAffine3, DQuat, DVec3};
use serde_json::Value;

use super::{TileCompression, TileModelCounts, TileModelOptions, write_tile_model};
use crate::check::triangles;
use crate::{Files, SceneFacts, SystemFacts, samples};

/// Triangle of a file or of a scene: material, feature, points (m) and normals, z up.
#[derive(Debug, Clone)]
struct ReadFace {
    material: usize,
    feature: Option<usize>,
    points: [DVec3; 3],
    normals: [DVec3; 3],
}

/// Description and body of a file.
struct ReadTile {
    json: Value,
    body: Vec<u8>,
    counts: TileModelCounts,
}

fn index(value: &Value) -> usize {
    value.as_u64().unwrap() as usize
}

fn z_up(point: DVec3) -> DVec3 {
    DVec3::new(point.x, -point.z, point.y)
}

impl ReadTile {
    fn of(scene: &Scene, options: &TileModelOptions, rows: usize) -> Self {
        let record = |row| Record { id: format!("way/{row}"), geometry: None, values: Vec::new() };
        let records = (0..rows).map(record).collect();
        let records = RecordTable { name: "houses".into(), columns: Vec::new(), records };
        let systems = [SystemFacts { system: 0, records, class: None }];
        let facts = SceneFacts { systems: &systems, metadata: Some(&[]), ..SceneFacts::default() };
        let temporary = tempfile::tempdir().unwrap();
        let path = temporary.path().join("tile.glb");
        let mut files = Files::new(&Arc::new(Stop::default()));
        let counts = write_tile_model(scene, &facts, options, &path, &mut files).unwrap();
        files.publish().unwrap();
        let bytes = std::fs::read(path).unwrap();
        let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
        let json = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
        Self { json, body: bytes.get(28 + length..).unwrap_or_default().to_vec(), counts }
    }

    fn array(&self, accessor: &Value) -> Vec<[f64; 4]> {
        let accessor = &self.json["accessors"][index(accessor)];
        let view = &self.json["bufferViews"][index(&accessor["bufferView"])];
        let from = view["byteOffset"].as_u64().unwrap_or(0) + accessor["byteOffset"].as_u64().unwrap_or(0);
        let width = match accessor["type"].as_str().unwrap() {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            _ => 4,
        };
        let component = accessor["componentType"].as_u64().unwrap();
        let size = match component {
            5120 => 1,
            5122 | 5123 => 2,
            _ => 4,
        };
        let stride = view["byteStride"].as_u64().map_or(width * size, |stride| stride as usize);
        let scale =
            if accessor["normalized"] == true { [127.0, 32767.0][usize::from(size == 2)] } else { 1.0 };
        let number = |item: usize, axis: usize| {
            let bytes = &self.body[from as usize + item * stride + axis * size..];
            let value = match component {
                5120 => f64::from(bytes[0].cast_signed()),
                5122 => f64::from(i16::from_le_bytes([bytes[0], bytes[1]])),
                5123 => f64::from(u16::from_le_bytes([bytes[0], bytes[1]])),
                5125 => f64::from(u32::from_le_bytes(bytes[..4].try_into().unwrap())),
                _ => f64::from(f32::from_le_bytes(bytes[..4].try_into().unwrap())),
            };
            value / scale
        };
        let item =
            |item: usize| std::array::from_fn(|axis| if axis < width { number(item, axis) } else { 0.0 });
        (0..index(&accessor["count"])).map(item).collect()
    }

    /// Returns the faces of all instances.
    fn faces(&self) -> Vec<ReadFace> {
        let mut faces = Vec::new();
        let vector = |value: &Value, other: DVec3| match value.as_array() {
            Some(list) => DVec3::from_slice(&list.iter().map(|it| it.as_f64().unwrap()).collect::<Vec<_>>()),
            None => other,
        };
        let mut open: Vec<(usize, DAffine3)> = Vec::new();
        let roots = self.json["scenes"][0]["nodes"].as_array().into_iter().flatten();
        open.extend(roots.map(|root| (index(root), DAffine3::IDENTITY)));
        while let Some((number, outer)) = open.pop() {
            let node = &self.json["nodes"][number];
            let place = outer
                * DAffine3::from_scale_rotation_translation(
                    vector(&node["scale"], DVec3::ONE),
                    DQuat::IDENTITY,
                    vector(&node["translation"], DVec3::ZERO),
                );
            open.extend(node["children"].as_array().into_iter().flatten().map(|child| (index(child), place)));
            // The node of the origin has no mesh.
            if node["mesh"].is_null() {
                continue;
            }
            let attributes = &node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
            let list = |key: &str| attributes.get(key).map(|accessor| self.array(accessor));
            let (translations, rotations, scales) = (list("TRANSLATION"), list("ROTATION"), list("SCALE"));
            let numbers = list("_FEATURE_ID_0");
            let instances = translations.as_ref().map_or(1, Vec::len);
            for instance in 0..instances {
                let point = |list: &Option<Vec<[f64; 4]>>, other: DVec3| {
                    list.as_ref().map_or(other, |list| DVec3::from_slice(&list[instance]))
                };
                let rotation =
                    rotations.as_ref().map_or(DQuat::IDENTITY, |it| DQuat::from_array(it[instance]));
                let own = DAffine3::from_scale_rotation_translation(
                    point(&scales, DVec3::ONE),
                    rotation.normalize(),
                    point(&translations, DVec3::ZERO),
                );
                let feature = numbers.as_ref().map(|numbers| numbers[instance][0] as usize);
                self.add(&self.json["meshes"][index(&node["mesh"])], &(place * own), feature, &mut faces);
            }
        }
        faces
    }

    fn add(&self, mesh: &Value, place: &DAffine3, of_instance: Option<usize>, faces: &mut Vec<ReadFace>) {
        for primitive in mesh["primitives"].as_array().unwrap() {
            let attributes = &primitive["attributes"];
            let positions = self.array(&attributes["POSITION"]);
            let normals = self.array(&attributes["NORMAL"]);
            let numbers = attributes.get("_FEATURE_ID_0").map(|accessor| self.array(accessor));
            let described = &primitive["extensions"]["EXT_mesh_features"]["featureIds"][0];
            assert_eq!(described.is_object(), numbers.is_some());
            let turn = place.matrix3.inverse().transpose();
            for corners in self.array(&primitive["indices"]).chunks(3) {
                let mut ends = [0, 1, 2].map(|corner| corners[corner][0] as usize);
                if place.matrix3.determinant() < 0.0 {
                    ends.swap(1, 2);
                }
                let feature = numbers.as_ref().map(|numbers| ends.map(|end| numbers[end][0] as usize));
                assert!(feature.is_none_or(|[a, b, c]| a == b && b == c), "a triangle has one feature");
                let feature = feature.map(|[feature, ..]| feature);
                faces.push(ReadFace {
                    material: index(&primitive["material"]),
                    feature: feature
                        .or(of_instance)
                        .filter(|it| described["nullFeatureId"].as_u64() != Some(*it as u64)),
                    points: ends.map(|end| z_up(place.transform_point3(DVec3::from_slice(&positions[end])))),
                    normals: ends.map(|end| z_up((turn * DVec3::from_slice(&normals[end])).normalize())),
                });
            }
        }
    }
}

/// Returns the faces of a scene, by material and in the order of instances.
fn expected(scene: &Scene) -> Vec<ReadFace> {
    let mut faces = Vec::new();
    for instance in &scene.instances {
        let place = &instance.transform;
        let turn = place.matrix3.inverse().transpose();
        for part in &scene.meshes[instance.mesh].parts {
            faces.extend(triangles(part).map(|mut ends| {
                if place.matrix3.determinant() < 0.0 {
                    ends.swap(1, 2);
                }
                let at = |end: u32| place.transform_point3(part.positions[end as usize].as_dvec3());
                let normal = |end: u32| (turn * part.normals[end as usize].vector().as_dvec3()).normalize();
                let feature = instance.origin.and_then(|origin| origin.record);
                ReadFace { material: part.material, feature, points: ends.map(at), normals: ends.map(normal) }
            }));
        }
    }
    // Faces that a flattening transform collapses are not written.
    let origin = crate::check::check(scene).unwrap().origin;
    faces.retain(|face: &ReadFace| {
        let [a, b, c] = face.points.map(|point| (point - origin).as_vec3());
        a != b && b != c && c != a
    });
    faces.sort_by_key(|face| face.material);
    faces
}

/// Assigns each instance to a feature, except every seventh.
fn with_features(mut scene: Scene) -> Scene {
    for (row, instance) in scene.instances.iter_mut().enumerate() {
        let record = (row % 7 != 6).then_some(row);
        instance.origin = Some(Origin { system: 0, chain: row, record });
    }
    scene
}

fn options(expand_instances: bool, compression: TileCompression, precision: f64) -> TileModelOptions {
    TileModelOptions { expand_instances, compression, precision }
}

#[test]
fn every_face_of_a_sample_is_in_the_mesh_with_its_normals_and_its_feature() {
    let folder = tempfile::tempdir().unwrap();
    let (none, quantize) = (TileCompression::None, TileCompression::Quantize);
    let mut compared = 0;
    for (name, scene) in samples::all(folder.path()) {
        let scene = with_features(scene);
        let wanted = expected(&scene);
        let origin = crate::check::check(&scene).unwrap().origin;
        for (compression, precision) in [(none, 0.001), (quantize, 0.001), (quantize, 0.1)] {
            let file = ReadTile::of(&scene, &options(true, compression, precision), scene.instances.len());
            let faces = file.faces();
            assert_eq!((faces.len(), file.counts.instances), (file.counts.triangles, 0), "{name}");
            let near =
                if compression == none { 5e-4 } else { precision } + origin.abs().max_element() * 1e-12;
            if compression == none || name == "town" {
                assert_eq!(faces.len(), wanted.len(), "{name}");
                let materials: Vec<usize> = wanted.iter().map(|face| face.material).collect();
                let different = materials.chunk_by(|a, b| a == b).count();
                assert_eq!(file.counts.primitives, different, "{name}");
                for (is, wanted) in faces.iter().zip(&wanted) {
                    assert_eq!(is.feature, wanted.feature, "{name}");
                    for corner in 0..3 {
                        let away = (is.points[corner] - wanted.points[corner]).length();
                        assert!(away < 2.0 * near, "{name}: {away} {is:?} {wanted:?}");
                        let away = (is.normals[corner] - wanted.normals[corner]).length();
                        // A flattened box has no normals.
                        let is_flat = !wanted.normals[corner].is_finite();
                        assert!(is_flat || away < 0.02, "{name}: {away} {is:?} {wanted:?}");
                    }
                }
                compared += faces.len();
            }
        }
    }
    assert!(compared > 10_000, "{compared}");
}

#[test]
fn repeated_models_are_instances_that_look_as_their_copies_do() {
    let mut scene = samples::town(16);
    scene.instances[5].transform.matrix3.x_axis.y += 3.0;
    scene.instances[6].transform.matrix3.x_axis *= -1.0;
    let scene = with_features(scene);
    for compression in [TileCompression::None, TileCompression::Quantize] {
        let count = scene.instances.len();
        let expanded = ReadTile::of(&scene, &options(true, compression, 0.001), count);
        let file = ReadTile::of(&scene, &options(false, compression, 0.001), count);
        assert_eq!(file.counts.triangles, expanded.counts.triangles);
        // The ground, the sheared house and the mirrored one are in the mesh, like the few houses without a feature.
        assert!(file.counts.instances > 200 && file.counts.instances < count - 2, "{:?}", file.counts);
        let sorted = |file: &ReadTile| {
            let centre = |face: &ReadFace| face.points.iter().sum::<DVec3>() / 3.0;
            let mut faces: Vec<_> =
                file.faces().iter().map(|face| (face.feature, face.material, centre(face))).collect();
            faces.sort_by_key(|face| (face.0, face.1));
            faces
        };
        for (is, wanted) in sorted(&file).into_iter().zip(sorted(&expanded)) {
            assert_eq!((is.0, is.1), (wanted.0, wanted.1));
            assert!(is.0.is_none() || (is.2 - wanted.2).length() < 0.002, "{is:?} {wanted:?}");
        }
    }
}

#[test]
fn quantised_tiles_are_smaller_and_need_the_extension() {
    let scene = with_features(samples::town(12));
    let of = |compression, precision| ReadTile::of(&scene, &options(true, compression, precision), 145);
    let [plain, fine, coarse] = [
        of(TileCompression::None, 0.001),
        of(TileCompression::Quantize, 0.001),
        of(TileCompression::Quantize, 0.02),
    ];
    assert!(plain.json["extensionsRequired"].to_string().find("quantization").is_none());
    for file in [&fine, &coarse] {
        assert!(file.json["extensionsRequired"].to_string().contains("KHR_mesh_quantization"));
    }
    assert!(fine.body.len() < plain.body.len() && coarse.body.len() < fine.body.len());
    let packed = of(TileCompression::Meshopt, 0.001);
    assert!(2 * packed.body.len() < plain.body.len(), "{} {}", packed.body.len(), plain.body.len());
    assert!(packed.json["extensionsRequired"].to_string().contains("EXT_meshopt_compression"));
    assert_eq!(packed.json["buffers"][1]["extensions"]["EXT_meshopt_compression"]["fallback"], true);
    // The ground is 178 m wide, so that 16 bits have a step of 3.9 mm.
    let kind = |file: &ReadTile| {
        let position = &file.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"];
        file.json["accessors"][index(position)]["componentType"].as_u64()
    };
    assert_eq!([kind(&plain), kind(&fine), kind(&coarse)], [Some(5126), Some(5126), Some(5123)]);
}

#[test]
fn the_second_set_of_texture_coordinates_is_kept_in_a_tile() {
    let folder = tempfile::tempdir().unwrap();
    let scene = samples::stained_boxes(folder.path());
    let tile = ReadTile::of(&scene, &TileModelOptions::default(), 0);
    let mut sets = 0;
    for mesh in tile.json["meshes"].as_array().unwrap() {
        for primitive in mesh["primitives"].as_array().unwrap() {
            let attributes = &primitive["attributes"];
            let material = &tile.json["materials"][index(&primitive["material"])];
            assert_eq!(attributes["TEXCOORD_1"].is_null(), material["occlusionTexture"].is_null());
            if attributes["TEXCOORD_1"].is_null() {
                continue;
            }
            let found = tile.array(&attributes["TEXCOORD_1"]);
            assert_eq!(found.len(), tile.array(&attributes["POSITION"]).len());
            let most = |found: &[[f64; 4]]| found.iter().fold(f64::MIN, |most, uv| most.max(uv[0]));
            let part = |vertices: &burgeon_scene::Part| {
                let all = (0..vertices.positions.len()).map(|vertex| vertices.second_uv(vertex).x);
                f64::from(all.fold(f32::MIN, f32::max)) / 4.0
            };
            let wanted = scene.meshes[..2].iter().map(|mesh| part(&mesh.parts[0]));
            assert!(wanted.into_iter().any(|wanted| (most(&found) - wanted).abs() < 1e-5));
            sets += 1;
        }
    }
    assert_eq!(sets, 2);
}
