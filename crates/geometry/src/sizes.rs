//! Possible sizes of the parts of a whole, and the division of a whole into parts.

use smallvec::{SmallVec, smallvec};

use burgeon_base::error::{Error, Limit, Result};

/// Tolerance (m) within which lengths are equal.
pub const SAME: f64 = 1e-9;

/// Maximum number of intervals of a set of sizes.
const MOST: usize = 4096;

/// Maximum number of pairs of intervals in a sum.
const MOST_SUMS: usize = 1 << 22;

/// A set of lengths (m): disjoint closed intervals in ascending order.
///
/// A row of 1 m windows can be 1, 2 or 3 m wide but nothing in between, so a minimum and a maximum are not
/// sufficient.
///
/// ```
/// use burgeon_geometry::Sizes;
///
/// let windows = Sizes::between(1.0, 1.25).times(1..=3)?;
/// assert!(windows.contains(2.5) && !windows.contains(1.5));
/// assert_eq!((windows.low(), windows.high(), windows.nearest(1.5)), (1.0, 3.75, 1.25));
/// let with_door = windows.plus(&Sizes::between(2.0, 2.0))?;
/// assert_eq!(with_door.low(), 3.0);
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sizes(SmallVec<[[f64; 2]; 2]>);

impl Sizes {
    /// Returns all lengths from `low` to `high` (m), which may be infinite; empty if `low` is greater.
    pub fn between(low: f64, high: f64) -> Self {
        if low > high + SAME { Self::default() } else { Self(smallvec![[low, high.max(low)]]) }
    }

    /// Returns true if the set contains no length.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Returns the minimum length (m); infinite if the set is empty.
    pub fn low(&self) -> f64 {
        self.0.first().map_or(f64::INFINITY, |first| first[0])
    }

    /// Returns the maximum length (m); 0 if the set is empty.
    pub fn high(&self) -> f64 {
        self.0.last().map_or(0.0, |last| last[1])
    }

    /// Returns true if the set contains `length` (m).
    pub fn contains(&self, length: f64) -> bool {
        self.0.iter().any(|[low, high]| length >= low - SAME && length <= high + SAME)
    }

    /// Returns the length (m) of the set that is closest to `length` (m), the smaller of two; infinite if the
    /// set is empty.
    pub fn nearest(&self, length: f64) -> f64 {
        let clamped = self.0.iter().map(|[low, high]| length.clamp(*low, *high));
        clamped.fold(
            f64::INFINITY,
            |best, next| {
                if (next - length).abs() < (best - length).abs() { next } else { best }
            },
        )
    }

    /// Returns the intersection of both sets.
    #[must_use]
    pub fn and(&self, other: &Self) -> Self {
        let pairs = self.0.iter().flat_map(|a| other.0.iter().map(move |b| (a, b)));
        let both = pairs.map(|(a, b)| [a[0].max(b[0]), a[1].min(b[1])]);
        Self::gather(both.filter(|[low, high]| *low <= high + SAME).collect())
    }

    /// Returns the sums of a length of each set; fails if there are too many intervals.
    pub fn plus(&self, other: &Self) -> Result<Self> {
        if self.0.len().saturating_mul(other.0.len()) > MOST_SUMS {
            return Err(too_many());
        }
        let pairs = self.0.iter().flat_map(|a| other.0.iter().map(move |b| [a[0] + b[0], a[1] + b[1]]));
        Self::gather(pairs.collect()).check_limits()
    }

    /// Returns the multiples of each length by each of `counts`; fails if there are too many intervals.
    pub fn times(&self, counts: std::ops::RangeInclusive<u32>) -> Result<Self> {
        let mut intervals: SmallVec<[[f64; 2]; 2]> = SmallVec::new();
        // Minimum length of an unbounded interval.
        let mut endless = f64::INFINITY;
        for count in counts {
            let count = f64::from(count);
            // Larger counts add nothing to an existing unbounded interval.
            if endless <= count * self.low() {
                break;
            }
            for [low, high] in &self.0 {
                let of_all = [low * count, high * count];
                if of_all[1].is_infinite() {
                    endless = endless.min(of_all[0]);
                }
                intervals.push(of_all);
            }
        }
        Self::gather(intervals).check_limits()
    }

