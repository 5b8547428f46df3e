//! Nodes of instances: one node for each instance, or one node for many.

use super::super::check::{PartExtent, SceneCheck};
use super::super::decompose::{Steps, Trs, decompose, y_up};
use super::attribute_column::{AttributeColumn, FeatureNumbers};
use super::body::{ArrayKind, Body, BodyArray};
use super::description::{Accessor, Description, FeatureExtras, Node, use_extension};
use super::mesh::{Arrays, accessor};
use super::metadata::{FeaturePlace, INSTANCE_FEATURES, Metadata, instance_features};
use super::quantize::{PositionGrid, rounding as grid_rounding};
use crate::InstanceStorage;
use crate::film_model::FilmModel;
use crate::level_storage::LevelStorage;
use burgeon_scene::{Instance, Scene};
use glam::{DAffine3, DQuat, DVec3};
use gltf_json as json;
use json::accessor::{ComponentType, Type};
use json::scene::UnitQuaternion;
use rustc_hash::FxHashMap;

const INSTANCING: &str = "EXT_mesh_gpu_instancing";

/// Extension of levels of detail.
const LEVELS: &str = "MSFT_lod";

/// Minimum number of instances that share a node.
///
/// A node takes about 130 bytes of JSON. An instance of a shared node takes up to 40 bytes of the body and its share of
/// about 600 bytes that describe the arrays, so sharing is smaller from 7 instances on. But a reader that does not
/// support the extension cannot open the file, so sharing must be worth it: at 16 instances it halves the size.
const ENOUGH: usize = 16;

/// Properties that instances of one node have in common; only their transforms differ.
#[derive(PartialEq, Eq, Hash, Clone, Copy)]
pub(super) struct InstanceKind<'a> {
    /// Frame of a film, 0 without one.
    frame: u32,
    mesh: usize,
    name: &'a str,
    /// Set if the instances are mirrored. Renderers choose the visible side once for all instances of a node.
    mirrored: bool,
    /// Property table of the features of the instances.
    table: Option<usize>,
}

/// Attribute with the feature of an instance, named as in `EXT_instance_features`: an index into the list `features` of
/// the scene's extras, or -1.
const FEATURE: &str = "_FEATURE_ID_0";

#[derive(Default)]
pub(super) struct InstanceGroup {
    count: usize,
    /// Numbers of the features of the instances; -1 for none.
    pub(super) features: Vec<f32>,
    translations: Vec<f32>,
    rotations: Vec<f32>,
    scales: Vec<f32>,
    /// Largest scale factor.
    largest: f64,
}

/// Location of an instance of the scene in a document.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct InstancePlace {
    /// Index of the node in the document's nodes.
    pub node: usize,
    /// Index of the instance among those that share the node; `None` if the node shows only this instance.
    pub shared: Option<usize>,
}

/// Nodes that [`write`] has added.
#[derive(Default)]
pub(super) struct InstanceNodes<'a> {
    /// Root nodes of the scene.
    pub(super) nodes: Vec<usize>,
    /// Location of each instance; `None` if the instance shows nothing.
    pub(super) places: Vec<Option<InstancePlace>>,
    /// Features of instances that share a node.
    pub(super) features: Vec<&'a str>,
    /// Frames of a film that show something, and the node of each.
    pub(super) frames: Vec<(u32, usize)>,
    /// Number of repeated instances that have nodes of their own.
    pub(super) separate: usize,
    /// Largest error (m) of positions along an axis, if they are integers.
    pub(super) rounding: Option<f64>,
}

