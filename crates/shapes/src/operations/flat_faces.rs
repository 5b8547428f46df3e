//! Removal of triangles without thickness.

use std::collections::VecDeque;

use burgeon_base::Stop;
use burgeon_base::error::Result;
use glam::DVec3;
use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use crate::mesh::PolygonMesh;

/// Largest thickness of a triangle without area, as a fraction of its longest edge.
const FLAT: f64 = 1e-9;
/// Largest number of changes for each triangle of the mesh.
const MOST_CHANGES: usize = 8;
/// Number of changes between two checks for cancellation.
const STRETCH: usize = 4096;

/// Removes triangles that are thinner than `near` (m), and pairs of opposite triangles, from a mesh of triangles. The corner on the
/// longest edge of a thin triangle becomes a corner of the neighbour there, which is divided into two triangles, so that a closed
/// mesh stays closed.
///
/// Fails if the work of this thread is cancelled.
pub(crate) fn remove_flat_triangles(mesh: &mut PolygonMesh, near: f64) -> Result<()> {
    let mut triangles: Vec<Option<[u32; 3]>> =
        mesh.faces.iter().map(|face| <[u32; 3]>::try_from(face.rings[0].as_slice()).ok()).collect();
    cancel_opposite(&mut triangles);
    let points = std::mem::take(&mut mesh.points);
    let is_flat = |triangle: [u32; 3]| is_thin(triangle.map(|point| points[point as usize]), near);
    let mut flat: VecDeque<usize> =
        (0..triangles.len()).filter(|&number| triangles[number].is_some_and(is_flat)).collect();
    let mut sides = TriangleSides::default();
    if !flat.is_empty() {
        triangles.iter().enumerate().for_each(|(number, triangle)| sides.add(number, *triangle));
    }
    let mut rest = MOST_CHANGES * triangles.len();
    while let Some(number) = flat.pop_front() {
        if rest.is_multiple_of(STRETCH) {
            Stop::check_current()?;
        }
        let Some(own) = triangles[number].filter(|own| is_flat(*own)) else { continue };
        if rest == 0 {
            break;
        }
        rest -= 1;
        let length =
            |side: usize| points[own[side] as usize].distance_squared(points[own[(side + 1) % 3] as usize]);
        let longest = (0..3).max_by(|a, b| length(*a).total_cmp(&length(*b))).unwrap_or(0);
        let [from, to, middle] = [0, 1, 2].map(|step| own[(longest + step) % 3]);
        let Some(neighbor) = sides.at([to, from], number) else { continue };
        let Some(other) = triangles[neighbor] else { continue };
        let Some(far) = other.into_iter().find(|point| *point != from && *point != to) else { continue };
        let [first, second] = match far == middle {
            true => [None, None],
            false => [Some([from, far, middle]), Some([far, to, middle])],
        };
        for (number, old, new) in [(number, own, first), (neighbor, other, second)] {
            sides.remove(number, old);
            triangles[number] = new;
            sides.add(number, new);
        }
        // The parts of the neighbour are like it.
        mesh.faces[number].style = mesh.faces[neighbor].style.clone();
        for (number, new) in [(number, first), (neighbor, second)] {
            if new.is_some_and(is_flat) {
                flat.push_back(number);
            }
        }
    }
    cancel_opposite(&mut triangles);
    let faces =
        std::mem::take(&mut mesh.faces).into_iter().zip(triangles).filter_map(|(mut face, triangle)| {
            face.rings[0].copy_from_slice(&triangle?);
            Some(face)
        });
    *mesh = PolygonMesh::new(points, faces.collect());
    Ok(())
}