    /// Returns the differences of `whole` and each length.
    #[must_use]
    fn rest_of(&self, whole: f64) -> Self {
        Self(self.0.iter().rev().map(|[low, high]| [whole - high, whole - low]).collect())
    }

    fn gather(mut intervals: SmallVec<[[f64; 2]; 2]>) -> Self {
        intervals.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut gathered: SmallVec<[[f64; 2]; 2]> = SmallVec::new();
        for [low, high] in intervals {
            match gathered.last_mut() {
                Some(last) if low <= last[1] + SAME => last[1] = last[1].max(high),
                _ => gathered.push([low, high.max(low)]),
            }
        }
        Self(gathered)
    }

    fn check_limits(self) -> Result<Self> {
        if self.0.len() <= MOST {
            return Ok(self);
        }
        Err(too_many())
    }
}

fn too_many() -> Error {
    Error::limit(Limit::Size, format!("it could have more than {MOST} separate sizes"))
        .help("let the size of a part vary, or repeat it less often")
}

/// A part of a whole.
#[derive(Debug, Clone, Default)]
pub struct Share {
    /// Possible lengths (m).
    pub sizes: Sizes,
    /// Preferred length (m).
    pub target: Option<f64>,
    /// Priority of the adjustment: parts of a lower order change first.
    pub order: u8,
}

/// Consecutive parts that fill a whole.
#[derive(Debug, Clone, Default)]
pub struct Split {
    shares: Vec<Share>,
    /// Sums of the sizes from each part to the end.
    rest: Vec<Sizes>,
}

impl Split {
    /// Creates a division into parts, in their order; fails if their sums have too many intervals.
    pub fn new(shares: Vec<Share>) -> Result<Self> {
        let mut rest = vec![Sizes::between(0.0, 0.0)];
        for share in shares.iter().rev() {
            let sum = share.sizes.plus(&rest[rest.len() - 1])?;
            rest.push(sum);
        }
        rest.reverse();
        Ok(Self { shares, rest })
    }

    /// Returns the possible lengths of the whole.
    pub fn sizes(&self) -> &Sizes {
        &self.rest[0]
    }

    /// Returns the preferred length (m) of the whole, if all parts have one.
    pub fn target(&self) -> Option<f64> {
        self.shares.iter().map(|share| share.target).sum()
    }

