//! Extent of scenes, so that several renders can share a camera.

use super::points;
use burgeon_scene::Upright;
use glam::{DAffine3, DMat3, DVec2, DVec3, Vec3A};

/// Minimum number of points of a ring around the axis of a turning scene.
const RING: usize = 72;

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

    /// Returns the points (m).
    pub(super) fn all(&self) -> &[DVec3] {
        &self.points
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

    /// Returns true if the scenes show nothing.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// Returns the extent of the scenes while they turn around the vertical axis through their centre, or through
    /// `center` (m), in `count` steps. Up is z unless `upright` is given.
    ///
    /// Cameras with the same elevation that see this extent keep their distance to the axis.
    #[must_use]
    pub fn revolved(&self, upright: Option<Upright>, center: Option<DVec3>, count: usize) -> Self {
        let turn = upright.map_or(DMat3::IDENTITY, |upright| upright.rotation());
        let (middle, _) = self.sphere(turn);
        let middle = center.map_or(middle, |center| turn * center);
        // A multiple of the steps, so that the points are the same after each of them.
        let steps = count.max(1) * RING.div_ceil(count.max(1));
        // Only the outermost points at each height matter.
        let mut rings: Vec<DVec2> = self
            .points
            .iter()
            .map(|point| turn * *point)
            .map(|point| DVec2::new((point - middle).truncate().length(), point.z))
            .collect();
        rings.sort_by(|a, b| b.x.total_cmp(&a.x).then(a.y.total_cmp(&b.y)));
        let mut kept: Vec<DVec2> = Vec::new();
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for ring in rings.into_iter().filter(|ring| ring.is_finite()) {
            if ring.y < low || ring.y > high {
                (low, high) = (low.min(ring.y), high.max(ring.y));
                kept.push(ring);
            }
        }
        let back = turn.transpose();
        let points = (0..steps).flat_map(|step| {
            let (sin, cos) = (step as f64 * std::f64::consts::TAU / steps as f64).sin_cos();
            let middle = middle.with_z(0.0);
            kept.iter().map(move |ring| back * (middle + DVec3::new(ring.x * cos, ring.x * sin, ring.y)))
        });
        Self { points: points.collect() }
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
