//! The reader for glTF files.

use std::borrow::Cow;
use std::path::Path;
use std::sync::Arc;

use super::bytes::{Bytes, NumberColumns};
use super::look::ImportMaterial;
use super::options::{ImportOptions, OBJECT, broken_file};
use super::shape::TintedPart;
use super::{instances, look, shape};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_kit::{Kind, LoadRequest, LoadedObject, Loader, Model, Table};
use burgeon_scene::{Instance, Mesh, Part, Scene};
use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3};
use gltf_json::{Index, Root, scene::Node};

/// Maximum nesting depth of nodes. `MOST_NODES` is their maximum number.
const DEEPEST: usize = 64;

const MOST_NODES: usize = 100_000;

/// Reads the scene of a glTF file, in metres, z up.
///
/// Reads positions, normals, texture coordinates, vertex colours and instances of a node. For materials, reads base
/// colour and its texture, the normal map, metalness, roughness and emission. Missing normals are the normals of flat
/// faces; missing texture coordinates are metres along the faces. Fails if the file is damaged, requires an unsupported
/// extension, or has too many triangles.
pub(super) fn read(content: &[u8], wanted: &mut ImportOptions<'_>) -> Result<Scene> {
    let name = wanted.name;
    let (json, own) = container(content).map_err(|why| broken_file(name, why))?;
    wanted.budget.check()?;
    // A description may contain many tiny objects, which take much more memory after parsing.
    let objects = json.iter().filter(|byte| **byte == b'{').count();
    wanted.budget.take(objects.saturating_mul(OBJECT).saturating_add(json.len()))?;
    let root =
        Root::from_slice(json).map_err(|error| broken_file(name, format!("its JSON is wrong: {error}")))?;
    check_extensions(&root, name)?;
    let bytes = Bytes::load(&root, own, wanted)?;
    let materials = look::materials(&root, &bytes, wanted)?;
    let mut model = Import {
        root: &root,
        columns: NumberColumns::new(&root, &bytes, wanted.budget),
        name,
        scene: Scene::default(),
        meshes: vec![None; root.meshes.len()],
        materials,
        nodes: 0,
        left: wanted.triangles,
        limit: wanted.triangles,
    };
    let start = match root.scene.and_then(|index| root.get(index)).or_else(|| root.scenes.first()) {
        Some(scene) => Cow::Borrowed(scene.nodes.as_slice()),
        None => roots(&root).into(),
    };
    model.nodes(&start, DAffine3::IDENTITY, 0)?;
    if model.scene.instances.is_empty() {
        return Err(Error::data(format!("the model {name} has no triangles"))
            .help("export it with its meshes; lines, points and other scenes are not supported"));
    }
    Ok(model.scene)
}

/// Returns the error for a damaged file, or for an exceeded limit.
fn damaged_file(name: &str, budget: &Budget, error: &Error) -> Error {
    // The cause may be an exceeded time or memory limit, and not the file.
    budget.check().err().unwrap_or_else(|| broken_file(name, error.message()))
}

/// Returns the JSON of a file, and the binary chunk of a `.glb` file.
fn container(content: &[u8]) -> Result<(&[u8], Option<&[u8]>), String> {
    if !content.starts_with(b"glTF") {
        let text = content.iter().find(|byte| !byte.is_ascii_whitespace());
        return if text == Some(&b'{') { Ok((content, None)) } else { Err("it is not a glTF file".into()) };
    }
    let word = |at: usize| {
        let bytes = content.get(at..at + 4).and_then(|bytes| <[u8; 4]>::try_from(bytes).ok());
        bytes.map(u32::from_le_bytes).ok_or("it ends too early")
    };
    if word(4)? != 2 {
        return Err(format!("it is glTF {}, not glTF 2", word(4)?));
    }
    let whole = content.get(..word(8)? as usize).ok_or("it ends too early")?;
    let (mut json, mut own, mut at) = (None, None, 12);
    while at + 8 <= whole.len() {
        let chunk = whole.get(at + 8..).and_then(|rest| rest.get(..word(at).ok()? as usize));
        let chunk = chunk.ok_or("it ends too early")?;
        match &whole[at + 4..at + 8] {
            b"JSON" if json.is_none() => json = Some(chunk),
            b"BIN\0" if own.is_none() => own = Some(chunk),
            _ => {}
        }
        // Chunks are padded to multiples of 4 bytes, but some programs omit the padding.
        let [bare, filled] = [chunk.len(), chunk.len().next_multiple_of(4)].map(|length| at + 8 + length);
        let is_chunk = |at: usize| matches!(whole.get(at + 4..at + 8), Some(b"JSON" | b"BIN\0"));
        at = if is_chunk(bare) && !is_chunk(filled) { bare } else { filled };
    }
    Ok((json.ok_or("it has no JSON description")?, own))
}

