//! Distances from positions to the drawn faces of an object, for rules that query their surroundings.

use glam::DVec3;
use rstar::{AABB, PointDistance, RTree, RTreeObject};

use burgeon_scene::{Part, nearest_on_triangle};

/// Spatial index of triangles for nearest-point queries.
pub(super) struct Nearest {
    tree: RTree<IndexedTriangle>,
}

struct IndexedTriangle([DVec3; 3]);

impl RTreeObject for IndexedTriangle {
    type Envelope = AABB<[f64; 3]>;

    fn envelope(&self) -> Self::Envelope {
        let [a, b, c] = self.0;
        AABB::from_corners(a.min(b).min(c).to_array(), a.max(b).max(c).to_array())
    }
}

impl PointDistance for IndexedTriangle {
    fn distance_2(&self, place: &[f64; 3]) -> f64 {
        let place = DVec3::from_array(*place);
        (nearest_on_triangle(place, self.0) - place).length_squared()
    }
}

impl Nearest {
    /// Indexes the triangles of `parts`.
    pub(super) fn new(parts: &[Part]) -> Self {
        let corners = |part: &Part, triangle: [u32; 3]| {
            IndexedTriangle(triangle.map(|corner| part.positions[corner as usize].as_dvec3()))
        };
        let triangles = parts.iter().flat_map(|part| part.triangles.iter().map(|it| corners(part, it)));
        Self { tree: RTree::bulk_load(triangles.collect()) }
    }

    /// Returns the distance (m) from `place` to the nearest point of the triangles; infinite if there are none.
    pub(super) fn distance(&self, place: DVec3) -> f64 {
        let place = place.to_array();
        let nearest = self.tree.nearest_neighbor(&place);
        nearest.map_or(f64::INFINITY, |triangle| triangle.distance_2(&place).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_of_many_triangles_is_the_one_that_a_scan_finds() {
        let mut part = Part::default();
        for index in 0..200u32 {
            let angle = f64::from(index);
            let center = DVec3::new((angle * 1.7).sin(), (angle * 2.3).cos(), (angle * 0.9).sin()) * 5.0;
            for corner in [DVec3::X, DVec3::Y, DVec3::Z] {
                part.positions.push((center + corner * 0.3).as_vec3());
            }
            part.triangles.push([3 * index, 3 * index + 1, 3 * index + 2]);
        }
        let nearest = Nearest::new(std::slice::from_ref(&part));
        for index in 0..50 {
            let place =
                DVec3::new(f64::from(index).sin(), f64::from(index * 3).cos(), 0.1 * f64::from(index)) * 6.0;
            let scanned = part.triangles.iter().map(|triangle| {
                let [a, b, c] = triangle.map(|corner| part.positions[corner as usize].as_dvec3());
                nearest_on_triangle(place, [a, b, c]).distance(place)
            });
            let scanned = scanned.fold(f64::INFINITY, f64::min);
            assert!((nearest.distance(place) - scanned).abs() < 1e-9);
        }
        assert_eq!(Nearest::new(&[]).distance(DVec3::ZERO), f64::INFINITY);
    }
}
