//! Triangles of a tile, merged by material.

use burgeon_scene::{Instance, Part, Scene};
use glam::{DAffine3, DVec3, Vec3};
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeMap;

use super::super::coordinates::tex_coord;
use super::super::metadata::Metadata;
use super::vertex::{VertexFormat, VertexRecord};
use crate::check::{SceneCheck, triangles};

/// Properties that the triangles of a primitive have in common.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct PrimitiveKey {
    /// Material of the scene.
    pub(super) material: usize,
    /// Property table of the features; `None` if no vertex has a feature.
    pub(super) table: Option<usize>,
}

/// Triangles of one material.
#[derive(Default)]
pub(super) struct MergedPart {
    pub(super) vertices: Vec<VertexRecord>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// Set if vertices have texture coordinates.
    pub(super) is_textured: bool,
    /// Second texture coordinates of all vertices, as bits of single-precision numbers; empty without a dirt map.
    pub(super) second_tex_coords: Vec<[u32; 2]>,
    known: FxHashMap<VertexRecord, u32>,
    /// Numbers of the vertices with second texture coordinates.
    known_second: FxHashMap<(VertexRecord, [u32; 2]), u32>,
}

/// Mesh that is put together from instances.
pub(super) struct MergedMesh<'a> {
    scene: &'a Scene,
    pub(super) format: VertexFormat,
    pub(super) parts: BTreeMap<PrimitiveKey, MergedPart>,
}

impl<'a> MergedMesh<'a> {
    pub(super) fn new(scene: &'a Scene, format: VertexFormat) -> Self {
        Self { scene, format, parts: BTreeMap::new() }
    }

    /// Adds the triangles of a mesh of the scene with a transform (z up), as a part of a feature: its property table and its
    /// row.
    pub(super) fn add(&mut self, mesh: usize, transform: &DAffine3, table: Option<usize>, feature: u32) {
        for part in &self.scene.meshes[mesh].parts {
            if triangles(part).next().is_none() {
                continue;
            }
            let key = PrimitiveKey { material: part.material, table };
            let material = &self.scene.materials[part.material];
            let (texture, dirt) =
                (material.image_size(), material.dirt_map.as_ref().map(|map| map.image.size));
            let merged = self.parts.entry(key).or_default();
            merged.is_textured = texture.is_some();
            merged.add(part, transform, (texture, dirt), feature, &self.format);
        }
    }

    /// Removes the parts whose triangles were all too small.
    pub(super) fn remove_empty(&mut self) {
        self.parts.retain(|_, part| !part.triangles.is_empty());
    }
}

impl MergedPart {
    fn add(
        &mut self,
        part: &Part,
        transform: &DAffine3,
        (texture, dirt): (Option<[f64; 2]>, Option<[f64; 2]>),
        feature: u32,
        format: &VertexFormat,
    ) {
        const NONE: u32 = u32::MAX;
        let turn = transform.matrix3.inverse().transpose();
        let mirrors = transform.matrix3.determinant() < 0.0;
        let mut moved = vec![NONE; part.positions.len()];
        for corners in triangles(part) {
            let mut ends = corners.map(|corner| {
                let index = corner as usize;
                if moved[index] == NONE {
                    let point = transform.transform_point3(part.positions[index].as_dvec3());
                    let normal = turn * part.normals[index].vector().as_dvec3();
                    let normal = normal.try_normalize().unwrap_or(DVec3::Z).as_vec3();
                    let uv = texture.map(|size| tex_coord(part.uvs[index], size)).unwrap_or_default();
                    let second = dirt.map(|size| {
                        let uv = tex_coord(part.second_uv(index), size);
                        uv.map(|number| (number + 0.0).to_bits())
                    });
                    let vertex = VertexRecord {
                        place: format.place(DVec3::new(point.x, point.z, -point.y)),
                        normal: format.normal(Vec3::new(normal.x, normal.z, -normal.y)),
                        tex_coord: uv.map(|number| (number + 0.0).to_bits()),
                        feature,
                    };
                    moved[index] = match second {
                        Some(second) => self.vertex_with_second(vertex, second),
                        None => self.vertex(vertex),
                    };
                }
                moved[index]
            });
            if mirrors {
                ends.swap(1, 2);
            }
            let [a, b, c] = ends.map(|end| self.vertices[end as usize].place);
            // Rounding can join the corners of a small triangle.
            if a != b && b != c && c != a {
                self.triangles.push(ends);
            }
        }
    }

    /// Returns the number of a vertex; adds it if it is new.
    fn vertex(&mut self, vertex: VertexRecord) -> u32 {
        let next = self.vertices.len() as u32;
        let number = *self.known.entry(vertex).or_insert(next);
        if number == next {
            self.vertices.push(vertex);
        }
        number
    }

    /// Returns the number of a vertex with second texture coordinates; adds it if it is new.
    fn vertex_with_second(&mut self, vertex: VertexRecord, second: [u32; 2]) -> u32 {
        let next = self.vertices.len() as u32;
        let number = *self.known_second.entry((vertex, second)).or_insert(next);
        if number == next {
            self.vertices.push(vertex);
            self.second_tex_coords.push(second);
        }
        number
    }

    /// Returns the number of features except `none`.
    pub(super) fn features(&self, none: u32) -> usize {
        let different: FxHashSet<u32> = self.vertices.iter().map(|vertex| vertex.feature).collect();
        different.len() - usize::from(different.contains(&none))
    }
}

/// Merges the instances of the scene with these indices.
///
/// Instances without a feature get the number after the last row of the first table, so that they share the primitives of
/// those with features.
pub(super) fn merge<'a>(
    checked: &SceneCheck<'a>,
    metadata: Option<&Metadata>,
    format: VertexFormat,
    instances: impl Iterator<Item = usize>,
) -> MergedMesh<'a> {
    let scene = checked.scene;
    let mut merged = MergedMesh::new(scene, format);
    for instance in instances.map(|index| &scene.instances[index]) {
        let (table, feature) = feature_number(metadata, instance);
        let mut transform = instance.transform;
        transform.translation -= checked.origin;
        merged.add(instance.mesh, &transform, table, feature);
    }
    merged.remove_empty();
    merged
}

/// Returns the table and the row of the feature of an instance.
fn feature_number(metadata: Option<&Metadata>, instance: &Instance) -> (Option<usize>, u32) {
    let Some(metadata) = metadata else { return (None, 0) };
    match metadata.of_instance(instance) {
        Some(place) => (Some(place.table), place.row as u32),
        None => (Some(0), metadata.rows(0) as u32),
    }
}
