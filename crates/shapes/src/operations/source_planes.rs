//! Check that the triangles of a set operation lie in the faces that they come from.

use glam::DVec3;

use crate::mesh::{PolygonFace, PolygonMesh};

/// Distance (m) from the plane of a flat face within which points lie in it.
const NEAR: f64 = 1e-6;

/// Plane of a face of a solid.
#[derive(Debug, Clone, Copy)]
pub(super) struct SourcePlane {
    /// Normal; 0 if the face has no area.
    normal: DVec3,
    /// Distance (m) from the origin.
    offset: f64,
    /// Distance (m) from the plane within which points of the face lie.
    thickness: f64,
}

impl SourcePlane {
    /// Creates the plane of a face of a mesh, relative to `center` (m).
    pub(super) fn of_face(mesh: &PolygonMesh, face: &PolygonFace, center: DVec3) -> Self {
        let normal = mesh.normal(face);
        let distances = || face.rings.iter().flatten().map(|point| normal.dot(mesh.at(*point) - center));
        let low = distances().fold(f64::INFINITY, f64::min);
        let high = distances().fold(f64::NEG_INFINITY, f64::max);
        Self { normal, offset: low.midpoint(high), thickness: high - low + NEAR }
    }

    /// Returns true if a triangle lies in the plane, and faces along the normal or against it (`reversed`).
    ///
    /// The direction of a triangle that is thinner than the plane is uncertain.
    pub(super) fn has_triangle(&self, [a, b, c]: [DVec3; 3], reversed: bool) -> bool {
        if self.normal == DVec3::ZERO {
            return true;
        }
        let is_near = |at: DVec3| (self.normal.dot(at) - self.offset).abs() <= self.thickness;
        if ![a, b, c].into_iter().all(is_near) {
            return false;
        }
        let doubled = (b - a).cross(c - a).dot(self.normal) * if reversed { -1.0 } else { 1.0 };
        let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a)).sqrt();
        doubled >= -longest * self.thickness
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Shape;

    #[test]
    fn a_triangle_off_the_plane_or_with_the_other_direction_is_refused() {
        let cube = Shape::cuboid(DVec3::splat(2.0));
        let mesh = cube.mesh();
        let center = DVec3::ONE;
        let top = mesh.faces.iter().find(|face| mesh.normal(face).z > 0.5).expect("a top");
        let plane = SourcePlane::of_face(&mesh, top, center);
        let [a, b, c] = [DVec3::new(0.0, 0.0, 1.0), DVec3::new(1.0, 0.0, 1.0), DVec3::new(0.0, 1.0, 1.0)];
        assert!(plane.has_triangle([a, b, c], false) && plane.has_triangle([a, c, b], true));
        assert!(!plane.has_triangle([a, c, b], false) && !plane.has_triangle([a, b, c], true));
        assert!(!plane.has_triangle([a, b, c - DVec3::Z * 0.001], false));
        assert!(plane.has_triangle([a, b, c - DVec3::Z * 1e-8], false));
    }
}
