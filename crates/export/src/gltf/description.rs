//! What a document says of what it holds, as JSON.
//!
//! A city has hundreds of thousands of accessors and primitives. They are plain data here: gltf-json's types have room
//! for all that the specification knows, which takes longer to fill, to write and to free than what is drawn.

use burgeon_base::error::{Error, Result};
use gltf_json as json;
use json::accessor::{ComponentType, Type};
use json::scene::UnitQuaternion;
use rayon::prelude::*;
use serde::Serialize;
use std::io::{self, Write};

/// Items of a list that are turned into text at a time.
const CHUNK: usize = 4096;

/// All that a document says, as `'a`, the scene, calls it.
#[derive(Default)]
pub(super) struct Description<'a> {
    /// What there are few of; it has no accessors, meshes and nodes.
    pub(super) root: json::Root,
    /// Extensions of the whole.
    pub(super) extensions: Option<serde_json::Value>,
    pub(super) accessors: Vec<Accessor>,
    pub(super) meshes: Vec<MeshDescription<'a>>,
    pub(super) nodes: Vec<Node<'a>>,
}

/// An array: where it is and what it is made of.
#[derive(Clone, Copy, Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    pub(super) buffer_view: u32,
    #[serde(skip_serializing_if = "is_zero")]
    pub(super) byte_offset: u64,
    pub(super) count: usize,
    pub(super) component_type: ComponentType,
    /// Whether integers stand for numbers from -1 to 1.
    #[serde(skip_serializing_if = "is_false")]
    pub(super) normalized: bool,
    #[serde(rename = "type")]
    pub(super) kind: Type,
    /// The corners of the box around points.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) min: Option<[f32; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) max: Option<[f32; 3]>,
}

#[derive(Serialize)]
pub(super) struct MeshDescription<'a> {
    #[serde(skip_serializing_if = "str::is_empty")]
    pub(super) name: &'a str,
    pub(super) primitives: Vec<Primitive>,
}

/// The triangles of one material; numbers of accessors.
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

/// What a viewer of Burgeon's own is told of a primitive.
#[derive(Clone, Copy, Serialize)]
pub(super) struct ShadingExtras {
    /// Whether each triangle has the normal of its last corner.
    pub(super) flat: bool,
}

/// The accessors of vertices.
#[derive(Clone, Copy, Serialize)]
pub(super) struct Attributes {
    #[serde(rename = "POSITION")]
    pub(super) positions: usize,
    /// Without them faces are flat.
    #[serde(rename = "NORMAL", skip_serializing_if = "Option::is_none")]
    pub(super) normals: Option<usize>,
    #[serde(rename = "TEXCOORD_0", skip_serializing_if = "Option::is_none")]
    pub(super) tex_coords: Option<usize>,
    /// The features that vertices are of.
    #[serde(rename = "_FEATURE_ID_0", skip_serializing_if = "Option::is_none")]
    pub(super) features: Option<usize>,
}

#[derive(Default, Serialize)]
pub(super) struct Node<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) children: Option<Vec<usize>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) extensions: Option<serde_json::Value>,
    /// In the extras and not in the name, since viewers change names that repeat or have unusual letters.
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

/// The id of the feature that a node shows.
#[derive(Clone, Copy, Serialize)]
pub(super) struct FeatureExtras<'a> {
    pub(super) feature: &'a str,
}

/// Everything, in gltf-json's order.
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

/// What stands between the accessors and the meshes.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct DocumentHead<'a> {
    asset: &'a json::Asset,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    buffers: &'a [json::Buffer],
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    buffer_views: &'a [json::buffer::View],
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

/// What stands behind the nodes.
#[derive(Serialize)]
struct DocumentTail<'a> {
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    samplers: &'a [json::texture::Sampler],
    scenes: &'a [json::Scene],
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    textures: &'a [json::Texture],
}

impl<'a> Description<'a> {
    /// Adds an accessor, and tells its number.
    pub(super) fn accessor(&mut self, accessor: Accessor) -> usize {
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Adds a node, and tells its number.
    pub(super) fn node(&mut self, node: Node<'a>) -> usize {
        self.nodes.push(node);
        self.nodes.len() - 1
    }

    fn whole(&self) -> WholeDocument<'_> {
        let root = &self.root;
        WholeDocument {
            accessors: &self.accessors,
            before: DocumentHead {
                asset: &root.asset,
                buffers: &root.buffers,
                buffer_views: &root.buffer_views,
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

    /// As text for people.
    pub(super) fn write_pretty(&self, out: &mut impl Write) -> io::Result<()> {
        serde_json::to_writer_pretty(out, &self.whole()).map_err(io::Error::from)
    }

    /// As text without a blank, in pieces to be put one after another.
    pub(super) fn text(&self) -> Result<Vec<Vec<u8>>> {
        let WholeDocument { accessors, before, meshes, nodes, after } = self.whole();
        let written = || -> serde_json::Result<Vec<Vec<u8>>> {
            let mut text = vec![b"{".to_vec()];
            text.extend(list("accessors", accessors)?);
            text.push(fields(&before)?);
            text.push(b",".to_vec());
            text.extend(list("meshes", meshes)?);
            text.extend(list("nodes", nodes)?);
            text.push(fields(&after)?);
            text.push(b"}".to_vec());
            Ok(text)
        };
        written().map_err(|error| Error::internal(format!("cannot write glTF: {error}")))
    }
}

/// A list with its name and a comma behind it, unless it is empty. All threads write it.
fn list<T: Serialize + Sync>(name: &str, items: &[T]) -> serde_json::Result<Vec<Vec<u8>>> {
    if items.is_empty() {
        return Ok(Vec::new());
    }
    let mut text = vec![format!("\"{name}\":").into_bytes()];
    let chunks = items.par_chunks(CHUNK).enumerate().map(|(number, chunk)| {
        let mut text = serde_json::to_vec(chunk)?;
        // Between two chunks there is a comma in place of the end of one list and the beginning of another.
        text.pop();
        if number > 0 {
            text[0] = b',';
        }
        Ok(text)
    });
    text.append(&mut chunks.collect::<serde_json::Result<_>>()?);
    text.push(b"],".to_vec());
    Ok(text)
}

/// The fields of an object without the braces around them.
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
                min: Some([0.1; 3]),
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
