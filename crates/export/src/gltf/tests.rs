//! Tests that read written files back with another crate.

use super::super::samples;
use super::*;
use crate::{Export, Files, InstanceStorage, SceneFacts};
use burgeon_base::stop::Stop;
use burgeon_picture::Picture;
use burgeon_scene::Scene;
use glam::{DMat4, DQuat, DVec3};
use gltf::Gltf;
use gltf_json as json;
use json::accessor::ComponentType;
use proptest::prelude::*;
use std::collections::BTreeMap;

const TURN: fn(DVec3) -> DVec3 = |p| DVec3::new(p.x, p.z, -p.y);

/// Returns the triangles of every instance in the world, as a viewer draws them.
pub(super) fn drawn_triangles(bytes: &[u8]) -> Vec<[DVec3; 3]> {
    let file = Gltf::from_slice_without_validation(bytes).unwrap();
    let blob = file.blob.clone().unwrap_or_default();
    let mut triangles = Vec::new();
    for node in file.default_scene().unwrap().nodes() {
        visit(&node, DMat4::IDENTITY, &file, &blob, &mut triangles);
    }
    triangles
}

fn matrix(node: &gltf::Node<'_>) -> DMat4 {
    let (translation, rotation, scale) = node.transform().decomposed();
    DMat4::from_scale_rotation_translation(
        glam::Vec3::from(scale).as_dvec3(),
        glam::Quat::from_array(rotation).as_dquat(),
        glam::Vec3::from(translation).as_dvec3(),
    )
}

fn visit(node: &gltf::Node<'_>, parent: DMat4, file: &Gltf, blob: &[u8], out: &mut Vec<[DVec3; 3]>) {
    let world = parent * matrix(node);
    if let Some(mesh) = node.mesh() {
        let places = match node.extension_value(place_extension()) {
            None => vec![DMat4::IDENTITY],
            Some(extension) => instances(extension, file, blob),
        };
        for primitive in mesh.primitives() {
            let reader = primitive.reader(|_| Some(blob));
            let points = positions(&primitive, blob);
            let corners: Vec<_> = reader.read_indices().unwrap().into_u32().collect();
            for place in &places {
                let at = |corner: u32| {
                    (world * *place).transform_point3(glam::Vec3::from(points[corner as usize]).as_dvec3())
                };
                for triangle in corners.chunks(3) {
                    let mut triangle = [at(triangle[0]), at(triangle[1]), at(triangle[2])];
                    if world.determinant() < 0.0 {
                        triangle.swap(1, 2);
                    }
                    assert!(place.determinant() > 0.0, "an instance must not mirror, its node has to");
                    out.push(triangle);
                }
            }
        }
    }
    for child in node.children() {
        visit(&child, world, file, blob, out);
    }
}

/// Returns the positions of a primitive, which may be integers.
fn positions(primitive: &gltf::Primitive<'_>, blob: &[u8]) -> Vec<[f32; 3]> {
    let accessor = primitive.get(&gltf::Semantic::Positions).unwrap();
    if accessor.data_type() == ComponentType::F32 {
        return primitive.reader(|_| Some(blob)).read_positions().unwrap().collect();
    }
    let (view, mut places) = (accessor.view().unwrap(), Vec::new());
    let start = view.offset() + accessor.offset();
    for item in blob[start..].chunks(view.stride().unwrap()).take(accessor.count()) {
        let shorts: Vec<u16> = bytemuck::pod_collect_to_vec(&item[..6]);
        places.push([f32::from(shorts[0]), f32::from(shorts[1]), f32::from(shorts[2])]);
    }
    places
}

fn place_extension() -> &'static str {
    "EXT_mesh_gpu_instancing"
}

