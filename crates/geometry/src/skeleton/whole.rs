//! Integers of any size, as fast as machine integers if these are sufficient.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

use dashu_int::IBig;
use dashu_int::ops::{BitTest, UnsignedAbs};

/// An integer of any size.
///
/// Axis-parallel plans need few digits: their products fit in 128 bits, which is several times faster than
/// big integers.
#[derive(Debug, Clone)]
pub(super) enum Whole {
    Short(i128),
    Long(IBig),
}

use Whole::{Long, Short};

impl Whole {
    pub(super) const ZERO: Self = Short(0);
    pub(super) const ONE: Self = Short(1);

    fn long(&self) -> IBig {
        match self {
            Short(number) => IBig::from(*number),
            Long(number) => number.clone(),
        }
    }

    /// Applies an operation to two numbers as big integers, if an operand or the result needs one.
    #[cold]
    fn longer(&self, other: &Self, of: impl Fn(&IBig, &IBig) -> IBig) -> Self {
        Long(match (self, other) {
            (Long(a), Long(b)) => of(a, b),
            (Long(a), b) => of(a, &b.long()),
            (a, Long(b)) => of(&a.long(), b),
            (a, b) => of(&a.long(), &b.long()),
        })
    }

    /// Returns the number multiplied by two to the power of `by`.
    pub(super) fn shifted(&self, by: usize) -> Self {
        match self {
            Short(0) => Self::ZERO,
            &Short(number) if by < number.unsigned_abs().leading_zeros() as usize => Short(number << by),
            number => Long(number.long() << by),
        }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.sign() == Ordering::Equal
    }

    /// Compares the number with zero.
    pub(super) fn sign(&self) -> Ordering {
        match self {
            Short(number) => number.cmp(&0),
            Long(number) => number.cmp(&IBig::ZERO),
        }
    }

    /// Returns the number of binary digits of the absolute value.
    fn bits(&self) -> usize {
        match self {
            Short(number) => 128 - number.unsigned_abs().leading_zeros() as usize,
            Long(number) => number.unsigned_abs().bit_len(),
        }
    }

    /// Returns the quotient by another number, rounded; NaN if that number is zero.
    pub(super) fn quotient(&self, under: &Self) -> f64 {
        if under.is_zero() {
            return f64::NAN;
        }
        let shift = (under.bits() + 66).saturating_sub(self.bits());
        let number = (self.long() << shift) / under.long();
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_possible_wrap,
            reason = "a few thousand at most"
        )]
        let power = (-(shift as i64)).max(-2000) as i32;
        number.to_f64().value() * 2f64.powi(power / 2) * 2f64.powi(power - power / 2)
    }
}

impl Mul for &Whole {
    type Output = Whole;

    #[inline]
    fn mul(self, other: Self) -> Whole {
        if let (&Short(a), &Short(b)) = (self, other)
            && let (Ok(a), Ok(b)) = (i64::try_from(a), i64::try_from(b))
        {
            return Short(i128::from(a) * i128::from(b));
        }
        self.longer(other, |a, b| a * b)
    }
}

impl Add for Whole {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        if let (&Short(a), &Short(b)) = (&self, &other)
            && let Some(sum) = a.checked_add(b)
        {
            return Short(sum);
        }
        match (self, other) {
            (Long(a), Long(b)) => Long(a + b),
            (a, b) => a.longer(&b, |a, b| a + b),
        }
    }
}

impl Sub for Whole {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Whole {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        match self {
            Short(number) => number.checked_neg().map_or_else(|| Long(-IBig::from(number)), Short),
            Long(number) => Long(-number),
        }
    }
}

impl PartialEq for Whole {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Whole {}

impl Ord for Whole {
    fn cmp(&self, other: &Self) -> Ordering {
        match (self, other) {
            (Short(a), Short(b)) => a.cmp(b),
            (Long(a), Long(b)) => a.cmp(b),
            (a, b) => a.long().cmp(&b.long()),
        }
    }
}

impl PartialOrd for Whole {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl From<i64> for Whole {
    fn from(number: i64) -> Self {
        Short(number.into())
    }
}

impl From<i128> for Whole {
    fn from(number: i128) -> Self {
        Short(number)
    }
}

impl From<IBig> for Whole {
    fn from(number: IBig) -> Self {
        Long(number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Returns numbers of all lengths around the limit of 128 bits.
    fn numbers() -> impl Strategy<Value = Whole> {
        let short =
            prop_oneof![any::<i64>().prop_map(i128::from), any::<i128>(), Just(i128::MIN), Just(i128::MAX)];
        (short, 0..3usize).prop_map(|(number, long)| match long {
            0 => Short(number),
            1 => Long(number.into()),
            _ => Long(IBig::from(number) << 70),
        })
    }

    proptest! {
        #[test]
        fn whole_numbers_of_all_lengths_are_reckoned_alike(a in numbers(), b in numbers(), by in 0..200usize) {
            let [x, y] = [a.long(), b.long()];
            prop_assert_eq!((&a * &b).long(), &x * &y);
            prop_assert_eq!((a.clone() + b.clone()).long(), &x + &y);
            prop_assert_eq!((a.clone() - b.clone()).long(), &x - &y);
            prop_assert_eq!((-a.clone()).long(), -x.clone());
            prop_assert_eq!(a.shifted(by).long(), x.clone() << by);
            prop_assert_eq!(a.cmp(&b), x.cmp(&y));
            prop_assert_eq!(a.sign(), x.cmp(&IBig::ZERO));
            prop_assert_eq!(a.bits(), (&x).unsigned_abs().bit_len());
            let rounded = a.quotient(&b);
            let expected = x.to_f64().value() / y.to_f64().value();
            prop_assert!(y == IBig::ZERO || (rounded - expected).abs() <= expected.abs() * 1e-15);
        }
    }
}
