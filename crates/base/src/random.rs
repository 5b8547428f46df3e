//! Random numbers: xoshiro256++ with a numeric seed.

use rand_core::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// A stream of random numbers.
///
/// ```
/// use burgeon_base::random::Stream;
///
/// let (mut one, mut same, mut other) = (Stream::new(7), Stream::new(7), Stream::new(8));
/// let numbers: Vec<f64> = (0..4).map(|_| one.uniform()).collect();
/// assert!(numbers.iter().all(|number| (0.0..1.0).contains(number)));
/// assert_eq!(numbers, (0..4).map(|_| same.uniform()).collect::<Vec<_>>());
/// assert_ne!(numbers[0], other.uniform());
/// ```
#[derive(Debug, Clone)]
pub struct Stream(Xoshiro256PlusPlus);

impl Stream {
    /// Creates the stream of `seed`, at its first number.
    #[inline]
    pub fn new(seed: u64) -> Self {
        Self(Xoshiro256PlusPlus::seed_from_u64(seed))
    }

    /// Returns the next number, uniform in [0, 1).
    #[inline]
    pub fn uniform(&mut self) -> f64 {
        #[allow(clippy::cast_precision_loss, reason = "53 bits fit an f64 exactly")]
        let bits = (self.0.next_u64() >> 11) as f64;
        bits * (1.0 / 9_007_199_254_740_992.0)
    }

    /// Returns a random integer from 0 to `count` - 1; 0 if `count` is 0.
    pub fn below(&mut self, count: usize) -> usize {
        #[allow(clippy::cast_possible_truncation, reason = "a remainder of a usize fits one")]
        let number = (self.0.next_u64() % count.max(1) as u64) as usize;
        number
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_numbers_are_uniform() {
        let mut stream = Stream::new(7);
        let mut counts = [0u32; 10];
        for _ in 0..100_000 {
            counts[(stream.uniform() * 10.0) as usize] += 1;
        }
        let chi: f64 = counts.iter().map(|count| (f64::from(*count) - 10_000.0).powi(2) / 10_000.0).sum();
        assert!(chi < 27.9, "chi-square {chi} with 9 degrees of freedom");
    }
}