fn check_extensions(root: &Root, name: &str) -> Result<()> {
    let known = |needed: &str| needed.starts_with("KHR_materials_") || needed == instances::EXTENSION;
    let unknown = root.extensions_required.iter().find(|needed| !known(needed));
    let Some(needed) = unknown else { return Ok(()) };
    Err(Error::data(format!("the model {name} needs the extension {needed}, which is not supported"))
        .help("export it without compression of meshes and textures, and without required extensions"))
}

/// Returns the nodes without parents.
fn roots(root: &Root) -> Vec<Index<Node>> {
    let mut own = vec![true; root.nodes.len()];
    for child in root.nodes.iter().flat_map(|node| node.children.iter().flatten()) {
        if let Some(own) = own.get_mut(child.value()) {
            *own = false;
        }
    }
    (0u32..).zip(own).filter(|(_, own)| *own).map(|(index, _)| Index::new(index)).collect()
}

struct Import<'a> {
    root: &'a Root,
    columns: NumberColumns<'a>,
    name: &'a str,
    scene: Scene,
    /// Mesh of the scene for each mesh of the file, once it is read; `None` inside if it has no triangles.
    meshes: Vec<Option<Option<usize>>>,
    materials: Vec<ImportMaterial>,
    nodes: usize,
    left: usize,
    limit: usize,
}

impl Import<'_> {
    fn nodes(&mut self, nodes: &[Index<Node>], above: DAffine3, depth: usize) -> Result<()> {
        if depth > DEEPEST {
            return Err(broken_file(self.name, format!("its nodes are nested more than {DEEPEST} deep")));
        }
        for index in nodes {
            self.nodes += 1;
            if self.nodes > MOST_NODES {
                return Err(broken_file(self.name, format!("it has more than {MOST_NODES} nodes")));
            }
            let Some(node) = self.root.get(*index) else {
                return Err(broken_file(self.name, format!("missing node {}", index.value())));
            };
            let here = above * transform(node);
            if !here.is_finite() {
                return Err(broken_file(
                    self.name,
                    format!("the transform of node {} is not finite", index.value()),
                ));
            }
            if let Some(mesh) = node.mesh {
                let name = node.name.as_deref().unwrap_or_default();
                let places = instances::places(&mut self.columns, node)
                    .map_err(|error| damaged_file(self.name, self.columns.budget, &error))?;
                match places {
                    None => self.instance(mesh, here, name)?,
                    Some(places) => {
                        for place in places {
                            self.instance(mesh, here * place, name)?;
                        }
                    }
                }
            }
            self.nodes(node.children.as_deref().unwrap_or_default(), here, depth + 1)?;
        }
        Ok(())
    }

    fn instance(&mut self, index: Index<gltf_json::Mesh>, place: DAffine3, name: &str) -> Result<()> {
        self.columns.budget.tick()?;
        if !place.is_finite() {
            return Err(broken_file(self.name, "the transform of an instance is not finite"));
        }
        let known = self.meshes.get(index.value()).copied();
        let mesh = match known {
            Some(Some(mesh)) => mesh,
            Some(None) => {
                let mesh = self.mesh(index)?;
                self.meshes[index.value()] = Some(mesh);
                mesh
            }
            None => return Err(broken_file(self.name, format!("missing mesh {}", index.value()))),
        };
        let Some(mesh) = mesh else { return Ok(()) };
        let triangles = self.scene.meshes[mesh].triangles();
        self.left = self.left.checked_sub(triangles).ok_or_else(|| self.too_many())?;
        self.columns.budget.take(OBJECT + name.len())?;
        self.scene.instances.push(Instance {
            mesh,
            transform: to_z_up(place),
            name: name.to_owned(),
            feature: None,
            origin: None,
            placement: None,
            meaning: None,
        });
        Ok(())
    }

    fn too_many(&self) -> Error {
        Error::limit(
            Limit::Triangles,
            format!("the model {} has more than {} triangles", self.name, self.limit),
        )
        .help("simplify it, or raise the limit: --triangle-limit N")
    }

    /// Returns the mesh of the scene for a mesh of the file, or `None` if it has no triangles.
    fn mesh(&mut self, index: Index<gltf_json::Mesh>) -> Result<Option<usize>> {
        let Some(described) = self.root.get(index) else { return Ok(None) };
        let name = described.name.clone().unwrap_or_default();
        let mut mesh = Mesh { name, ..Mesh::default() };
        // Pieces of each part. The file has separate primitives of the same material, which become one part.
        let mut pieces: Vec<Vec<Part>> = Vec::new();
        let mut triangles = 0;
        for primitive in &described.primitives {
            self.columns.budget.check()?;
            let look =
                match primitive.material {
                    Some(index) => self.materials.get(index.value()).cloned().ok_or_else(|| {
                        broken_file(self.name, format!("missing material {}", index.value()))
                    })?,
                    None => look::plain(),
                };
            let shapes = shape::shapes(&mut self.columns, primitive, look.set).map_err(|error| {
                let noted = error.noting(&format!("mesh {}", index.value()));
                damaged_file(self.name, self.columns.budget, &noted)
            })?;
            for TintedPart { tint, part } in shapes {
                let material = self.scene.material(&look.tinted(tint));
                triangles += part.triangles.len();
                match mesh.parts.iter().position(|part| part.material == material) {
                    Some(place) => pieces[place].push(part),
                    None => {
                        mesh.part(material);
                        pieces.push(vec![part]);
                    }
                }
            }
            if triangles > self.left {
                return Err(self.too_many());
            }
        }
        for (whole, pieces) in mesh.parts.iter_mut().zip(pieces) {
            shape::join(whole, pieces, self.columns.budget)
                .map_err(|error| damaged_file(self.name, self.columns.budget, &error))?;
        }
        if mesh.parts.is_empty() {
            return Ok(None);
        }
        self.scene.meshes.push(mesh);
        Ok(Some(self.scene.meshes.len() - 1))
    }
}