/// Adds the instances.
pub(super) fn write<'a>(
    checked: &SceneCheck<'a>,
    metadata: Option<&Metadata>,
    (meshes, grids): (&[Option<usize>], &[Option<PositionGrid>]),
    (arrays, film, storage): (Arrays, Option<&'a FilmModel>, InstanceStorage),
    description: &mut Description<'a>,
    body: &mut Body<'a>,
) -> InstanceNodes<'a> {
    let scene = checked.scene;
    let frame_of = |number: usize| film.and_then(|film| film.frames.get(number)).copied().unwrap_or(0);
    let mut groups: Vec<(InstanceKind<'_>, InstanceGroup)> = Vec::new();
    let mut known = FxHashMap::default();
    let mut group_of = Vec::with_capacity(scene.instances.len());
    for (number, instance) in scene.instances.iter().enumerate() {
        group_of.push(InstanceKind::of(instance, frame_of(number), metadata).map(|kind| {
            let group = *known.entry(kind).or_insert_with(|| {
                groups.push((kind, InstanceGroup::default()));
                groups.len() - 1
            });
            groups[group].1.count += 1;
            group
        }));
    }
    let is_repeated = |(kind, group): &(InstanceKind<'_>, InstanceGroup)| {
        group.count >= ENOUGH && !kind.has_features(metadata)
    };
    let repeated: usize =
        groups.iter().filter(|group| is_repeated(group)).map(|(_, group)| group.count).sum();
    let is_sharing = match storage {
        InstanceStorage::Automatic => repeated > InstanceStorage::MOST_NODES,
        InstanceStorage::Extension => true,
        InstanceStorage::Nodes | InstanceStorage::Expanded => false,
    };
    let separate = if is_sharing { 0 } else { repeated };
    let mut rounding = arrays.quantized.then_some(0.0);
    let mut features = FeatureNumbers::default();
    let mut nodes = Vec::new();
    let mut places = vec![None; scene.instances.len()];
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); groups.len()];
    for (number, (instance, group)) in scene.instances.iter().zip(group_of).enumerate() {
        let Some(mesh) = meshes[instance.mesh] else { continue };
        let mut transform = instance.transform;
        transform.translation -= checked.origin;
        let mut transform = y_up(&transform);
        if let (Some(grid), Some(rounding)) = (grids[instance.mesh], &mut rounding) {
            transform *= grid.transform();
            *rounding = grid_rounding(&transform).max(*rounding);
        }
        let at = group;
        let shared = group
            .map(|group| &mut groups[group])
            .filter(|(kind, group)| is_sharing && group.count >= ENOUGH || kind.has_features(metadata));
        if let Some((kind, group)) = shared
            && group.take(&kind.mirror(transform))
        {
            group.features.push(match metadata {
                Some(metadata) => metadata.number_of(instance),
                None => features.number(instance.feature.as_deref()),
            });
            members[at.unwrap_or_default()].push(number);
            continue;
        }
        let (node, shown) = add_single(instance, mesh, &transform, description);
        if let Some(metadata) = metadata.filter(|metadata| metadata.is_shared(instance.mesh)) {
            add_feature(shown, metadata.of_instance(instance), description, body);
        }
        nodes.push((frame_of(number), node));
        places[number] = Some(InstancePlace { node: shown, shared: None });
    }
    for ((kind, group), members) in groups.into_iter().zip(members) {
        if let Some(mesh) = meshes[kind.mesh].filter(|_| !group.translations.is_empty()) {
            let reach = match arrays {
                Arrays { small: true, .. } => f64::INFINITY,
                _ if grids[kind.mesh].is_some() => PositionGrid::reach(),
                _ => reach(checked, kind.mesh),
            };
            let features = metadata.is_some().then_some(kind.table).flatten();
            let node = add_group(kind, group, features, (mesh, reach), description, body);
            nodes.push((kind.frame, node));
            for (shared, number) in members.into_iter().enumerate() {
                places[number] = Some(InstancePlace { node, shared: Some(shared) });
            }
        }
    }
    let features = features.list;
    let frames = film.map(|film| add_frames(film, &nodes, description)).unwrap_or_default();
    let nodes: Vec<usize> = match film {
        Some(film) if film.levels == Some(LevelStorage::Extension) => link_levels(&frames, description),
        Some(_) => frames.iter().map(|(_, node)| *node).collect(),
        None => nodes.into_iter().map(|(_, node)| node).collect(),
    };
    if checked.origin == DVec3::ZERO || nodes.is_empty() {
        return InstanceNodes { nodes, places, features, frames, separate, rounding };
    }
    let origin = Node {
        name: "origin",
        translation: translation(y_up(&DAffine3::from_translation(checked.origin)).translation),
        children: Some(nodes),
        ..Node::default()
    };
    InstanceNodes { nodes: vec![description.node(origin)], places, features, frames, separate, rounding }
}

