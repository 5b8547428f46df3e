//! Input of an export: the scene and the facts about it.

use burgeon_picture::Picture;
use burgeon_scene::{CityClass, Recipe, Scene};
use burgeon_spatial::RecordTable;
use burgeon_spatial::ReferenceFrame;

/// Input of an export, from a run.
#[derive(Clone, Copy)]
pub struct Export<'a> {
    /// Scene to write.
    pub scene: &'a Scene,
    /// Camera and size of a render of the scene.
    pub picture: &'a Picture,
    /// Facts about the scene.
    pub facts: SceneFacts<'a>,
}

/// Facts about a scene beyond its geometry, for formats that store them.
#[derive(Clone, Copy)]
pub struct SceneFacts<'a> {
    /// Projection and origin of the scene on the earth.
    pub frame: Option<&'a ReferenceFrame>,
    /// Level of detail of the scene, from 0 to 3.
    pub detail: u8,
    /// Facts about the systems that contributed to the scene and have features.
    pub systems: &'a [SystemFacts],
    /// Layers of modules with a geometry: one table for each symbol.
    pub layers: &'a [RecordTable],
    /// Feature attributes to include in glTF models, in addition to ids (`EXT_structural_metadata`). `None` omits ids
    /// too.
    pub metadata: Option<&'a [String]>,
    /// Storage of instances in glTF models.
    pub instances: InstanceStorage,
    /// Set to compress the arrays of `.glb` files (`EXT_meshopt_compression`).
    pub is_compressed: bool,
    /// Set to write the arrays of glTF models as integers (`KHR_mesh_quantization`).
    pub is_quantized: bool,
    /// Sums that the interpretations of each system have reported, with the index of the system in the script.
    pub reports: &'a [(usize, RecordTable)],
    /// Recipe of the model, for formats that carry it.
    pub recipe: Option<&'a Recipe>,
}

/// Storage of repeated instances in glTF models.
///
/// With [`metadata`](SceneFacts::metadata), models that several features share always have the extension, because only
/// its instances can store features.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum InstanceStorage {
    /// [`Nodes`](Self::Nodes) for up to [`MOST_NODES`](Self::MOST_NODES) repeated instances, and the extension for more.
    #[default]
    Automatic,
    /// A node for each instance, which every program reads.
    Nodes,
    /// A node for all similar instances, with `EXT_mesh_gpu_instancing`. Few programs outside the web read it.
    Extension,
    /// Merged meshes, one for each system and feature.
    Expanded,
}

impl InstanceStorage {
    /// Maximum number of repeated instances that have nodes of their own, unless the user chooses the storage.
    pub const MOST_NODES: usize = 1000;
}

/// Facts about the chains of a system.
#[derive(Debug, Clone, Default)]
pub struct SystemFacts {
    /// Index of the system in the script, from 0.
    pub system: usize,
    /// Attributes of the feature of each chain, in the order of the chains.
    pub records: RecordTable,
    /// Class of its city objects, if the script specifies one.
    pub class: Option<CityClass>,
}

impl Default for SceneFacts<'_> {
    /// Returns facts of a scene in full detail, without a frame, systems, layers, metadata, reports or recipe.
    fn default() -> Self {
        Self {
            frame: None,
            detail: 3,
            systems: &[],
            layers: &[],
            metadata: None,
            instances: InstanceStorage::default(),
            is_compressed: false,
            is_quantized: false,
            reports: &[],
            recipe: None,
        }
    }
}
