//! Oriented boxes.

use glam::{DMat3, DVec3};

/// An oriented box: the coordinate system of a shape.
///
/// ```
/// use burgeon_shapes::Scope;
/// use glam::DVec3;
///
/// let scope = Scope { size: DVec3::new(4.0, 2.0, 3.0), ..Scope::default() };
/// assert_eq!((scope.center(), scope.local(DVec3::ONE)), (DVec3::new(2.0, 1.0, 1.5), DVec3::ONE));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scope {
    /// Corner with the least coordinates (m).
    pub origin: DVec3,
    /// Axes: orthonormal and right-handed.
    pub axes: DMat3,
    /// Extent along each axis (m); 0 along z for a face.
    pub size: DVec3,
}

impl Default for Scope {
    fn default() -> Self {
        Self { origin: DVec3::ZERO, axes: DMat3::IDENTITY, size: DVec3::ZERO }
    }
}

impl Scope {
    /// Creates the smallest box with these axes around `points` (m); empty at the origin without points.
    pub fn around(axes: DMat3, points: impl IntoIterator<Item = DVec3>) -> Self {
        let turn = axes.transpose();
        let mut bounds: Option<[DVec3; 2]> = None;
        for point in points {
            let at = turn * point;
            bounds = Some(bounds.map_or([at; 2], |[low, high]| [low.min(at), high.max(at)]));
        }
        let [low, high] = bounds.unwrap_or_default();
        Self { origin: axes * low, axes, size: high - low }
    }

    /// Returns the axes of a face with this normal, of a shape with these axes: x to the right seen from outside, y up
    /// and z along the normal. Horizontal faces keep the direction of the shape's x axis.
    pub fn face_axes(normal: DVec3, axes: DMat3) -> DMat3 {
        let right = DVec3::Z.cross(normal);
        let x = if right.length() > 1e-6 {
            right.normalize()
        } else {
            let along = axes.x_axis - normal * normal.dot(axes.x_axis);
            if along.length_squared() > 1e-12 { along.normalize() } else { normal.any_orthonormal_vector() }
        };
        DMat3::from_cols(x, normal.cross(x), normal)
    }

    /// Returns the position (m) of a point with local coordinates (m).
    #[inline]
    pub fn point(&self, local: DVec3) -> DVec3 {
        self.origin + self.axes * local
    }

    /// Returns the local coordinates (m) of a position (m).
    #[inline]
    pub fn local(&self, position: DVec3) -> DVec3 {
        self.axes.transpose() * (position - self.origin)
    }

    /// Returns the centre (m).
    pub fn center(&self) -> DVec3 {
        self.point(self.size / 2.0)
    }

    /// Returns the corners (m): x changes first, then y, then z.
    pub fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|index| {
            let bit = |axis: usize| if index >> axis & 1 == 1 { self.size[axis] } else { 0.0 };
            self.point(DVec3::new(bit(0), bit(1), bit(2)))
        })
    }

    /// Returns the part from `from` to `to` (m) along the axis with this index.
    #[must_use]
    pub fn slab(&self, axis: usize, [from, to]: [f64; 2]) -> Self {
        let mut size = self.size;
        size[axis] = to - from;
        Self { origin: self.origin + self.axes.col(axis) * from, size, axes: self.axes }
    }
}
