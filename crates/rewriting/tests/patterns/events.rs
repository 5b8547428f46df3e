//! Rules with propensities: the crate and a plain implementation draw the same events at the same times.

use std::sync::Arc;

use burgeon_base::Stop;

use super::functions::Prepared;
use super::plain::{self, Part};
use super::plain_events::{plain_event, rate};
use super::systems::{Dice, RandomSystem};
use crate::rewriting::{ChainsBetween, EventSeries, EventsNext, ModuleKey, Propensity, Rule, Stepper};

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
        rule.clone().with_propensity(if number.is_multiple_of(2) { constant } else { Propensity::Computed })
    });
    let rules: Vec<Rule> = rules.collect();
    let mut stepper = Stepper::new(&prepared.plan(rules, batch, traced));
    let mut chain = prepared.chain.clone();
    chain.mark(batch, &prepared.functions.arities());
    let mut chain = Arc::new(chain);
    let mut found = Vec::new();
    let mut done = 0;
    while done < steps {
        // The chains between events are those of requests for single events.
        let mut seen = Vec::new();
        let mut between = |chains: &ChainsBetween, number: usize| {
            seen.push((number - 1, prepared.read(chains.whole()), chains.time()));
            Ok([EventsNext::Continue, EventsNext::Recompute, EventsNext::End][number % 3])
        };
        let mut series = EventSeries {
            first: done + 1,
            last: steps.min(done + together),
            until: f64::INFINITY,
            is_changed: false,
            ends_at: &[],
            watch: &mut |_, _| true,
            between: Some(&mut between),
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
        found.append(&mut seen);
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
            match plain_event(&system, chain, (expected.len(), *time), ModuleKey::default()) {
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
