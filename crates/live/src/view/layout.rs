//! Conversion between triangles by glTF's indices, which pages use, and by the scene's indices, which the engine uses.
//!
//! A document omits meshes and parts without shown triangles, and triangles without area.

use std::collections::BTreeMap;

use super::message::{PickCommand, Range};
use burgeon_base::error::{Error, Result};
use burgeon_engine::trace::{self, TriangleRun, exported_triangle};
use burgeon_export::gltf::Layout;
use burgeon_scene::{Mesh, Part, Scene};

/// Scene, with its layout in the document that pages have.
pub(super) struct Indices<'a> {
    pub scene: &'a Scene,
    pub layout: &'a Layout,
}

impl Indices<'_> {
    /// Returns the triangle of the scene that a page has picked. Fails if the document has no such triangle.
    pub(super) fn triangle(&self, pick: &PickCommand) -> Result<trace::Pick> {
        let gone = || Error::unavailable("unknown triangle; the live view may show an older model");
        let shows = |instance: &usize| -> bool {
            let known = self.layout.places.get(*instance).copied().flatten();
            let mesh = self.layout.meshes.get(self.scene.instances[*instance].mesh).copied().flatten();
            mesh == Some(pick.mesh)
                && known.is_some_and(|place| {
                    pick.node.is_none_or(|node| place.node == node)
                        && (place.shared.is_none() || place.shared == Some(pick.instance.unwrap_or(0)))
                })
        };
        let instance = (0..self.scene.instances.len()).find(shows).ok_or_else(gone)?;
        let mesh = &self.scene.meshes[self.scene.instances[instance].mesh];
        let (part, found) = shown_parts(mesh).nth(pick.primitive).ok_or_else(gone)?;
        let triangle = exported_triangle(found, pick.triangle).ok_or_else(gone)?;
        Ok(trace::Pick { instance, part, triangle })
    }

    /// Converts `runs` to ranges of the document, merging adjacent ones.
    pub(super) fn ranges(&self, runs: &[TriangleRun]) -> Vec<Range> {
        let mut sorted: Vec<&TriangleRun> = runs.iter().collect();
        sorted.sort_by_key(|run| (run.mesh, run.part, run.from));
        let mut ranges: Vec<Range> = Vec::new();
        let mut parts: BTreeMap<(usize, usize), Option<DocumentPart>> = BTreeMap::new();
        for run in sorted {
            let written = parts.entry((run.mesh, run.part)).or_insert_with(|| self.document_part(run));
            let Some(written) = written else { continue };
            let (from, end) =
                (written.triangles_before(run.from), written.triangles_before(run.from + run.count));
            if from == end {
                continue;
            }
            let (mesh, primitive) = (written.mesh, written.primitive);
            match ranges.last_mut() {
                Some(last)
                    if last.mesh == mesh && last.primitive == primitive && last.from + last.count >= from =>
                {
                    last.count = last.count.max(end - last.from);
                }
                _ => ranges.push(Range {
                    mesh,
                    primitive,
                    from,
                    count: end - from,
                    node: None,
                    instances: None,
                }),
            }
        }
        ranges
    }

    /// Returns everything that these instances show.
    pub(super) fn instance_ranges(&mut self, instances: &[usize]) -> Vec<Range> {
        let mut nodes: BTreeMap<(usize, usize), Option<Vec<usize>>> = BTreeMap::new();
        for instance in instances {
            let Some(place) = self.layout.places.get(*instance).copied().flatten() else { continue };
            let shared = nodes.entry((self.scene.instances[*instance].mesh, place.node)).or_default();
            if let Some(number) = place.shared {
                shared.get_or_insert_default().push(number);
            }
        }
        let mut ranges = Vec::new();
        for ((mesh, node), instances) in nodes {
            let Some(index) = self.layout.meshes.get(mesh).copied().flatten() else { continue };
            for (primitive, (_, part)) in shown_parts(&self.scene.meshes[mesh]).enumerate() {
                let count = part.triangles.len() - degenerate(part).count();
                let (node, instances) = (Some(node), instances.clone());
                ranges.push(Range { mesh: index, primitive, from: 0, count, node, instances });
            }
        }
        ranges
    }

    fn document_part(&self, run: &TriangleRun) -> Option<DocumentPart> {
        let mesh = self.layout.meshes.get(run.mesh).copied().flatten()?;
        let primitive =
            shown_parts(self.scene.meshes.get(run.mesh)?).position(|(part, _)| part == run.part)?;
        let part = self.scene.meshes[run.mesh].parts.get(run.part)?;
        Some(DocumentPart {
            mesh,
            primitive,
            left_out: degenerate(part).collect(),
            count: part.triangles.len(),
        })
    }
}

