//! Tests of trees of tubes: closedness, manifold surfaces, volumes, joints of known shapes, and bodies that do not fit.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::{DVec3, Vec3};
use proptest::prelude::*;

use super::axis::{AxisPoint, JoinedTubes, JointAxis};
use super::tubes::joined_tubes;
use crate::curves::curve::{Curve, CurveKind};
use crate::solid::{check, volume};
use crate::sweeps::cylinder::CylinderPoint;
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

fn topology(part: &Part) -> Topology {
    let mut known: BTreeMap<[u32; 3], usize> = BTreeMap::new();
    let mut welded = Vec::new();
    for position in &part.positions {
        let next = known.len();
        welded.push(*known.entry((*position + Vec3::ZERO).to_array().map(f32::to_bits)).or_insert(next));
    }
    let mut above: Vec<usize> = (0..known.len()).collect();
    fn top(above: &mut [usize], mut at: usize) -> usize {
        while above[at] != at {
            above[at] = above[above[at]];
            at = above[at];
        }
        at
    }
    let mut edges: BTreeMap<(usize, usize), [usize; 2]> = BTreeMap::new();
    let mut used = vec![false; known.len()];
    for triangle in &part.triangles {
        let corners = triangle.map(|corner| welded[corner as usize]);
        for side in 0..3 {
            let (from, to) = (corners[side], corners[(side + 1) % 3]);
            edges.entry((from.min(to), from.max(to))).or_default()[usize::from(from < to)] += 1;
            let (a, b) = (top(&mut above, from), top(&mut above, to));
            above[a] = b;
            used[from] = true;
        }
    }
    let count = used.iter().filter(|it| **it).count();
    Topology {
        bodies: (0..used.len()).filter(|&at| used[at] && above[at] == at).count(),
        euler: count as i64 - edges.len() as i64 + part.triangles.len() as i64,
        bad_edges: edges.values().filter(|sides| **sides != [1, 1]).count(),
    }
}

fn point(position: DVec3, radius: f64) -> CylinderPoint {
    CylinderPoint { position, radius, contour: None }
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

fn looks_outwards(part: &Part) -> usize {
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
        let expected = polygon(sides) * (4.0 * 0.25 + 2.5 * 0.09);
        let ratio = volume([&part]) / expected;
        println!("{sides} {ratio} {}", looks_outwards(&part));
        assert!((0.93..1.25).contains(&ratio), "{sides}: {ratio}");
    }
}