impl<'a> InstanceKind<'a> {
    /// Returns the group key of an instance that may share its node. A drawing of a feature has a separate node, which
    /// stores the feature's id.
    fn of(instance: &'a Instance, frame: u32, metadata: Option<&Metadata>) -> Option<Self> {
        let shared = metadata.is_some_and(|metadata| metadata.is_shared(instance.mesh));
        (instance.feature.is_none() || instance.placement.is_some() || shared).then(|| Self {
            frame,
            mesh: instance.mesh,
            name: &instance.name,
            mirrored: instance.transform.matrix3.determinant() < 0.0,
            table: metadata.and_then(|metadata| metadata.of_instance(instance)).map(|place| place.table),
        })
    }

    /// Returns the group key of an instance in a tile, where features have no nodes of their own.
    pub(super) fn in_tile(instance: &Instance, metadata: Option<&Metadata>) -> Self {
        Self {
            frame: 0,
            mesh: instance.mesh,
            name: "",
            mirrored: instance.transform.matrix3.determinant() < 0.0,
            table: metadata.and_then(|metadata| metadata.of_instance(instance)).map(|place| place.table),
        }
    }

    /// Returns the mesh of the scene.
    pub(super) fn mesh(&self) -> usize {
        self.mesh
    }

    /// Returns the property table of the features.
    pub(super) fn table(&self) -> Option<usize> {
        self.table
    }

    /// Returns true if the instances store their features, because their mesh cannot.
    fn has_features(&self, metadata: Option<&Metadata>) -> bool {
        self.table.is_some() && metadata.is_some_and(|metadata| metadata.is_shared(self.mesh))
    }

    /// Returns the transform that remains for the instance if its node mirrors.
    pub(super) fn mirror(self, transform: DAffine3) -> DAffine3 {
        if self.mirrored { DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0)) * transform } else { transform }
    }
}

impl InstanceGroup {
    /// Adds an instance and returns true, unless its transform is sheared.
    pub(super) fn take(&mut self, transform: &DAffine3) -> bool {
        let Steps::One(Trs { translation, rotation, scale }) = decompose(transform) else { return false };
        self.translations.extend((translation.as_vec3() + 0.0).to_array());
        self.rotations.extend(quaternion(rotation));
        self.scales.extend((scale.as_vec3() + 0.0).to_array());
        self.largest = self.largest.max(scale.abs().max_element());
        true
    }
}

/// Returns the number of bytes that the transforms of the instances of each mesh of `scene` take more if its positions are
/// integers: a translation and a scale for a node, and a scale for an instance that shares one.
pub(super) fn integer_costs(scene: &Scene, storage: InstanceStorage) -> Vec<usize> {
    let mut counts = vec![0; scene.meshes.len()];
    scene.instances.iter().for_each(|instance| counts[instance.mesh] += 1);
    let cost = |count: usize| match storage {
        InstanceStorage::Automatic | InstanceStorage::Extension if count >= ENOUGH => 12 * count,
        _ => 75 * count,
    };
    counts.into_iter().map(cost).collect()
}

/// Returns the maximum distance (m) of a point of a mesh from the mesh's origin.
pub(super) fn reach(checked: &SceneCheck<'_>, mesh: usize) -> f64 {
    let furthest = |part: &PartExtent| part.low.abs().max(part.high.abs()).as_dvec3().length();
    checked.parts[mesh].iter().map(furthest).fold(0.0, f64::max)
}

