//! Patterns with several predecessors, values, wildcards, ends, cuts, rings and contexts in the new chain: the crate and a
//! plain implementation derive the same chains.

mod events;
mod functions;
mod plain;
mod plain_events;
mod systems;

use burgeon_rewriting as rewriting;

use plain::PlainPattern;
use systems::{Dice, RandomSystem};

/// Numbers of compared systems, to ensure that the test is meaningful.
#[derive(Debug, Default)]
struct Compared {
    changed: usize,
    runs: usize,
    values: usize,
    ends: usize,
    cuts: usize,
    rings: usize,
    ignored: usize,
    new_left: usize,
    new_right: usize,
    /// Systems of which a chain is not the same without regions.
    regions: usize,
}

#[test]
fn random_systems_derive_the_same_chains_in_the_crate_and_plainly() {
    let compared = compare(0..10_000, RandomSystem::new);
    assert!(compared.changed > 2000 && compared.runs > 2000 && compared.values > 500, "{compared:?}");
    assert!(compared.ends > 500 && compared.cuts > 500, "{compared:?}");
    assert!(compared.rings > 500 && compared.ignored > 500, "{compared:?}");
    assert!(compared.new_left > 500 && compared.new_right > 500, "{compared:?}");
}

#[test]
fn random_systems_with_regions_derive_the_same_chains_in_the_crate_and_plainly() {
    let compared = compare(0..10_000, RandomSystem::with_regions);
    assert!(compared.regions > 3000 && compared.runs > 2000 && compared.cuts > 500, "{compared:?}");
    assert!(compared.rings > 500 && compared.ignored > 500, "{compared:?}");
    assert!(compared.new_left > 500 && compared.new_right > 500, "{compared:?}");
}

/// Compares the chains of systems that `make` returns for the seeds of their random numbers.
fn compare(seeds: std::ops::Range<u64>, make: fn(&mut Dice) -> RandomSystem) -> Compared {
    let mut compared = Compared::default();
    for seed in seeds {
        let mut dice = Dice::new(seed);
        let system = make(&mut dice);
        let axiom = plain::axiom(system.axiom.clone(), seed);
        let mut expected = Vec::new();
        let mut chain = axiom.clone();
        while expected.len() < 4 && plain::modules(&chain) < 300 {
            let cut = plain::cut_branches(&chain, "Cut");
            compared.cuts += usize::from(cut != chain);
            chain = plain::step(&cut, &system.rules, &system.settings);
            expected.push(chain.clone());
        }
        let division = (1 + usize::from(seed % 4 == 0), [1, 2, 7, 4096][seed as usize / 4 % 4]);
        let found = functions::derive(&system, &axiom, expected.len(), division);
        let texts: Vec<String> = system.rules.iter().map(|rule| rule.pattern.text().0).collect();
        for (step, (found, expected)) in found.iter().zip(&expected).enumerate() {
            assert_eq!(found, expected, "seed {seed}, step {}, {division:?}: {texts:#?}", step + 1);
        }
        let any = |what: &str| texts.iter().any(|text| text.contains(what));
        compared.changed += usize::from(expected.first() != Some(&axiom));
        compared.runs += usize::from(system.rules.iter().any(|rule| rule.pattern.predecessors.len() > 1));
        compared.values += usize::from(any("\"") || any("true") || any("nil"));
        compared.ends += usize::from(any("$") || any("^"));
        compared.rings += usize::from(system.settings.ring && (any("<") || any(">")));
        compared.ignored += usize::from(system.rules.iter().any(|rule| rule.ignored.is_some()));
        compared.new_left += usize::from(any("<<"));
        compared.new_right += usize::from(any(">>"));
        if !system.settings.openers.is_empty() {
            let settings = plain::PlainSettings { openers: Vec::new(), ..system.settings.clone() };
            let mut chain = axiom.clone();
            let differs = expected.iter().any(|expected| {
                chain = plain::step(&plain::cut_branches(&chain, "Cut"), &system.rules, &settings);
                chain != *expected
            });
            compared.regions += usize::from(differs);
        }
    }
    compared
}

/// Turns contexts in the new chain into contexts in the old chain, next to the module.
fn see_the_old_chain(pattern: &mut PlainPattern) {
    pattern.left.modules.append(&mut pattern.new_left.modules);
    pattern.right.splice(0..0, pattern.new_right.drain(..));
}

#[test]
fn systems_of_modules_that_depend_on_one_another_derive_the_same_chains_in_the_crate_and_plainly() {
    let (mut dependent, mut differing, mut grown) = (0, 0, 0);
    for seed in 0..6_000 {
        let mut dice = Dice::new(seed);
        let system = RandomSystem::of_dependents(&mut dice);
        let axiom = plain::axiom(system.axiom.clone(), seed);
        let mut expected = Vec::new();
        let mut chain = axiom.clone();
        while expected.len() < 4 && plain::modules(&chain) < 300 {
            let cut = plain::cut_branches(&chain, "Cut");
            chain = plain::step(&cut, &system.rules, &system.settings);
            expected.push(chain.clone());
        }
        // Each system depends on contexts in the new chain if it derives another chain when they see the old chain.
        let mut parallel = system.rules.clone();
        for rule in &mut parallel {
            see_the_old_chain(&mut rule.pattern);
        }
        let cut = plain::cut_branches(&axiom, "Cut");
        differing += usize::from(Some(&plain::step(&cut, &parallel, &system.settings)) != expected.first());
        dependent += usize::from(functions::Prepared::new(&system, &axiom).rewrites_dependents());
        grown += usize::from(plain::modules(&chain) > plain::modules(&axiom));
        let texts: Vec<String> = system.rules.iter().map(|rule| rule.pattern.text().0).collect();
        for division in [(1, [1, 2, 7, 4096][seed as usize % 4]), (2, [7, 1, 4096, 2][seed as usize % 4])] {
            let found = functions::derive(&system, &axiom, expected.len(), division);
            for (step, (found, expected)) in found.iter().zip(&expected).enumerate() {
                assert_eq!(found, expected, "seed {seed}, step {}, {division:?}: {texts:#?}", step + 1);
            }
        }
    }
    println!("{dependent} {differing} {grown}");
    assert!(dependent > 5_000 && differing > 1_000 && grown > 800, "{dependent} {differing} {grown}");
}
