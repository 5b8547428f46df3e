//! Holes in faces.

use burgeon_base::error::{Error, Result};
use burgeon_geometry::overlay::{overlay, unite};
use burgeon_geometry::{Polygon, Rings};
use glam::DVec2;

use crate::mesh::PolygonMeshBuilder;
use crate::{Scope, Shape};

/// Share of an area that is a rounding error.
const NOTHING: f64 = 1e-9;

/// Area of a hole.
#[derive(Debug, Clone, Copy)]
pub enum HoleOutline<'a> {
    /// Rings in the scope of the face: x to the right and y upwards from its corner (m).
    Rings(&'a [Vec<DVec2>]),
    /// Projection of a shape along the normal of the face.
    Shape(&'a Shape),
}

/// A face with a hole.
#[derive(Debug)]
pub struct CutFace {
    /// Rest of the face; `None` if the hole covers it.
    pub rest: Option<Shape>,
    /// Set if the hole is beside the face, which is unchanged.
    pub is_beside: bool,
}

impl Shape {
    /// Cuts a hole in a face: the rest without the area of the hole, which may reach beyond the face.
    ///
    /// Fails unless the shape is one face, and if the outline crosses itself.
    pub fn cut_hole(&self, hole: HoleOutline<'_>) -> Result<CutFace> {
        let (polygon, frame) = self.single_face("cut_hole")?;
        let area = match hole {
            HoleOutline::Rings(rings) => {
                let local = Rings(rings.to_vec());
                let outline = Polygon::turned(local)?;
                crate::crossings::check_crossings(&outline)?;
                vec![Rings::from(&outline)]
            }
            HoleOutline::Shape(shape) => projection(shape, &frame)?,
        };
        let rest = overlay(&[Rings::from(&polygon)], &area, |[face, hole]| face && !hole)?;
        let parts: Vec<Polygon> = rest
            .into_iter()
            .filter_map(|rings| Polygon::turned(rings).ok())
            .filter(|part| part.area() > NOTHING * polygon.area())
            .collect();
        let left: f64 = parts.iter().map(Polygon::area).sum();
        if left >= polygon.area() * (1.0 - NOTHING) {
            return Ok(CutFace { rest: Some(self.clone()), is_beside: true });
        }
        if parts.is_empty() {
            return Ok(CutFace { rest: None, is_beside: false });
        }
        let style = self.styles().into_iter().next().flatten();
        let mut builder = PolygonMeshBuilder::default();
        for part in &parts {
            let rings: Vec<Vec<glam::DVec3>> =
                part.iter().map(|ring| ring.iter().map(|at| frame.point(at.extend(0.0))).collect()).collect();
            builder.face(rings.iter().map(Vec::as_slice), &style);
        }
        let rest = Self::of_mesh(builder.build(), frame.axes).with_trim_of(self);
        Ok(CutFace { rest: Some(rest), is_beside: false })
    }
}

/// Returns the area of the faces of a shape in the plane of a frame.
fn projection(shape: &Shape, frame: &Scope) -> Result<Vec<Rings<DVec2>>> {
    let mesh = shape.mesh();
    let flat = mesh.faces.iter().filter_map(|face| mesh.flat_polygon(face, frame.axes, frame.origin));
    let parts: Vec<Rings<DVec2>> = flat.map(|polygon| Rings::from(&polygon)).collect();
    if parts.is_empty() {
        return Err(Error::argument("the shape of the hole has no area on the face")
            .help("use a shape that is in front of the face, or an outline"));
    }
    unite(parts)
}

#[cfg(test)]
mod tests {
    use glam::{DMat3, DVec3};

    use super::*;
    use crate::components::selector::{FaceDirection, Selector};

    fn wall() -> Shape {
        Shape::cuboid(DVec3::new(6.0, 4.0, 3.0))
            .faces(&Selector::Own(FaceDirection::Front))
            .expect("faces")
            .remove(0)
    }

    fn square(x: f64, y: f64, size: f64) -> Vec<Vec<DVec2>> {
        vec![[(x, y), (x + size, y), (x + size, y + size), (x, y + size)].map(DVec2::from).to_vec()]
    }

    #[test]
    fn a_hole_has_its_area_and_its_place_in_the_scope_of_the_face() {
        let rest = wall()
            .cut_hole(HoleOutline::Rings(&square(1.0, 0.5, 1.5)))
            .expect("a face")
            .rest
            .expect("a rest");
        let mesh = rest.mesh();
        assert!((mesh.area() - (18.0 - 2.25)).abs() < 1e-9 && mesh.faces[0].rings.len() == 2);
        assert!(
            mesh.points.iter().any(|at| at.distance(DVec3::new(1.0, 0.0, 0.5)) < 1e-9),
            "{:?}",
            mesh.points
        );
        assert!(mesh.normal(&mesh.faces[0]).distance(DVec3::NEG_Y) < 1e-9);
        // A second hole, and one that reaches beyond the edge.
        let more =
            rest.cut_hole(HoleOutline::Rings(&square(4.0, 1.0, 1.0))).expect("a face").rest.expect("a rest");
        assert_eq!(more.mesh().faces[0].rings.len(), 3);
        let door =
            more.cut_hole(HoleOutline::Rings(&square(2.6, -1.0, 1.0))).expect("a face").rest.expect("a rest");
        assert!((door.mesh().area() - (18.0 - 2.25 - 1.0)).abs() < 1e-9);
    }

    #[test]
    fn a_solid_cuts_its_shadow_and_a_hole_can_divide_or_cover_a_face() {
        let ball = Shape::sphere(1.0, 32).expect("a ball");
        let moved = ball
            .transform(&glam::DAffine3::from_mat3_translation(DMat3::IDENTITY, DVec3::new(3.0, -5.0, 1.5)));
        let rest = wall().cut_hole(HoleOutline::Shape(&moved)).expect("a face").rest.expect("a rest");
        let shadow = 18.0 - rest.mesh().area();
        assert!((3.0..std::f64::consts::PI).contains(&shadow), "{shadow} m²");
        let slit = vec![[(2., -1.), (3., -1.), (3., 4.), (2., 4.)].map(DVec2::from).to_vec()];
        assert_eq!(
            wall()
                .cut_hole(HoleOutline::Rings(&slit))
                .expect("a face")
                .rest
                .expect("a rest")
                .mesh()
                .faces
                .len(),
            2
        );
        assert!(
            wall().cut_hole(HoleOutline::Rings(&square(-1.0, -1.0, 9.0))).expect("a face").rest.is_none()
        );
        assert!(wall().cut_hole(HoleOutline::Rings(&square(20.0, 1.0, 1.0))).expect("a face").is_beside);
        assert!(Shape::cuboid(DVec3::ONE).cut_hole(HoleOutline::Rings(&square(0.0, 0.0, 1.0))).is_err());
        let crossed = vec![[(0., 0.), (1., 1.), (1., 0.), (0., 1.)].map(DVec2::from).to_vec()];
        assert!(wall().cut_hole(HoleOutline::Rings(&crossed)).is_err());
    }
}
