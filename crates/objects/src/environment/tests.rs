//! Environments against plain searches over all pairs.

use burgeon_base::random::Stream;
use burgeon_kit::{Environment as _, Object as _, Vector};
use glam::DVec3;

use super::*;

/// Returns random places in a box with sides of this length (m).
fn places(seed: u64, count: usize, side: f64) -> Vec<DVec3> {
    let mut stream = Stream::new(seed);
    (0..count).map(|_| DVec3::from_array([0; 3].map(|_| (stream.uniform() - 0.5) * side))).collect()
}

#[test]
fn shadows_are_those_of_all_voxels_above_in_the_pyramid() {
    for seed in 0..20 {
        let options = || ShadowVoxelOptions {
            size: 0.7,
            depth: 1 + u32::try_from(seed).unwrap() % 6,
            strength: 0.01,
            decay: 0.6,
        };
        let mut light = ShadowVoxels::new(options()).unwrap();
        let voxel = |place: DVec3| (place / 0.7).floor();
        let mut expected = vec![0.0; 200];
        let (shades, asked) = (places(seed, 300, 9.0), places(seed + 100, 200, 12.0));
        for (number, place) in shades.iter().enumerate() {
            let amount = number as f64 % 3.0;
            light.shade(Vector(*place), Some(amount)).unwrap();
            for (sum, at) in expected.iter_mut().zip(&asked) {
                let apart = voxel(*place) - voxel(*at);
                let inside = apart.x.abs().max(apart.y.abs()) <= apart.z;
                if inside && apart.z <= f64::from(options().depth) {
                    *sum += amount * 0.01 * 0.6f64.powf(apart.z);
                }
            }
        }
        // Before and after the pass has ended.
        for _ in 0..2 {
            for (sum, at) in expected.iter().zip(&asked) {
                let light = light.light(Vector(*at)).unwrap();
                assert!((light - (1.0 - sum + 0.01).clamp(0.0, 1.0)).abs() < 1e-9, "{light} {sum}");
            }
            light.end_pass().unwrap();
        }
        light.begin();
        assert_eq!(light.light(Vector(asked[0])).unwrap(), 1.0);
    }
}

#[test]
fn each_point_attracts_the_nearest_place_until_one_is_near() {
    for seed in 0..20 {
        let (mut points, nodes) = (places(seed, 400, 8.0), places(seed + 50, 60, 8.0));
        let given = points.iter().copied().map(Vector).collect();
        let options = AttractorOptions { points: given, influence: 1.5, kill: 0.6 };
        let mut space = Attractors::new(options).unwrap();
        nodes.iter().for_each(|node| space.add(Vector(*node)).unwrap());
        space.end_pass().unwrap();
        points.retain(|point| nodes.iter().all(|node| node.distance(*point) > 0.6));
        assert_eq!(space.remaining() as usize, points.len());
        let nearest = |point: &DVec3| {
            nodes.iter().min_by(|a, b| a.distance(*point).total_cmp(&b.distance(*point))).copied().unwrap()
        };
        for node in &nodes {
            let own = points.iter().filter(|point| nearest(point) == *node && node.distance(**point) <= 1.5);
            let own: Vec<DVec3> = own.copied().collect();
            assert_eq!(space.count(Vector(*node)) as usize, own.len());
            let sum: DVec3 = own.iter().map(|point| (*point - *node).normalize()).sum();
            assert!(space.direction(Vector(*node)).distance(sum.normalize_or_zero()) < 1e-9);
        }
    }
}

#[test]
fn the_weaker_of_two_discs_that_overlap_is_dominated() {
    for seed in 0..20 {
        let overlap = seed as f64 % 3.0 * 0.2;
        let mut ground = Discs::new(DiscOptions { overlap }).unwrap();
        let discs: Vec<(DVec3, f64)> = places(seed, 150, 20.0)
            .into_iter()
            .enumerate()
            .map(|(number, place)| (place, 0.5 + (number % 7) as f64 * 0.1))
            .collect();
        discs.iter().for_each(|(place, radius)| ground.add(Vector(*place), *radius, None).unwrap());
        ground.end_pass().unwrap();
        for (number, (place, radius)) in discs.iter().enumerate() {
            let expected = discs.iter().enumerate().any(|(other, (at, reach))| {
                let stronger = reach > radius || reach == radius && other < number;
                let distance = (place.truncate() - at.truncate()).length();
                other != number && stronger && distance < (radius + reach) * (1.0 - overlap)
            });
            assert_eq!(ground.dominated(Vector(*place)), expected);
        }
    }
}
