//! Sums of propensities that do not depend on the order of addition.

use burgeon_base::random::Stream;

/// Number of binary digits after the point.
const DIGITS: i32 = 64;

/// Maximum propensity of a rule (events per unit of time). The sums of all modules of a chain then stay exact.
pub const MOST_PROPENSITY: f64 = 1e9;

/// Propensity, or sum of propensities, in units of 2^-64. Additions are exact, so that sums are equal for any order and
/// division of a chain.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Amount(u128);

impl Amount {
    /// No propensity.
    pub(crate) const ZERO: Self = Self(0);

    /// Returns the amount next to `propensity`, which is from 0 to [`MOST_PROPENSITY`], towards 0.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "within the range of the type"
    )]
    pub(crate) fn of(propensity: f64) -> Self {
        Self((propensity * 2f64.powi(DIGITS)) as u128)
    }

    /// Returns the sum as a number.
    #[allow(clippy::cast_precision_loss, reason = "rounds to the nearest number")]
    pub(crate) fn number(self) -> f64 {
        self.0 as f64 * 2f64.powi(-DIGITS)
    }

    /// Returns the sum of two amounts.
    pub(crate) fn plus(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }

    /// Returns the rest of this amount after `other`; `None` if it is less than `other`.
    pub(crate) fn minus(self, other: Self) -> Option<Self> {
        self.0.checked_sub(other.0).map(Self)
    }

    /// Returns an amount that is uniform from 0 to less than this one, which is not zero.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "53 bits")]
    pub(crate) fn draw(self, stream: &mut Stream) -> Self {
        let mut bits = || (stream.uniform() * 2f64.powi(53)) as u128;
        let fraction = (bits() << 75) | (bits() << 22);
        Self(high_product(self.0, fraction))
    }
}

/// Returns the upper 128 bits of the product of two numbers.
fn high_product(a: u128, b: u128) -> u128 {
    const LOW: u128 = u64::MAX as u128;
    let ([a_high, a_low], [b_high, b_low]) = ([a >> 64, a & LOW], [b >> 64, b & LOW]);
    let (first, second) = (a_high * b_low, a_low * b_high);
    let carry = ((a_low * b_low) >> 64) + (first & LOW) + (second & LOW);
    a_high * b_high + (first >> 64) + (second >> 64) + (carry >> 64)
}

/// Amounts in an order, with their sum and the search for the amount at a place of the sum in logarithmic time.
#[derive(Debug, Default)]
pub(crate) struct AmountTree {
    /// Sums of a complete binary tree, from its root at index 1. The amounts are its leaves.
    sums: Vec<Amount>,
    count: usize,
}

impl AmountTree {
    /// Replaces all amounts.
    pub(crate) fn fill(&mut self, amounts: impl ExactSizeIterator<Item = Amount>) {
        self.count = amounts.len();
        let leaves = self.count.next_power_of_two();
        self.sums.clear();
        self.sums.resize(leaves, Amount::ZERO);
        self.sums.extend(amounts);
        self.sums.resize(2 * leaves, Amount::ZERO);
        for index in (1..leaves).rev() {
            self.sums[index] = self.sums[2 * index].plus(self.sums[2 * index + 1]);
        }
    }

    /// Replaces the amount at `index` by `parts` amounts of 0.
    pub(crate) fn divide(&mut self, index: usize, parts: usize) {
        let leaves = self.sums.len() / 2;
        let mut amounts = self.sums[leaves..leaves + self.count].to_vec();
        amounts.splice(index..=index, std::iter::repeat_n(Amount::ZERO, parts));
        self.fill(amounts.into_iter());
    }

    /// Replaces the amount at `index`.
    pub(crate) fn set(&mut self, index: usize, amount: Amount) {
        let mut at = self.sums.len() / 2 + index;
        self.sums[at] = amount;
        while at > 1 {
            at /= 2;
            self.sums[at] = self.sums[2 * at].plus(self.sums[2 * at + 1]);
        }
    }

    /// Returns the sum of all amounts.
    pub(crate) fn total(&self) -> Amount {
        self.sums.get(1).copied().unwrap_or_default()
    }

    /// Returns the index of the amount that contains the place `drawn` of the sum, and the rest of `drawn` in it. `drawn` is less
    /// than the sum.
    pub(crate) fn find(&self, mut drawn: Amount) -> (usize, Amount) {
        let mut at = 1;
        while at < self.sums.len() / 2 {
            at *= 2;
            if let Some(rest) = drawn.minus(self.sums[at]) {
                drawn = rest;
                at += 1;
            }
        }
        (at - self.sums.len() / 2, drawn)
    }
}

#[cfg(test)]
mod tests {
    use super::super::ModuleKey;
    use super::*;

    #[test]
    fn the_upper_half_of_a_product_is_exact() {
        assert_eq!(high_product(u128::MAX, u128::MAX), u128::MAX - 1);
        assert_eq!(high_product(1 << 127, 6), 3);
        assert_eq!(high_product(0x1_0000_0000_0000_0001, 0x1_0000_0000_0000_0001), 1);
        assert_eq!(high_product(u128::MAX, 1), 0);
    }

    #[test]
    fn a_tree_finds_what_a_scan_finds() {
        let mut stream = ModuleKey::seed(3).stream();
        for count in 1..40 {
            let mut amounts: Vec<Amount> =
                (0..count).map(|_| Amount::of((stream.uniform() * 4.0).floor())).collect();
            let mut tree = AmountTree::default();
            tree.fill(amounts.iter().copied());
            for _ in 0..20 {
                let changed = stream.below(count);
                amounts[changed] = Amount::of(stream.uniform());
                tree.set(changed, amounts[changed]);
                let total = amounts.iter().fold(Amount::ZERO, |sum, amount| sum.plus(*amount));
                assert_eq!(tree.total(), total);
                let drawn = total.draw(&mut stream);
                let (mut at, mut rest) = (0, drawn);
                while let Some(left) = rest.minus(amounts[at]) {
                    (at, rest) = (at + 1, left);
                }
                assert_eq!(tree.find(drawn), (at, rest));
            }
        }
    }

    #[test]
    fn draws_are_uniform_and_sums_do_not_depend_on_the_order() {
        let mut stream = ModuleKey::seed(4).stream();
        let numbers: Vec<f64> = (0..1000).map(|_| stream.uniform() * 1e-3).collect();
        let sum = |numbers: &mut dyn Iterator<Item = &f64>| {
            numbers.fold(Amount::ZERO, |sum, number| sum.plus(Amount::of(*number)))
        };
        let total = sum(&mut numbers.iter());
        assert_eq!(total, sum(&mut numbers.iter().rev()));
        assert!((total.number() - numbers.iter().sum::<f64>()).abs() < 1e-12);
        let mean = (0..10_000).map(|_| total.draw(&mut stream).number()).sum::<f64>() / 1e4;
        assert!((mean / total.number() - 0.5).abs() < 0.01, "{mean}");
    }
}
