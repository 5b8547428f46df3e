//! Description of a document as JSON.
//!
//! A city has hundreds of thousands of accessors and primitives. They are plain structs here, because gltf-json's types
//! have fields for the whole specification, which take longer to fill, write and free than the geometry.

use std::borrow::Cow;

use burgeon_base::error::{Error, Result};
use gltf_json as json;
use json::accessor::{ComponentType, Type};
use json::scene::UnitQuaternion;
use rayon::prelude::*;
use serde::Serialize;
use std::io::{self, Write};

/// Number of list items that are serialised at a time.
const CHUNK: usize = 4096;

/// Description of a document; names are borrowed from the scene (`'a`).
#[derive(Default)]
pub(super) struct Description<'a> {
    /// Parts of the document with few items; accessors, meshes and nodes are stored below.
    pub(super) root: json::Root,
    /// Extensions of the document.
    pub(super) extensions: Option<serde_json::Value>,
    pub(super) animations: Vec<serde_json::Value>,
    pub(super) cameras: Vec<serde_json::Value>,
    pub(super) accessors: Vec<Accessor>,
    pub(super) meshes: Vec<MeshDescription<'a>>,
    pub(super) nodes: Vec<Node<'a>>,
}

/// Accessor: location and type of an array.
#[derive(Clone, Copy, Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    pub(super) buffer_view: u32,
    #[serde(skip_serializing_if = "is_zero")]
    pub(super) byte_offset: u64,
    pub(super) count: usize,
    pub(super) component_type: ComponentType,
    /// Set if integers represent numbers from -1 to 1.
    #[serde(skip_serializing_if = "is_false")]
    pub(super) normalized: bool,
    #[serde(rename = "type")]
    pub(super) kind: Type,
    /// Corners of the bounding box of points, or the first and the last of times.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) min: Option<Extreme>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) max: Option<Extreme>,
}

/// Smallest or largest item of an array, for each component.
#[derive(Clone, Copy, Serialize)]
#[serde(untagged)]
pub(super) enum Extreme {
    Point([f32; 3]),
    Number([f32; 1]),
    /// Point with integer coordinates.
    Whole([u32; 3]),
}

#[derive(Serialize)]
pub(super) struct MeshDescription<'a> {
    #[serde(skip_serializing_if = "str::is_empty")]
    pub(super) name: &'a str,
    pub(super) primitives: Vec<Primitive>,
}

/// Triangles of one material, as indices of accessors.
#[derive(Clone, Serialize)]
pub(super) struct Primitive {
    pub(super) attributes: Attributes,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) extensions: Option<serde_json::Value>,
    #[serde(rename = "extras", skip_serializing_if = "Option::is_none")]
    pub(super) shading: Option<ShadingExtras>,
    pub(super) indices: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) material: Option<json::Index<json::Material>>,
}

/// Hints on a primitive for Burgeon's viewer.
#[derive(Clone, Copy, Serialize)]
pub(super) struct ShadingExtras {
    /// Set if each triangle has the normal of its last corner.
    pub(super) flat: bool,
}

/// Accessors of vertex attributes.
#[derive(Clone, Copy, Serialize)]
pub(super) struct Attributes {
    #[serde(rename = "POSITION")]
    pub(super) positions: usize,
    /// Normals; faces without normals are flat.
    #[serde(rename = "NORMAL", skip_serializing_if = "Option::is_none")]
    pub(super) normals: Option<usize>,
    #[serde(rename = "TEXCOORD_0", skip_serializing_if = "Option::is_none")]
    pub(super) tex_coords: Option<usize>,
    #[serde(rename = "TEXCOORD_1", skip_serializing_if = "Option::is_none")]
    pub(super) second_tex_coords: Option<usize>,
    /// Feature numbers of vertices.
    #[serde(rename = "_FEATURE_ID_0", skip_serializing_if = "Option::is_none")]
    pub(super) features: Option<usize>,
}

#[derive(Default, Serialize)]
pub(super) struct Node<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) camera: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) children: Option<Vec<usize>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) extensions: Option<serde_json::Value>,
    /// Id of the feature. It is stored in the extras, because viewers change names that repeat or contain unusual
    /// characters.
    #[serde(rename = "extras", skip_serializing_if = "Option::is_none")]
    pub(super) feature: Option<FeatureExtras<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) mesh: Option<usize>,
    #[serde(skip_serializing_if = "str::is_empty")]
    pub(super) name: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) rotation: Option<UnitQuaternion>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) scale: Option<[f32; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) translation: Option<[f32; 3]>,
}

/// Id of the feature that a node shows.
#[derive(Clone, Copy, Serialize)]
pub(super) struct FeatureExtras<'a> {
    pub(super) feature: &'a str,
}

/// Complete document, in gltf-json's order.
#[derive(Serialize)]
struct WholeDocument<'a> {
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    accessors: &'a [Accessor],
    #[serde(flatten)]
    before: DocumentHead<'a>,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    meshes: &'a [MeshDescription<'a>],
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    nodes: &'a [Node<'a>],
    #[serde(flatten)]
    after: DocumentTail<'a>,
}

/// Fields between the accessors and the meshes.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct DocumentHead<'a> {
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    animations: &'a [serde_json::Value],
    asset: &'a json::Asset,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    buffers: &'a [json::Buffer],
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    buffer_views: &'a [json::buffer::View],
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    cameras: &'a [serde_json::Value],
    scene: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    extensions: Option<&'a serde_json::Value>,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    extensions_used: &'a [String],
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    extensions_required: &'a [String],
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    images: &'a [json::Image],
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    materials: &'a [json::Material],
}

