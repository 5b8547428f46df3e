//! Tests of trees of tubes: closedness, manifold surfaces, volumes, joints of known shapes, and bodies that do not fit.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::{PI, TAU};

use glam::{DVec3, Vec3};
use proptest::prelude::*;

use super::axis::{AxisPoint, JoinedTubes, JointAxis};
use super::tubes::joined_tubes;
use crate::solid::{check, volume};
use crate::sweeps::control_point::CylinderPoint;
use burgeon_scene::Part;

/// Numbers of a surface whose points are welded.
#[derive(Debug, PartialEq)]
struct Topology {
    bodies: usize,
    /// Euler characteristic.
    euler: i64,
    /// Number of edges that do not have one triangle in each direction.
    bad_edges: usize,
}

/// Bodies are connected by edges: two of them may touch at a point, such as the tips of two branches.
fn topology(part: &Part) -> Topology {
    let mut known: BTreeMap<[u32; 3], usize> = BTreeMap::new();
    let mut welded = Vec::new();
    for position in &part.positions {
        let next = known.len();
        welded.push(*known.entry((*position + Vec3::ZERO).to_array().map(f32::to_bits)).or_insert(next));
    }
    let triangles: Vec<[usize; 3]> =
        part.triangles.iter().map(|triangle| triangle.map(|corner| welded[corner as usize])).collect();
    let mut above: Vec<usize> = (0..triangles.len()).collect();
    fn top(above: &mut [usize], mut at: usize) -> usize {
        while above[at] != at {
            above[at] = above[above[at]];
            at = above[at];
        }
        at
    }
    // The number of triangles in each direction, and the first of them.
    let mut edges: BTreeMap<(usize, usize), ([usize; 2], usize)> = BTreeMap::new();
    for (index, corners) in triangles.iter().enumerate() {
        for side in 0..3 {
            let (from, to) = (corners[side], corners[(side + 1) % 3]);
            let edge = edges.entry((from.min(to), from.max(to))).or_insert(([0; 2], index));
            edge.0[usize::from(from < to)] += 1;
            let (a, b) = (top(&mut above, edge.1), top(&mut above, index));
            above[a] = b;
        }
    }
    let mut corners = BTreeSet::new();
    let mut bodies = BTreeSet::new();
    for (index, triangle) in triangles.iter().enumerate() {
        let body = top(&mut above, index);
        bodies.insert(body);
        corners.extend(triangle.map(|corner| (corner, body)));
    }
    Topology {
        bodies: bodies.len(),
        euler: corners.len() as i64 - edges.len() as i64 + triangles.len() as i64,
        bad_edges: edges.values().filter(|(sides, _)| *sides != [1, 1]).count(),
    }
}

fn point(position: DVec3, radius: f64) -> CylinderPoint {
    CylinderPoint { position, radius, contour: None, side: None }
}

fn axis(points: &[(DVec3, f64)], parent: Option<(usize, usize)>) -> JointAxis {
    let points = points.iter().map(|(at, radius)| point(*at, *radius)).collect();
    let parent = parent.map(|(axis, point)| AxisPoint { axis, point });
    JointAxis { points, side: DVec3::X, parent, smooth: false }
}

fn joined(axes: &[JointAxis], sides: usize) -> (Part, JoinedTubes) {
    let mut part = Part::default();
    let found = joined_tubes(&mut part, axes, sides).expect("tubes");
    assert_eq!(found.runs.iter().map(|run| run.1).sum::<usize>(), part.triangles.len());
    assert!(part.normals.iter().all(|normal| (normal.vector().length() - 1.0).abs() < 1e-4));
    assert!(part.uvs.iter().all(|uv| uv.is_finite()) && part.positions.iter().all(|at| at.is_finite()));
    assert!(part.uvs.len() == part.positions.len() && part.normals.len() == part.positions.len());
    (part, found)
}

/// Area (m²) of a regular polygon with radius 1.
fn polygon(sides: usize) -> f64 {
    sides as f64 / 2.0 * (TAU / sides as f64).sin()
}

