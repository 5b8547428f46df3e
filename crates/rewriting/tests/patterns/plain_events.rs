//! Rules with propensities, by a plain implementation.

use std::collections::HashMap;

use super::plain::{
    Application, Part, Place, PlainModule, PlainRule, PlainSettings, PlainValue, Walk, keyed,
};
use super::systems::{RandomSystem, sum};
use crate::rewriting::{KeyPart, ModuleKey};

/// Returns the propensity of a rule for these arguments. Some are 0.
pub(crate) fn propensity(arguments: &[PlainValue]) -> f64 {
    let sum = sum(arguments);
    if (sum * 8.0).floor().rem_euclid(3.0) == 2.0 { 0.0 } else { (sum.abs() + 0.1).min(1e6) }
}

/// Returns the propensity of an event; every other rule has the same for all modules.
pub(crate) fn rate(rule: usize, arguments: &[PlainValue]) -> f64 {
    if rule.is_multiple_of(2) { 0.5 * (rule + 1) as f64 } else { propensity(arguments) }
}

/// Returns the upper 128 bits of a product, by long multiplication of digits of 32 bits.
fn high_product(a: u128, b: u128) -> u128 {
    let digits =
        |number: u128| -> Vec<u128> { (0..4).map(|at| (number >> (32 * at)) & 0xFFFF_FFFF).collect() };
    let mut product = [0_u128; 9];
    for (i, x) in digits(a).into_iter().enumerate() {
        for (j, y) in digits(b).into_iter().enumerate() {
            product[i + j] += (x * y) & 0xFFFF_FFFF;
            product[i + j + 1] += (x * y) >> 32;
        }
    }
    for at in 0..8 {
        product[at + 1] += product[at] >> 32;
        product[at] &= 0xFFFF_FFFF;
    }
    (0..4).map(|at| product[4 + at] << (32 * at)).sum()
}

/// Performs the event of a step on a chain whose end has the key `key`, plainly. Returns the chain after it and its time; `None` if no event can occur.
pub(crate) fn plain_event(
    system: &RandomSystem,
    chain: &[Part],
    (step, time): (usize, f64),
    key: ModuleKey,
) -> Option<(Vec<Part>, f64)> {
    let events = events(chain, &system.rules, &system.settings);
    let amounts: Vec<u128> = events
        .iter()
        .map(|event| (rate(event.rule, &event.arguments) * 18_446_744_073_709_551_616.0) as u128)
        .collect();
    let total: u128 = amounts.iter().sum();
    if total == 0 {
        return None;
    }
    let key = key.substream(KeyPart::Text(b"events")).child(step);
    let mut stream = key.stream();
    let waiting = -(1.0 - stream.uniform()).ln() / (total as f64 / 18_446_744_073_709_551_616.0);
    let mut bits = || (stream.uniform() * 9_007_199_254_740_992.0) as u128;
    let fraction = (bits() << 75) | (bits() << 22);
    let mut drawn = high_product(total, fraction);
    let chosen = events.iter().zip(amounts).find(|(_, amount)| {
        let is_here = drawn < *amount;
        drawn = drawn.wrapping_sub(*amount);
        is_here
    });
    let (event, _) = chosen.expect("the place is less than the sum");
    Some((apply_event(chain, &system.rules, event), time + waiting))
}

/// Rule that can be applied to a module.
struct PlainEvent {
    /// Number of the rule.
    rule: usize,
    arguments: Vec<PlainValue>,
    key: ModuleKey,
    /// Indices of the branches that contain the module, from the outermost, and the index of the module.
    at: Vec<usize>,
}

/// Returns all applications of rules to the modules of a chain, in its order and that of the rules.
fn events<R: PlainRule>(chain: &[Part], rules: &[R], settings: &PlainSettings) -> Vec<PlainEvent> {
    let walk = Walk { rules, settings, ring: if settings.ring { chain } else { &[] } };
    let mut found = Vec::new();
    walk.collect_events(chain, &mut Vec::new(), &mut Vec::new(), &mut found);
    found
}

impl<R: PlainRule> Walk<'_, R> {
    fn collect_events<'a>(
        &self,
        parts: &'a [Part],
        path: &mut Vec<&'a PlainModule>,
        at: &mut Vec<usize>,
        found: &mut Vec<PlainEvent>,
    ) {
        let (depth, is_main, ring) = (path.len(), at.is_empty(), self.ring);
        for (position, part) in parts.iter().enumerate() {
            at.push(position);
            match part {
                Part::Branch(inner) => self.collect_events(inner, path, at, found),
                Part::Module(module) => {
                    let (written, after): (&[_], &[_]) = (&[], &[]);
                    let place = Place { path, parts, position, region: 0, is_main, ring, written, after };
                    for (rule, declared) in self.rules.iter().enumerate() {
                        let ignored = declared.ignored().unwrap_or(&self.settings.ignored);
                        let arguments = declared.pattern().bind(&place, ignored);
                        if let Some(arguments) = arguments.filter(|arguments| declared.holds(arguments)) {
                            found.push(PlainEvent { rule, arguments, key: module.key, at: at.clone() });
                        }
                    }
                    path.push(module);
                }
            }
            at.pop();
        }
        path.truncate(depth);
    }
}

/// Returns the chain after an event.
fn apply_event<R: PlainRule>(chain: &[Part], rules: &[R], event: &PlainEvent) -> Vec<Part> {
    let (mut chain, rule) = (chain.to_vec(), &rules[event.rule]);
    let [branches @ .., position] = event.at.as_slice() else { return chain };
    let inner = branches.iter().fold(&mut chain, |parts, index| match &mut parts[*index] {
        Part::Branch(inner) => inner,
        Part::Module(_) => unreachable!("the index of a branch"),
    });
    let application = Application { arguments: &event.arguments, key: event.key, weighted: false };
    match rule.successor(&application) {
        Some(successor) => {
            let made = keyed(successor, event.key, &mut HashMap::new());
            inner.splice(*position..position + rule.pattern().predecessors.len(), made);
        }
        None => {
            if let Part::Module(module) = &mut inner[*position] {
                module.key = module.key.advance();
            }
        }
    }
    chain
}
