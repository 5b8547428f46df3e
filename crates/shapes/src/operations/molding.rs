//! Profiles swept around the outline of a face.

use burgeon_base::Stop;
use burgeon_base::error::{Error, Result};
use burgeon_geometry::planar::twice_area;
use glam::{DVec2, DVec3};

use crate::Shape;
use crate::mesh::PolygonMeshBuilder;
use crate::style::FaceStyle;

/// Largest extension of a mitred corner, as a multiple of the distance from the outline.
const MITRE: f64 = 8.0;

impl Shape {
    /// Returns the solid that a closed profile sweeps around all rings of a face, with mitred corners: a cornice or a
    /// frame. Also returns the numbers (from 0) of the edges that are too short for the profile, so that the solid crosses itself.
    ///
    /// Points of the profile are a distance (m) outwards from the outline and a height (m) along the face's normal, in
    /// any direction. Faces have the tag "molding". Fails unless the shape is one face, and if the profile has no area.
    pub fn molding(&self, profile: &[DVec2]) -> Result<(Self, Vec<usize>)> {
        let (polygon, frame) = self.single_face("molding")?;
        let area = twice_area(profile.iter().copied());
        if profile.len() < 3 || area.abs() < 1e-12 || profile.iter().any(|at| !at.is_finite()) {
            return Err(Error::argument("the profile of a molding encloses no area")
                .help("give at least three points { outwards, up }"));
        }
        let mut profile = profile.to_vec();
        if area < 0.0 {
            profile.reverse();
        }
        let own = self.styles().into_iter().next().flatten();
        let style = FaceStyle::with_automatic_tag(&own, "molding");
        let mut builder = PolygonMeshBuilder::default();
        let (mut crossing, mut first) = (Vec::new(), 0);
        for ring in &polygon {
            Stop::check_current()?;
            let count = ring.len();
            let corner = |index: usize| -> Vec<DVec3> {
                let [before, at, after] =
                    [index + count - 1, index, index + 1].map(|index| ring[index % count]);
                let outward = mitre(at - before, after - at);
                let point = |offset: &DVec2| frame.point((at + outward * offset.x).extend(offset.y));
                profile.iter().map(point).collect()
            };
            let corners: Vec<Vec<DVec3>> = (0..count).map(corner).collect();
            for index in 0..count {
                let (from, to) = (&corners[index], &corners[(index + 1) % count]);
                let along = frame.axes * (ring[(index + 1) % count] - ring[index]).extend(0.0);
                let turns_back = |point: usize| (to[point] - from[point]).dot(along) <= 0.0;
                if (0..profile.len()).any(turns_back) {
                    crossing.push(first + index);
                }
                for point in 0..profile.len() {
                    let next = (point + 1) % profile.len();
                    let [a, b, c, d] = [from[point], to[point], to[next], from[next]];
                    if turns_back(point) == turns_back(next) {
                        builder.face([[a, b, c, d].as_slice()], &style);
                    } else {
                        builder.face([[a, b, c].as_slice()], &style);
                        builder.face([[a, c, d].as_slice()], &style);
                    }
                }
            }
            first += count;
        }
        Ok((Self::of_mesh(builder.build(), frame.axes), crossing))
    }

