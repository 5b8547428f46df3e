//! Faces between two rings, split into triangles.

use glam::{DVec3, Vec3};

use super::ring::SectionRing;
use crate::solid::is_flat;

/// A face between two rings: two corners on the first ring from left to right, then two on the second from
/// right to left.
pub(super) struct Quad {
    exact: [DVec3; 4],
    points: [Vec3; 4],
}

impl Quad {
    pub(super) fn new(corners: [(&SectionRing, usize); 4]) -> Self {
        Self {
            exact: corners.map(|(ring, point)| ring.exact[point]),
            points: corners.map(|(ring, point)| ring.points[point]),
        }
    }

    /// Splits the face along its shorter diagonal, without the triangles that have collapsed to a line
    /// between two points.
    ///
    /// Returns `None` if a triangle has three collinear corners with either diagonal.
    #[inline]
    pub(super) fn split(&self) -> Option<[Option<[usize; 3]>; 2]> {
        let [a, b, c, d] = self.exact;
        // The margin prevents rounding from choosing different diagonals in equal faces. At a tip, the right
        // corner represents the face.
        let second = if self.is_one_point(2, 3) {
            false
        } else {
            self.is_one_point(0, 1) || b.distance_squared(d) < a.distance_squared(c) * (1.0 - 1e-9)
        };
        let along_ac = [[0, 1, 2], [0, 2, 3]];
        let along_bd = [[0, 1, 3], [1, 2, 3]];
        let [first, other] = if second { [along_bd, along_ac] } else { [along_ac, along_bd] };
        self.faces(first).or_else(|| self.faces(other))
    }

    /// Returns the triangles that have not collapsed to a line between two points; `None` if another triangle
    /// is flat.
    #[inline]
    fn faces(&self, split: [[usize; 3]; 2]) -> Option<[Option<[usize; 3]>; 2]> {
        let mut kept = [None; 2];
        for (corners, kept) in split.into_iter().zip(&mut kept) {
            if self.has_vanished(corners) {
                continue;
            }
            if is_flat(corners.map(|corner| self.exact[corner])) {
                return None;
            }
            *kept = Some(corners);
        }
        Some(kept)
    }

    #[inline]
    fn has_vanished(&self, [a, b, c]: [usize; 3]) -> bool {
        self.is_one_point(a, b) || self.is_one_point(b, c) || self.is_one_point(c, a)
    }

    #[inline]
    fn is_one_point(&self, a: usize, b: usize) -> bool {
        self.points[a] == self.points[b]
    }

    /// Returns the normal of a triangle with a length of twice its area (m²).
    pub(super) fn area(&self, corners: [usize; 3]) -> DVec3 {
        let [a, b, c] = corners.map(|corner| self.exact[corner]);
        (b - a).cross(c - a)
    }
}