const ONE: Topology = Topology { bodies: 1, euler: 2, bad_edges: 0 };

fn is_one(part: &Part) -> bool {
    topology(part) == ONE && check([part]).is_solid()
}

/// Returns the number of triangles that face away from a normal of their corners.
fn inverted(part: &Part) -> usize {
    let looks = |triangle: [u32; 3]| {
        let [a, b, c] = triangle.map(|corner| part.positions[corner as usize]);
        let face = (b - a).cross(c - a);
        triangle.iter().all(|&corner| face.dot(part.normals[corner as usize].vector()) > 0.0)
    };
    part.triangles.iter().filter(|triangle| !looks(*triangle)).count()
}

#[test]
fn a_tee_is_one_body_with_the_volume_of_both_tubes() {
    for sides in [3, 5, 8, 24] {
        let trunk = axis(&[(DVec3::ZERO, 0.5), (DVec3::Z * 2.0, 0.5), (DVec3::Z * 4.0, 0.5)], None);
        let branch = axis(&[(DVec3::Z * 2.0, 0.3), (DVec3::new(3.0, 0.0, 2.0), 0.3)], Some((0, 1)));
        let (part, found) = joined(&[trunk, branch], sides);
        assert!(is_one(&part), "{:?} {:?}", topology(&part), check([&part]));
        assert_eq!((found.joints, found.separate.len()), (1, 0));
        assert_eq!(inverted(&part), 0);
        let expected = polygon(sides) * (4.0 * 0.25 + 2.5 * 0.09);
        let ratio = volume([&part]) / expected;
        assert!((0.97..1.1).contains(&ratio), "{sides}: {ratio}");
    }
}

#[test]
fn a_fork_of_equal_branches_is_one_body_at_all_angles_from_10_to_170_degrees() {
    for degrees in (10..=170).step_by(10) {
        let half = f64::from(degrees).to_radians() / 2.0;
        let trunk = axis(&[(DVec3::ZERO, 0.2), (DVec3::Z * 3.0, 0.2)], None);
        let arm = |sign: f64| {
            let way = DVec3::new(sign * half.sin(), 0.0, half.cos());
            axis(&[(DVec3::Z * 3.0, 0.2), (DVec3::Z * 3.0 + way * 6.0, 0.1)], Some((0, 1)))
        };
        let (part, found) = joined(&[trunk, arm(1.0), arm(-1.0)], 12);
        assert_eq!((topology(&part), found.joints, found.separate.len()), (ONE, 1, 0), "{degrees}");
        assert!(check([&part]).is_solid() && inverted(&part) == 0, "{degrees}");
        let expected = polygon(12) * (3.0 * 0.04 + 12.0 * 0.07 / 3.0);
        let ratio = volume([&part]) / expected;
        assert!((0.85..1.1).contains(&ratio), "{degrees}: {ratio}");
    }
}

#[test]
fn a_star_of_five_tubes_is_one_body() {
    let hub = axis(&[(DVec3::ZERO, 0.2)], None);
    let mut axes = vec![hub];
    for index in 0..5 {
        let angle = TAU * f64::from(index) / 5.0;
        let tip = DVec3::new(angle.cos(), angle.sin(), 0.3) * 2.0;
        axes.push(axis(&[(DVec3::ZERO, 0.2), (tip, 0.0)], Some((0, 0))));
    }
    let (part, found) = joined(&axes, 8);
    assert!(is_one(&part), "{:?} {:?}", topology(&part), check([&part]));
    assert_eq!((found.joints, found.separate.len(), inverted(&part)), (1, 0, 0));
}

