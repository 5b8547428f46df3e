//! Tests that read files with integers back.

use super::super::samples;
use super::tests::{drawn_triangles, largest_distance, scene_triangles};
use crate::{Export, Files, InstanceStorage, SceneFacts};
use burgeon_picture::Picture;
use burgeon_scene::Scene;
use glam::{DVec3, Vec2};
use gltf::Gltf;
use gltf_json::accessor::ComponentType;
use std::path::Path;

/// Writes a scene with integers to a file and returns its bytes and notes.
fn write_quantized(scene: &Scene, instances: InstanceStorage, path: &Path) -> (Vec<u8>, Vec<String>) {
    let facts = SceneFacts { is_quantized: true, instances, ..SceneFacts::default() };
    let picture = Picture::default();
    let mut files = Files::default();
    files.export(&Export { scene, picture: &picture, facts }, path).unwrap();
    let notes = files.take_notes();
    files.publish().unwrap();
    (std::fs::read(path).unwrap(), notes)
}

/// Returns half a step (m) of the coarsest mesh in the world.
fn bound(scene: &Scene) -> f64 {
    let size = |instance: &burgeon_scene::Instance| {
        let points = scene.meshes[instance.mesh].parts.iter().flat_map(|part| &part.positions);
        let (low, high) = points.fold((DVec3::MAX, DVec3::MIN), |(low, high), at| {
            (low.min(at.as_dvec3()), high.max(at.as_dvec3()))
        });
        let scale = instance.transform.matrix3.to_cols_array_2d().map(|axis| DVec3::from(axis).length());
        (high - low).max_element() * scale.into_iter().fold(0.0, f64::max)
    };
    scene.instances.iter().map(size).fold(0.0, f64::max) * 0.5 / 65_535.0
}

#[test]
fn every_sample_is_drawn_within_half_a_step_with_and_without_shared_nodes() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.glb");
    let mut scenes = samples::all(folder.path());
    scenes.retain(|(_, scene)| scene.triangles() > 0);
    let (mut count, mut rounded) = (0, 0);
    for (name, scene) in &scenes {
        for instances in [InstanceStorage::Nodes, InstanceStorage::Extension] {
            let (bytes, notes) = write_quantized(scene, instances, &path);
            let exact_path = folder.path().join("exact.glb");
            let mut files = Files::default();
            let facts = SceneFacts { instances, ..SceneFacts::default() };
            files.export(&Export { scene, picture: &Picture::default(), facts }, &exact_path).unwrap();
            files.publish().unwrap();
            // Triangles of both files have the same order.
            let exact = drawn_triangles(&std::fs::read(&exact_path).unwrap());
            let drawn = drawn_triangles(&bytes);
            assert_eq!(drawn.len(), scene_triangles(scene).len(), "{name}");
            // An error of half a step on each axis, and single precision of transforms.
            let most = bound(scene) * 3.0_f64.sqrt() * 1.01 + 1e-3;
            let off = largest_distance(&exact, &drawn);
            assert!(off <= most, "{name}: {off} of {most}");
            let is_rounded = notes.iter().any(|note| note.contains("positions are rounded by at most"));
            let is_exact = notes.iter().any(|note| note.contains("positions are exact"));
            assert!(is_rounded != is_exact, "{notes:?}");
            rounded += usize::from(is_rounded);
            // Names of extensions, and the transforms of texture coordinates.
            let names = 250 + 150 * scene.materials.len();
            let plain = std::fs::metadata(&exact_path).unwrap().len() as usize;
            assert!(bytes.len() <= plain + names, "{name}: {} of {plain}", bytes.len());
            let document = Gltf::from_slice_without_validation(&bytes).unwrap();
            let required: Vec<_> = document.extensions_required().collect();
            assert!(required.contains(&"KHR_mesh_quantization"), "{name}: {required:?}");
            count += 1;
        }
    }
    assert!(count == 2 * scenes.len() && count >= 16 && rounded >= 4, "{count} {rounded}");
}

#[test]
fn a_large_mesh_is_off_by_half_a_step_of_its_box_and_the_note_states_it() {
    let folder = tempfile::tempdir().unwrap();
    let mut scene = samples::hill(60);
    let (low, high) = scene.bounds().unwrap();
    let size = (high - low).max_element();
    scene.meshes[0].parts[0].positions.iter_mut().for_each(|at| *at *= 1000.0 / size as f32);
    let (bytes, notes) = write_quantized(&scene, InstanceStorage::Nodes, &folder.path().join("hill.glb"));
    let off = largest_distance(&scene_triangles(&scene), &drawn_triangles(&bytes));
    // 1,000 m in 65,535 steps.
    assert!(off > 0.004 && off <= 0.007_63 * 3.0_f64.sqrt(), "{off}");
    assert_eq!(notes, ["hill.glb: positions are rounded by at most 7.7 mm"]);
    let document = Gltf::from_slice_without_validation(&bytes).unwrap();
    let primitive = document.meshes().next().unwrap().primitives().next().unwrap();
    let normals = primitive.get(&gltf::Semantic::Normals).unwrap();
    assert!(normals.data_type() == ComponentType::I8 && normals.normalized());
}

