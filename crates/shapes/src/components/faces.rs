//! Faces and holes as shapes.

use std::sync::Arc;

use burgeon_base::{MemoryOwner, error::Result};
use glam::DVec3;

use crate::mesh::PolygonMesh;
use crate::{Scope, Selector, Shape, ShapeBody};

impl Shape {
    /// Returns the faces that a selector matches, in their order, each as a shape of its own.
    ///
    /// The scope of a face has x to the right, seen from outside, y up and z along the normal.
    ///
    /// ```
    /// use burgeon_shapes::{Selector, Shape};
    /// use glam::DVec3;
    ///
    /// let mass = Shape::cuboid(DVec3::new(10.0, 6.0, 3.0));
    /// let front = &mass.faces(&Selector::read("front")?)?[0];
    /// assert_eq!((front.scope().size, front.scope().axes.z_axis), (DVec3::new(10.0, 3.0, 0.0), -DVec3::Y));
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn faces(&self, selector: &Selector) -> Result<Vec<Self>> {
        let axes = &self.scope().axes;
        let source = self.trim_source();
        match &self.body {
            ShapeBody::Edge(..) => Ok(Vec::new()),
            ShapeBody::Rectangle(style) => {
                Ok(if selector.matches(axes.z_axis, style, axes) { vec![self.clone()] } else { Vec::new() })
            }
            ShapeBody::Box(_) | ShapeBody::Recess(_) => {
                let normals =
                    [-axes.z_axis, -axes.y_axis, axes.x_axis, axes.y_axis, -axes.x_axis, axes.z_axis];
                let outwards = if matches!(self.body, ShapeBody::Box(_)) { 1.0 } else { -1.0 };
                let quads = self.body.quads(&self.scope()).into_iter().flatten();
                let mut faces = Vec::with_capacity(normals.len());
                for (number, ((corners, style), normal)) in quads.zip(normals).enumerate() {
                    let (style, normal) = (style.clone(), normal * outwards);
                    if selector.matches(normal, &style, axes) {
                        let own = Scope::face_axes(normal, *axes);
                        let mut scope = Scope::around(own, corners);
                        scope.size.z = 0.0;
                        // A box that leans is not made of rectangles along these axes.
                        let is_upright = (scope.size.x * scope.size.y - face_area(self.scope().size, number))
                            .abs()
                            <= 1e-9 * (1.0 + scope.size.x * scope.size.y);
                        faces.push(if is_upright {
                            Self::new(scope, ShapeBody::Rectangle(style)).with_trim(source.as_ref(), number)
                        } else {
                            Self::of_mesh(self.mesh().select([number]), own)
                                .with_trim(source.as_ref(), number)
                        });
                    }
                }
                Ok(faces)
            }
            ShapeBody::Mesh(mesh) => {
                let normals: Vec<DVec3> = mesh.faces.iter().map(|face| mesh.normal(face)).collect();
                let selected = (0..mesh.faces.len())
                    .filter(|&face| selector.matches(normals[face], &mesh.faces[face].style, axes));
                let mut faces = Vec::new();
                for number in selected {
                    let own = Scope::face_axes(normals[number], *axes);
                    let face = match Self::of_rectangle(mesh, number, own) {
                        Some(rectangle) => rectangle,
                        None => {
                            let part = mesh.select([number]);
                            MemoryOwner::ensure_room(part.memory())?;
                            Self::of_mesh(part, own)
                        }
                    };
                    // The only face of a shape is the shape itself.
                    faces.push(if source.is_some() {
                        face.with_trim(source.as_ref(), number)
                    } else {
                        face.with_trim_of(self)
                    });
                }
                Ok(faces)
            }
        }
    }

    /// Returns all faces that a selector matches as one shape with the same axes; `None` if there are none.
    pub fn join_faces(&self, selector: &Selector) -> Option<Self> {
        let mesh = self.mesh();
        let axes = &self.scope().axes;
        let matching =
            |&face: &usize| selector.matches(mesh.normal(&mesh.faces[face]), &mesh.faces[face].style, axes);
        let part = mesh.select((0..mesh.faces.len()).filter(matching));
        (!part.faces.is_empty()).then(|| Self::of_mesh(part, *axes))
    }

    /// Returns the holes of all faces as faces that fill them.
    pub fn holes(&self) -> Vec<Self> {
        let ShapeBody::Mesh(mesh) = &self.body else { return Vec::new() };
        let mut holes = Vec::new();
        for face in &mesh.faces {
            for hole in face.rings.iter().skip(1) {
                let ring: Vec<DVec3> = hole.iter().rev().map(|point| mesh.at(*point)).collect();
                let mut builder = crate::mesh::PolygonMeshBuilder::default();
                builder.face([ring.as_slice()], &face.style);
                holes.push(Self::of_mesh(
                    builder.build(),
                    Scope::face_axes(mesh.normal(face), self.scope().axes),
                ));
            }
        }
        holes
    }

    /// Returns the faces without their holes.
    #[must_use]
    pub fn without_holes(&self) -> Self {
        let ShapeBody::Mesh(mesh) = &self.body else { return self.clone() };
        let mut filled = (**mesh).clone();
        filled.faces.iter_mut().for_each(|face| face.rings.truncate(1));
        let count = filled.faces.len();
        let filled = PolygonMesh::new(filled.points, filled.faces).select(0..count);
        Self { scope: self.scope.clone(), body: ShapeBody::Mesh(Arc::new(filled)), trim: self.trim.clone() }
    }
}

/// Returns the area (m²) of a face of a box.
fn face_area(size: DVec3, number: usize) -> f64 {
    match number {
        0 | 5 => size.x * size.y,
        1 | 3 => size.x * size.z,
        _ => size.y * size.z,
    }
}
