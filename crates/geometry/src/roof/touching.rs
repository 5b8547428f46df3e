//! Rings that touch themselves, divided into rings that do not.

use std::hash::Hash;

use glam::DVec2;
use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use crate::planar::{contains, twice_area};

/// Maximum number of corners of a ring whose corners are searched one by one.
const FEW: usize = 64;

/// Divides a ring at repeated corners; the ring with its first corners comes first.
pub(super) fn simple_rings<T: Copy + Eq + Hash>(ring: &[T]) -> SmallVec<[Vec<T>; 2]> {
    let mut left: Vec<T> = Vec::with_capacity(ring.len());
    let mut parts = SmallVec::new();
    // Positions of corners of long rings; those after a division may be gone.
    let mut positions: FxHashMap<T, usize> = FxHashMap::default();
    let is_long = ring.len() > FEW;
    for &corner in ring {
        let known = if is_long {
            positions.get(&corner).copied().filter(|&at| left.get(at) == Some(&corner))
        } else {
            left.iter().position(|&other| other == corner)
        };
        if let Some(at) = known {
            if left.len() > at + 2 {
                parts.push(left[at..].to_vec());
            }
            left.truncate(at);
        }
        if is_long {
            positions.insert(corner, left.len());
        }
        left.push(corner);
    }
    if left.len() > 2 {
        parts.insert(0, left);
    }
    parts
}

/// Divides a face whose outer ring touches itself from outside into faces, each with its holes; `place` returns the position of a
/// corner in the plane of the face.
///
/// A face that touches itself around a hole stays whole.
pub(super) fn touching_parts<T: Copy + Eq + Hash>(
    rings: Vec<Vec<T>>,
    place: impl Fn(T) -> DVec2,
) -> Vec<Vec<Vec<T>>> {
    let Some(outer) = rings.first() else { return Vec::new() };
    let parts = simple_rings(outer);
    let corners = |ring: &[T]| -> Vec<DVec2> { ring.iter().map(|corner| place(*corner)).collect() };
    if parts.len() < 2 || parts.iter().any(|part| twice_area(corners(part)) <= 0.0) {
        return vec![rings];
    }
    let mut faces: Vec<Vec<Vec<T>>> = parts.into_iter().map(|part| vec![part]).collect();
    for hole in rings.into_iter().skip(1) {
        let is_around = |face: &Vec<Vec<T>>| {
            let free = hole.iter().find(|corner| !face[0].contains(corner));
            free.is_some_and(|corner| contains(&corners(&face[0]), place(*corner)))
        };
        let index = faces.iter().position(is_around).unwrap_or(0);
        faces[index].push(hole);
    }
    faces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_squares_that_share_a_corner_are_two_faces_and_each_keeps_its_hole() {
        let places = [
            (0., 0.),
            (4., 0.),
            (4., 4.),
            (0., 4.),
            (8., 4.),
            (8., 8.),
            (4., 8.),
            (5., 5.),
            (5., 6.),
            (6., 5.),
        ];
        let place = |corner: usize| DVec2::from(places[corner]);
        let rings = vec![vec![0, 1, 2, 4, 5, 6, 2, 3], vec![7, 8, 9]];
        assert_eq!(
            touching_parts(rings, place),
            [vec![vec![0, 1, 2, 3]], vec![vec![2, 4, 5, 6], vec![7, 8, 9]]]
        );
        // A hole that touches the outline at a corner.
        let pinched = vec![vec![4, 5, 6, 2, 7, 8, 9, 7, 2]];
        assert_eq!(touching_parts(pinched.clone(), place), [pinched]);
    }
}