#[test]
fn repeated_textures_have_short_coordinates_and_a_transform_that_restores_them() {
    let folder = tempfile::tempdir().unwrap();
    let mut scene = samples::textured_boxes(folder.path());
    for mesh in &mut scene.meshes {
        mesh.parts[0].uvs.iter_mut().for_each(|uv| *uv = *uv * 7.0 - Vec2::ONE);
    }
    let exact = super::glb(&scene).unwrap();
    let (bytes, _) = write_quantized(&scene, InstanceStorage::Nodes, &folder.path().join("a.glb"));
    let read = |bytes: &[u8]| -> Vec<(Vec<[f32; 2]>, ComponentType)> {
        let file = Gltf::from_slice_without_validation(bytes).unwrap();
        let blob = file.blob.clone().unwrap();
        let primitives = file.meshes().flat_map(|mesh| mesh.primitives().collect::<Vec<_>>());
        let textured = primitives.filter_map(|primitive| {
            let found: Vec<_> = primitive.reader(|_| Some(&blob)).read_tex_coords(0)?.into_f32().collect();
            let texture = primitive.material().pbr_metallic_roughness().base_color_texture()?;
            let document = file.as_json();
            let material = &document.materials[primitive.material().index()?];
            let info = material.pbr_metallic_roughness.base_color_texture.as_ref()?;
            let transform = info.extensions.as_ref().and_then(|it| it.others.get("KHR_texture_transform"));
            let number = |key: &str, axis: usize, default: f32| {
                transform.map_or(default, |it| it[key][axis].as_f64().unwrap() as f32)
            };
            let restored = found.iter().map(|uv| {
                [0, 1].map(|axis| number("offset", axis, 0.0) + number("scale", axis, 1.0) * uv[axis])
            });
            assert_eq!(texture.tex_coord(), 0);
            let kind = primitive.get(&gltf::Semantic::TexCoords(0))?.data_type();
            Some((restored.collect(), kind))
        });
        textured.collect()
    };
    let (meant, found) = (read(&exact), read(&bytes));
    assert!(!meant.is_empty() && meant.len() == found.len());
    for ((meant, float), (found, short)) in meant.iter().zip(&found) {
        assert_eq!((*float, *short), (ComponentType::F32, ComponentType::U16));
        // The largest range is 14 images.
        let near = |(a, b): (&[f32; 2], &[f32; 2])| (a[0] - b[0]).abs().max((a[1] - b[1]).abs()) < 2e-4;
        assert!(meant.len() == found.len() && meant.iter().zip(found).all(near), "{meant:?} {found:?}");
    }
    // Too many repetitions stay exact.
    scene.meshes[0].parts[0].uvs[0] *= 1000.0;
    let (bytes, _) = write_quantized(&scene, InstanceStorage::Nodes, &folder.path().join("b.glb"));
    assert_eq!(read(&bytes)[0].1, ComponentType::F32);
}

#[test]
fn integers_take_at_most_six_tenths_of_the_bytes_and_compress_further() {
    let folder = tempfile::tempdir().unwrap();
    let scene = samples::hill(120);
    let size = |is_quantized: bool, is_compressed: bool| {
        let path = folder.path().join("a.glb");
        let facts = SceneFacts { is_quantized, is_compressed, ..SceneFacts::default() };
        let mut files = Files::default();
        files.export(&Export { scene: &scene, picture: &Picture::default(), facts }, &path).unwrap();
        files.publish().unwrap();
        std::fs::metadata(&path).unwrap().len()
    };
    let (plain, small) = (size(false, false), size(true, false));
    assert!(small * 10 < plain * 7, "{small} of {plain}");
    assert!(size(true, true) * 2 < small && size(true, true) < size(false, true));
}

#[test]
fn arrays_of_instances_are_compressed_and_a_view_that_would_grow_is_not() {
    let folder = tempfile::tempdir().unwrap();
    let size = |scene: &Scene, is_compressed: bool| {
        let path = folder.path().join("a.glb");
        let instances = InstanceStorage::Extension;
        let facts = SceneFacts { is_compressed, instances, ..SceneFacts::default() };
        let mut files = Files::default();
        files.export(&Export { scene, picture: &Picture::default(), facts }, &path).unwrap();
        files.publish().unwrap();
        let bytes = std::fs::read(&path).unwrap();
        let is_used = bytes.windows(23).any(|text| text == b"EXT_meshopt_compression");
        (bytes.len(), is_used)
    };
    let mut scene = samples::hill(1);
    assert!(size(&scene, true).0 <= size(&scene, false).0 && !size(&scene, true).1);
    let instance = scene.instances[0].clone();
    for number in 1..2000_u32 {
        let mut copy = instance.clone();
        copy.transform.translation += DVec3::new(f64::from(number % 50), f64::from(number / 50), 0.0);
        scene.instances.push(copy);
    }
    let ((plain, _), (packed, is_used)) = (size(&scene, false), size(&scene, true));
    assert!(is_used && packed * 2 < plain, "{packed} of {plain}");
}
