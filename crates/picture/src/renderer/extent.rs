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
