//! Normals of faces that are drawn smooth across their edges.

use burgeon_shapes::PolygonMesh;
use glam::DVec3;
use smallvec::SmallVec;

/// Faces around each point of a mesh.
pub(super) struct SmoothNormals {
    around: Vec<SmallVec<[u32; 6]>>,
}

impl SmoothNormals {
    /// Finds the smooth faces around each point; `None` if no face is drawn smooth.
    #[allow(clippy::cast_possible_truncation, reason = "a mesh has fewer than 2^32 faces")]
    pub(super) fn of(mesh: &PolygonMesh) -> Option<Self> {
        let smooth =
            mesh.faces.iter().map(|face| face.style.as_deref().is_some_and(|style| style.smooth.is_some()));
        let smooth: Vec<bool> = smooth.collect();
        if !smooth.contains(&true) {
            return None;
        }
        let mut around: Vec<SmallVec<[u32; 6]>> = vec![SmallVec::new(); mesh.points.len()];
        for (number, face) in mesh.faces.iter().enumerate().filter(|(number, _)| smooth[*number]) {
            face.rings.iter().flatten().for_each(|point| around[*point as usize].push(number as u32));
        }
        Some(Self { around })
    }

    /// Returns the normal of a face at one of its points: the mean of the faces around the point that turn by at most the angle
    /// of the face, by their areas. `None` if the face is flat.
    pub(super) fn at(&self, mesh: &PolygonMesh, face: usize, point: u32) -> Option<DVec3> {
        let angle = mesh.faces[face].style.as_deref()?.smooth?;
        let own = mesh.normal(&mesh.faces[face]);
        let near =
            self.around[point as usize].iter().map(|other| mesh.area_vector(&mesh.faces[*other as usize]));
        let near = near.filter(|other| own.angle_between(*other) <= angle + 1e-9);
        near.sum::<DVec3>().try_normalize()
    }
}

#[cfg(test)]
mod tests {
    use burgeon_shapes::{FaceStyle, Shape};

    use super::*;

    #[test]
    fn sides_of_a_cylinder_are_smooth_and_its_rim_is_sharp() {
        let solid = Shape::cylinder(1.0, 1.0, 2.0, 16).expect("a cylinder");
        assert!(SmoothNormals::of(&solid.mesh()).is_none());
        let solid = solid.with_styles(|style| FaceStyle::with_smooth(style, 0.7));
        let mesh = solid.mesh();
        let normals = SmoothNormals::of(&mesh).expect("smooth faces");
        for (number, face) in mesh.faces.iter().enumerate() {
            let is_side = mesh.normal(face).z.abs() < 0.5;
            for point in face.rings.iter().flatten() {
                let normal = normals.at(&mesh, number, *point).expect("a normal");
                let radial = mesh.at(*point).truncate().extend(0.0).normalize();
                let wanted = if is_side { radial } else { mesh.normal(face) };
                assert!((normal - wanted).length() < 1e-9, "{normal} {wanted}");
            }
        }
    }
}