fn instances(extension: &serde_json::Value, file: &Gltf, blob: &[u8]) -> Vec<DMat4> {
    let array = |key: &str, width: usize| -> Option<Vec<Vec<f64>>> {
        let index = extension["attributes"].get(key)?.as_u64().unwrap() as usize;
        let accessor = file.accessors().nth(index).unwrap();
        let start = accessor.view().unwrap().offset() + accessor.offset();
        let numbers = accessor.count() * width;
        let numbers: Vec<f64> = if accessor.data_type() == ComponentType::I16 {
            let shorts: Vec<i16> = bytemuck::pod_collect_to_vec(&blob[start..start + numbers * 2]);
            shorts.into_iter().map(|it| (f64::from(it) / 32767.0).max(-1.0)).collect()
        } else {
            let floats: Vec<f32> = bytemuck::pod_collect_to_vec(&blob[start..start + numbers * 4]);
            floats.into_iter().map(f64::from).collect()
        };
        Some(numbers.chunks(width).map(<[f64]>::to_vec).collect())
    };
    let translations = array("TRANSLATION", 3).unwrap();
    let rotations = array("ROTATION", 4);
    let scales = array("SCALE", 3);
    let place = |i: usize| {
        DMat4::from_scale_rotation_translation(
            scales.as_ref().map_or(DVec3::ONE, |it| DVec3::from_slice(&it[i])),
            rotations.as_ref().map_or(DQuat::IDENTITY, |it| DQuat::from_slice(&it[i]).normalize()),
            DVec3::from_slice(&translations[i]),
        )
    };
    (0..translations.len()).map(place).collect()
}

/// Returns the triangles of every instance, directly from the scene.
pub(super) fn scene_triangles(scene: &Scene) -> Vec<[DVec3; 3]> {
    let mut triangles = Vec::new();
    for instance in &scene.instances {
        for part in &scene.meshes[instance.mesh].parts {
            for corners in super::super::check::triangles(part) {
                let mut triangle = corners.map(|corner| {
                    TURN(instance.transform.transform_point3(part.positions[corner as usize].as_dvec3()))
                });
                if instance.transform.matrix3.determinant() < 0.0 {
                    triangle.swap(1, 2);
                }
                triangles.push(triangle);
            }
        }
    }
    triangles
}

/// Returns the largest distance (m) between an expected triangle and the one that is drawn, in any order.
fn distance(scene: &Scene) -> f64 {
    let (mut meant, mut drawn) = (scene_triangles(scene), drawn_triangles(&glb(scene).unwrap()));
    assert_eq!(meant.len(), drawn.len());
    let key = |it: &[DVec3; 3]| {
        let [a, b, c] = it.map(|p| [p.x, p.y, p.z].map(|it| (it * 37.7123).round() as i64));
        let turns = [[a, b, c], [b, c, a], [c, a, b]];
        turns.into_iter().min().unwrap()
    };
    meant.sort_by_key(key);
    drawn.sort_by_key(key);
    largest_distance(&meant, &drawn)
}

/// Returns the largest distance (m) between triangles in the same order, which may begin at different corners.
pub(super) fn largest_distance(some: &[[DVec3; 3]], others: &[[DVec3; 3]]) -> f64 {
    assert_eq!(some.len(), others.len());
    let apart = |(a, b): (&[DVec3; 3], &[DVec3; 3])| {
        let turned = |by: usize| (0..3).map(|i| a[i].distance(b[(i + by) % 3])).fold(0.0, f64::max);
        turned(0).min(turned(1)).min(turned(2))
    };
    some.iter().zip(others).map(apart).fold(0.0, f64::max)
}

#[test]
fn what_is_drawn_is_what_was_meant() {
    let folder = tempfile::tempdir().unwrap();
    let mut count = 0;
    // The validating reader rejects empty scenes.
    let seen = |(_, scene): &(&str, Scene)| scene.triangles() > 0;
    for (name, scene) in samples::all(folder.path()).into_iter().filter(seen) {
        let distance = distance(&scene);
        assert!(distance < 1e-3, "{name}: {distance} m apart");
        count += 1;
    }
    assert_eq!(count, 15);
}

#[test]
fn an_instance_becomes_a_node_and_its_mesh_is_stored_once() {
    let scene = samples::boxes(5);
    let file = Gltf::from_slice(&glb(&scene).unwrap()).unwrap();
    assert_eq!((file.meshes().count(), file.nodes().count(), file.accessors().count()), (1, 5, 2));
    let names: Vec<_> = file.nodes().map(|node| node.name().unwrap().to_owned()).collect();
    assert_eq!(names, ["box 0", "box 1", "box 2", "box 3", "box 4"]);
}

