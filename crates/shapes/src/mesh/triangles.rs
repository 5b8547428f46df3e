//! Triangles of faces.

use burgeon_base::error::Result;
use burgeon_geometry::Polygon;
use glam::DVec3;

use super::{PolygonFace, PolygonMesh};
use crate::Scope;

impl PolygonMesh {
    /// Returns the triangles of a face as point numbers, counter-clockwise seen from outside.
    ///
    /// Every edge of a ring belongs to one triangle. Fails if the face is too narrow at some point.
    pub fn triangles(&self, face: &PolygonFace) -> Result<Vec<[u32; 3]>> {
        let mut triangles = self.corner_triangles(face)?;
        if let [ring] = face.rings.as_slice() {
            triangles.iter_mut().flatten().for_each(|corner| *corner = ring[*corner as usize]);
        } else {
            let numbers: Vec<u32> = face.rings.iter().flatten().copied().collect();
            triangles.iter_mut().flatten().for_each(|corner| *corner = numbers[*corner as usize]);
        }
        Ok(triangles)
    }

    /// Returns the triangles of a face like [`Self::triangles`], as numbers of corners: those of all rings, one ring after the other.
    pub fn corner_triangles(&self, face: &PolygonFace) -> Result<Vec<[u32; 3]>> {
        if let [ring] = face.rings.as_slice() {
            match ring.as_slice() {
                [_, _, _] => return Ok(vec![[0, 1, 2]]),
                [a, b, c, d] => {
                    if let Some(pair) = self.halves([*a, *b, *c, *d]) {
                        return Ok(pair.to_vec());
                    }
                }
                _ => {}
            }
        }
        let normal = self.normal(face);
        let first = face.rings.first().and_then(|ring| ring.first());
        let (false, Some(&first)) = (normal == DVec3::ZERO, first) else { return Ok(Vec::new()) };
        let axes = Scope::face_axes(normal, glam::DMat3::IDENTITY);
        let polygon = Polygon::new(self.flat_rings(face, axes, self.at(first)))?;
        let number = |corner: usize| u32::try_from(corner).unwrap_or(u32::MAX);
        Ok(polygon.triangles()?.into_iter().map(|corners| corners.map(number)).collect())
    }

    /// Returns true if all faces can be filled with triangles.
    pub(crate) fn is_fillable(&self) -> bool {
        self.faces.iter().all(|face| self.is_face_fillable(face))
    }

    /// Returns true if a face can be filled with triangles.
    pub(crate) fn is_face_fillable(&self, face: &PolygonFace) -> bool {
        matches!(face.rings.as_slice(), [ring] if ring.len() == 3)
            || self.corner_triangles(face).is_ok_and(|triangles| !triangles.is_empty())
    }

    /// Returns the halves of a convex quadrilateral, divided by its shorter diagonal, as numbers of its corners; `None` if it is not
    /// convex.
    fn halves(&self, ring: [u32; 4]) -> Option<[[u32; 3]; 2]> {
        let [a, b, c, d] = ring.map(|point| self.at(point));
        let normal = (c - a).cross(d - b);
        let turns = [[d, a, b], [a, b, c], [b, c, d], [c, d, a]];
        let is_convex = turns.iter().all(|[from, at, to]| {
            let turn = (*at - *from).cross(*to - *at);
            turn.dot(normal) > 1e-9 * turn.length_squared().max(normal.length_squared()) * 1e-3
        });
        let halves = if a.distance_squared(c) <= b.distance_squared(d) {
            [[0, 1, 2], [0, 2, 3]]
        } else {
            [[0, 1, 3], [1, 2, 3]]
        };
        is_convex.then_some(halves)
    }
}
