//! Meshes that are shared between scenes.

use std::sync::Arc;

use super::Scene;

/// Indices of other scenes' meshes in a scene, so that each mesh is stored once regardless of the number of its
/// instances.
#[derive(Debug, Clone, Default)]
pub struct SharedMeshes(Vec<(Arc<Scene>, Vec<Option<usize>>)>);

impl PartialEq for SharedMeshes {
    /// Returns true: the origin of meshes does not affect the equality of scenes.
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Scene {
    /// Returns the index of mesh `mesh` of `other` in this scene, adding it the first time.
    ///
    /// ```
    /// use burgeon_scene::{Mesh, Scene};
    /// use std::sync::Arc;
    ///
    /// let model = Arc::new(Scene { meshes: vec![Mesh::default()], ..Scene::default() });
    /// let mut park = Scene::default();
    /// assert_eq!((park.share(&model, 0), park.share(&model, 0)), (0, 0));
    /// assert_eq!(park.meshes.len(), 1);
    /// ```
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
