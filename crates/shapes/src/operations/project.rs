//! Projections of texture coordinates on shapes.

use std::sync::Arc;

use glam::DAffine3;

use crate::style::{FaceStyle, SharedStyle};
use crate::{Shape, ShapeBody, UvMap};

impl Shape {
    /// Returns the shape with a projection of texture coordinates on all faces.
    #[must_use]
    pub fn project(&self, map: UvMap) -> Self {
        self.project_set(&Arc::default(), map)
    }

    /// Returns the shape with the projection of a set of texture coordinates on all faces: the named one, or the first one if the
    /// name is empty. All operations keep the sets of the faces that they cut, move or join.
    /// Faces that an operation adds to a face, as extrusions and tapers do, have its sets; faces of cuts and the sides of sweeps
    /// have none.
    ///
    /// ```
    /// use burgeon_shapes::{Shape, UvMap};
    /// use glam::{DVec2, DVec3};
    ///
    /// let wall = Shape::rectangle(DVec2::new(6.0, 3.0));
    /// let map = |size: f64| UvMap::of_plane(&wall.scope(), [0, 1], DVec2::splat(size));
    /// let wall = wall.project(map(1.0)).project_set(&"dirt".into(), map(3.0));
    /// let style = wall.styles()[0].clone().expect("a style");
    /// assert_eq!(style.set("dirt").map(|map| map.at(DVec3::new(6.0, 3.0, 0.0))), Some(DVec2::new(2.0, 1.0)));
    /// ```
    #[must_use]
    pub fn project_set(&self, set: &Arc<str>, map: UvMap) -> Self {
        self.with_styles(|style| FaceStyle::with_projection(style, set, map))
    }

    /// Returns the moved shape with its projections moved, too.
    #[must_use]
    pub(crate) fn with_uv_moved(self, frame: &DAffine3) -> Self {
        let has_map = |style: &SharedStyle| style.as_deref().is_some_and(FaceStyle::is_projected);
        let any = match &self.body {
            ShapeBody::Box(styles) => styles.as_deref().is_some_and(|styles| styles.iter().any(has_map)),
            ShapeBody::Recess(styles) => styles.iter().any(has_map),
            ShapeBody::Rectangle(style) | ShapeBody::Edge(_, style) => has_map(style),
            ShapeBody::Mesh(mesh) => mesh.faces.iter().any(|face| has_map(&face.style)),
        };
        if !any {
            return self;
        }
        self.with_styles(|style| FaceStyle::with_projections_moved(style, frame))
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use super::*;
    use crate::{PartSize, PartSizes, SizedParts, SplitAxis};

    #[test]
    fn coordinates_stay_on_a_face_that_is_cut_and_moved() {
        let wall = Shape::rectangle(DVec2::new(6.0, 3.0));
        let wall = wall.project(UvMap::of_plane(&wall.scope(), [0, 1], DVec2::new(2.0, 1.5)).rotate(0.3));
        let map = |shape: &Shape| shape.styles()[0].as_ref().and_then(|style| style.uv).expect("a map");
        let corner = wall.scope().point(wall.scope().size);
        let before = map(&wall).at(corner);
        let sizes = PartSizes(vec![SizedParts::Repeated(vec![PartSize::Flexible(1.0)])]);
        let part = &wall.split(SplitAxis::X, &sizes).expect("parts").parts[5].1;
        let frame = DAffine3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 1.1);
        let moved = part.translate(DVec3::new(1.0, 2.0, 3.0)).transform(&frame);
        let there = moved.scope().point(moved.scope().size);
        assert!((map(&moved).at(there) - before).length() < 1e-12);
        let wide = part.resize(DVec3::new(2.0, 3.0, 0.0)).expect("wider");
        let end = wide.scope().point(wide.scope().size);
        assert!((map(&wide).at(end) - before).length() < 1e-12, "a stretched face stretches its image");
    }

    #[test]
    fn all_sets_stay_on_faces_that_operations_cut_move_and_join() {
        let set: Arc<str> = "dirt".into();
        let solid = Shape::cuboid(DVec3::new(6.0, 4.0, 3.0));
        let map = |size: f64| UvMap::of_plane(&solid.scope(), [0, 2], DVec2::splat(size));
        let solid = solid.project(map(1.0)).project_set(&set, map(2.0));
        let tool = Shape::cuboid(DVec3::new(2.0, 9.0, 2.0)).translate(DVec3::new(1.0, -1.0, 1.0));
        let cut = solid
            .combine(&tool, crate::SolidOperation::Difference)
            .expect("no error")
            .solid
            .expect("a solid");
        let front =
            |shape: &Shape| shape.faces(&crate::Selector::read("front").expect("a selector")).expect("faces");
        let whole = SizedParts::Repeated(vec![PartSize::Flexible(1.0)]);
        let slices = solid.split(SplitAxis::X, &PartSizes(vec![whole])).expect("parts").parts;
        let slices: Vec<&Shape> = slices.iter().map(|(_, part)| part).collect();
        let joined = Shape::join(&slices).expect("no error").expect("a shape");
        for shape in [cut, joined.recompose().expect("a shape")] {
            let moved = shape.translate(DVec3::new(5.0, 6.0, 7.0));
            let face = front(&moved)[0].clone();
            let style = face.styles()[0].clone().expect("a style");
            let (first, second) =
                (style.uv.expect("the first set"), style.set("dirt").expect("the second set"));
            let place = DVec3::new(11.0, 6.0, 10.0);
            assert!((first.at(place) - DVec2::new(6.0, 3.0)).length() < 1e-9);
            assert!((second.at(place) - DVec2::new(3.0, 1.5)).length() < 1e-9);
        }
    }

    #[test]
    fn a_rotated_image_keeps_the_size_of_its_tiles() {
        let scope = Shape::rectangle(DVec2::ONE).scope();
        let map = UvMap::of_plane(&scope, [0, 1], DVec2::new(2.0, 4.0)).rotate(std::f64::consts::FRAC_PI_2);
        // After a quarter turn, u runs upwards in tiles of 2 m.
        assert!((map.at(DVec3::new(0.0, 2.0, 0.0)) - DVec2::X).length() < 1e-12);
        assert!((map.at(DVec3::new(-4.0, 0.0, 0.0)) - DVec2::Y).length() < 1e-12);
        assert!(map.shows(DVec3::Z) && !map.shows(DVec3::X));
    }
}