/// Adds the nodes for one instance. Returns the outermost node and the node with the mesh. They are the same unless the
/// instance is sheared, or so far away that a second translation stores the rounding error of the first.
fn add_single<'a>(
    instance: &'a Instance,
    mesh: usize,
    transform: &DAffine3,
    description: &mut Description<'a>,
) -> (usize, usize) {
    let shown = Node {
        mesh: Some(mesh),
        name: &instance.name,
        feature: instance.feature.as_deref().map(|feature| FeatureExtras { feature }),
        ..Node::default()
    };
    let (outer, inner) = match decompose(transform) {
        Steps::One(trs) => {
            let node = description.node(with_transform(shown, &trs));
            (node, node)
        }
        Steps::Two(rest, first) => {
            let inner = description.node(Node { rotation: rotation(first), ..shown });
            let outer = Node { children: Some(vec![inner]), ..Node::default() };
            (description.node(with_transform(outer, &rest)), inner)
        }
    };
    let Some(lost) = rounding(transform.translation) else { return (outer, inner) };
    let children = Some(vec![outer]);
    (description.node(Node { translation: translation(lost), children, ..Node::default() }), inner)
}

/// Adds one node for all instances of a group; `mesh` is the index of the mesh and its radius (m).
pub(super) fn add_group<'a>(
    kind: InstanceKind<'a>,
    group: InstanceGroup,
    table: Option<usize>,
    (mesh, reach): (usize, f64),
    description: &mut Description<'a>,
    body: &mut Body<'a>,
) -> usize {
    use_extension(&mut description.root, INSTANCING);
    description.root.extensions_required = vec![INSTANCING.into()];
    let mut attributes = serde_json::Map::new();
    let count = group.translations.len() / 3;
    let mut add = |key: &str, column: AttributeColumn, kind: Type| {
        let shared = match (&column, kind) {
            (AttributeColumn::Floats(_), Type::Vec3) => Some(ArrayKind::InstanceVectors),
            (AttributeColumn::Floats(_), Type::Vec4) => Some(ArrayKind::InstanceRotations),
            (AttributeColumn::Shorts(..), Type::Vec4) => Some(ArrayKind::ShortRotations),
            _ => None,
        };
        let (block, component, normalized) = match column {
            AttributeColumn::Floats(floats) => (BodyArray::Floats(floats), ComponentType::F32, false),
            AttributeColumn::Shorts(shorts, normalized) => {
                (BodyArray::Shorts(shorts), ComponentType::I16, normalized)
            }
        };
        let place = match shared {
            Some(shared) => body.share(shared, block),
            None => (body.add(block), 0),
        };
        let array = Accessor { normalized, ..accessor(place, component, kind, count) };
        attributes.insert(key.into(), description.accessor(array).into());
    };
    let differs = |floats: &[f32], default: &[f32]| floats.chunks(default.len()).any(|item| item != default);
    let told = table.map(|table| instance_features(&group.features, table));
    if table.is_some() {
        add(FEATURE, AttributeColumn::Floats(group.features), Type::Scalar);
    } else if group.features.iter().any(|feature| *feature >= 0.0) {
        add(FEATURE, AttributeColumn::whole(group.features), Type::Scalar);
    }
    // TRANSLATION is always written, because one array must exist to define the number of instances.
    add("TRANSLATION", AttributeColumn::Floats(group.translations), Type::Vec3);
    if differs(&group.rotations, &[0.0, 0.0, 0.0, 1.0]) {
        add("ROTATION", AttributeColumn::rotations(group.rotations, reach * group.largest), Type::Vec4);
    }
    if differs(&group.scales, &[1.0, 1.0, 1.0]) {
        add("SCALE", AttributeColumn::Floats(group.scales), Type::Vec3);
    }
    let mut extensions = serde_json::json!({ INSTANCING: { "attributes": attributes } });
    if let Some(told) = told {
        use_extension(&mut description.root, INSTANCE_FEATURES);
        extensions[INSTANCE_FEATURES] = told;
    }
    description.node(Node {
        mesh: Some(mesh),
        name: kind.name,
        scale: kind.mirrored.then_some([-1.0, 1.0, 1.0]),
        extensions: Some(extensions),
        ..Node::default()
    })
}