#[test]
fn a_feature_id_stays_with_its_node() {
    let scene = samples::town(2);
    let text = String::from_utf8_lossy(&glb(&scene).unwrap()).into_owned();
    for i in 0..4 {
        assert!(text.contains(&format!(r#""extras":{{"feature":"way/{i}"}}"#)), "way/{i}");
    }
}

/// Returns the bytes of a `.glb` file with instances in `instances`, and the notes.
fn written(scene: &Scene, instances: InstanceStorage) -> (Vec<u8>, Vec<String>) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.glb");
    let facts = SceneFacts { instances, ..SceneFacts::default() };
    let mut files = Files::default();
    files.export(&Export { scene, picture: &Picture::default(), facts }, &path).unwrap();
    let notes = files.take_notes();
    files.publish().unwrap();
    (std::fs::read(path).unwrap(), notes)
}

#[test]
fn up_to_a_thousand_instances_are_nodes_and_more_need_the_extension_unless_the_user_decides() {
    use InstanceStorage::{Automatic, Expanded, Extension, Nodes};
    let all = [
        (60, Automatic, 60, "a.glb: 60 repeated instances are plain nodes"),
        (1000, Automatic, 1000, "a.glb: 1,000 repeated instances are plain nodes"),
        (1002, Automatic, 2, "a.glb: 1,002 instances need EXT_mesh_gpu_instancing"),
        (60, Extension, 2, "a.glb: 60 instances need EXT_mesh_gpu_instancing"),
        (1002, Nodes, 1002, "a.glb: 1,002 repeated instances are plain nodes"),
        (1002, Expanded, 1, ""),
    ];
    for (count, storage, nodes, note) in all {
        let scene = samples::many(count);
        let (bytes, notes) = written(&scene, storage);
        let file = Gltf::from_slice_without_validation(&bytes).unwrap();
        assert_eq!(file.nodes().count(), nodes, "{count} {storage:?}");
        assert_eq!(file.extensions_required().count() > 0, nodes == 2, "{count} {storage:?}");
        assert!(
            notes.concat().starts_with(note) && notes.len() == usize::from(!note.is_empty()),
            "{notes:?}"
        );
        let drawn = drawn_triangles(&bytes);
        let volume: f64 = drawn.iter().map(|[a, b, c]| a.dot(b.cross(*c)) / 6.0).sum();
        let real = samples::volume(&scene);
        assert_eq!(drawn.len(), scene.triangles());
        assert!((volume - real).abs() < 1e-3 * real, "{count} {storage:?}: {volume} is not {real}");
    }
}

#[test]
fn many_like_instances_share_a_node_and_mirrored_ones_another() {
    let glb = |scene: &Scene| written(scene, InstanceStorage::Extension);
    let node_count = |scene: &Scene| {
        let file = Gltf::from_slice_without_validation(&glb(scene).0).unwrap();
        (file.nodes().count(), file.extensions_required().map(str::to_owned).collect::<Vec<_>>())
    };
    assert_eq!(node_count(&samples::many(500)), (2, vec![place_extension().into()]));
    assert_eq!(node_count(&samples::many(15)), (15, vec![]));
    let mut named = samples::many(500);
    for (i, instance) in named.instances.iter_mut().enumerate() {
        instance.feature = Some(i.to_string());
    }
    assert_eq!(node_count(&named), (500, vec![]));
    let [some, more] = [200, 1200].map(|count| glb(&samples::many(count)).0.len());
    assert!((more - some) / 1000 <= 40, "{} bytes for 1000 more", more - some);
}

#[test]
fn models_that_features_have_placed_share_a_node_which_tells_whose_each_is() {
    let mut scene = samples::many(60);
    for (i, instance) in scene.instances.iter_mut().enumerate() {
        instance.feature = (i > 0).then(|| format!("way/{}", i % 3));
        instance.placement = Some(i);
    }
    let bytes = written(&scene, InstanceStorage::Extension).0;
    let file = Gltf::from_slice_without_validation(&bytes).unwrap();
    let blob = file.blob.clone().unwrap_or_default();
    let extras = file.default_scene().unwrap().extras().clone().unwrap();
    let features: serde_json::Value = serde_json::from_str(extras.get()).unwrap();
    let mut told = BTreeMap::new();
    for node in file.nodes() {
        let attributes = &node.extension_value(place_extension()).unwrap()["attributes"];
        let index = attributes["_FEATURE_ID_0"].as_u64().unwrap() as usize;
        let accessor = file.accessors().nth(index).unwrap();
        let start = accessor.view().unwrap().offset() + accessor.offset();
        assert_eq!(accessor.data_type(), ComponentType::I16);
        for number in bytemuck::pod_collect_to_vec::<u8, i16>(&blob[start..start + accessor.count() * 2]) {
            let name = (number >= 0).then(|| features["features"][number as usize].as_str().unwrap());
            *told.entry(name.map(str::to_owned)).or_insert(0) += 1;
        }
    }
    let expected = [(None, 1), (Some("way/0"), 19), (Some("way/1"), 20), (Some("way/2"), 20)];
    let expected = expected.map(|(name, count)| (name.map(str::to_owned), count));
    assert_eq!(told.into_iter().collect::<Vec<_>>(), expected.to_vec());
}

#[test]
fn a_far_model_has_one_whole_offset_and_loses_less_than_a_millimetre() {
    let scene = samples::far_box();
    let file = Gltf::from_slice(&glb(&scene).unwrap()).unwrap();
    let top: Vec<_> = file.default_scene().unwrap().nodes().collect();
    assert_eq!(top.len(), 1);
    assert_eq!(top[0].transform().decomposed().0.to_vec(), [531_000.0, 0.0, -4_556_000.0]);
    assert!(distance(&scene) < 1e-4);
}

#[test]
fn a_model_as_large_as_a_planet_loses_less_than_a_millimetre() {
    let mut scene = samples::boxes(5);
    let places = [[0.3, 6_371_000.7, -12.1], [4_100_000.2, -3.3, 0.1], [-6_371_000.4, 0.2, 812.3]];
    for (instance, place) in scene.instances.iter_mut().zip(places) {
        instance.transform.translation = DVec3::from(place);
    }
    assert!(distance(&scene) < 1e-3, "{}", distance(&scene));
    // Three instances have a second node, and all are children of the origin's node.
    let file = Gltf::from_slice(&glb(&scene).unwrap()).unwrap();
    assert_eq!(file.nodes().count(), 5 + 3 + 1);
}

#[test]
fn points_beyond_a_u16_are_indexed_by_u32() {
    for (n, kind) in [(254, json::accessor::ComponentType::U16), (256, json::accessor::ComponentType::U32)] {
        let bytes = glb(&samples::hill(n)).unwrap();
        let file = Gltf::from_slice(&bytes).unwrap();
        let primitive = file.meshes().next().unwrap().primitives().next().unwrap();
        assert_eq!(primitive.indices().unwrap().data_type(), kind, "{n}");
        assert_eq!(drawn_triangles(&bytes).len(), (n * n * 2) as usize);
    }
}

#[test]
fn texture_coordinates_are_parts_of_the_image_from_its_top() {
    let folder = tempfile::tempdir().unwrap();
    let mut scene = samples::textured_boxes(folder.path());
    for mesh in &mut scene.meshes {
        mesh.parts[0].uvs[0] = glam::Vec2::new(0.25, 0.5);
    }
    let bytes = glb(&scene).unwrap();
    let (file, buffers, images) = gltf::import_slice(&bytes).unwrap();
    assert_eq!((images.len(), file.images().count(), file.textures().count()), (2, 2, 2));
    let first = |mesh: gltf::Mesh<'_>| {
        let primitive = mesh.primitives().next().unwrap();
        let reader = primitive.reader(|_| Some(&buffers[0]));
        reader.read_tex_coords(0).unwrap().into_f32().next().unwrap()
    };
    let all: Vec<_> = file.meshes().map(first).collect();
    assert_eq!(all, [[0.5, -1.0], [0.25, 0.5], [0.5, 0.25]]);
    let plain = Gltf::from_slice(&glb(&samples::boxes(1)).unwrap()).unwrap();
    assert_eq!(plain.meshes().next().unwrap().primitives().next().unwrap().attributes().count(), 1);
}

#[test]
fn a_normal_map_is_written_with_its_scale_and_with_texture_coordinates() {
    let folder = tempfile::tempdir().unwrap();
    let scene = samples::relief_boxes(folder.path());
    let file = Gltf::from_slice(&glb(&scene).unwrap()).unwrap();
    let maps: Vec<_> = file.materials().map(|material| material.normal_texture()).collect();
    let of = |map: &Option<gltf::material::NormalTexture<'_>>| {
        map.as_ref().map(|map| (map.scale(), map.texture().source().index()))
    };
    assert_eq!(maps.iter().map(of).collect::<Vec<_>>(), [Some((1.0, 1)), Some((0.5, 1)), None]);
    // Brick and waves: the leaf has no texture here.
    assert_eq!(file.images().count(), 2);
    let second = file.meshes().nth(1).unwrap().primitives().next().unwrap();
    assert!(second.material().pbr_metallic_roughness().base_color_texture().is_none());
    assert!(second.get(&gltf::Semantic::TexCoords(0)).is_some());
}

