//! Growth from 1,000 to 300,000 pieces: time of each proposal, neighbours that the index gave for it, dead ends, faces.
//! `cargo bench -p burgeon-streets`.

#![allow(
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "a bench prints its figures, and ends where it cannot"
)]

use std::collections::VecDeque;
use std::time::Instant;

use burgeon_streets::{Constraints, DeadEndOptions, Fate, Obstacles, StreetAttributes, StreetNetwork};
use glam::DVec2;

/// A generator of numbers: xorshift.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, limit: f64) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64 * limit
    }
}

/// A network that grows from its tips, with side streets; and how often a street was proposed.
fn grown(size: usize) -> (StreetNetwork, usize) {
    let mut random = Numbers(0x9E37_79B9_7F4A_7C15);
    let mut network = StreetNetwork::new(Constraints::default(), Obstacles::default()).unwrap();
    let start = network.begin(DVec2::ZERO).unwrap();
    let mut tips: VecDeque<(u32, f64, f64)> =
        (0..4).map(|way| (start, f64::from(way) * 90.0 + random.below(10.0), 18.0)).collect();
    let mut tries = 0;
    while network.size() < size {
        let Some((from, heading, width)) = tips.pop_front() else { break };
        tries += 1;
        let heading = heading + random.below(20.0) - 10.0;
        let to = network.at(from) + DVec2::from_angle(heading.to_radians()) * (60.0 + random.below(60.0));
        let growth =
            network.grow(from, to, StreetAttributes { width, ..StreetAttributes::default() }).unwrap();
        if matches!(growth.fate, Fate::Built | Fate::Bent | Fate::Shortened) {
            tips.push_back((growth.end, heading, width));
            for side in [-90.0, 90.0] {
                if random.below(1.0) < 0.4 {
                    tips.push_back((growth.end, heading + side, 11.0));
                }
            }
        }
    }
    (network, tries)
}

fn main() {
    println!("pieces   growth (s)  µs/proposal  neighbours/proposal  dead ends (s)  faces (s)");
    for size in [1_000, 3_000, 10_000, 30_000, 100_000, 300_000] {
        let begin = Instant::now();
        let (mut network, tries) = grown(size);
        let growth = begin.elapsed().as_secs_f64();
        let looked_at = network.looked_at() as f64 / tries as f64;
        let begin = Instant::now();
        network.join_dead_ends(DeadEndOptions::default());
        let joined = begin.elapsed().as_secs_f64();
        let begin = Instant::now();
        let faces = network.faces().len();
        let divided = begin.elapsed().as_secs_f64();
        assert!(faces > 0);
        println!(
            "{:7} {growth:11.3} {:12.2} {looked_at:20.1} {joined:14.3} {divided:10.3}",
            network.size(),
            growth * 1e6 / tries as f64
        );
    }
}
