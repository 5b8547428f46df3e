//! Shading of faces that approximate a curve.

use burgeon_scene::Part;
use glam::{DVec2, Vec3};
use rustc_hash::FxHashMap;

/// Minimum cosine of the angle between faces that form one curve (40 degrees).
const ALIKE: f32 = 0.766;

/// Minimum cosine of the angle between the directions of neighbouring sides that form one curve (40.5 degrees), so that domes of
/// nine sides and more are round.
const ROUND: f64 = 0.7604;

/// Averages the normals of the vertices from `first` on that share a place, if their faces form one curve.
///
/// `sides` has for each of these vertices the direction along its side of the roof, if the sides meet at ribs: all faces of two
/// sides form one curve, or none, so that a rib is sharp from the eaves to the top. Empty for other roofs.
pub(super) fn smooth(part: &mut Part, first: usize, sides: &[DVec2]) {
    let mut places: FxHashMap<[u32; 3], usize> = FxHashMap::default();
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for (index, place) in part.positions.iter().enumerate().skip(first) {
        let bits = (*place + Vec3::ZERO).to_array().map(f32::to_bits);
        let group = *places.entry(bits).or_insert_with(|| {
            groups.push(Vec::new());
            groups.len() - 1
        });
        groups[group].push(index);
    }
    let flat = part.normals.clone();
    for group in groups {
        for &vertex in &group {
            let own = flat[vertex].vector();
            let is_alike = |other: usize| match (sides.get(vertex - first), sides.get(other - first)) {
                (Some(one), Some(two)) => one.dot(*two) > ROUND && own.dot(flat[other].vector()) > 0.5,
                _ => own.dot(flat[other].vector()) > ALIKE,
            };
            let alike = group.iter().filter(|other| is_alike(**other)).map(|&other| flat[other].vector());
            part.normals[vertex] = alike.sum::<Vec3>().normalize_or(own).into();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_of_a_curve_are_averaged_and_those_of_an_edge_are_kept() {
        let normals = [Vec3::Z, Vec3::new(0.3, 0.0, 1.0).normalize(), Vec3::X];
        let mut part = Part { positions: vec![Vec3::ONE; 3], ..Part::default() };
        part.normals = normals.iter().map(|normal| (*normal).into()).collect();
        smooth(&mut part, 0, &[]);
        let after: Vec<Vec3> = part.normals.iter().map(|normal| normal.vector()).collect();
        assert!(after[0].distance(after[1]) < 1e-6 && after[0].x > 0.1);
        assert!(after[2].distance(Vec3::X) < 1e-6);
    }

    #[test]
    fn a_rib_between_sides_is_sharp_at_any_height_and_sides_of_a_round_dome_have_none() {
        // Two faces near the top, where their normals differ little.
        let normals = [Vec3::new(0.1, 0.0, 1.0).normalize(), Vec3::new(0.0, 0.1, 1.0).normalize()];
        for (turn, is_sharp) in [(45.0_f64, true), (40.0, false), (15.0, false)] {
            let mut part = Part { positions: vec![Vec3::ONE; 2], ..Part::default() };
            part.normals = normals.iter().map(|normal| (*normal).into()).collect();
            smooth(&mut part, 0, &[DVec2::X, DVec2::from_angle(turn.to_radians())]);
            let after: Vec<Vec3> = part.normals.iter().map(|normal| normal.vector()).collect();
            assert_eq!(after[0].distance(after[1]) > 0.05, is_sharp, "{turn}");
        }
    }
}
