//! Tests that read the second set of texture coordinates back.

use super::super::samples;
use crate::{Export, Files, SceneFacts};
use burgeon_picture::Picture;
use burgeon_scene::Scene;
use gltf::{Gltf, Semantic};
use gltf_json::accessor::ComponentType;

/// Dirt map of a material: the restored coordinates of each vertex with their positions, y up, and the type of the coordinates.
struct ReadDirt {
    vertices: Vec<([f32; 3], [f32; 2])>,
    kind: ComponentType,
}

fn write(scene: &Scene, facts: SceneFacts<'_>) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.glb");
    let mut files = Files::default();
    files.export(&Export { scene, picture: &Picture::default(), facts }, &path).unwrap();
    files.publish().unwrap();
    std::fs::read(path).unwrap()
}

/// Returns the dirt maps of all primitives of a file.
fn read(bytes: &[u8]) -> Vec<ReadDirt> {
    let file = Gltf::from_slice_without_validation(bytes).unwrap();
    let blob = file.blob.clone().unwrap();
    let primitives = file.meshes().flat_map(|mesh| mesh.primitives().collect::<Vec<_>>());
    let stained = primitives.filter_map(|primitive| {
        let dirt = primitive.material().occlusion_texture()?;
        assert_eq!((dirt.tex_coord(), dirt.strength()), (1, 1.0));
        let reader = primitive.reader(|_| Some(&blob));
        let found: Vec<[f32; 2]> = reader.read_tex_coords(1)?.into_f32().collect();
        let json = &file.as_json().materials[primitive.material().index()?];
        let info = json.occlusion_texture.as_ref()?;
        let transform = info.extensions.as_ref().and_then(|it| it.others.get("KHR_texture_transform"));
        let number = |key: &str, axis: usize, default: f32| {
            transform.map_or(default, |it| it[key][axis].as_f64().unwrap() as f32)
        };
        let restored = found
            .iter()
            .map(|uv| [0, 1].map(|axis| number("offset", axis, 0.0) + number("scale", axis, 1.0) * uv[axis]));
        // Positions are read as they are, in steps if they are integers.
        let positions = primitive.get(&Semantic::Positions)?;
        let places: Vec<[f32; 3]> = match positions.data_type() {
            ComponentType::F32 => reader.read_positions()?.collect(),
            _ => vec![[0.0; 3]; found.len()],
        };
        assert!(primitive.get(&Semantic::TexCoords(0)).is_some(), "sets are numbered from 0 without gaps");
        let kind = primitive.get(&Semantic::TexCoords(1))?.data_type();
        Some(ReadDirt { vertices: places.into_iter().zip(restored).collect(), kind })
    });
    stained.collect()
}

/// Returns the coordinates that the scene means for each vertex of a mesh, in images.
fn meant(scene: &Scene, mesh: usize) -> Vec<[f32; 2]> {
    let part = &scene.meshes[mesh].parts[0];
    let uvs = (0..part.positions.len()).map(|vertex| part.second_uv(vertex));
    uvs.map(|uv| [uv.x / 4.0, 1.0 - uv.y / 2.0]).collect()
}

#[test]
fn a_dirt_map_has_the_second_set_of_coordinates_also_as_integers() {
    let folder = tempfile::tempdir().unwrap();
    let scene = samples::stained_boxes(folder.path());
    for is_quantized in [false, true] {
        let bytes = write(&scene, SceneFacts { is_quantized, ..SceneFacts::default() });
        let dirt = read(&bytes);
        assert_eq!(dirt.len(), 2);
        for (mesh, dirt) in dirt.iter().enumerate() {
            let kind = if is_quantized { ComponentType::U16 } else { ComponentType::F32 };
            assert_eq!(dirt.kind, kind);
            let meant = meant(&scene, mesh);
            assert_eq!(meant.len(), dirt.vertices.len());
            for ((_, found), meant) in dirt.vertices.iter().zip(&meant) {
                let off = (found[0] - meant[0]).abs().max((found[1] - meant[1]).abs());
                assert!(off < 2e-4, "{found:?} {meant:?}");
            }
        }
    }
}

#[test]
fn a_scene_without_dirt_maps_has_neither_a_second_set_nor_occlusion() {
    let folder = tempfile::tempdir().unwrap();
    let bytes = write(&samples::textured_boxes(folder.path()), SceneFacts::default());
    assert!(!bytes.windows(10).any(|text| text == b"TEXCOORD_1" || text == b"occlusionT"));
    assert!(
        write(&samples::stained_boxes(folder.path()), SceneFacts::default())
            .windows(10)
            .any(|text| text == b"TEXCOORD_1")
    );
}

#[test]
fn compressed_files_and_models_for_the_page_have_the_second_set() {
    let folder = tempfile::tempdir().unwrap();
    let scene = samples::stained_boxes(folder.path());
    let packed =
        write(&scene, SceneFacts { is_quantized: true, is_compressed: true, ..SceneFacts::default() });
    let (page, _) = super::glb_for_viewer(&scene).unwrap();
    for bytes in [packed, page] {
        let file = Gltf::from_slice_without_validation(&bytes).unwrap();
        let primitives = file.meshes().flat_map(|mesh| mesh.primitives().collect::<Vec<_>>());
        let sets = primitives.map(|primitive| primitive.get(&Semantic::TexCoords(1)).is_some());
        assert_eq!(sets.collect::<Vec<_>>(), [true, true, false]);
        let dirt = file.materials().filter(|material| material.occlusion_texture().is_some());
        assert_eq!(dirt.count(), 2);
    }
}

#[test]
fn repeated_instances_that_are_merged_keep_the_second_set() {
    let folder = tempfile::tempdir().unwrap();
    let mut scene = samples::stained_boxes(folder.path());
    let copy = scene.instances[0].clone();
    scene.instances.push(copy);
    let expanded = super::expand::expand(&scene).unwrap();
    let stained = expanded.meshes.iter().flat_map(|mesh| &mesh.parts).filter(|part| part.material == 0);
    let merged = stained.max_by_key(|part| part.positions.len()).unwrap();
    let own = &scene.meshes[0].parts[0].second_uvs;
    assert_eq!(merged.second_uvs, [own.as_slice(), own.as_slice()].concat());
}
