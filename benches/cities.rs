//! Towns: 200 seeds of each script, with statistics of buildings and streets.
//! `cargo bench --bench cities [-- SEEDS] [SCRIPT] [extent=METRES]`.

#![allow(clippy::print_stdout, reason = "a bench prints its figures")]

use std::time::Instant;

#[path = "../tests/streets/check.rs"]
#[allow(dead_code, reason = "what whole towns do not need")]
mod check;
#[path = "../tests/streets/cities.rs"]
mod cities;

use cities::{TOWNS, Town, TownFigures, figures};

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    let seeds: u64 = words.iter().find_map(|word| word.parse().ok()).unwrap_or(200);
    let extent = words.iter().find_map(|word| word.strip_prefix("extent="));
    let script = words.iter().find(|word| TOWNS.iter().any(|town| town.script == **word));
    println!(
        "| script | towns | buildings | pairs that overlap | on a street | streets that cross | least angle over the minimum | parts | joined | lots | without access | areas off by | height and depth |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|---|");
    let name = |town: &Town| match extent {
        Some(extent) => format!("{} extent={extent}", town.script),
        None => town.name(),
    };
    for town in TOWNS.iter().filter(|town| script.is_none_or(|script| town.script == *script)) {
        let begin = Instant::now();
        let all: Vec<TownFigures> = (0..seeds).map(|seed| figures(town, seed, extent)).collect();
        let sum = |of: fn(&TownFigures) -> usize| all.iter().map(of).sum::<usize>();
        let least = |of: fn(&TownFigures) -> f64| all.iter().map(of).fold(f64::INFINITY, f64::min);
        let parts = all.iter().map(|it| it.components).max().unwrap_or(0);
        let area = all.iter().map(|it| it.area).fold(0.0, f64::max);
        let known: Vec<f64> =
            all.iter().filter_map(|it| it.correlation).filter(|it| it.is_finite()).collect();
        let correlation = known.iter().sum::<f64>() / known.len().max(1) as f64;
        println!(
            "| {} | {} | {} | {} | {} | {} | {:.2}° | {parts} | {:.1} % | {} | {} | {area:.1e} | {correlation:.2} |",
            name(town),
            all.len(),
            sum(|it| it.buildings),
            sum(|it| it.overlaps),
            sum(|it| it.on_street),
            sum(|it| it.crossings),
            least(|it| it.angle),
            100.0 * least(TownFigures::joined),
            sum(|it| it.lots),
            sum(|it| it.landlocked),
        );
        for (seed, of) in (0..).zip(&all) {
            if let Some(fault) = of.fault() {
                println!("seed {seed} of {}: {fault}: {of:?}", name(town));
            }
        }
        println!("{} in {:.1} s", name(town), begin.elapsed().as_secs_f64());
    }
}