#[test]
fn a_normal_map_of_another_size_than_the_texture_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let mut scene = samples::relief_boxes(folder.path());
    if let Some(map) = &mut scene.materials[0].normal_map {
        map.image.size = [3.0, 3.0];
    }
    let error = glb(&scene).unwrap_err().to_string();
    assert!(error.contains("has a texture and a normal map of different sizes"), "{error}");
}

#[test]
fn a_gltf_file_refers_to_its_body_and_textures() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("große Stadt.gltf");
    let scene = samples::textured_boxes(folder.path());
    super::super::write(&scene, &path, &burgeon_picture::Picture::default()).unwrap();
    let (file, buffers, images) = gltf::import(&path).unwrap();
    assert_eq!((file.meshes().count(), buffers.len(), images.len()), (3, 1, 2));
    assert!(folder.path().join("große Stadt.bin").is_file());
    assert!(folder.path().join("große Stadt_brick.png").is_file());
}

#[test]
fn normals_have_length_one_whatever_came_in() {
    let mut scene = samples::hill(3);
    let normals = &mut scene.meshes[0].parts[0].normals;
    normals[0] = glam::Vec3::ZERO.into();
    normals[1] = glam::Vec3::NAN.into();
    normals[2] = glam::Vec3::splat(1e-30).into();
    let bytes = glb(&scene).unwrap();
    let (file, buffers, _) = gltf::import_slice(&bytes).unwrap();
    let primitive = file.meshes().next().unwrap().primitives().next().unwrap();
    let normals: Vec<_> = primitive.reader(|_| Some(&buffers[0])).read_normals().unwrap().collect();
    assert_eq!(normals.len(), 16);
    for normal in normals {
        assert!((glam::Vec3::from(normal).length() - 1.0).abs() < 1e-6, "{normal:?}");
    }
}