/// Removes pairs of triangles with the same corners and opposite directions.
fn cancel_opposite(triangles: &mut [Option<[u32; 3]>]) {
    let mut known: FxHashMap<[u32; 3], SmallVec<[usize; 1]>> = FxHashMap::default();
    for number in 0..triangles.len() {
        let Some([a, b, c]) = triangles[number] else { continue };
        let [a, b, c] = if a < b && a < c {
            [a, b, c]
        } else if b < c {
            [b, c, a]
        } else {
            [c, a, b]
        };
        match known.get_mut(&[a, c, b]).and_then(SmallVec::pop) {
            Some(other) => (triangles[other], triangles[number]) = (None, None),
            None => known.entry([a, b, c]).or_default().push(number),
        }
    }
}

/// Returns true if a triangle is thinner than `near` (m), or than the rounding errors of its longest edge.
fn is_thin([a, b, c]: [DVec3; 3], near: f64) -> bool {
    let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
    (b - a).cross(c - a).length() <= (longest.sqrt() * near).max(longest * FLAT)
}

/// Triangles at each directed edge.
#[derive(Default)]
struct TriangleSides(FxHashMap<[u32; 2], SmallVec<[usize; 1]>>);

impl TriangleSides {
    fn add(&mut self, number: usize, triangle: Option<[u32; 3]>) {
        for [a, b] in triangle.into_iter().flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]) {
            self.0.entry([a, b]).or_default().push(number);
        }
    }

    fn remove(&mut self, number: usize, [a, b, c]: [u32; 3]) {
        for edge in [[a, b], [b, c], [c, a]] {
            if let Some(all) = self.0.get_mut(&edge) {
                all.retain(|known| *known != number);
            }
        }
    }

    /// Returns a triangle with this edge, other than `number`.
    fn at(&self, edge: [u32; 2], number: usize) -> Option<usize> {
        self.0.get(&edge)?.iter().copied().find(|known| *known != number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::PolygonFace;
    use crate::{Shape, SolidOperation};

    fn triangles(points: &[[f64; 3]], faces: &[[u32; 3]]) -> PolygonMesh {
        let points = points.iter().copied().map(DVec3::from).collect();
        PolygonMesh::new(points, faces.iter().map(|ring| PolygonFace::of(ring, &None)).collect())
    }

    #[test]
    fn a_thin_triangle_divides_its_neighbour_and_the_solid_stays_closed() {
        // A pyramid with a point on an edge of its base, to which a triangle without thickness leads.
        let points = [[0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0], [1.0, 1e-9, 0.0]];
        let faces = [[0, 2, 4], [4, 2, 1], [0, 4, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let mut mesh = triangles(&points, &faces);
        assert!(mesh.is_closed());
        remove_flat_triangles(&mut mesh, 1e-7).expect("no limit");
        assert!(mesh.is_closed() && (mesh.volume() - 2.0).abs() < 1e-8, "{}", mesh.volume());
        assert_eq!(mesh.faces.len(), 6);
        assert!(mesh.faces.iter().all(|face| mesh.area_vector(face).length() > 0.5));
    }

    #[test]
    fn opposite_triangles_vanish() {
        let points = [[0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0], [5.0, 5.0, 0.0]];
        let solid = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let mut mesh = triangles(&points, &[&solid[..], &[[1, 2, 4], [2, 1, 4]]].concat());
        remove_flat_triangles(&mut mesh, 1e-7).expect("no limit");
        assert!(mesh.is_closed() && mesh.faces.len() == 4);
    }

    #[test]
    fn unions_of_plates_that_almost_coincide_have_few_faces() {
        let plate = |number: u32| {
            let shift = f64::from(number % 3) * 1e-9;
            Shape::cuboid(DVec3::new(1.0, 1.0, 0.02)).translate(DVec3::new(shift, 2.0 * shift, shift))
        };
        let mut whole = plate(0);
        for number in 1..12 {
            whole = whole
                .combine(&plate(number), SolidOperation::Union)
                .expect("a union")
                .solid
                .expect("a solid");
            assert!(whole.is_closed() && whole.body.faces() < 20, "{number}: {}", whole.body.faces());
        }
    }
}