/// Returns the transform of a node relative to its parent.
fn transform(node: &Node) -> DAffine3 {
    if let Some(matrix) = node.matrix {
        return DAffine3::from_mat4(DMat4::from_cols_array(&matrix.map(f64::from)));
    }
    let vector = |values: Option<[f32; 3]>, other: DVec3| {
        values.map_or(other, |values| DVec3::from(values.map(f64::from)))
    };
    let rotation = node.rotation.map_or(DQuat::IDENTITY, |turn| {
        let turn = DQuat::from_array(turn.0.map(f64::from));
        if turn.length_squared() > 0.0 { turn.normalize() } else { DQuat::IDENTITY }
    });
    DAffine3::from_scale_rotation_translation(
        vector(node.scale, DVec3::ONE),
        rotation,
        vector(node.translation, DVec3::ZERO),
    )
}

/// Converts a transform from y-up to z-up coordinates.
fn to_z_up(place: DAffine3) -> DAffine3 {
    let turn = DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y);
    DAffine3 { matrix3: turn * place.matrix3 * turn.transpose(), translation: turn * place.translation }
}

/// Creates the model type with the loader for glTF files.
pub(crate) fn kind() -> Kind {
    let loader = Loader {
        what: "model",
        example: "model(\"window.glb\")",
        example_with_fields: "model(\"window.glb\")",
        several: &[],
        load,
    };
    Kind::clone(Model::kind()).loaded(Vec::new(), loader)
}

fn load(file: &mut LoadRequest<'_>, _: &Table) -> Result<LoadedObject> {
    let remedy = "specify a .glb or .gltf file";
    let content = file.read(remedy)?;
    // External files are relative to the folder of the file.
    let folder = Path::new(file.name).parent().map(Path::to_path_buf).unwrap_or_default();
    let mut beside = |uri: &str| {
        let name = folder.join(uri).display().to_string();
        file.read_beside("model file", &name, remedy)
    };
    let mut wanted = ImportOptions {
        name: file.name,
        triangles: file.triangles,
        budget: file.budget,
        beside: &mut beside,
    };
    let model = Model::new(read(&content, &mut wanted)?);
    Ok(LoadedObject { memory: model.memory(), object: Arc::new(model), warnings: Vec::new() })
}
