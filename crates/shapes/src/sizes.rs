//! Sizes of the parts of a split: absolute, relative, flexible and repeated.

use burgeon_base::error::{Error, Limit, Result};

/// Size of a part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PartSize {
    /// Length (m).
    Absolute(f64),
    /// Share of the whole, from 0 to 1.
    Relative(f64),
    /// Preferred length (m) of a part that shares the rest with the other flexible parts, in proportion.
    Flexible(f64),
}

/// Sizes of the parts of a whole, in their order.
///
/// ```
/// use burgeon_shapes::{PartSize, PartSizes, SizedParts};
///
/// let storeys = PartSizes(vec![
///     SizedParts::One(PartSize::Absolute(4.0)),
///     SizedParts::Repeated(vec![PartSize::Flexible(3.0)]),
/// ]);
/// let parts = storeys.divide(20.0, 100)?;
/// assert_eq!(parts.parts.len(), 6);
/// assert_eq!((parts.parts[0].from, parts.parts[1].to), (0.0, 4.0 + 3.2));
/// # Ok::<(), burgeon_base::Error>(())
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PartSizes(pub Vec<SizedParts>);

/// One part, or a group of parts that is repeated as often as it fits.
#[derive(Debug, Clone, PartialEq)]
pub enum SizedParts {
    /// One part.
    One(PartSize),
    /// A repeated group. With flexible sizes the count is the nearest one, otherwise the largest that fits.
    Repeated(Vec<PartSize>),
}

/// Intervals of the parts of a whole.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct DividedParts {
    /// Parts with a length, in ascending order.
    pub parts: Vec<PartInterval>,
    /// Length (m) that no part covers, at the end.
    pub rest: f64,
    /// Length (m) of the requested sizes that did not fit.
    pub missing: f64,
    /// Number of sizes below 0, which make no part.
    pub negative: usize,
}

/// Interval of a part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PartInterval {
    /// Number of the entry that made it, from 0; parts of a repeated group count separately.
    pub entry: usize,
    /// Start (m).
    pub from: f64,
    /// End (m).
    pub to: f64,
}

/// Shortest part (m); shorter ones are left out.
const SHORTEST: f64 = 1e-6;

impl PartSizes {
    /// Divides `whole` (m) into at most `most` parts.
    ///
    /// Sizes of 0 or less make no part. Flexible parts get what the others leave, in proportion to their sizes. If the
    /// sizes exceed the whole, the last parts are cut or left out. Fails if there are too many parts.
    pub fn divide(&self, whole: f64, most: usize) -> Result<DividedParts> {
        let length = |size: &PartSize| match size {
            PartSize::Absolute(length) | PartSize::Flexible(length) => length.max(0.0),
            PartSize::Relative(share) => share.max(0.0) * whole,
        };
        let is_flexible = |size: &PartSize| matches!(size, PartSize::Flexible(_));
        let (mut once, mut groups) = (0.0, 0_u32);
        for parts in &self.0 {
            match parts {
                SizedParts::One(size) => once += length(size),
                SizedParts::Repeated(group) => {
                    groups += u32::from(group.iter().map(length).sum::<f64>() > 0.0)
                }
            }
        }
        let each = (whole - once).max(0.0) / f64::from(groups.max(1));
        let mut sizes: Vec<(usize, f64, bool)> = Vec::new();
        let mut entry = 0;
        for parts in &self.0 {
            let (group, count) = match parts {
                SizedParts::One(size) => (std::slice::from_ref(size), 1.0),
                SizedParts::Repeated(group) => (group.as_slice(), repetitions(group, each, &length)),
            };
            if count * group.len() as f64 + sizes.len() as f64 > most as f64 {
                let message = format!("the split would have more than {most} parts");
                return Err(Error::limit(Limit::Size, message).help("use longer parts"));
            }
            for _ in 0..count as usize {
                let numbered = group.iter().enumerate();
                sizes.extend(numbered.map(|(index, size)| (entry + index, length(size), is_flexible(size))));
            }
            entry += group.len();
        }
        let total = |flexible: bool| -> f64 {
            sizes.iter().filter(|(_, _, is)| *is == flexible).map(|(_, length, _)| length).sum()
        };
        let (fixed, preferred) = (total(false), total(true));
        let factor = if preferred > 0.0 { (whole - fixed).max(0.0) / preferred } else { 0.0 };
        let mut divided = DividedParts {
            missing: (fixed - whole).max(0.0),
            negative: self.negative_sizes(),
            ..DividedParts::default()
        };
        let (mut at, count) = (0.0, sizes.len());
        for (number, (entry, length, flexible)) in sizes.into_iter().enumerate() {
            let length = if flexible { length * factor } else { length };
            let mut to = (at + length).min(whole);
            // Rounding does not leave a gap at the end.
            if number + 1 == count && (whole - to).abs() < SHORTEST {
                to = whole;
            }
            if to - at >= SHORTEST {
                divided.parts.push(PartInterval { entry, from: at, to });
            }
            at = to.max(at);
        }
        divided.rest = if whole - at < SHORTEST { 0.0 } else { whole - at };
        if divided.missing < SHORTEST {
            divided.missing = 0.0;
        }
        Ok(divided)
    }

