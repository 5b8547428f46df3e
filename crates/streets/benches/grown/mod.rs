//! The network that the benches grow: streets start at the ends of other streets, with side streets, up to a given
//! size.

use std::collections::VecDeque;

use burgeon_streets::{Constraints, Fate, Obstacles, StreetAttributes, StreetNetwork};
use glam::DVec2;

/// Random number generator (xorshift).
pub(crate) struct Numbers(pub(crate) u64);

impl Numbers {
    /// Returns the next number, from 0 to `limit`.
    pub(crate) fn below(&mut self, limit: f64) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64 * limit
    }
}

/// Grows a network of `size` segments; returns it with the number of proposed streets.
pub(crate) fn grown(size: usize) -> (StreetNetwork, usize) {
    let mut random = Numbers(0x9E37_79B9_7F4A_7C15);
    let mut network = StreetNetwork::new(Constraints::default(), Obstacles::default()).unwrap();
    let start = network.begin(DVec2::ZERO).unwrap();
    let mut tips: VecDeque<(u32, f64, u32)> =
        (0..4).map(|way| (start, f64::from(way) * 90.0 + random.below(10.0), 0)).collect();
    let mut tries = 0;
    while network.size() < size {
        let Some((from, heading, depth)) = tips.pop_front() else { break };
        tries += 1;
        let heading = heading + random.below(20.0) - 10.0;
        let length = 60.0 + random.below(60.0);
        let to = network.at(from) + DVec2::from_angle(heading.to_radians()) * length;
        let width = if depth == 0 { 18.0 } else { 11.0 };
        let street = StreetAttributes { width, depth, ..StreetAttributes::default() };
        let growth = network.grow(from, to, street).unwrap();
        if matches!(growth.fate, Fate::Built | Fate::Bent | Fate::Shortened) {
            tips.push_back((growth.end, heading, depth));
            for side in [-90.0, 90.0] {
                if random.below(1.0) < 0.4 {
                    tips.push_back((growth.end, heading + side, depth + 1));
                }
            }
        }
    }
    (network, tries)
}