#[test]
fn flat_faces_have_no_normals_and_share_their_corners() {
    let folder = tempfile::tempdir().unwrap();
    let samples = samples::all(folder.path());
    let corners = |name: &str| {
        let scene = &samples.iter().find(|(known, _)| *known == name).unwrap().1;
        let bytes = glb(scene).unwrap();
        let file = Gltf::from_slice_without_validation(&bytes).unwrap();
        let mut counts = BTreeMap::new();
        for primitive in file.meshes().flat_map(|mesh| mesh.primitives().collect::<Vec<_>>()) {
            assert!(primitive.get(&gltf::Semantic::Normals).is_none(), "{name}");
            let positions = primitive.get(&gltf::Semantic::Positions).unwrap();
            let corners = primitive.reader(|_| file.blob.as_deref()).read_indices().unwrap().into_u32();
            assert!(corners.max().unwrap() < positions.count() as u32);
            counts.insert(positions.index(), positions.count());
        }
        counts.into_values().collect::<Vec<_>>()
    };
    // Parts without triangles are not written.
    assert_eq!(corners("odd"), [8]);
    assert_eq!(corners("boxes"), [8]);
}

#[test]
fn faces_without_an_image_share_the_corners_of_those_with_one() {
    let folder = tempfile::tempdir().unwrap();
    let mut scene = samples::textured_boxes(folder.path());
    let mesh = &mut scene.meshes[0];
    let mut plain = mesh.parts[0].clone();
    plain.material = scene.materials.len();
    scene.materials.push(burgeon_scene::Material::default());
    let half = mesh.parts[0].triangles.len() / 2;
    plain.triangles = mesh.parts[0].triangles.iter().skip(half).collect();
    mesh.parts[0].triangles.truncate(half);
    mesh.parts.insert(0, plain);
    let file = Gltf::from_slice(&glb(&scene).unwrap()).unwrap();
    let primitives: Vec<_> = file.meshes().next().unwrap().primitives().collect();
    let positions = |index: usize| primitives[index].get(&gltf::Semantic::Positions).unwrap();
    let place = |index: usize| (positions(index).view().unwrap().index(), positions(index).offset());
    assert_eq!(place(0), place(1), "the same bytes");
    assert!(primitives[0].get(&gltf::Semantic::TexCoords(0)).is_none());
    let coordinates = primitives[1].get(&gltf::Semantic::TexCoords(0)).unwrap();
    assert_eq!(coordinates.count(), positions(1).count());
    assert!(positions(0).count() >= positions(1).count() && positions(0).count() < 24);
    assert!(distance(&scene) < 1e-4);
}