/// Part as written in the document.
struct DocumentPart {
    mesh: usize,
    primitive: usize,
    /// Triangles that are omitted, in order.
    left_out: Vec<usize>,
    count: usize,
}

impl DocumentPart {
    /// Returns the number of triangles of the document before triangle `index` of the part.
    fn triangles_before(&self, index: usize) -> usize {
        let index = index.min(self.count);
        index - self.left_out.partition_point(|left_out| *left_out < index)
    }
}

/// Returns the parts that are written, with their indices.
fn shown_parts(mesh: &Mesh) -> impl Iterator<Item = (usize, &Part)> {
    mesh.parts.iter().enumerate().filter(|(_, part)| exported_triangle(part, 0).is_some())
}

/// Returns the triangles that are not written.
fn degenerate(part: &Part) -> impl Iterator<Item = usize> {
    let triangles = part.triangles.iter().enumerate();
    triangles.filter(|(_, [a, b, c])| a == b || b == c || c == a).map(|(index, _)| index)
}

#[cfg(test)]
mod tests {
    use super::*;
    use burgeon_export::gltf::InstancePlace;
    use burgeon_scene::Instance;

    /// Returns two instances of a mesh. Its first part shows nothing, and its second part has a triangle without area.
    fn scene() -> (Scene, Layout) {
        let part = |triangles: Vec<[u32; 3]>| Part { triangles: triangles.into(), ..Part::default() };
        let mesh = Mesh {
            parts: vec![part(vec![[1, 1, 2]]), part(vec![[0, 1, 2], [3, 3, 4], [0, 2, 3], [1, 2, 3]])],
            ..Mesh::default()
        };
        let instance = || Instance {
            mesh: 1,
            transform: glam::DAffine3::IDENTITY,
            name: String::new(),
            feature: None,
            origin: None,
            placement: None,
            meaning: None,
        };
        let scene = Scene {
            meshes: vec![Mesh::default(), mesh],
            instances: vec![instance(), instance()],
            ..Scene::default()
        };
        let place = |shared| Some(InstancePlace { node: 5, shared: Some(shared) });
        (scene, Layout { places: vec![place(0), place(1)], meshes: vec![None, Some(0)] })
    }

    #[test]
    fn picked_triangles_skip_what_is_not_written() {
        let (scene, layout) = scene();
        let indices = Indices { scene: &scene, layout: &layout };
        let pick = |instance, triangle| {
            let (node, instance) = (Some(5), Some(instance));
            indices.triangle(&PickCommand { id: 0, mesh: 0, primitive: 0, triangle, instance, node })
        };
        assert_eq!(pick(1, 1).unwrap(), trace::Pick { instance: 1, part: 1, triangle: 2 });
        assert!(pick(2, 0).is_err() && pick(0, 3).is_err());
    }

    #[test]
    fn ranges_count_only_what_is_written_and_grow_together() {
        let (scene, layout) = scene();
        let mut indices = Indices { scene: &scene, layout: &layout };
        let run = |part, from, count| TriangleRun { mesh: 1, part, from, count };
        let pairs = |ranges: Vec<Range>| -> Vec<(usize, usize)> {
            ranges.iter().map(|range| (range.from, range.count)).collect()
        };
        assert_eq!(pairs(indices.ranges(&[run(1, 2, 1), run(1, 0, 2), run(0, 0, 1)])), [(0, 2)]);
        assert_eq!(pairs(indices.ranges(&[run(1, 3, 9), run(1, 0, 1)])), [(0, 1), (2, 1)]);
        assert_eq!(
            pairs(indices.ranges(&[run(1, 1, 1), TriangleRun { mesh: 0, part: 0, from: 0, count: 1 }])),
            []
        );
        let placed = indices.instance_ranges(&[0, 1]);
        assert_eq!((placed[0].count, placed[0].instances.clone()), (3, Some(vec![0, 1])));
    }
}
