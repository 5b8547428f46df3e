//! Shading of faces that approximate a curve.

use burgeon_scene::Part;
use glam::Vec3;
use rustc_hash::FxHashMap;

/// Minimum cosine of the angle between faces that form one curve (40 degrees).
const ALIKE: f32 = 0.766;

/// Averages the normals of the vertices from `first` on that share a place, if their faces form one curve.
pub(super) fn smooth(part: &mut Part, first: usize) {
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
            let alike =
                group.iter().map(|&other| flat[other].vector()).filter(|normal| own.dot(*normal) > ALIKE);
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
        smooth(&mut part, 0);
        let after: Vec<Vec3> = part.normals.iter().map(|normal| normal.vector()).collect();
        assert!(after[0].distance(after[1]) < 1e-6 && after[0].x > 0.1);
        assert!(after[2].distance(Vec3::X) < 1e-6);
    }
}
