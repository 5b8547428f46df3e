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
        if let [ring] = face.rings.as_slice() {
            match ring.as_slice() {
                [a, b, c] => return Ok(vec![[*a, *b, *c]]),
                [a, b, c, d] => {
                    if let Some(pair) = self.halves([*a, *b, *c, *d]) {
                        return Ok(pair.to_vec());
                    }
                }
                _ => {}
            }
        }
        let normal = self.normal(face);
        if normal == DVec3::ZERO {
            return Ok(Vec::new());
        }
        let axes = Scope::face_axes(normal, glam::DMat3::IDENTITY);
        let numbers: Vec<u32> = face.rings.iter().flatten().copied().collect();
        let polygon = Polygon::new(self.flat_rings(face, axes, self.at(numbers[0])))?;
        let triangles = polygon.triangles()?;
        Ok(triangles.into_iter().map(|corners| corners.map(|corner| numbers[corner])).collect())
    }

    /// Returns the halves of a convex quadrilateral, divided by its shorter diagonal; `None` if it is not convex.
    fn halves(&self, ring: [u32; 4]) -> Option<[[u32; 3]; 2]> {
        let [a, b, c, d] = ring.map(|point| self.at(point));
        let normal = (c - a).cross(d - b);
        let turns = [[d, a, b], [a, b, c], [b, c, d], [c, d, a]];
        let is_convex = turns.iter().all(|[from, at, to]| {
            let turn = (*at - *from).cross(*to - *at);
            turn.dot(normal) > 1e-9 * turn.length_squared().max(normal.length_squared()) * 1e-3
        });
        let [p, q, r, s] = ring;
        is_convex.then(|| {
            if a.distance_squared(c) <= b.distance_squared(d) {
                [[p, q, r], [p, r, s]]
            } else {
                [[p, q, s], [q, r, s]]
            }
        })
    }
}
