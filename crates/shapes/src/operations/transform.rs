//! Moved, turned, scaled and mirrored shapes.

use std::sync::Arc;

use burgeon_base::error::{Error, Result};
use glam::{DAffine3, DMat3, DVec3};

use crate::{Scope, Shape, ShapeBody};

impl Shape {
    /// Returns the shape moved by `offset` (m).
    #[must_use]
    pub fn translate(&self, offset: DVec3) -> Self {
        let scope = Scope { origin: self.scope().origin + offset, ..self.scope() };
        let body = match &self.body {
            ShapeBody::Mesh(mesh) => ShapeBody::Mesh(Arc::new(mesh.translate(|at| at + offset, false))),
            other => other.clone(),
        };
        let frame = DAffine3::from_translation(offset);
        Self::new(scope, body).with_trim_moved(self, &frame).with_uv_moved(&frame)
    }

    /// Returns the shape rotated by `angle` (radians) around an axis through `center` (m).
    #[must_use]
    pub fn rotate(&self, center: DVec3, axis: DVec3, angle: f64) -> Self {
        let turn = DMat3::from_axis_angle(axis, angle);
        let place = |at: DVec3| center + turn * (at - center);
        let scope = Scope {
            origin: place(self.scope().origin),
            axes: turn * self.scope().axes,
            size: self.scope().size,
        };
        let body = match &self.body {
            ShapeBody::Mesh(mesh) => ShapeBody::Mesh(Arc::new(mesh.translate(place, false))),
            other => other.clone(),
        };
        let frame = DAffine3::from_mat3_translation(turn, place(DVec3::ZERO));
        Self::new(scope, body).with_trim_moved(self, &frame).with_uv_moved(&frame)
    }

    /// Returns the shape with a scope of another size (m), scaled from the scope's origin. An extent of 0 stays 0.
    ///
    /// Fails if a size is not above 0.
    pub fn resize(&self, size: DVec3) -> Result<Self> {
        let old = self.scope().size;
        let mut factor = DVec3::ONE;
        for axis in 0..3 {
            if old[axis] > 0.0 {
                if !(size[axis] > 0.0 && size[axis].is_finite()) {
                    let name = ["x", "y", "z"][axis];
                    return Err(Error::argument(format!("the size along {name} is {} m", size[axis]))
                        .help("use sizes above 0"));
                }
                factor[axis] = size[axis] / old[axis];
            }
        }
        let scope = self.scope().with_size(old * factor);
        let body = match &self.body {
            ShapeBody::Mesh(mesh) => {
                let scaled = mesh.translate(|at| self.scope().point(self.scope().local(at) * factor), false);
                ShapeBody::Mesh(Arc::new(scaled))
            }
            other => other.clone(),
        };
        let stretch = self.scope().axes * DMat3::from_diagonal(factor) * self.scope().axes.transpose();
        let frame =
            DAffine3::from_mat3_translation(stretch, self.scope().origin - stretch * self.scope().origin);
        Ok(Self::new(scope, body).with_trim_moved(self, &frame).with_uv_moved(&frame))
    }

    /// Returns the shape moved by a transformation that keeps angles and lengths.
    #[must_use]
    pub fn transform(&self, frame: &DAffine3) -> Self {
        let mirrors = frame.matrix3.determinant() < 0.0;
        let mesh = self.mesh().translate(|at| frame.transform_point3(at), mirrors);
        Self::of_mesh(mesh, if mirrors { self.scope().axes } else { frame.matrix3 * self.scope().axes })
            .with_trim_moved(self, frame)
            .with_uv_moved(frame)
    }

    /// Returns the shape mirrored at the plane through `point` (m) with a unit normal.
    #[must_use]
    pub fn mirror(&self, point: DVec3, normal: DVec3) -> Self {
        let place = |at: DVec3| at - normal * (2.0 * normal.dot(at - point));
        let turn = DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::Z)
            - DMat3::from_cols(normal * normal.x, normal * normal.y, normal * normal.z) * 2.0;
        let frame = DAffine3::from_mat3_translation(turn, place(DVec3::ZERO));
        Self::of_mesh(self.mesh().translate(place, true), self.scope().axes)
            .with_trim_moved(self, &frame)
            .with_uv_moved(&frame)
    }

    /// Returns the shape with reversed faces.
    #[must_use]
    pub fn reverse(&self) -> Self {
        let mesh = self.mesh().translate(|at| at, true);
        // The z axis of a face stays outwards.
        let axes = match mesh.faces.as_slice() {
            [face] => Scope::face_axes(mesh.normal(face), self.scope().axes),
            _ => self.scope().axes,
        };
        Self::of_mesh(mesh, axes)
    }

    /// Returns the shape with a scope of other axes around it.
    #[must_use]
    pub fn align(&self, axes: DMat3) -> Self {
        match &self.body {
            ShapeBody::Edge(..) => self.clone(),
            _ => Self::of_mesh(self.mesh().into_owned(), axes).with_trim_of(self),
        }
    }
}