    /// Returns the lengths (m) of the parts, which add up to `whole` (m); `None` if [`Split::sizes`] does not
    /// contain it.
    ///
    /// Each part begins with its preferred length or its minimum length. The difference to `whole` is
    /// distributed evenly, lower orders first, as far as the sizes allow.
    ///
    /// ```
    /// use burgeon_geometry::{Share, Sizes, Split};
    ///
    /// let door = Share { sizes: Sizes::between(1.0, 1.0), target: None, order: 0 };
    /// let wall = Share { sizes: Sizes::between(0.5, 10.0), target: Some(2.0), order: 0 };
    /// let split = Split::new(vec![wall.clone(), door, wall])?;
    /// assert_eq!(split.divide(7.0).as_deref(), Some(&[3.0, 1.0, 3.0][..]));
    /// // The walls are at least half a metre long.
    /// assert_eq!(split.divide(1.5), None);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn divide(&self, whole: f64) -> Option<SmallVec<[f64; 8]>> {
        if !self.sizes().contains(whole) {
            return None;
        }
        let first = |share: &Share| match share.target {
            Some(target) => share.sizes.nearest(target),
            None => share.sizes.low(),
        };
        let mut lengths: SmallVec<[f64; 8]> = self.shares.iter().map(first).collect();
        for order in 0..=2 {
            self.level(&mut lengths, order, whole);
        }
        // If sizes have gaps, choose the closest lengths for which the remaining parts can fill the rest.
        let mut left = whole;
        for (index, share) in self.shares.iter().enumerate() {
            let possible = share.sizes.and(&self.rest[index + 1].rest_of(left));
            lengths[index] = possible.nearest(lengths[index]);
            left -= lengths[index];
        }
        lengths.iter().all(|length| length.is_finite()).then_some(lengths)
    }

    /// Grows or shrinks the parts of an order evenly towards a sum of `whole`.
    fn level(&self, lengths: &mut [f64], order: u8, whole: f64) {
        // Each round ends with a part at its limit or with no difference left.
        for _ in 0..=self.shares.len() {
            let missing = whole - lengths.iter().sum::<f64>();
            if missing.abs() <= SAME {
                return;
            }
            let room = |index: usize| {
                let share = &self.shares[index];
                let room = if missing > 0.0 {
                    share.sizes.high() - lengths[index]
                } else {
                    lengths[index] - share.sizes.low()
                };
                (share.order == order && room > SAME).then_some(room)
            };
            let open: SmallVec<[(usize, f64); 8]> =
                (0..lengths.len()).filter_map(|index| Some((index, room(index)?))).collect();
            if open.is_empty() {
                return;
            }
            #[allow(clippy::cast_precision_loss, reason = "walls have few parts")]
            let each = missing.abs() / open.len() as f64;
            for (index, room) in open {
                lengths[index] += each.min(room) * missing.signum();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn share(low: f64, high: f64, target: Option<f64>) -> Share {
        Share { sizes: Sizes::between(low, high), target, order: u8::from(target.is_some()) }
    }

    fn assert_near(split: &Split, whole: f64, expected: &[f64]) {
        let lengths = split.divide(whole).expect("a size that it may have");
        assert_eq!(lengths.len(), expected.len());
        let apart = lengths.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < SAME, "{lengths:?}, expected {expected:?}");
    }

    #[test]
    fn a_row_of_equal_cells_has_gaps_between_its_sizes() {
        let row = Sizes::between(1.0, 1.2).times(1..=3).unwrap();
        for (length, fits) in
            [(0.9, false), (1.1, true), (1.3, false), (2.3, true), (3.6, true), (3.7, false)]
        {
            assert_eq!(row.contains(length), fits, "{length} m");
        }
        assert!((row.low() - 1.0).abs() < SAME && (row.high() - 3.6).abs() < SAME);
        assert_eq!(row.nearest(1.5), 1.2);
    }

    #[test]
    fn a_flexible_part_takes_what_a_preferred_one_leaves() {
        let split = Split::new(vec![
            share(0.2, f64::INFINITY, None),
            share(0.8, 2.0, Some(1.4)),
            share(0.2, f64::INFINITY, None),
        ])
        .unwrap();
        assert_near(&split, 3.0, &[0.8, 1.4, 0.8]);
        assert_near(&split, 1.4, &[0.2, 1.0, 0.2]);
        assert!(split.divide(1.1).is_none());
    }

    #[test]
    fn a_part_with_gaps_leaves_the_others_a_size_that_they_can_have() {
        let cells = Share { sizes: Sizes::between(3.0, 3.0).times(1..=9).unwrap(), target: None, order: 0 };
        let split = Split::new(vec![cells, share(0.5, 2.5, None)]).unwrap();
        assert_near(&split, 10.0, &[9.0, 1.0]);
        assert!(split.divide(9.25).is_none());
    }

    proptest! {
        #[test]
        fn parts_fill_the_whole_within_their_sizes(
            parts in proptest::collection::vec((0.0..3.0f64, 0.0..4.0f64, 0.0..6.0f64, 1u32..4, any::<bool>()), 1..7),
            fraction in 0.0..1.0f64,
        ) {
            let shares: Vec<Share> = parts
                .iter()
                .map(|&(low, more, target, count, aims)| Share {
                    sizes: Sizes::between(low, low + more).times(1..=count).unwrap(),
                    target: aims.then_some(target),
                    order: u8::from(aims),
                })
                .collect();
            let split = Split::new(shares.clone()).unwrap();
            let sizes = split.sizes();
            let whole = sizes.nearest(sizes.low() + fraction * (sizes.high() - sizes.low()));
            let lengths = split.divide(whole).expect("a size that it may have");
            prop_assert!((lengths.iter().sum::<f64>() - whole).abs() < 1e-9);
            for (length, share) in lengths.iter().zip(&shares) {
                prop_assert!(share.sizes.contains(*length), "{length} of {:?}", share.sizes);
            }
        }
    }
}
