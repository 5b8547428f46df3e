//! Tests of the guarantees of growth: next to obstacles, on existing streets, and in predictions.

use glam::DVec2;

use crate::tests::{TestNumbers, check, grown};
use crate::*;
use burgeon_geometry::{Polygon, Rings};

/// Returns random obstacles away from the origin: boxes, triangles and stars at any angle; some can be bridged.
fn obstacles(seed: u64, count: usize) -> (Vec<Obstacle>, Obstacles) {
    let mut random = TestNumbers(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) + 7);
    let mut areas = Vec::new();
    while areas.len() < count {
        let middle = DVec2::new(random.below(900.0) - 450.0, random.below(900.0) - 450.0);
        let (radius, turned) = (8.0 + random.below(70.0), random.below(6.3));
        if middle.length() < radius + 40.0 {
            continue;
        }
        let corners = 3 + random.below(7.0) as usize;
        let ring = (0..corners).map(|corner| {
            let reach = radius * (0.3 + random.below(0.7));
            middle
                + DVec2::from_angle(turned + corner as f64 / corners as f64 * std::f64::consts::TAU) * reach
        });
        let area = Polygon::new(Rings(vec![ring.collect()])).expect("a star");
        areas.push(Obstacle { area, is_limit: false, can_be_bridged: random.below(1.0) < 0.4 });
    }
    (areas.clone(), Obstacles::new(areas))
}

/// Returns the distance (m) between two segments.
fn apart([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> f64 {
    let aside = |place: DVec2, [from, to]: [DVec2; 2]| {
        let way = to - from;
        let along = ((place - from).dot(way) / way.length_squared()).clamp(0.0, 1.0);
        place.distance(from + way * along)
    };
    let side = |a: DVec2, b: DVec2, c: DVec2| (b - a).perp_dot(c - a).signum();
    let crosses = side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0;
    let least = [aside(a, [c, d]), aside(b, [c, d]), aside(c, [a, b]), aside(d, [a, b])];
    if crosses { 0.0 } else { least.into_iter().fold(f64::INFINITY, f64::min) }
}

/// Asserts that each segment except bridges keeps half of its width from all edges of all areas, and is inside none.
fn check_obstacles(network: &StreetNetwork, areas: &[Obstacle]) {
    for (id, piece) in network.pieces() {
        let line = network.line(id);
        for obstacle in areas {
            let is_bridge = piece.is_bridge && obstacle.can_be_bridged;
            assert!(line.iter().all(|end| !obstacle.area.contains(*end)), "{line:?} ends in an obstacle");
            for edge in obstacle.area.edges() {
                let apart = apart(line, edge);
                // Segments that were divided turned by half a grid step.
                assert!(is_bridge || apart >= piece.attributes.width / 2.0 - 0.002, "{apart} from {edge:?}");
            }
        }
    }
}

#[test]
fn no_street_is_within_an_obstacle_whatever_its_shape() {
    let mut built = 0;
    for seed in 1..=40 {
        let (areas, all) = obstacles(seed, 30);
        let bridge = if seed % 2 == 0 { 60.0 } else { 0.0 };
        let constraints = Constraints { bridge, ..Constraints::default() };
        let mut network = grown(seed, 150, constraints, all);
        network.join_dead_ends(DeadEndOptions::default());
        check_obstacles(&network, &areas);
        check(&network);
        built += network.size();
    }
    assert!(built > 40 * 60, "{built}");
}

#[test]
fn streets_stay_inside_of_a_limit() {
    for seed in 1..=20 {
        let ring = vec![(-200.0, -170.0), (210.0, -190.0), (260.0, 140.0), (20.0, 60.0), (-180.0, 220.0)];
        let ring: Vec<DVec2> = ring.into_iter().map(DVec2::from).collect();
        let area = Polygon::new(Rings(vec![ring])).expect("a limit");
        let limit = Obstacle { area: area.clone(), is_limit: true, can_be_bridged: false };
        let network = grown(seed, 200, Constraints::default(), Obstacles::new(vec![limit]));
        for (id, piece) in network.pieces() {
            assert!(network.line(id).iter().all(|end| area.contains(*end)));
            for edge in area.edges() {
                assert!(apart(network.line(id), edge) >= piece.attributes.width / 2.0 - 0.002);
            }
        }
    }
}

#[test]
fn what_is_probed_is_what_is_built() {
    let mut random = TestNumbers(99);
    let (_, all) = obstacles(5, 20);
    let mut network = grown(5, 120, Constraints::default(), all);
    let street = StreetAttributes { width: 11.0, ..StreetAttributes::default() };
    for _ in 0..500 {
        let from = random.below(network.junctions().len() as f64) as u32;
        let to = network.at(from) + DVec2::from_angle(random.below(6.3)) * random.below(120.0);
        let before = network.size();
        let prospect = network.probe(from, to, street);
        assert_eq!(network.size(), before);
        let growth = network.grow(from, to, street).expect("room");
        assert_eq!(prospect.fate, growth.fate);
        if !matches!(growth.fate, Fate::Refused(_)) {
            assert_eq!(prospect.place, network.at(growth.end));
            assert!(prospect.junction.is_none_or(|junction| junction == growth.end));
        }
    }
    check(&network);
}