    /// Returns the solid between a face and another one with as many corners: the first corner of one is joined to the
    /// first of the other. Sides that are not flat become triangles, with the tag "loft.side". Projections of the other
    /// face stay on it.
    ///
    /// Fails unless both shapes are one face, and if their numbers of rings or corners differ.
    pub fn loft(&self, other: &Self) -> Result<Self> {
        let (own, others) = (self.mesh(), other.mesh());
        let ([one], [two]) = (own.faces.as_slice(), others.faces.as_slice()) else {
            return Err(Error::argument("a loft takes two faces").help("use faces: shape:faces(\"top\")[1]"));
        };
        let lengths = |rings: &[Vec<u32>]| rings.iter().map(Vec::len).collect::<Vec<_>>();
        if lengths(&one.rings) != lengths(&two.rings) {
            let (a, b) = (one.edges().count(), two.edges().count());
            return Err(Error::argument(format!("a loft takes faces with as many corners, not {a} and {b}"))
                .help("add corners to one of them"));
        }
        let towards = other.centroid() - self.centroid();
        let (normal, other_normal) = (own.normal(one), others.normal(two));
        if normal.dot(towards) <= 0.0 || other_normal.dot(towards) <= 0.0 {
            return Err(Error::geometry(
                "the faces of a loft do not look in the direction from the first to the second",
            )
            .help("turn a face with shape:reverse(), or swap the faces"));
        }
        let style = |tag: &'static str| FaceStyle::with_automatic_tag(&one.style, tag);
        let [bottom, side, mut top] = ["loft.bottom", "loft.side", "loft.top"].map(style);
        if two.style.as_deref().is_some_and(FaceStyle::is_projected) {
            top = FaceStyle::with_projections_of(&top, &two.style);
        }
        let mut builder = PolygonMeshBuilder::default();
        let places = |ring: &Vec<u32>, mesh: &crate::PolygonMesh| -> Vec<DVec3> {
            ring.iter().map(|point| mesh.at(*point)).collect()
        };
        let low: Vec<Vec<DVec3>> = one.rings.iter().map(|ring| places(ring, &own)).collect();
        let high: Vec<Vec<DVec3>> = two.rings.iter().map(|ring| places(ring, &others)).collect();
        let below: Vec<Vec<DVec3>> = low.iter().map(|ring| ring.iter().rev().copied().collect()).collect();
        builder.face(below.iter().map(Vec::as_slice), &bottom);
        for (low, high) in low.iter().zip(&high) {
            for index in 0..low.len() {
                let next = (index + 1) % low.len();
                let [a, b, c, d] = [low[index], low[next], high[next], high[index]];
                if (b - a).cross(c - a).dot(d - a).abs() <= 1e-9 * (c - a).length().powi(3) {
                    builder.face([[a, b, c, d].as_slice()], &side);
                } else {
                    builder.face([[a, b, c].as_slice()], &side);
                    builder.face([[a, c, d].as_slice()], &side);
                }
            }
        }
        builder.face(high.iter().map(Vec::as_slice), &top);
        Ok(Self::of_mesh(builder.build(), self.scope().axes))
    }
}

/// Returns the offset of a corner whose edges both move outwards, to the right, by 1 m.
fn mitre(before: DVec2, after: DVec2) -> DVec2 {
    let right = |along: DVec2| -along.normalize_or_zero().perp();
    let (one, other) = (right(before), right(after));
    let sum = one + other;
    let offset = if sum.length_squared() > 1e-12 { sum * (2.0 / sum.length_squared()) } else { one };
    offset.clamp_length_max(MITRE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_molding_around_a_rectangle_has_the_volume_of_its_mitred_bars() {
        let face = Shape::rectangle(DVec2::new(6.0, 4.0));
        let square = [(0.0, 0.0), (0.5, 0.0), (0.5, 0.2), (0.0, 0.2)].map(DVec2::from);
        let (frame, crossing) = face.molding(&square).expect("a frame");
        assert!(frame.is_closed() && crossing.is_empty());
        assert!((frame.volume() - (7.0 * 5.0 - 24.0) * 0.2).abs() < 1e-9, "{}", frame.volume());
    }

    #[test]
    fn edges_that_are_shorter_than_their_molding_are_reported_and_can_be_drawn() {
        let face = Shape::rectangle(DVec2::new(6.0, 4.0));
        let wide = [(0.0, 0.0), (-2.5, 0.0), (-2.5, 1.0), (0.0, 1.0)].map(DVec2::from);
        let (frame, crossing) = face.molding(&wide).expect("a frame");
        assert_eq!(crossing, [1, 3]);
        let mesh = frame.mesh();
        assert!(frame.is_closed() && mesh.faces.iter().all(|face| mesh.triangles(face).is_ok()));
    }

    #[test]
    fn a_loft_between_a_square_and_a_turned_square_is_closed() {
        let face = Shape::rectangle(DVec2::new(2.0, 2.0));
        let other = face.rotate(face.scope().center(), DVec3::Z, 0.4).translate(DVec3::Z * 3.0);
        let solid = face.loft(&other).expect("a loft");
        assert!(solid.is_closed() && solid.body.faces() == 10, "{}", solid.body.faces());
        let straight = face.loft(&face.translate(DVec3::Z * 3.0)).expect("a loft");
        assert!((straight.volume() - 12.0).abs() < 1e-9);
        assert!(other.loft(&face).is_err());
    }
}
