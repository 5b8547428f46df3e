//! Environments against plain searches over all pairs.

use burgeon_base::random::Stream;
use burgeon_geometry::sphere;
use burgeon_kit::Model;
use burgeon_kit::{Environment as _, Object as _, Vector};
use burgeon_scene::{Instance, Material, Mesh, Scene};
use glam::{DAffine3, DVec3};
use std::sync::Arc;

use super::*;

/// Returns random places in a box with sides of this length (m).
fn places(seed: u64, count: usize, side: f64) -> Vec<DVec3> {
    let mut stream = Stream::new(seed);
    (0..count).map(|_| DVec3::from_array([0; 3].map(|_| (stream.uniform() - 0.5) * side))).collect()
}

#[test]
fn many_shadows_in_few_voxels_add_up() {
    let options = ShadowVoxelOptions { size: 1.0, depth: 2, strength: 0.5, decay: 0.5 };
    let mut light = ShadowVoxels::new(options).unwrap();
    // All sums are exact.
    let amount = 1.0 / 65536.0;
    for number in 0..65536 {
        light.shade(Vector(DVec3::new(f64::from(number % 2) * 9.0, 0.5, 0.5)), Some(amount)).unwrap();
    }
    let at = |x: f64, z: f64| light.light(Vector(DVec3::new(x, 0.5, z))).unwrap();
    assert_eq!((at(0.5, 0.5), at(9.5, 0.5), at(4.5, 0.5)), (1.0, 1.0, 1.0));
    light.shade(Vector(DVec3::new(0.5, 0.5, 0.5)), Some(1.5)).unwrap();
    let at = |x: f64, z: f64| light.light(Vector(DVec3::new(x, 0.5, z))).unwrap();
    assert_eq!((at(0.5, 0.5), at(9.5, 0.5), at(1.5, -0.5), at(0.5, -0.5)), (0.5, 1.0, 1.0, 1.0));
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

/// Returns the signed distance (m) to a box.
fn to_cuboid(place: DVec3, low: DVec3, high: DVec3) -> f64 {
    let beyond = (place - low.midpoint(high)).abs() - (high - low) / 2.0;
    beyond.max(DVec3::ZERO).length() + beyond.max_element().min(0.0)
}

#[test]
fn distances_and_hits_of_obstacles_are_those_of_a_scan_of_all_solids() {
    let (mut inside, mut hits) = (0, 0);
    for seed in 0..10 {
        let mut all = ObstacleSolids::new();
        let mut solids: Vec<Box<dyn Fn(DVec3) -> f64>> = Vec::new();
        for pair in places(seed, 60, 10.0).chunks_exact(2) {
            let (place, size) = (pair[0], pair[1].abs() * 0.3 + 0.05);
            match solids.len() % 3 {
                0 => {
                    all = all.sphere(Vector(place), size.x).unwrap();
                    solids.push(Box::new(move |at| at.distance(place) - size.x));
                }
                1 => {
                    all = all.r#box(Vector(place - size), Vector(place + size)).unwrap();
                    solids.push(Box::new(move |at| to_cuboid(at, place - size, place + size)));
                }
                _ => {
                    // Counter-clockwise and clockwise rings.
                    let turn = if seed % 2 == 0 { 1.0 } else { -1.0 };
                    let corners = [(1.0, turn), (-1.0, turn), (-1.0, -turn), (1.0, -turn)];
                    let corners =
                        corners.map(|(x, y)| place + DVec3::new(x * size.x, y * size.y, 7.0)).to_vec();
                    let area = burgeon_spatial::Geometry::polygon(vec![corners]).unwrap();
                    let [low, high] = [place - size, place + size];
                    all = all.prism(area, high.z - low.z, Some(low.z)).unwrap();
                    solids.push(Box::new(move |at| to_cuboid(at, low, high)));
                }
            }
        }
        assert_eq!(all.count(), 30);
        let distance = |at: DVec3| {
            let inside = solids.iter().map(|solid| solid(at)).filter(|distance| *distance <= 0.0);
            inside
                .reduce(f64::min)
                .unwrap_or_else(|| solids.iter().map(|solid| solid(at)).fold(f64::INFINITY, f64::min))
        };
        for pair in places(seed + 40, 400, 12.0).chunks_exact(2) {
            let [from, to] = [pair[0], pair[1]];
            let expected = distance(from);
            assert!((all.distance(Vector(from)).unwrap() - expected).abs() < 1e-9, "{from}");
            assert_eq!(all.contains(Vector(from)).unwrap(), expected <= 0.0);
            inside += u32::from(expected <= 0.0);
            let nearest = all.nearest(Vector(from)).unwrap();
            assert!((nearest.distance(from) - expected.abs()).abs() < 1e-9);
            // The distance grows along the normal.
            let on = from + all.normal(Vector(from)).unwrap() * 1e-6;
            assert!((distance(on) - expected - 1e-6).abs() < 1e-9, "{from}");
            let first =
                (0..=2000).map(|step| f64::from(step) / 2000.0).find(|t| distance(from.lerp(to, *t)) <= 0.0);
            match (all.hit(Vector(from), Vector(to)).unwrap(), first) {
                (Some(share), Some(first)) => {
                    hits += 1;
                    // A shorter part of the segment may be in another obstacle before.
                    assert!(
                        share <= first + 1e-9 && distance(from.lerp(to, share)) < 1e-9,
                        "{share} {first}"
                    );
                    let before = distance(from.lerp(to, share - 1e-6));
                    assert!(share == 0.0 || before > 0.0);
                }
                (Some(share), None) => assert!(distance(from.lerp(to, share)).abs() < 1e-9, "{share}"),
                (share, first) => assert_eq!(share, first),
            }
        }
    }
    assert!(inside > 50 && hits > 500, "{inside} {hits}");
}

/// Returns instances of the first mesh.
fn instances<const COUNT: usize>(places: [DVec3; COUNT]) -> Vec<Instance> {
    let instance = |place| Instance {
        mesh: 0,
        transform: DAffine3::from_translation(place),
        name: String::new(),
        feature: None,
        origin: None,
        placement: None,
        meaning: None,
    };
    places.map(instance).to_vec()
}

/// Returns a model of two balls with a radius of 1 m.
fn balls(centers: [DVec3; 2]) -> Arc<Model> {
    let mut mesh = Mesh::default();
    sphere(mesh.part(0), DVec3::ZERO, 1.0, 32).unwrap();
    let scene = Scene {
        materials: vec![Material::default()],
        meshes: vec![mesh],
        instances: instances(centers),
        ..Scene::default()
    };
    Arc::new(Model::new(scene))
}

#[test]
fn a_model_is_an_obstacle_with_all_its_instances_at_its_place_and_scale() {
    let model = balls([DVec3::ZERO, DVec3::X * 1.5]);
    let at = Vector(DVec3::new(10.0, 0.0, 3.0));
    let all =
        ObstacleSolids::new().mesh(model, Some(at), Some(burgeon_kit::AxisScale(DVec3::splat(2.0)))).unwrap();
    for place in places(5, 3000, 10.0).into_iter().map(|place| place + DVec3::new(11.0, 0.0, 3.0)) {
        let distances = [10.0, 13.0].map(|x| place.distance(DVec3::new(x, 0.0, 3.0)) - 2.0);
        let expected = distances[0].min(distances[1]);
        // The balls have flat faces, at most 2 * (1 - cos(180 / 32 degrees)) below the sphere.
        if expected.abs() > 0.03 {
            assert_eq!(all.contains(Vector(place)).unwrap(), expected < 0.0, "{place}");
        }
        if expected > 0.03 {
            let distance = all.distance(Vector(place)).unwrap();
            assert!((distance - expected).abs() < 0.03, "{distance} {expected}");
        }
    }
}

#[test]
fn obstacles_refuse_solids_without_size_and_open_models() {
    let at = |x: f64| Vector(DVec3::new(x, 0.0, 0.0));
    let none = ObstacleSolids::new();
    let mut open = Mesh::default();
    sphere(open.part(0), DVec3::ZERO, 1.0, 6).unwrap();
    open.part(0).truncate(usize::MAX, 5);
    let open = Scene {
        materials: vec![Material::default()],
        meshes: vec![open],
        instances: instances([DVec3::ZERO]),
        ..Scene::default()
    };
    let line = burgeon_spatial::Geometry::line(vec![DVec3::ZERO, DVec3::X]).unwrap();
    let said = [
        none.r#box(at(0.0), at(1.0)).err().unwrap(),
        none.sphere(at(0.0), 0.0).err().unwrap(),
        none.sphere(at(0.0), f64::NAN).err().unwrap(),
        none.prism(line, 2.0, None).err().unwrap(),
        none.mesh(balls([DVec3::ZERO; 2]), None, Some(burgeon_kit::AxisScale(DVec3::new(1.0, -1.0, 1.0))))
            .err()
            .unwrap(),
        none.mesh(Arc::new(Model::new(open)), None, None).err().unwrap(),
        none.nearest(at(0.0)).err().unwrap(),
    ];
    let said: Vec<String> =
        said.iter().map(|error| format!("{} | {}", error.message(), error.remedy().unwrap())).collect();
    insta::assert_snapshot!(said.join("\n"), @r#"
    obstacles:box: the corners are {0.0, 0.0, 0.0} and {1.0, 0.0, 0.0} | give a low and a high corner, with x, y and z that increase and are below 1e9 m
    obstacles:sphere: the centre is {0.0, 0.0, 0.0} and the radius 0 | give a radius above 0, and numbers below 1e9 m
    obstacles:sphere: the centre is {0.0, 0.0, 0.0} and the radius NaN | give a radius above 0, and numbers below 1e9 m
    obstacles:prism: the geometry contains no area | give a polygon, such as a plan
    obstacles:mesh: the position is {0.0, 0.0, 0.0} and the scale {1.0, -1.0, 1.0} | give a scale above 0, and coordinates below 1e9 m
    obstacles:mesh: the mesh has 7 open edges, such as from {0.000, 0.000, 1.000} to {0.866, 0.000, 0.500} (m) | close the surface, with caps and without gaps, and orient all faces outwards
    obstacles:nearest: there are no obstacles | add a solid: obstacles():box({ 0, 0, 0 }, { 1, 1, 2 })
    "#);
    assert_eq!(none.distance(at(0.0)).unwrap(), f64::INFINITY);
    assert_eq!(none.normal(at(0.0)).unwrap(), DVec3::ZERO);
    assert_eq!(none.mesh(Arc::new(Model::new(Scene::default())), None, None).unwrap().count(), 0);
    assert_eq!(none.hit(at(0.0), at(1.0)).unwrap(), None);
}

#[test]
fn a_long_chain_of_obstacles_shares_its_solids() {
    let mut all = ObstacleSolids::new();
    for number in 0..200_000 {
        all = all.sphere(Vector(DVec3::X * f64::from(number)), 0.25).unwrap();
    }
    let before = all.clone();
    all = all.sphere(Vector(DVec3::Y * 9.0), 1.0).unwrap();
    assert_eq!(before.distance(Vector(DVec3::Y * 9.0)).unwrap(), 8.75);
    assert_eq!(all.distance(Vector(DVec3::Y * 9.0)).unwrap(), -1.0);
    drop(all);
    assert!(before.contains(Vector(DVec3::X * 70_000.0)).unwrap());
}
