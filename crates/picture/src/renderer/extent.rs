//! Extent of scenes, so that several renders can share a camera.

use super::points;
use glam::{DAffine3, DMat3, DVec3, Vec3A};

/// Extent of one or more scenes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Extent {
    /// Points of the scenes (m): the farthest in each of many directions.
    points: Vec<DVec3>,
}

impl Extent {
    /// Creates the extent of points (m).
    pub(super) fn new(points: Vec<DVec3>) -> Self {
        Self { points }
    }

    /// Extends the extent by `other`.
    ///
    /// ```
    /// use burgeon_picture::Extent;
    /// use burgeon_scene::{Instance, Mesh, Scene};
    /// use glam::{DAffine3, Vec3};
    ///
    /// let extent_of = |size: f32| {
    ///     let (transform, name, feature) = (DAffine3::IDENTITY, String::new(), None);
    ///     let tile = Instance { mesh: 0, transform, name, feature, origin: None, placement: None, meaning: None };
    ///     let mut scene = Scene { instances: vec![tile], meshes: vec![Mesh::default()], ..Scene::default() };
    ///     let material = scene.material(&Default::default());
    ///     let part = scene.meshes[0].part(material);
    ///     part.positions = vec![Vec3::ZERO, Vec3::X * size, Vec3::Y * size];
    /// #     (part.normals, part.uvs) = (vec![burgeon_scene::Normal::Z; 3], vec![glam::Vec2::ZERO; 3]);
    ///     part.triangles.push([0, 1, 2]);
    ///     Extent::of(&scene)
    /// };
    /// let mut both = extent_of(1.0)?;
    /// both.join(&extent_of(20.0)?);
    /// assert_ne!(both, extent_of(1.0)?);
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn join(&mut self, other: &Self) {
        self.points.extend_from_slice(&other.points);
    }

    /// Returns the centre and the radius (m) of a bounding sphere after the rotation `turn`.
    pub(super) fn sphere(&self, turn: DMat3) -> (DVec3, f64) {
        let (low, high) = points::bounds(self.points.iter().map(|point| turn * *point));
        points::sphere(low, high)
    }

    /// Returns the points of the extent, transformed by `shrink`.
    pub(super) fn points(&self, shrink: &DAffine3) -> Vec<Vec3A> {
        self.points.iter().map(|point| shrink.transform_point3(*point).as_vec3a()).collect()
    }
}
