//! Contexts and choices of thousands of random systems, compared with the naive matcher of the tests; and the time of a
//! context by the length of the chain, which must not grow. `cargo bench --bench contexts [-- SEEDS]`.

#![allow(clippy::print_stdout, reason = "a bench prints its figures")]

use std::hint::black_box;
use std::time::Instant;

#[allow(dead_code, reason = "the tests use more of it")]
#[path = "../tests/rewriting/candidates.rs"]
mod candidates;
#[allow(dead_code, reason = "the tests use more of it")]
#[path = "../tests/rewriting/generate.rs"]
mod generate;
#[allow(dead_code, reason = "the tests use more of it")]
#[path = "../tests/rewriting/naive.rs"]
mod naive;
#[allow(dead_code, reason = "the tests use more of it")]
#[path = "../tests/rewriting/scripts.rs"]
mod scripts;

use generate::{Dice, Engine, KINDS, Made};

const SIZES: [usize; 4] = [32_768, 131_072, 524_288, 1_048_576];

/// Chains that repeat one unit, in which no context matches at any distance.
const REGULAR: [(&[&str], &str); 6] = [
    (&["X"], "X > [ Z ]"),
    (&["X", "[", "C", "]"], "X > [ Z ]"),
    (&["X", "[", "C", "[", "C", "]", "]"], "X > [ C [ C ] ] [ Z ]"),
    (&["X", "[", "[", "C", "]", "]"], "X > [ [ Z ] ]"),
    (&["X", "[", "]"], "X > Z"),
    (&["[", "X", "X"], "A < X > A"),
];

/// Measures the time to compute the links and all matches of a chain (ns for each word): the minimum of three runs.
#[allow(clippy::cast_precision_loss, reason = "shown with one digit")]
fn time(made: &Made) -> f64 {
    let each = (0..3).map(|_| {
        let begin = Instant::now();
        let engine = Engine::new(made);
        for rule in 0..made.patterns.len() {
            black_box(engine.matching(rule).count());
        }
        begin.elapsed().as_secs_f64() * 1e9 / made.words.len() as f64
    });
    each.fold(f64::INFINITY, f64::min)
}

/// Prints a row. Panics if the time per word grows with the chain.
fn row(name: &str, make: impl Fn(usize) -> Made) {
    let times = SIZES.map(|size| time(&make(size)));
    println!("| {name} | {} |", times.map(|time| format!("{time:.1}")).join(" | "));
    assert!(times[3] < 4.0 * times[0] + 20.0, "{name}: the time of a context grows with the chain");
}

fn main() {
    let seeds = std::env::args().skip(1).find_map(|text| text.parse().ok()).unwrap_or(2000);
    for kind in KINDS {
        let begin = Instant::now();
        let matched: usize = (1000..1000 + seeds)
            .map(|seed| generate::compare(kind, seed, 10 + (seed as usize % 20) * 20))
            .sum();
        println!(
            "{kind:?}: {seeds} chains of 6 patterns, {matched} matches as in the naive matcher, {:.1?}",
            begin.elapsed()
        );
    }
    let begin = Instant::now();
    let (mut applied, mut drawn, mut weightless) = (0, 0, 0);
    for seed in 0..seeds / 200 {
        let compared = candidates::compare(seed, 500, burgeon::options());
        (applied, drawn, weightless) =
            (applied + compared.applied, drawn + compared.drawn, weightless + compared.weightless);
    }
    println!(
        "Choice: {} systems, {applied} rules applied, {drawn} drawn, {weightless} times a rule of weight 0 passed over, {:.1?}",
        seeds / 200 * 500,
        begin.elapsed()
    );
    println!("\nTime for a word of the chain (ns), links included.");
    println!("| chain and patterns | 32 k | 131 k | 524 k | 1 M |\n|---|---|---|---|---|");
    for (unit, pattern) in REGULAR {
        row(&format!("{} ..., {pattern}", unit.join(" ")), |size| {
            let mut words = unit.repeat(size / unit.len());
            let open = words.iter().filter(|word| **word == "[").count();
            words.extend(std::iter::repeat_n("]", open - words.iter().filter(|word| **word == "]").count()));
            Made { words, patterns: vec![pattern.to_owned()], ignored: vec!["X"] }
        });
    }
    for kind in KINDS {
        row(&format!("{kind:?}, 6 patterns"), |size| kind.make(&mut Dice::new(7), size, 6));
    }
}
