//! Document of a tile.

use std::path::Path;

use burgeon_base::error::Result;
use burgeon_scene::Scene;
use glam::{DAffine3, DVec3};

use super::super::body::Body;
use super::super::description::{Description, MeshDescription, Node, Primitive, use_extension};
use super::super::document::{Document, QUANTIZATION};
use super::super::material::{self, Textures};
use super::super::metadata::{MESH_FEATURES, Metadata};
use super::super::packing::MESHOPT;
use super::super::place::{add_group, reach};
use super::super::quantize::TexCoordRanges;
use super::arrays::add_primitive;
use super::merge::{MergedMesh, merge};
use super::options::{TileCompression, TileModelOptions};
use super::repeated::divide_repeated;
use super::vertex::{PlaceFormat, VertexFormat};
use crate::SceneFacts;
use crate::check::{SceneCheck, check};
use crate::files::Files;
use crate::texture::Images;

/// Counts of the model of a tile.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct TileModelCounts {
    /// Number of triangles, counted for each instance.
    pub triangles: usize,
    /// Number of primitives, each of which a viewer draws with one call.
    pub primitives: usize,
    /// Number of instances that are not copied into the mesh.
    pub instances: usize,
}

/// Writes the model of a tile to the future `.glb` file `path`: one mesh with a primitive for each material, and one for each
/// material of models that repeat often.
///
/// Fails as [`Files::export`] does.
pub fn write_tile_model(
    scene: &Scene,
    facts: &SceneFacts<'_>,
    options: &TileModelOptions,
    path: &Path,
    files: &mut Files,
) -> Result<TileModelCounts> {
    let checked = check(scene)?;
    let images = Images::load_all(&checked)?;
    let stop = files.stop();
    stop.check()?;
    let mut counts = TileModelCounts::default();
    let (description, body) = describe(&checked, facts, &images, options, &mut counts)?;
    let document = Document::of_parts(description, body)?;
    document.write(path, files, &stop)?;
    Ok(counts)
}

/// Describes the model of a tile and counts its parts.
fn describe<'a>(
    checked: &SceneCheck<'a>,
    facts: &SceneFacts<'a>,
    images: &'a Images,
    options: &TileModelOptions,
    counts: &mut TileModelCounts,
) -> Result<(Description<'a>, Body<'a>)> {
    let mut description = Description::default();
    description.root.asset = Document::asset(&checked.scene.packages, facts);
    let mut body = Body::default();
    let metadata = Metadata::of(checked.scene, facts);
    if let Some(metadata) = &metadata {
        description.extensions = Some(metadata.write(&mut body));
        metadata.use_tables(&mut description.root);
    }
    let metadata = metadata.as_ref();
    let ranges = TexCoordRanges::default();
    let materials =
        material::write(checked, images, &Textures::Embedded, &ranges, &mut description.root, &mut body);
    let (repeated, others) = divide_repeated(checked, metadata, options.expand_instances);
    let (low, high) = checked.scene.bounds().unwrap_or_default();
    let (low, high) = (low - checked.origin, high - checked.origin);
    let format =
        VertexFormat::of(options, DVec3::new(low.x, low.z, -high.y), DVec3::new(high.x, high.z, -low.y));
    let merged = merge(checked, metadata, format, others.into_iter());
    let mut nodes = Vec::new();
    let add = |merged: MergedMesh<'_>, description: &mut Description<'a>, body: &mut Body<'a>| {
        let mut primitives = Vec::with_capacity(merged.parts.len());
        for (key, part) in merged.parts {
            let rows = key.table.zip(metadata).map_or(0, |(table, metadata)| metadata.rows(table));
            let primitive = add_primitive((key, &part), rows, &merged.format, description, body);
            if key.table.is_some() {
                use_extension(&mut description.root, MESH_FEATURES);
            }
            primitives.push(Primitive { material: materials[key.material], ..primitive });
        }
        primitives
    };
    let triangles =
        |merged: &MergedMesh<'_>| merged.parts.values().map(|part| part.triangles.len()).sum::<usize>();
    counts.triangles = triangles(&merged);
    if !merged.parts.is_empty() {
        let primitives = add(merged, &mut description, &mut body);
        counts.primitives = primitives.len();
        description.meshes.push(MeshDescription { name: "", primitives });
        let mut node = Node { mesh: Some(0), ..Node::default() };
        if let PlaceFormat::Short { origin, step } = format.places {
            (node.translation, node.scale) = (Some(origin.as_vec3().to_array()), Some([step as f32; 3]));
        }
        nodes.push(description.node(node));
    }
    for model in repeated {
        let mesh = model.kind.mesh();
        // Integers would need a transform of their own, between that of an instance and that of its mesh.
        let single = VertexFormat { places: PlaceFormat::Exact, ..format };
        let mut merged = MergedMesh::new(checked.scene, single);
        merged.add(mesh, &DAffine3::IDENTITY, None, 0);
        merged.remove_empty();
        if merged.parts.is_empty() {
            continue;
        }
        counts.triangles += triangles(&merged) * model.count;
        counts.instances += model.count;
        let primitives = add(merged, &mut description, &mut body);
        counts.primitives += primitives.len();
        description.meshes.push(MeshDescription { name: "", primitives });
        let shown = (description.meshes.len() - 1, reach(checked, mesh));
        let table = model.kind.table();
        nodes.push(add_group(model.kind, model.group, table, shown, &mut description, &mut body));
    }
    if options.compression != TileCompression::None {
        use_extension(&mut description.root, QUANTIZATION);
        description.root.extensions_required.push(QUANTIZATION.into());
    }
    if options.compression == TileCompression::Meshopt {
        body.compress()?;
        use_extension(&mut description.root, MESHOPT);
        description.root.extensions_required.push(MESHOPT.into());
    }
    if checked.origin != DVec3::ZERO && !nodes.is_empty() {
        let DVec3 { x, y, z } = checked.origin;
        let translation = Some(DVec3::new(x, z, -y).as_vec3().to_array());
        nodes = vec![description.node(Node { translation, children: Some(nodes), ..Node::default() })];
    }
    let nodes = nodes.into_iter().map(|node| gltf_json::Index::new(node as u32)).collect();
    description.root.scenes.push(gltf_json::Scene { extensions: None, extras: None, name: None, nodes });
    Ok((description, body))
}
