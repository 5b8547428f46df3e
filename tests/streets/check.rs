//! Invariants of every network, for any pattern and seed, tested for all pairs of segments in integers.

use std::path::PathBuf;
use std::sync::Arc;

use burgeon::objects::Network;
use burgeon::script::RunOptions;
use glam::{DVec2, DVec3};

/// Patterns of `scripts/roads.lua`, with the search radius (m) for joining their dead ends.
pub(crate) const PATTERNS: [(&str, f64); 7] = [
    ("organic", 30.0),
    ("raster", 40.0),
    ("radial", 40.0),
    ("contours", 40.0),
    ("population", 40.0),
    ("districts", 40.0),
    ("centres", 30.0),
];
/// Minimum ratio of the path along the streets to the length of a joining street.
pub(crate) const DETOUR: f64 = 2.5;

/// Returns the network that a script grows.
pub(crate) fn grown(script: &str, seed: u64, set: &[(&str, &str)]) -> Network {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("scripts").join(script);
    let set: Vec<_> = set.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect();
    let run = burgeon::run(&path, RunOptions { seed, params: set.into(), lod: 0, ..burgeon::options() })
        .expect("streets grow");
    let object: Arc<dyn std::any::Any + Send + Sync> = run.systems[0].objects[0].clone();
    Arc::unwrap_or_clone(object.downcast::<Network>().expect("a network"))
}

pub(crate) type Whole = (i128, i128);

/// Returns the exact position in grid steps.
#[allow(clippy::cast_possible_truncation, reason = "places are on the grid, and within 2^30 steps")]
pub(crate) fn whole(at: DVec2) -> Whole {
    let steps = at * 1024.0;
    assert!(steps.fract() == DVec2::ZERO, "{at} is off the grid");
    (steps.x as i128, steps.y as i128)
}

pub(crate) fn side(a: Whole, b: Whole, c: Whole) -> i128 {
    ((b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0)).signum()
}

/// Returns true if two segments share a point.
pub(crate) fn meet([a, b]: [Whole; 2], [c, d]: [Whole; 2]) -> bool {
    let within = |a: Whole, b: Whole, p: Whole| {
        a.0.min(b.0) <= p.0 && p.0 <= a.0.max(b.0) && a.1.min(b.1) <= p.1 && p.1 <= a.1.max(b.1)
    };
    let (of_c, of_d, of_a, of_b) = (side(a, b, c), side(a, b, d), side(c, d, a), side(c, d, b));
    of_c * of_d < 0 && of_a * of_b < 0
        || of_c == 0 && within(a, b, c)
        || of_d == 0 && within(a, b, d)
        || of_a == 0 && within(c, d, a)
        || of_b == 0 && within(c, d, b)
}

/// Asserts that streets meet only at junctions, that junctions keep their minimum angle, that the network is connected,
/// that no dead end remains that could be joined, and that areas add up.
pub(crate) fn check(grown: &Network, radius: f64, about: &str) {
    let network = grown.network();
    let pieces: Vec<_> =
        network.pieces().map(|(id, _)| (id, network.ends(id), network.line(id).map(whole))).collect();
    assert!(pieces.len() > 5, "{about}: {} pieces", pieces.len());
    for (index, (_, ends, line)) in pieces.iter().enumerate() {
        for (_, others, other) in &pieces[..index] {
            let shared: Vec<_> = ends.iter().filter(|end| others.contains(end)).collect();
            match shared[..] {
                [] => assert!(!meet(*line, *other), "{about}: {line:?} and {other:?} cross"),
                [junction] => {
                    let way = |ends: &[u32; 2]| {
                        let far = if ends[0] == *junction { ends[1] } else { ends[0] };
                        network.at(far) - network.at(*junction)
                    };
                    let angle = way(ends).angle_to(way(others)).abs().to_degrees();
                    assert!(angle >= network.constraints().least_angle(), "{about}: {angle} degrees");
                }
                _ => panic!("{about}: two streets join the same junctions"),
            }
        }
    }
    assert_eq!(network.components(), 1, "{about}: parts");
    let (left, joinable) = (grown.dead_ends(), grown.joinable(Some(radius), Some(DETOUR)).expect("a radius"));
    assert_eq!(joinable, 0, "{about}: {joinable} of {left} dead ends could be joined");
    // Euler's formula: vertices plus faces, including the outside, equals edges plus 2.
    let there = network.junctions().iter().filter(|junction| junction.degree() > 0).count();
    assert_eq!(there + network.faces().len() + 1, network.size() + 2, "{about}: faces");
    // Streets, blocks and the outside fill the plane.
    let surfaces = network.surfaces(Default::default(), &Default::default());
    let twice = |ring: &[DVec3]| -> f64 {
        let first = ring[0];
        let pairs = ring.iter().zip(ring.iter().cycle().skip(1));
        pairs.map(|(a, b)| (*a - first).truncate().perp_dot((*b - first).truncate())).sum()
    };
    let medians = surfaces.medians.iter().map(|median| &median.top);
    let streets: f64 = surfaces
        .carriageways
        .iter()
        .chain(medians)
        .flat_map(|surface| {
            let corner = |index: u32| surface.points[index as usize];
            surface.triangles.iter().map(move |corners| corners.map(corner))
        })
        .map(|corners| twice(&corners) / 2.0)
        .sum();
    let sides = surfaces.sidewalks.iter().map(|walk| {
        let bands = (0..walk.kerb.len()).map(|index| {
            let next = (index + 1) % walk.kerb.len();
            twice(&[walk.kerb[index], walk.kerb[next], walk.edge[next], walk.edge[index]])
        });
        (bands.sum::<f64>() + twice(&walk.edge)) / 2.0
    });
    let all = streets + sides.sum::<f64>();
    assert!(all.abs() < 1e-6 * streets, "{about}: {all} of {streets} m² of streets are open or twice");
}