#[test]
fn faces_that_are_shaded_otherwise_than_they_lie_are_written_with_their_normals() {
    let mut scene = samples::boxes(3);
    let part = &mut scene.meshes[0].parts[0];
    let tilted = burgeon_scene::Normal::from(glam::Vec3::new(0.3, 0.4, 0.5));
    part.normals[..4].fill(tilted);
    let bytes = glb(&scene).unwrap();
    let file = Gltf::from_slice(&bytes).unwrap();
    let primitives: Vec<_> = file.meshes().next().unwrap().primitives().collect();
    assert_eq!(primitives.len(), 2);
    let normals = |index: usize| primitives[index].reader(|_| file.blob.as_deref()).read_normals();
    assert!(normals(0).is_none());
    for normal in normals(1).unwrap() {
        assert!(glam::Vec3::from(normal).distance(coordinates::y_up(tilted.vector())) < 1e-6);
    }
    assert!(distance(&scene) < 1e-4);
}

#[test]
fn a_large_scene_is_written_in_batches_and_is_the_same() {
    let mut scene = samples::boxes(1);
    // More corners than a batch, in meshes that exceed short indices and in small ones.
    let part = scene.meshes[0].parts[0].clone();
    for count in [9_000_u32, 26_000, 40, 3] {
        let mut mesh = burgeon_scene::Mesh::default();
        let into = mesh.part(0);
        for step in 0..count {
            let aside = glam::Vec3::new((step % 200) as f32 * 3.0, (step / 200) as f32 * 3.0, 0.0);
            let first = into.positions.len() as u32;
            into.positions.extend(part.positions.iter().map(|at| *at + aside));
            into.normals.extend_from_slice(&part.normals);
            into.uvs.extend_from_slice(&part.uvs);
            into.triangles.extend(part.triangles.iter().map(|corners| corners.map(|corner| corner + first)));
        }
        scene.meshes.push(mesh);
        let transform =
            glam::DAffine3::from_translation(DVec3::new(0.0, 0.0, 5.0 * scene.meshes.len() as f64));
        let instance = scene.instances[0].clone();
        scene.instances.push(burgeon_scene::Instance { mesh: scene.meshes.len() - 1, transform, ..instance });
    }
    assert!(distance(&scene) < 1e-3);
    let views = Gltf::from_slice_without_validation(&glb(&scene).unwrap()).unwrap().views().count();
    assert!((5..12).contains(&views), "{views} views");
}

