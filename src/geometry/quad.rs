//! Faces between two rings, split into triangles.

use glam::DVec3;

use super::ring::Ring;
use super::solid::is_flat;

/// A face between two rings: two corners on the first from left to right, then two on the second from right.
pub(super) struct Quad<'a> {
    points: [(&'a Ring, usize); 4],
}

impl<'a> Quad<'a> {
    pub(super) fn new(points: [(&'a Ring, usize); 4]) -> Self {
        Self { points }
    }

    /// The triangles along the shorter diagonal, without those that have shrunk to a line between two points.
    ///
    /// `None` if a triangle has three corners on one line whichever diagonal is taken.
    pub(super) fn split(&self) -> Option<[Option<[usize; 3]>; 2]> {
        let [a, b, c, d] = [0, 1, 2, 3].map(|corner| self.exact(corner));
        // The margin keeps rounding from turning the diagonals of equal faces in different ways. At a tip, the
        // corner on the right is the one that stands for the face.
        let second = if self.is_one_point(2, 3) {
            false
        } else {
            self.is_one_point(0, 1) || b.distance_squared(d) < a.distance_squared(c) * (1.0 - 1e-9)
        };
        let splits = [[[0, 1, 2], [0, 2, 3]], [[0, 1, 3], [1, 2, 3]]];
        let order = if second { [1, 0] } else { [0, 1] };
        order.into_iter().map(|index| splits[index]).find_map(|split| {
            let kept = split.map(|corners| (!self.has_vanished(corners)).then_some(corners));
            let flat = kept.iter().flatten().any(|corners| is_flat(corners.map(|corner| self.exact(corner))));
            (!flat).then_some(kept)
        })
    }

    fn exact(&self, corner: usize) -> DVec3 {
        let (ring, point) = self.points[corner];
        ring.exact[point]
    }

    fn has_vanished(&self, corners: [usize; 3]) -> bool {
        let [a, b, c] = corners;
        self.is_one_point(a, b) || self.is_one_point(b, c) || self.is_one_point(c, a)
    }

    fn is_one_point(&self, a: usize, b: usize) -> bool {
        let [a, b] = [a, b].map(|corner| self.points[corner]).map(|(ring, point)| ring.points[point]);
        a == b
    }

    /// The normal of a triangle, as long as twice its area (m²).
    pub(super) fn area(&self, corners: [usize; 3]) -> DVec3 {
        let [a, b, c] = corners.map(|corner| self.exact(corner));
        (b - a).cross(c - a)
    }
}
