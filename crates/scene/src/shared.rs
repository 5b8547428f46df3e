//! Scenes whose meshes other scenes show many times.

use std::sync::Arc;

use super::Scene;

/// Where the meshes of other scenes are among a scene's own, so that each is stored once however often it is placed.
#[derive(Debug, Clone, Default)]
pub struct SharedMeshes(Vec<(Arc<Scene>, Vec<Option<usize>>)>);

impl PartialEq for SharedMeshes {
    /// Scenes that show the same are equal, however they came about.
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Scene {
    /// The index of mesh `mesh` of `other` in this scene, where it is added the first time.
    pub fn share(&mut self, other: &Arc<Self>, mesh: usize) -> usize {
        let known = self.shared.0.iter().position(|(known, _)| Arc::ptr_eq(known, other));
        let known = known.unwrap_or_else(|| {
            self.shared.0.push((Arc::clone(other), vec![None; other.meshes.len()]));
            self.shared.0.len() - 1
        });
        if let Some(index) = self.shared.0[known].1[mesh] {
            return index;
        }
        let mut copy = other.meshes[mesh].clone();
        for part in &mut copy.parts {
            part.material = self.material(&other.materials[part.material]);
        }
        self.meshes.push(copy);
        self.shared.0[known].1[mesh] = Some(self.meshes.len() - 1);
        self.meshes.len() - 1
    }
}