#[test]
fn a_viewer_is_sent_the_same_triangles_in_fewer_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let mut rounded = 0;
    for (name, scene) in samples::all(folder.path()).into_iter().filter(|(_, scene)| scene.triangles() > 0) {
        let file = written(&scene, InstanceStorage::Extension).0;
        let viewer = glb_for_viewer(&scene).unwrap().0;
        // Only files have rounded rotations.
        let is_rounded = file.windows(10).any(|bytes| bytes == b"\"ROTATION\"");
        let most = if is_rounded { 1e-3 } else { 0.0 };
        let (sent, written) = (drawn_triangles(&viewer), drawn_triangles(&file));
        assert!(largest_distance(&sent, &written) <= most, "{name}");
        let measured = drawn_triangles(&glb_with_texture_coordinates(&scene, &Stop::default()).unwrap());
        assert!(largest_distance(&measured, &sent) <= 0.0, "{name}");
        rounded += usize::from(is_rounded);
    }
    assert_eq!(rounded, 3);
    let hill = samples::hill(100);
    let (file, viewer) = (glb(&hill).unwrap().len(), glb_for_viewer(&hill).unwrap().0.len());
    assert!(viewer < file * 9 / 10, "{viewer} of {file} bytes");
}

#[test]
fn small_normals_are_near_the_true_ones_and_nearer_where_surfaces_are_smooth() {
    for (scene, width, most) in [(samples::boxes(3), 1, 0.01), (samples::hill(20), 2, 4e-5)] {
        let bytes = glb_for_viewer(&scene).unwrap().0;
        let file = Gltf::from_slice_without_validation(&bytes).unwrap();
        let primitive = file.meshes().next().unwrap().primitives().next().unwrap();
        let accessor = primitive.get(&gltf::Semantic::Normals).unwrap();
        assert!(accessor.normalized() && accessor.data_type().size() == width);
        let view = accessor.view().unwrap();
        assert_eq!(view.stride(), Some(4 * width));
        let blob = &file.blob.as_ref().unwrap()[view.offset() + accessor.offset()..];
        let one = |at: &[u8]| match width {
            1 => f32::from(at[0].cast_signed()) / 127.0,
            _ => f32::from(i16::from_le_bytes([at[0], at[1]])) / 32767.0,
        };
        let part = &scene.meshes[0].parts[0];
        let written = |corner: u32| {
            let at = &blob[corner as usize * 4 * width..];
            glam::Vec3::new(one(at), one(&at[width..]), one(&at[2 * width..]))
        };
        let flat = primitive.extras().as_ref().is_some_and(|extras| extras.get() == r#"{"flat":true}"#);
        assert_eq!(flat, width == 1);
        let indices: Vec<u32> =
            primitive.reader(|_| file.blob.as_deref()).read_indices().unwrap().into_u32().collect();
        for (given, corners) in part.triangles.iter().zip(indices.chunks(3)) {
            let pairs = if flat {
                vec![(given[0], corners[2])]
            } else {
                given.iter().copied().zip(corners.iter().copied()).collect()
            };
            for (given, corner) in pairs {
                let normal = part.normals[given as usize].vector();
                assert!(
                    written(corner).distance(coordinates::y_up(normal)) < most,
                    "{normal} is {}",
                    written(corner)
                );
            }
        }
    }
}

#[test]
fn the_same_scene_gives_the_same_bytes() {
    let scene = samples::many(100);
    assert_eq!(glb(&scene).unwrap(), glb(&scene.clone()).unwrap());
}

#[test]
fn more_than_4_gib_is_refused_with_a_remedy() {
    assert_eq!(body::within_limit(u64::from(u32::MAX)).unwrap(), u32::MAX);
    insta::assert_snapshot!(body::within_limit(10 << 30).unwrap_err(), @r"
    the model takes 10.0 GiB, and glTF files end at 4 GiB
      help: write it in parts, with less detail, or with more instances of fewer meshes
    ");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn any_transform_survives_the_file(
        cols in proptest::array::uniform9(-3.0_f64..3.0), at in proptest::array::uniform3(-9000.0_f64..9000.0)
    ) {
        let mut scene = samples::boxes(1);
        scene.instances[0].transform = glam::DAffine3::from_mat3_translation(
            glam::DMat3::from_cols_array(&cols), DVec3::from(at) * 0.5,
        );
        let (meant, drawn) = (scene_triangles(&scene), drawn_triangles(&glb(&scene).unwrap()));
        for (meant, drawn) in meant.iter().zip(&drawn) {
            for (a, b) in meant.iter().zip(drawn) {
                prop_assert!(a.distance(*b) < 1e-3, "{a} {b}");
            }
        }
    }
}
