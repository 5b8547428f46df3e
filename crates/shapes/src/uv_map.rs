//! Texture coordinates by projection.

use glam::{DAffine3, DVec2, DVec3};

use crate::Scope;

/// A projection of positions to texture coordinates, in tiles: repetitions of the image.
///
/// ```
/// use burgeon_shapes::{Shape, UvMap};
/// use glam::{DVec2, DVec3};
///
/// let wall = Shape::rectangle(DVec2::new(6.0, 3.0));
/// let map = UvMap::of_plane(&wall.scope(), [0, 1], DVec2::new(2.0, 1.5));
/// assert_eq!(map.at(DVec3::new(6.0, 3.0, 0.0)), DVec2::new(3.0, 2.0));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UvMap {
    /// Position (m) with the coordinates `offset`.
    pub origin: DVec3,
    /// Direction of u, as long as the number of tiles in a metre.
    pub u: DVec3,
    /// Direction of v, as long as the number of tiles in a metre.
    pub v: DVec3,
    /// Coordinates (tiles) at the origin.
    pub offset: DVec2,
}

impl UvMap {
    /// Creates the projection along the third axis of a scope: u along one of its axes, v along another one, with tiles of
    /// this size (m) from its corner.
    pub fn of_plane(scope: &Scope, [u, v]: [usize; 2], tile: DVec2) -> Self {
        let [u, v] = [scope.axes.col(u) / tile.x, scope.axes.col(v) / tile.y];
        Self { origin: scope.origin, u, v, offset: DVec2::ZERO }
    }

    /// Returns the coordinates (tiles) of a position (m).
    pub fn at(&self, place: DVec3) -> DVec2 {
        let from = place - self.origin;
        DVec2::new(from.dot(self.u), from.dot(self.v)) + self.offset
    }

    /// Returns the projection with the image rotated by `angle` (radians), counter-clockwise, around the origin.
    #[must_use]
    pub fn rotate(&self, angle: f64) -> Self {
        // The directions of the axes in metres, which turn; the sizes of tiles stay.
        let (width, height) = (self.u.length(), self.v.length());
        let (x, y) = (self.u / width, self.v / height);
        let (sin, cos) = angle.sin_cos();
        Self { u: (x * cos + y * sin) * width, v: (y * cos - x * sin) * height, ..*self }
    }

    /// Returns true if the projection gives an area to faces with this normal.
    pub fn shows(&self, normal: DVec3) -> bool {
        let along = self.u.cross(self.v);
        along.dot(normal).abs() > 0.05 * along.length()
    }

    /// Returns the projection after a movement of the shape.
    #[must_use]
    pub(crate) fn transform(&self, frame: &DAffine3) -> Self {
        let turn = frame.matrix3.inverse().transpose();
        Self {
            origin: frame.transform_point3(self.origin),
            u: turn * self.u,
            v: turn * self.v,
            offset: self.offset,
        }
    }
}
