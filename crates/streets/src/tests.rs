//! Tests of random networks against all guarantees, by examining all pairs of segments.

use glam::DVec2;

use super::*;
use crate::plan::grid::touch;

/// Random number generator (xorshift).
pub(crate) struct TestNumbers(pub(crate) u64);

impl TestNumbers {
    pub(crate) fn below(&mut self, limit: f64) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64 * limit
    }
}

/// Returns the street type of a depth in a network grown from a seed.
pub(crate) fn kind_of(seed: u64, depth: u32) -> StreetKind {
    StreetKind::of(&kinds(seed), depth)
}

/// Returns the street types by depth.
pub(crate) fn kinds(seed: u64) -> [StreetKind; 2] {
    let kind = |width, sidewalk, median| StreetKind { width, sidewalk, median, ..StreetKind::default() };
    match seed % 4 {
        0 => [kind(18.0, 2.5, 0.0), kind(11.0, 2.5, 0.0)],
        1 => [kind(24.0, 4.0, 2.5), kind(11.0, 1.5, 0.0)],
        2 => [kind(18.0, 5.5, 0.0), kind(18.0, 2.0, 1.2)],
        _ => [kind(20.0, 3.0, 3.0), kind(16.0, 0.0, 0.0)],
    }
}

/// Grows a network from its dead ends, with side streets, up to `size` segments.
pub(crate) fn grown(seed: u64, size: usize, constraints: Constraints, obstacles: Obstacles) -> StreetNetwork {
    let mut random = TestNumbers(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) + 1);
    let mut network = StreetNetwork::new(constraints, obstacles).expect("constraints");
    let start = network.begin(DVec2::ZERO).expect("free ground");
    let mut tips: std::collections::VecDeque<(u32, f64, u32)> =
        (0..4).map(|way| (start, f64::from(way) * 90.0 + random.below(10.0), 0)).collect();
    let mut tries = 0;
    while network.size() < size && tries < size * 20 {
        tries += 1;
        let Some((from, heading, depth)) = tips.pop_front() else { break };
        let heading = heading + random.below(20.0) - 10.0;
        let length = 60.0 + random.below(60.0);
        let to = network.at(from) + DVec2::from_angle(heading.to_radians()) * length;
        let growth = network.grow(from, to, kind_of(seed, depth).attributes(depth)).expect("room");
        if matches!(growth.fate, Fate::Built | Fate::Bent | Fate::Shortened) {
            tips.push_back((growth.end, heading, depth));
            for side in [-90.0, 90.0] {
                if random.below(1.0) < 0.4 {
                    tips.push_back((growth.end, heading + side, depth + 1));
                }
            }
        }
    }
    network
}

/// Asserts all guarantees of a network, by examining all pairs of segments.
pub(crate) fn check(network: &StreetNetwork) {
    let pieces: Vec<u32> = network.pieces().map(|(id, _)| id).collect();
    let least = network.constraints().least_angle();
    for (index, &a) in pieces.iter().enumerate() {
        assert!(network.length(a) >= network.constraints().min_length - 1e-3, "length {}", network.length(a));
        for &b in &pieces[..index] {
            let shared: Vec<u32> =
                network.ends(a).into_iter().filter(|end| network.ends(b).contains(end)).collect();
            match shared[..] {
                [] => assert!(!touch(network.grid_line(a), network.grid_line(b)), "{a} and {b} cross"),
                [junction] => {
                    let angle = network.leaves(a, junction).angle_to(network.leaves(b, junction)).abs();
                    assert!(angle.to_degrees() >= least, "{} degrees", angle.to_degrees());
                }
                _ => panic!("{a} and {b} join the same junctions"),
            }
        }
    }
    for &piece in &pieces {
        let both: f64 = network.ends(piece).into_iter().map(|end| network.reach_at(end, piece)).sum();
        assert!(both <= network.length(piece) + 0.01, "corners take {both} of {}", network.length(piece));
    }
    // Euler's formula: faces and the outside.
    let there = network.junctions().iter().filter(|junction| junction.degree() > 0).count();
    let faces = network.faces();
    assert_eq!(there + faces.len() + 1, network.size() + 1 + network.components());
    let inside: f64 = faces.iter().map(|face| network.area(&face.around)).sum();
    assert!(inside >= 0.0);
}

#[test]
fn streets_meet_at_junctions_only_and_keep_their_angles() {
    for seed in 1..=40 {
        let network = grown(seed, 300, Constraints::default(), Obstacles::default());
        assert!(network.size() >= 200, "{}", network.size());
        check(&network);
    }
}

#[test]
fn dead_ends_are_joined_until_none_can_be() {
    let options = DeadEndOptions::default();
    let (mut before, mut after) = (0, 0);
    for seed in 1..=20 {
        let mut network = grown(seed, 300, Constraints::default(), Obstacles::default());
        before += network.dead_ends().count();
        network.join_dead_ends(options);
        after += network.dead_ends().count();
        assert_eq!(network.joinable_dead_ends(options), 0);
        assert_eq!(network.components(), 1);
        check(&network);
        network.remove_dead_ends();
        assert_eq!(network.dead_ends().count(), 0);
        check(&network);
    }
    assert!(after * 2 < before, "{before} dead ends, {after} left");
}

#[test]
fn the_same_proposals_give_the_same_network() {
    let [a, b] = [7, 7].map(|seed| grown(seed, 200, Constraints::default(), Obstacles::default()));
    let lines =
        |network: &StreetNetwork| network.pieces().map(|(id, _)| network.line(id)).collect::<Vec<_>>();
    assert_eq!(lines(&a), lines(&b));
}