    /// Returns the number of sizes below 0.
    fn negative_sizes(&self) -> usize {
        let sizes = self.0.iter().flat_map(|parts| match parts {
            SizedParts::One(size) => std::slice::from_ref(size),
            SizedParts::Repeated(group) => group.as_slice(),
        });
        let number = |size: &PartSize| match *size {
            PartSize::Absolute(number) | PartSize::Relative(number) | PartSize::Flexible(number) => number,
        };
        sizes.filter(|size| number(size) < 0.0).count()
    }
}

/// Returns how often a group fits in `length` (m).
fn repetitions(group: &[PartSize], length: f64, size: &impl Fn(&PartSize) -> f64) -> f64 {
    let one: f64 = group.iter().map(size).sum();
    if one <= 0.0 {
        return 0.0;
    }
    let exact = length / one;
    if group.iter().any(|size| matches!(size, PartSize::Flexible(_))) {
        let fixed: f64 = group.iter().filter(|size| !matches!(size, PartSize::Flexible(_))).map(size).sum();
        let most = if fixed > 0.0 { (length / fixed + 1e-9).floor() } else { f64::INFINITY };
        // At least one, so that something remains of a short whole.
        exact.round().max(1.0).min(most)
    } else {
        (exact + 1e-9).floor()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lengths(sizes: Vec<SizedParts>, whole: f64) -> (Vec<f64>, f64, f64) {
        let divided = PartSizes(sizes).divide(whole, 100).expect("few parts");
        let round = |length: f64| (length * 1e6).round() / 1e6;
        let parts = divided.parts.iter().map(|part| round(part.to - part.from)).collect();
        (parts, round(divided.rest), round(divided.missing))
    }

    use PartSize::{Absolute, Flexible, Relative};
    use SizedParts::{One, Repeated};

    #[test]
    fn flexible_parts_share_what_the_others_leave() {
        let row = vec![One(Flexible(1.0)), One(Absolute(2.0)), One(Flexible(3.0)), One(Relative(0.2))];
        assert_eq!(lengths(row, 10.0), (vec![1.5, 2.0, 4.5, 2.0], 0.0, 0.0));
    }

    #[test]
    fn a_group_with_flexible_sizes_is_repeated_to_the_nearest_count() {
        let row = |size| vec![One(Absolute(1.0)), Repeated(vec![size]), One(Absolute(1.0))];
        assert_eq!(
            lengths(row(Flexible(3.0)), 12.0).0,
            vec![1.0, 10.0 / 3.0, 10.0 / 3.0, 10.0 / 3.0, 1.0]
                .into_iter()
                .map(|it: f64| (it * 1e6).round() / 1e6)
                .collect::<Vec<_>>()
        );
        assert_eq!(lengths(row(Absolute(3.0)), 12.0), (vec![1.0, 3.0, 3.0, 3.0, 1.0], 1.0, 0.0));
        let bays = vec![Repeated(vec![Flexible(1.0), Absolute(1.0), Flexible(1.0)])];
        assert_eq!(lengths(bays, 7.0).0, vec![1.25, 1.0, 1.25, 1.25, 1.0, 1.25]);
    }

    #[test]
    fn what_does_not_fit_is_cut_and_counted() {
        let row = vec![
            One(Absolute(4.0)),
            One(Absolute(0.0)),
            One(Absolute(4.0)),
            One(Flexible(1.0)),
            One(Absolute(4.0)),
        ];
        assert_eq!(lengths(row, 7.0), (vec![4.0, 3.0], 0.0, 5.0));
    }

    #[test]
    fn too_many_parts_are_refused() {
        let row = PartSizes(vec![Repeated(vec![Absolute(1e-3)])]);
        assert!(row.divide(1.0, 100).is_err());
    }
}