/// Fields after the nodes.
#[derive(Serialize)]
struct DocumentTail<'a> {
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    samplers: &'a [json::texture::Sampler],
    scenes: &'a [json::Scene],
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    textures: &'a [json::Texture],
}

impl<'a> Description<'a> {
    /// Adds an accessor and returns its index.
    pub(super) fn accessor(&mut self, accessor: Accessor) -> usize {
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Adds a node and returns its index.
    pub(super) fn node(&mut self, node: Node<'a>) -> usize {
        self.nodes.push(node);
        self.nodes.len() - 1
    }

    fn whole(&self) -> WholeDocument<'_> {
        let root = &self.root;
        WholeDocument {
            accessors: &self.accessors,
            before: DocumentHead {
                animations: &self.animations,
                asset: &root.asset,
                buffers: &root.buffers,
                buffer_views: &root.buffer_views,
                cameras: &self.cameras,
                scene: 0,
                extensions: self.extensions.as_ref(),
                extensions_used: &root.extensions_used,
                extensions_required: &root.extensions_required,
                images: &root.images,
                materials: &root.materials,
            },
            meshes: &self.meshes,
            nodes: &self.nodes,
            after: DocumentTail { samplers: &root.samplers, scenes: &root.scenes, textures: &root.textures },
        }
    }

    /// Writes the document as indented JSON.
    pub(super) fn write_pretty(&self, out: &mut impl Write) -> io::Result<()> {
        serde_json::to_writer_pretty(out, &self.whole()).map_err(io::Error::from)
    }

    /// Returns the document as compact JSON, in consecutive pieces.
    pub(super) fn text(&self) -> Result<Vec<Cow<'static, [u8]>>> {
        let WholeDocument { accessors, before, meshes, nodes, after } = self.whole();
        let written = || -> serde_json::Result<Vec<Cow<'static, [u8]>>> {
            let mut text: Vec<Cow<[u8]>> = vec![Cow::Borrowed(b"{")];
            text.extend(list("accessors", accessors)?);
            text.push(Cow::Owned(fields(&before)?));
            text.push(Cow::Borrowed(b","));
            text.extend(list("meshes", meshes)?);
            text.extend(list("nodes", nodes)?);
            text.push(Cow::Owned(fields(&after)?));
            text.push(Cow::Borrowed(b"}"));
            Ok(text)
        };
        written().map_err(|error| Error::internal(format!("cannot write glTF: {error}")))
    }
}

/// Serialises a named list followed by a comma, unless the list is empty. Chunks are serialised in parallel.
fn list<T: Serialize + Sync>(name: &str, items: &[T]) -> serde_json::Result<Vec<Cow<'static, [u8]>>> {
    if items.is_empty() {
        return Ok(Vec::new());
    }
    let mut text: Vec<Cow<[u8]>> = vec![Cow::Owned(format!("\"{name}\":").into_bytes())];
    let chunks = items.par_chunks(CHUNK).enumerate().map(|(number, chunk)| {
        let mut text = serde_json::to_vec(chunk)?;
        // Between two chunks, a comma replaces the end of one list and the beginning of the next.
        text.pop();
        if number > 0 {
            text[0] = b',';
        }
        Ok(Cow::Owned(text))
    });
    text.append(&mut chunks.collect::<serde_json::Result<_>>()?);
    text.push(Cow::Borrowed(b"],"));
    Ok(text)
}

/// Serialises the fields of an object without the enclosing braces.
fn fields(object: &impl Serialize) -> serde_json::Result<Vec<u8>> {
    let mut text = serde_json::to_vec(object)?;
    text.pop();
    text.remove(0);
    Ok(text)
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde passes fields by reference")]
fn is_false(value: &bool) -> bool {
    !value
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde passes fields by reference")]
fn is_zero(number: &u64) -> bool {
    *number == 0
}

/// Adds `extension` to the list of used extensions.
pub(super) fn use_extension(root: &mut json::Root, extension: &str) {
    if !root.extensions_used.iter().any(|used| used == extension) {
        root.extensions_used.push(extension.into());
        root.extensions_used.sort();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pieces_of_the_text_say_what_the_text_for_people_says() {
        let mut description = Description::default();
        for count in 0..2 * CHUNK + 1 {
            description.accessor(Accessor {
                buffer_view: 0,
                byte_offset: count as u64 * 12,
                count,
                component_type: ComponentType::F32,
                normalized: false,
                kind: Type::Vec3,
                min: Some(Extreme::Point([0.1; 3])),
                max: None,
            });
        }
        description.node(Node {
            name: "a",
            feature: Some(FeatureExtras { feature: "way/1" }),
            ..Node::default()
        });
        let mut pretty = Vec::new();
        description.write_pretty(&mut pretty).unwrap();
        let said: serde_json::Value = serde_json::from_slice(&pretty).unwrap();
        assert_eq!(description.text().unwrap().concat(), said.to_string().into_bytes());
        assert_eq!(said["accessors"].as_array().unwrap().len(), 2 * CHUNK + 1);
        assert_eq!(said["accessors"][1]["type"], "VEC3");
        assert_eq!(said["nodes"][0]["extras"]["feature"], "way/1");
    }
}
