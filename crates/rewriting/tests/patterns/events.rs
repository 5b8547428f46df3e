//! Rules with propensities: the crate and a plain implementation draw the same events at the same times.

use std::sync::Arc;

use burgeon_base::Stop;

use super::functions::Prepared;
use super::plain::{self, Part, PlainValue};
use super::systems::{Dice, RandomSystem, sum};
use crate::rewriting::{EventSeries, KeyPart, ModuleKey, Propensity, Rule, Stepper};

/// Returns the propensity of a rule for these arguments. Some are 0.
pub(crate) fn propensity(arguments: &[PlainValue]) -> f64 {
    let sum = sum(arguments);
    if (sum * 8.0).floor() % 3.0 == 2.0 { 0.0 } else { (sum.abs() + 0.1).min(1e6) }
}

/// Returns the propensity of an event; every other rule has the same for all modules.
fn rate(rule: usize, arguments: &[PlainValue]) -> f64 {
    if rule % 2 == 0 { 0.5 * (rule + 1) as f64 } else { propensity(arguments) }
}

/// Returns the upper 128 bits of a product, by long multiplication of digits of 32 bits.
fn high_product(a: u128, b: u128) -> u128 {
    let digits = |number: u128| -> Vec<u128> { (0..4).map(|at| number >> (32 * at) & 0xFFFF_FFFF).collect() };
    let mut product = [0_u128; 9];
    for (i, x) in digits(a).into_iter().enumerate() {
        for (j, y) in digits(b).into_iter().enumerate() {
            product[i + j] += x * y & 0xFFFF_FFFF;
            product[i + j + 1] += x * y >> 32;
        }
    }
    for at in 0..8 {
        product[at + 1] += product[at] >> 32;
        product[at] &= 0xFFFF_FFFF;
    }
    (0..4).map(|at| product[4 + at] << (32 * at)).sum()
}

/// Performs the event of a step plainly. Returns the chain after it and its time; `None` if no event can occur.
fn plain_event(system: &RandomSystem, chain: &[Part], step: usize, time: f64) -> Option<(Vec<Part>, f64)> {
    let events = plain::events(chain, &system.rules, &system.settings);
    let amounts: Vec<u128> = events
        .iter()
        .map(|event| (rate(event.rule, &event.arguments) * 18_446_744_073_709_551_616.0) as u128)
        .collect();
    let total: u128 = amounts.iter().sum();
    if total == 0 {
        return None;
    }
    let key = ModuleKey::default().substream(KeyPart::Text(b"events")).child(step);
    let mut stream = key.stream();
    let waiting = -(1.0 - stream.uniform()).ln() / (total as f64 / 18_446_744_073_709_551_616.0);
    let mut bits = || (stream.uniform() * 9_007_199_254_740_992.0) as u128;
    let fraction = bits() << 75 | bits() << 22;
    let mut drawn = high_product(total, fraction);
    let chosen = events.iter().zip(amounts).find(|(_, amount)| {
        let is_here = drawn < *amount;
        drawn = drawn.wrapping_sub(*amount);
        is_here
    });
    let (event, _) = chosen.expect("the place is less than the sum");
    Some((plain::apply_event(chain, &system.rules, event), time + waiting))
}

/// Performs `steps` events in the crate, `together` in each request. Returns the chain and the time after each request.
fn crate_events(
    system: &RandomSystem,
    axiom: &[Part],
    steps: usize,
    (together, batch, traced): (usize, usize, bool),
) -> Vec<(usize, Vec<Part>, f64)> {
    let prepared = Prepared::new(system, axiom);
    let rules = prepared.rules.iter().enumerate().map(|(number, rule)| {
        let constant = Propensity::Constant(rate(number, &[]));
        rule.clone().with_propensity(if number % 2 == 0 { constant } else { Propensity::Computed })
    });
    let rules: Vec<Rule> = rules.collect();
    let mut stepper = Stepper::new(prepared.plan(rules, batch, traced));
    let mut chain = prepared.chain.clone();
    chain.mark(batch, &prepared.functions.arities());
    let mut chain = Arc::new(chain);
    let mut found = Vec::new();
    let mut done = 0;
    while done < steps {
        let mut series = EventSeries {
            first: done + 1,
            last: steps.min(done + together),
            until: f64::INFINITY,
            is_changed: false,
            ends_at: &[],
            watch: &mut |_, _| true,
        };
        let before = Arc::clone(&chain);
        let outcome = stepper
            .perform_events(&*prepared.functions, &Stop::new(), &chain, &mut series)
            .expect("the functions do not fail");
        if traced && !outcome.settled {
            let counted: usize = outcome.applied.iter().map(|(_, count)| *count as usize).sum();
            assert_eq!(outcome.applied.len(), before.symbols.len());
            assert_eq!(counted, outcome.chain.symbols.len(), "each symbol has an origin");
        }
        chain = Arc::clone(&outcome.chain);
        done += outcome.steps;
        found.push((done, prepared.read(&chain), stepper.event_times()[0]));
        if outcome.settled {
            break;
        }
    }
    found
}

#[test]
fn the_crate_and_a_plain_implementation_draw_the_same_events() {
    let (mut segmented, mut ended, mut grown) = (0, 0, 0);
    for seed in 0..3_000 {
        let mut dice = Dice::new(seed);
        let system = RandomSystem::of_events(&mut dice);
        let axiom = plain::axiom(system.axiom.clone(), seed);
        let mut expected = vec![(axiom.clone(), 0.0)];
        while expected.len() < 30 {
            let (chain, time) = expected.last().expect("the axiom");
            match plain_event(&system, chain, expected.len(), *time) {
                Some(next) => expected.push(next),
                None => break,
            }
        }
        let steps = expected.len() - 1;
        ended += usize::from(steps < 29);
        let more = |(chain, _): &(Vec<Part>, f64)| plain::modules(chain) >= plain::modules(&axiom) + 20;
        grown += usize::from(expected.last().is_some_and(more));
        let division = ([1, 3, 100][dice.below(3)], [1, 2, 7, 4096][dice.below(4)], dice.chance(0.2));
        let texts: Vec<String> = system.rules.iter().map(|rule| rule.pattern.text().0).collect();
        for (done, chain, time) in crate_events(&system, &axiom, 29, division) {
            let (expected_chain, expected_time) = &expected[done];
            assert_eq!(&chain, expected_chain, "seed {seed}, step {done}, {division:?}: {texts:#?}");
            assert_eq!(time.to_bits(), expected_time.to_bits(), "seed {seed}, step {done}: {texts:#?}");
            segmented += usize::from(!division.2 && division.1 < 8);
        }
        if steps < 29 {
            let all = crate_events(&system, &axiom, 29, division);
            assert_eq!(all.last().map(|(done, ..)| *done), Some(steps), "seed {seed}: {texts:#?}");
        }
    }
    assert!(segmented > 5_000 && ended > 100 && grown > 200, "{segmented} {ended} {grown}");
}
