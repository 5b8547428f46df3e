//! Models of several frames in one scene, where equal meshes are stored once.

use crate::level_storage::LevelStorage;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_scene::{Instance, Mesh, Scene};
use rustc_hash::{FxHashMap, FxHasher};
use std::hash::Hasher;

/// Models of all frames.
#[derive(Debug, Default)]
pub struct FilmModel {
    /// Instances of all frames, in order.
    pub(crate) scene: Scene,
    /// Frame of each instance, which counts from 0.
    pub(crate) frames: Vec<u32>,
    /// Name of each frame.
    pub(crate) names: Vec<String>,
    /// Storage of the frames as levels of detail; `None` in a film.
    pub(crate) levels: Option<LevelStorage>,
    /// Meshes by hash.
    known: FxHashMap<u64, Vec<usize>>,
    /// Memory of the meshes and instances (bytes).
    size: usize,
    limit: usize,
}

impl FilmModel {
    /// Creates a model without frames, whose memory may take `limit` (bytes).
    pub(super) fn new(limit: usize) -> Self {
        Self { limit, ..Self::default() }
    }

    /// Adds the model of the next frame. Fails if all models together exceed the memory limit.
    pub(super) fn add(&mut self, frame: Scene) -> Result<()> {
        let Scene { materials, meshes, instances, upright, packages, .. } = frame;
        let number = self.count();
        if number == 0 {
            (self.scene.upright, self.scene.packages) = (upright, packages);
        }
        let mut used = vec![false; meshes.len()];
        for instance in &instances {
            if let Some(used) = used.get_mut(instance.mesh) {
                *used = true;
            }
        }
        let materials: Vec<usize> = materials.iter().map(|material| self.scene.material(material)).collect();
        let mut places = Vec::with_capacity(meshes.len());
        for (mut mesh, used) in meshes.into_iter().zip(used) {
            let mut refers = mesh.parts.iter_mut();
            let known = refers.try_for_each(|part| {
                part.material = *materials.get(part.material)?;
                Some(())
            });
            if known.is_none() {
                return Err(Error::internal(format!(
                    "the mesh {:?} refers to a missing material",
                    mesh.name
                )));
            }
            places.push(if used { self.mesh(mesh) } else { usize::MAX });
        }
        self.size += instances.len() * size_of::<Instance>();
        for instance in instances {
            let mesh = places.get(instance.mesh).copied().unwrap_or(usize::MAX);
            self.scene.instances.push(Instance { mesh, ..instance });
            self.frames.push(number);
        }
        self.names.push(format!("frame {number}"));
        if self.size > self.limit {
            let message = format!(
                "the models of {} frames exceed the memory limit of {} MB",
                self.count(),
                self.limit / 1_000_000
            );
            return Err(Error::limit(Limit::Memory, message)
                .help("use fewer frames or one file for each, such as %04d.glb, or raise --memory-limit"));
        }
        Ok(())
    }

    /// Returns the index of a mesh that is equal to `mesh`, adding it if it is new.
    fn mesh(&mut self, mesh: Mesh) -> usize {
        let alike = self.known.entry(hash(&mesh)).or_default();
        if let Some(index) = alike.iter().find(|index| self.scene.meshes[**index] == mesh) {
            return *index;
        }
        alike.push(self.scene.meshes.len());
        let bytes = |part: &burgeon_scene::Part| part.positions.len() * 32 + part.triangles.len() * 12;
        self.size += mesh.parts.iter().map(bytes).sum::<usize>();
        self.scene.meshes.push(mesh);
        self.scene.meshes.len() - 1
    }

    /// Returns the number of frames.
    pub(crate) fn count(&self) -> u32 {
        self.names.len() as u32
    }
}

/// Returns a hash of the points of a mesh, which rarely agree in different meshes.
fn hash(mesh: &Mesh) -> u64 {
    let mut hasher = FxHasher::default();
    hasher.write(mesh.name.as_bytes());
    for part in &mesh.parts {
        hasher.write_usize(part.material);
        hasher.write_usize(part.triangles.len());
        for point in &part.positions {
            hasher.write(bytemuck::bytes_of(point));
        }
    }
    hasher.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples;

    #[test]
    fn equal_meshes_of_several_frames_are_stored_once() {
        let mut model = FilmModel::new(1 << 30);
        model.add(samples::boxes(2)).unwrap();
        model.add(samples::boxes(3)).unwrap();
        let mut other = samples::boxes(1);
        other.meshes[0].parts[0].positions[0].x += 0.5;
        other.meshes.push(samples::cube("unused", 0));
        model.add(other).unwrap();
        model.add(Scene::default()).unwrap();
        assert_eq!((model.scene.meshes.len(), model.scene.materials.len(), model.count()), (2, 1, 4));
        assert_eq!(model.frames, [0, 0, 1, 1, 1, 2]);
        assert_eq!(model.scene.instances.iter().map(|it| it.mesh).collect::<Vec<_>>(), [0, 0, 0, 0, 0, 1]);
    }

    #[test]
    fn models_beyond_the_memory_limit_are_refused() {
        let mut model = FilmModel::new(2_000);
        model.add(samples::boxes(1)).unwrap();
        insta::assert_snapshot!(model.add(samples::boxes(9)).unwrap_err(), @r"
        the models of 2 frames exceed the memory limit of 0 MB
          help: use fewer frames or one file for each, such as %04d.glb, or raise --memory-limit
        ");
    }
}