/// Refers from the node of the first level of detail to the others (`MSFT_lod`), and returns it.
fn link_levels(levels: &[(u32, usize)], description: &mut Description<'_>) -> Vec<usize> {
    let Some(((_, first), others)) = levels.split_first() else { return Vec::new() };
    let others: Vec<usize> = others.iter().map(|(_, node)| *node).collect();
    if !others.is_empty() {
        use_extension(&mut description.root, LEVELS);
        description.nodes[*first].extensions = Some(serde_json::json!({ LEVELS: { "ids": others } }));
    }
    vec![*first]
}

/// Adds a node for each frame that shows something, with the `nodes` of the frame; only the first frame is visible at
/// the beginning.
fn add_frames<'a>(
    film: &'a FilmModel,
    nodes: &[(u32, usize)],
    description: &mut Description<'a>,
) -> Vec<(u32, usize)> {
    let mut children = vec![Vec::new(); film.count() as usize];
    for (frame, node) in nodes {
        if let Some(children) = children.get_mut(*frame as usize) {
            children.push(*node);
        }
    }
    let shown = (0_u32..).zip(children).zip(&film.names).filter(|((_, children), _)| !children.is_empty());
    let added = shown.map(|((frame, children), name)| {
        let scale = (frame > 0 && film.levels.is_none()).then_some([0.0; 3]);
        (frame, description.node(Node { name, children: Some(children), scale, ..Node::default() }))
    });
    added.collect()
}

/// Assigns a feature to the node of a sheared instance, which cannot share a node.
fn add_feature(
    node: usize,
    feature: Option<FeaturePlace>,
    description: &mut Description<'_>,
    body: &mut Body<'_>,
) {
    let Some(FeaturePlace { table, row }) = feature else { return };
    for extension in [INSTANCING, INSTANCE_FEATURES] {
        use_extension(&mut description.root, extension);
    }
    description.root.extensions_required = vec![INSTANCING.into()];
    let mut add = |numbers: Vec<f32>, kind: Type| {
        let place = (body.add(BodyArray::Floats(numbers)), 0);
        description.accessor(accessor(place, ComponentType::F32, kind, 1))
    };
    let (features, translation) = (add(vec![row as f32], Type::Scalar), add(vec![0.0; 3], Type::Vec3));
    description.nodes[node].extensions = Some(serde_json::json!({
        INSTANCING: { "attributes": { FEATURE: features, "TRANSLATION": translation } },
        INSTANCE_FEATURES: instance_features(&[row as f32], table),
    }));
}

/// Maximum rounding error (m) of a translation that is not corrected. 32-bit floats exceed it from 8 km on.
const UNCORRECTED: f64 = 5e-4;

/// Returns the part (m) of a translation that 32-bit floats lose, if it is large enough to open gaps between
/// neighbours.
fn rounding(translation: DVec3) -> Option<DVec3> {
    let lost = translation - translation.as_vec3().as_dvec3();
    (lost.abs().max_element() > UNCORRECTED).then_some(lost)
}

/// Sets the transform of `node`, omitting default values.
fn with_transform<'a>(node: Node<'a>, trs: &Trs) -> Node<'a> {
    Node {
        translation: translation(trs.translation),
        rotation: rotation(trs.rotation),
        scale: unless([1.0; 3], (trs.scale.as_vec3() + 0.0).to_array()),
        ..node
    }
}

pub(super) fn translation(translation: DVec3) -> Option<[f32; 3]> {
    unless([0.0; 3], (translation.as_vec3() + 0.0).to_array())
}

pub(super) fn rotation(rotation: DQuat) -> Option<UnitQuaternion> {
    unless([0.0, 0.0, 0.0, 1.0], quaternion(rotation)).map(UnitQuaternion)
}

/// Returns `value`, or `None` if it equals the default exactly.
fn unless<const N: usize>(default: [f32; N], value: [f32; N]) -> Option<[f32; N]> {
    (value.map(f32::to_bits) != default.map(f32::to_bits)).then_some(value)
}

/// Returns the quaternion of `rotation` with non-negative w, as x, y, z, w.
pub(super) fn quaternion(rotation: DQuat) -> [f32; 4] {
    let rotation = if rotation.w < 0.0 { -rotation } else { rotation };
    rotation.as_quat().to_array().map(|number| number + 0.0)
}
