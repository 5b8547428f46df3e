//! Benchmark of growth from 1,000 to 300,000 segments: time per proposal, neighbours returned by the index, dead ends,
//! faces. `cargo bench -p burgeon-streets`.

#![allow(
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "a bench prints its figures, and ends where it cannot"
)]

mod grown;

use std::time::Instant;

use burgeon_streets::DeadEndOptions;
use grown::grown;

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
        if size == 100_000 {
            println!("100,000 pieces in under 5 s: {}", if growth < 5.0 { "met" } else { "missed" });
        }
    }
}
