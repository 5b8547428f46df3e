//! Texture coordinates by projection.

use std::sync::Arc;

use glam::{DAffine3, DVec2, DVec3};

use crate::Shape;
use crate::style::{FaceStyle, SharedStyle};

/// A projection of positions to texture coordinates, in tiles: repetitions of the image.
///
/// ```
/// use burgeon_shapes::{Shape, UvMap};
/// use glam::{DVec2, DVec3};
///
/// let wall = Shape::rectangle(DVec2::new(6.0, 3.0));
/// let map = UvMap::of_plane(&wall.scope, [0, 1], DVec2::new(2.0, 1.5));
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
    pub fn of_plane(scope: &crate::Scope, [u, v]: [usize; 2], tile: DVec2) -> Self {
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
    fn transform(&self, frame: &DAffine3) -> Self {
        let turn = frame.matrix3.inverse().transpose();
        Self {
            origin: frame.transform_point3(self.origin),
            u: turn * self.u,
            v: turn * self.v,
            offset: self.offset,
        }
    }
}

impl Shape {
    /// Returns the shape with a projection of texture coordinates on all faces.
    #[must_use]
    pub fn project(&self, map: UvMap) -> Self {
        self.with_styles(|style| {
            let own = style.as_deref().cloned().unwrap_or_default();
            Some(Arc::new(FaceStyle { uv: Some(map), ..own }))
        })
    }

    /// Returns the moved shape with its projections moved, too.
    #[must_use]
    pub(crate) fn with_uv_moved(self, frame: &DAffine3) -> Self {
        let has_map = |style: &SharedStyle| style.as_deref().is_some_and(|own| own.uv.is_some());
        let any = match &self.body {
            crate::ShapeBody::Box(styles) => {
                styles.as_deref().is_some_and(|styles| styles.iter().any(has_map))
            }
            crate::ShapeBody::Rectangle(style) | crate::ShapeBody::Edge(_, style) => has_map(style),
            crate::ShapeBody::Mesh(mesh) => mesh.faces.iter().any(|face| has_map(&face.style)),
        };
        if !any {
            return self;
        }
        self.with_styles(|style| {
            let own = style.as_deref()?;
            let Some(map) = own.uv else { return style.clone() };
            Some(Arc::new(FaceStyle { uv: Some(map.transform(frame)), ..own.clone() }))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{PartSize, PartSizes, SizedParts, SplitAxis};

    #[test]
    fn coordinates_stay_on_a_face_that_is_cut_and_moved() {
        let wall = Shape::rectangle(DVec2::new(6.0, 3.0));
        let wall = wall.project(UvMap::of_plane(&wall.scope, [0, 1], DVec2::new(2.0, 1.5)).rotate(0.3));
        let map = |shape: &Shape| shape.styles()[0].as_ref().and_then(|style| style.uv).expect("a map");
        let corner = wall.scope.point(wall.scope.size);
        let before = map(&wall).at(corner);
        let sizes = PartSizes(vec![SizedParts::Repeated(vec![PartSize::Flexible(1.0)])]);
        let part = &wall.split(SplitAxis::X, &sizes).expect("parts").parts[5].1;
        let frame = DAffine3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 1.1);
        let moved = part.translate(DVec3::new(1.0, 2.0, 3.0)).transform(&frame);
        let there = moved.scope.point(moved.scope.size);
        assert!((map(&moved).at(there) - before).length() < 1e-12);
        let wide = part.resize(DVec3::new(2.0, 3.0, 0.0)).expect("wider");
        let end = wide.scope.point(wide.scope.size);
        assert!((map(&wide).at(end) - before).length() < 1e-12, "a stretched face stretches its image");
    }

    #[test]
    fn a_rotated_image_keeps_the_size_of_its_tiles() {
        let scope = Shape::rectangle(DVec2::ONE).scope;
        let map = UvMap::of_plane(&scope, [0, 1], DVec2::new(2.0, 4.0)).rotate(std::f64::consts::FRAC_PI_2);
        // After a quarter turn, u runs upwards in tiles of 2 m.
        assert!((map.at(DVec3::new(0.0, 2.0, 0.0)) - DVec2::X).length() < 1e-12);
        assert!((map.at(DVec3::new(-4.0, 0.0, 0.0)) - DVec2::Y).length() < 1e-12);
        assert!(map.shows(DVec3::Z) && !map.shows(DVec3::X));
    }
}