#[test]
fn along_a_joint_the_texture_of_the_trunk_continues() {
    let trunk = axis(&[(DVec3::ZERO, 0.5), (DVec3::Z * 2.0, 0.5), (DVec3::Z * 4.0, 0.5)], None);
    let branch = axis(&[(DVec3::Z * 2.0, 0.2), (DVec3::new(3.0, 0.0, 2.0), 0.2)], Some((0, 1)));
    let (part, _) = joined(&[trunk, branch], 16);
    let around = polygon_perimeter(16) * 0.5;
    let mut count = 0;
    for (at, uv) in part.positions.iter().zip(&part.uvs) {
        // The back of the trunk, opposite to the branch.
        if at.x < -0.1 && at.z > 0.01 && at.z < 3.99 {
            assert!((uv.y - at.z).abs() < 0.02, "{at} {uv}");
            let turn = f64::from(at.y).atan2(f64::from(at.x)) / TAU;
            let u = (turn.rem_euclid(1.0) - 0.5) * around;
            assert!((f64::from(uv.x) - u).abs() < 0.02, "{at} {uv} {u}");
            count += 1;
        }
    }
    assert!(count > 30);
}

/// Perimeter (m) of a regular polygon with radius 1.
fn polygon_perimeter(sides: usize) -> f64 {
    2.0 * sides as f64 * (PI / sides as f64).sin()
}

#[test]
fn a_tree_of_many_segments_is_one_body() {
    let mut axes = Vec::new();
    let mut ends = vec![(DVec3::ZERO, DVec3::Z, 0.5, 8.0, None)];
    while axes.len() < 3000 {
        let mut next = Vec::new();
        for (from, way, radius, length, parent) in ends {
            let index = axes.len();
            let (middle, to) = (from + way * length * 0.5, from + way * length);
            axes.push(axis(&[(from, radius), (middle, radius * 0.9), (to, radius * 0.8)], parent));
            let x = way.any_orthonormal_vector();
            let y = way.cross(x);
            let turned = |a: f64, b: f64| (way + x * a + y * b).normalize();
            next.push((middle, turned(0.3, 0.8), radius * 0.5, length * 0.7, Some((index, 1))));
            next.push((to, turned(0.6, -0.2), radius * 0.7, length * 0.8, Some((index, 2))));
            next.push((to, turned(-0.7, -0.3), radius * 0.6, length * 0.8, Some((index, 2))));
        }
        ends = next;
    }
    let (part, found) = joined(&axes, 8);
    assert!(axes.len() > 3000 && found.joints > axes.len() / 3);
    assert_eq!((topology(&part), found.separate.len()), (ONE, 0));
}

/// Random trees: for each axis its parent (a number and a point), its steps and radii.
fn trees() -> impl Strategy<Value = Vec<JointAxis>> {
    let step = (-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0);
    let radius = prop_oneof![4 => 0.02f64..0.3, 1 => Just(0.0)];
    let one = (any::<u32>(), any::<u32>(), prop::collection::vec((step, radius), 1..6), any::<bool>());
    prop::collection::vec(one, 1..12).prop_map(|all| {
        let mut axes: Vec<JointAxis> = Vec::new();
        for (parent, place, steps, smooth) in all {
            let parent = (!axes.is_empty()).then(|| {
                let axis = parent as usize % axes.len();
                AxisPoint { axis, point: place as usize % axes[axis].points.len() }
            });
            let begin = parent.map_or(DVec3::ZERO, |at| axes[at.axis].points[at.point].position);
            let mut position = begin;
            let mut points = vec![point(begin, 0.1)];
            for ((x, y, z), radius) in steps {
                position += DVec3::new(x, y, z);
                points.push(point(position, radius));
            }
            axes.push(JointAxis { points, side: DVec3::Y, parent, smooth });
        }
        axes
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_tree_is_closed_and_has_a_body_for_itself_and_for_each_branch_that_does_not_fit(
        axes in trees(),
        sides in 3usize..12,
    ) {
        let (part, found) = joined(&axes, sides);
        let shape = topology(&part);
        let solid = check([&part]);
        prop_assert!(solid.is_solid(), "{solid:?}");
        prop_assert_eq!(shape.bad_edges, 0);
        prop_assert_eq!(shape.bodies, 1 + found.separate.len());
        prop_assert_eq!(shape.euler, 2 * shape.bodies as i64);
    }
}
