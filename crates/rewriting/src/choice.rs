//! Selection of the rule that is applied to a module, among the rules of its symbol.

use smallvec::SmallVec;

use super::rule::Rule;
use burgeon_base::random::Stream;

/// Method of choosing a rule among the rules of a symbol.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Choice {
    /// The only rule, which always applies.
    Sole(u16),
    /// Contexts, values and weights decide.
    Contexts,
    /// Guards decide, in addition to contexts, values and weights.
    Guards,
    /// Contexts in the chain that the step writes decide, in addition to all others.
    NewContexts,
}

impl Choice {
    /// Returns the method of choosing among `rules`, which have these numbers.
    pub(crate) fn among<'a>(rules: impl Iterator<Item = &'a Rule> + Clone, numbers: &[u16]) -> Self {
        if rules.clone().any(Rule::has_new_contexts) {
            return Self::NewContexts;
        }
        if rules.clone().any(|rule| rule.guarded) {
            return Self::Guards;
        }
        let mut first = rules;
        match (first.next(), numbers) {
            (Some(rule), [number])
                if !rule.has_contexts() && !rule.tests_modules() && rule.weight.is_none() =>
            {
                Self::Sole(*number)
            }
            _ => Self::Contexts,
        }
    }
}

/// Candidates for one module: rules of its symbol, in the order of declaration.
///
/// ```
/// use burgeon_rewriting::{Candidates, ModuleKey, Pattern, Rule, Signature, Symbols};
///
/// let mut symbols = Symbols::default();
/// symbols.declare(Signature::new("Bud", &[])?)?;
/// let bud = Pattern::parse("Bud", &symbols)?;
/// let rules = [Some(3.0), Some(1.0)].map(|weight| Rule::new(bud.clone(), weight, false, None));
/// let mut candidates = Candidates::default();
/// (0..).zip(&rules).for_each(|(number, rule)| candidates.add(number, rule));
///
/// let key = ModuleKey::seed(7);
/// let chosen = (0..4000).filter_map(|child| candidates.choose(|| key.child(child).stream()));
/// let first = chosen.filter(|rule| *rule == 0).count();
/// assert!((2900..3100).contains(&first), "{first} of 4000, three in four");
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Candidates {
    /// Candidate without a weight that came before all others.
    winner: Option<u16>,
    weighted: SmallVec<[(u16, f64); 4]>,
}

impl Candidates {
    /// Returns true if `rule` can still be chosen, provided its contexts match and its guard holds. A rule without a
    /// weight can only be chosen as the first candidate, a rule with a weight until a rule without a weight has won.
    #[inline]
    pub fn admit(&self, rule: &Rule) -> bool {
        self.winner.is_none() && (rule.weight.is_some() || self.weighted.is_empty())
    }

    /// Adds `rule`, which has this number, as a candidate.
    #[inline]
    pub fn add(&mut self, number: u16, rule: &Rule) {
        match rule.weight {
            Some(weight) => self.weighted.push((number, weight)),
            None => self.winner = Some(number),
        }
    }

    /// Returns true if no other rule can be chosen.
    #[inline]
    pub fn is_settled(&self) -> bool {
        self.winner.is_some()
    }

    /// Returns the rule to apply, if there is a candidate. Among weighted rules, the first number of the module's
    /// `stream` selects one in proportion to the weights.
    #[inline]
    pub fn choose(&self, stream: impl FnOnce() -> Stream) -> Option<u16> {
        if self.winner.is_some() {
            return self.winner;
        }
        let (last, _) = self.weighted.last()?;
        // Scaling by a power of two is exact, and keeps the sum finite.
        let scale = scale(self.weighted.iter().fold(0.0, |most, (_, weight)| weight.max(most)));
        let total: f64 = self.weighted.iter().map(|(_, weight)| weight * scale).sum();
        let mut left = stream().uniform() * total;
        for (rule, weight) in &self.weighted {
            left -= weight * scale;
            if left < 0.0 {
                return Some(*rule);
            }
        }
        Some(*last)
    }
}

/// Returns a power of two that scales `heaviest` to about 1, as far as the range of numbers allows.
fn scale(heaviest: f64) -> f64 {
    const EXPONENT: u64 = 0x7FF;
    let exponent = heaviest.to_bits() >> 52 & EXPONENT;
    f64::from_bits((2046 - exponent.min(2045)) << 52)
}

#[cfg(test)]
mod tests {
    use super::super::{ModuleKey, Pattern, Signature, Symbols};
    use super::*;

    fn rule(weight: Option<f64>) -> Rule {
        let mut symbols = Symbols::default();
        symbols.declare(Signature::new("A", &[]).unwrap()).unwrap();
        Rule::new(Pattern::parse("A", &symbols).unwrap(), weight, false, None)
    }

    fn candidates(weights: &[Option<f64>]) -> Candidates {
        let mut candidates = Candidates::default();
        for (number, weight) in (0u16..).zip(weights) {
            let rule = rule(*weight);
            if candidates.admit(&rule) {
                candidates.add(number, &rule);
            }
        }
        candidates
    }

    fn shares(weights: &[f64]) -> Vec<f64> {
        let candidates = candidates(&weights.iter().map(|weight| Some(*weight)).collect::<Vec<_>>());
        let mut counts = vec![0.0; weights.len()];
        for seed in 0..4000 {
            let chosen = candidates.choose(|| ModuleKey::seed(seed).stream()).unwrap();
            counts[usize::from(chosen)] += 1.0 / 4000.0;
        }
        counts
    }

    #[test]
    fn a_rule_without_weight_wins_only_as_the_first_candidate() {
        let chosen = |weights: &[Option<f64>]| candidates(weights).choose(|| ModuleKey::seed(1).stream());
        assert_eq!(chosen(&[]), None);
        assert_eq!(chosen(&[None, Some(1e9), None]), Some(0));
        assert_eq!(chosen(&[Some(1.0), None]), Some(0));
    }

    #[test]
    fn weights_of_any_size_are_drawn_in_proportion() {
        for unit in [1.0, 3e-324, 5e-324, 1e-310, 1e-200, 0.7, 1e200, 4e307] {
            for (counted, expected) in shares(&[unit, 2.0 * unit, unit]).iter().zip([0.25, 0.5, 0.25]) {
                assert!((counted - expected).abs() < 0.04, "{unit:e}: {counted} in place of {expected}");
            }
        }
        assert!(shares(&[f64::MAX; 50]).iter().all(|share| (share - 0.02).abs() < 0.02));
        assert!(shares(&[f64::MAX, 5e-324])[0] > 0.999);
    }

    #[test]
    fn a_power_of_two_leaves_what_is_drawn_as_it_was() {
        let weights = [3.0, 0.1, 7.25, 0.3];
        let candidates = candidates(&weights.map(Some));
        for seed in 0..2000 {
            let total: f64 = weights.iter().sum();
            let mut left = ModuleKey::seed(seed).stream().uniform() * total;
            let plain = weights.iter().position(|weight| {
                left -= weight;
                left < 0.0
            });
            assert_eq!(candidates.choose(|| ModuleKey::seed(seed).stream()).map(usize::from), plain);
        }
    }
}
