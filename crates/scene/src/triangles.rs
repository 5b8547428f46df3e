//! Lists of triangles in which tubes are stored as rings and rectangles as their corners.

mod fewer_sides;

use std::ops::Range;

use burgeon_base::memory::make_room;

/// Triangles as indices of their corners, counter-clockwise seen from outside.
///
/// Rewriting draws mostly tubes and rectangles. Their faces follow from their rings and corners, so a band, a fan or a row of
/// quads is stored as such and expanded triangle by triangle. That takes a tenth of the memory, whose first access costs more than the computation of the
/// geometry.
///
/// ```
/// use burgeon_scene::Triangles;
///
/// let mut triangles = Triangles::from(vec![[9, 8, 7]]);
/// triangles.fan(0, 4, false);
/// assert_eq!(triangles.iter().collect::<Vec<_>>(), [[9, 8, 7], [0, 1, 2], [0, 2, 3]]);
/// ```
#[derive(Debug, Clone, Default)]
pub struct Triangles {
    runs: Vec<TriangleSpan>,
    listed: Vec<[u32; 3]>,
    count: usize,
    /// The run of every [`MARK_STEP`]th triangle, if the runs differ in length; empty otherwise.
    marks: Vec<u32>,
}

/// Number of triangles from mark to mark.
const MARK_STEP: usize = 64;

/// Consecutive triangles of one pattern; at least one.
#[derive(Debug, Clone, Copy)]
struct TriangleSpan {
    /// Number of triangles before the run.
    first: u32,
    faces: FacePattern,
}

#[derive(Debug, Clone, Copy)]
enum FacePattern {
    /// Triangles of the list, from an index on.
    Listed(u32),
    /// Faces between two rings. The stride is the step from one corner of a ring to the next.
    Band {
        from: u32,
        to: u32,
        sides: u16,
        stride: u8,
    },
    Fan {
        first: u32,
        turned: bool,
        stride: u8,
    },
    /// Pairs of triangles, each with four corners that follow those of the last pair.
    Quads {
        first: u32,
    },
}

impl Triangles {
    /// Maximum number of triangles before a band, a fan or a quad.
    pub const MOST_BEFORE: usize = u32::MAX as usize;

    /// Returns the number of triangles.
    #[inline]
    pub fn len(&self) -> usize {
        self.count
    }

    /// Returns true if there are no triangles.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Adds one triangle.
    #[inline]
    pub fn push(&mut self, corners: [u32; 3]) {
        if !matches!(self.runs.last(), Some(TriangleSpan { faces: FacePattern::Listed(_), .. })) {
            self.begin(FacePattern::Listed(short(self.listed.len())));
        }
        self.listed.push(corners);
        self.count += 1;
    }

    /// Adds the triangles between two rings that begin at the corners `from` and `to`. The band has `sides` faces and
    /// each ring has one corner more. The halves with two corners on the first ring come first, then those with two
    /// corners on the second.
    ///
    /// ```
    /// use burgeon_scene::Triangles;
    ///
    /// // The side of a tube: rings of 4 corners and one more at the seam.
    /// let mut triangles = Triangles::default();
    /// triangles.band(0, 5, 4);
    /// assert_eq!((triangles.len(), triangles.get(0)), (8, Some([0, 1, 6])));
    /// ```
    #[inline]
    pub fn band(&mut self, from: u32, to: u32, sides: u16) {
        if sides > 0 {
            self.begin(FacePattern::Band { from, to, sides, stride: 1 });
            self.count += 2 * usize::from(sides);
        }
    }

    /// Adds the triangles of a convex face with this number of `corners`, which begin at `first`. With `turned`, they
    /// face the opposite side.
    #[inline]
    pub fn fan(&mut self, first: u32, corners: u16, turned: bool) {
        if corners > 2 {
            self.begin(FacePattern::Fan { first, turned, stride: 1 });
            self.count += usize::from(corners) - 2;
        }
    }

    /// Adds the two triangles of a convex face with four corners, which begin at `first`.
    ///
    /// Faces whose corners follow each other need no memory.
    ///
    /// ```
    /// use burgeon_scene::Triangles;
    ///
    /// let mut triangles = Triangles::default();
    /// triangles.quad(0);
    /// triangles.quad(4);
    /// assert_eq!(triangles.iter().collect::<Vec<_>>(), [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]]);
    /// ```
    #[inline]
    pub fn quad(&mut self, first: u32) {
        let follows = self.runs.last().is_some_and(|run| match run.faces {
            FacePattern::Quads { first: start } => {
                start + 2 * short(self.count - run.first as usize) == first
            }
            _ => false,
        });
        if !follows {
            self.begin(FacePattern::Quads { first });
        }
        self.count += 2;
    }

    #[inline]
    fn begin(&mut self, faces: FacePattern) {
        make_room(&mut self.runs, 1);
        self.runs.push(TriangleSpan { first: short(self.count), faces });
    }

    /// Returns the triangle at `index`.
    pub fn get(&self, index: usize) -> Option<[u32; 3]> {
        self.range(index..self.count).next()
    }

    /// Iterates over all triangles.
    pub fn iter(&self) -> Iter<'_> {
        self.range(0..self.count)
    }

    /// Iterates over the triangles at these indices, as far as they exist.
    pub fn range(&self, places: Range<usize>) -> Iter<'_> {
        let after = self.runs_until(places.start);
        let end = places.end.min(self.count);
        let next = places.start.min(end);
        let nothing = FacePattern::Listed(0);
        Iter { of: self, next, end, run: after.saturating_sub(1), first: 0, until: next, faces: nothing }
    }

    /// Returns the number of runs that begin at or before the triangle `place`.
    ///
    /// Most runs of a mesh are about equally long, so without marks the search begins where the run would be if all were, and doubles its
    /// steps.
    fn runs_until(&self, place: usize) -> usize {
        if let Some(mark) = self.marks.get(place / MARK_STEP) {
            let low = *mark as usize;
            let high =
                self.marks.get(place / MARK_STEP + 1).map_or(self.runs.len(), |next| *next as usize + 1);
            return low + self.runs[low..high].partition_point(|run| run.first as usize <= place);
        }
        let begins_before =
            |index: usize| self.runs.get(index).is_some_and(|run| run.first as usize <= place);
        let guess = (place as u128 * self.runs.len() as u128 / self.count.max(1) as u128) as usize;
        let (mut low, mut high) = (guess.min(self.runs.len()), guess.min(self.runs.len()));
        let mut step = 1;
        while low > 0 && !begins_before(low - 1) {
            low = low.saturating_sub(step);
            step *= 2;
        }
        step = 1;
        while begins_before(high) {
            high = (high + step).min(self.runs.len());
            step *= 2;
        }
        low + self.runs[low..high].partition_point(|run| run.first as usize <= place)
    }

    /// Returns the smallest and the largest corner of the triangles at these indices; `None` if there are none.
    ///
    /// ```
    /// use burgeon_scene::Triangles;
    ///
    /// let mut triangles = Triangles::from(vec![[9, 8, 7]]);
    /// triangles.band(10, 15, 4);
    /// assert_eq!(triangles.corner_bounds(0..9), Some((7, 19)));
    /// assert_eq!((triangles.corner_bounds(1..2), triangles.corner_bounds(9..9)), (Some((10, 16)), None));
    /// ```
    pub fn corner_bounds(&self, places: Range<usize>) -> Option<(u32, u32)> {
        let (mut place, end) = (places.start, places.end.min(self.count));
        if place >= end {
            return None;
        }
        let mut bounds = (u32::MAX, 0);
        let mut join = |least: u32, most: u32| bounds = (bounds.0.min(least), bounds.1.max(most));
        let first = self.runs.partition_point(|run| run.first as usize <= place).saturating_sub(1);
        for (index, run) in self.runs.iter().enumerate().skip(first) {
            if place >= end {
                break;
            }
            let until = self.runs.get(index + 1).map_or(self.count, |run| run.first as usize);
            let is_whole = place == run.first as usize && until <= end;
            match run.faces {
                FacePattern::Band { from, to, sides, stride } if is_whole => {
                    join(from.min(to), from.max(to) + u32::from(sides) * u32::from(stride));
                }
                FacePattern::Fan { first, stride, .. } if is_whole => {
                    join(first, first + (short(until - place) + 1) * u32::from(stride));
                }
                FacePattern::Quads { first } if is_whole => join(first, first + 2 * short(until - place) - 1),
                _ => self.range(place..until.min(end)).flatten().for_each(|corner| join(corner, corner)),
            }
            place = until;
        }
        Some(bounds)
    }

    /// Shortens the list to the first `count` triangles.
    pub fn truncate(&mut self, count: usize) {
        if count >= self.count {
            return;
        }
        self.marks.clear();
        let kept = self.runs.partition_point(|run| (run.first as usize) < count);
        let Some(last) = kept.checked_sub(1) else { return self.clear() };
        let listed_from = |runs: &[TriangleSpan]| {
            runs.iter().find_map(|run| match run.faces {
                FacePattern::Listed(from) => Some(from as usize),
                _ => None,
            })
        };
        if self.runs.get(kept).is_some_and(|next| next.first as usize == count) {
            let listed = listed_from(&self.runs[kept..]);
            self.runs.truncate(kept);
            self.listed.truncate(listed.unwrap_or(self.listed.len()));
            self.count = count;
            return;
        }
        let first = self.runs[last].first as usize;
        let rest: Vec<[u32; 3]> = self.range(first..count).collect();
        let listed = listed_from(&self.runs[last..]);
        self.runs.truncate(last);
        self.listed.truncate(listed.unwrap_or(self.listed.len()));
        self.count = first;
        self.extend(rest);
    }

    /// Removes all triangles but keeps the memory.
    pub fn clear(&mut self) {
        self.runs.clear();
        self.listed.clear();
        self.marks.clear();
        self.count = 0;
    }

    /// Reserves memory for more triangles that are added one by one, on huge pages if they are many.
    #[inline]
    pub fn make_room(&mut self, more: usize) {
        make_room(&mut self.listed, more);
    }
}

/// Converts an index for storage. Beyond [`Triangles::MOST_BEFORE`] only one list is allowed, which begins at 0.
#[inline]
fn short(place: usize) -> u32 {
    u32::try_from(place).unwrap_or(u32::MAX)
}

impl PartialEq for Triangles {
    /// Compares the triangles in order, regardless of their storage.
    fn eq(&self, other: &Self) -> bool {
        self.iter().eq(other.iter())
    }
}

impl From<Vec<[u32; 3]>> for Triangles {
    fn from(listed: Vec<[u32; 3]>) -> Self {
        let count = listed.len();
        let run = (count > 0).then_some(TriangleSpan { first: 0, faces: FacePattern::Listed(0) });
        Self { runs: run.into_iter().collect(), listed, count, marks: Vec::new() }
    }
}

impl FromIterator<[u32; 3]> for Triangles {
    fn from_iter<T: IntoIterator<Item = [u32; 3]>>(triangles: T) -> Self {
        Self::from(triangles.into_iter().collect::<Vec<_>>())
    }
}

impl Extend<[u32; 3]> for Triangles {
    #[inline]
    fn extend<T: IntoIterator<Item = [u32; 3]>>(&mut self, triangles: T) {
        let mut triangles = triangles.into_iter();
        if let Some(first) = triangles.next() {
            self.push(first);
            let before = self.listed.len();
            self.listed.extend(triangles);
            self.count += self.listed.len() - before;
        }
    }
}

impl<'a> IntoIterator for &'a Triangles {
    type Item = [u32; 3];
    type IntoIter = Iter<'a>;

    fn into_iter(self) -> Iter<'a> {
        self.iter()
    }
}

/// Iterator over triangles.
#[derive(Debug, Clone)]
pub struct Iter<'a> {
    of: &'a Triangles,
    next: usize,
    end: usize,
    /// Index of the run after the current one.
    run: usize,
    /// Pattern of the current run, the index at which it begins, and the index at which the next one begins.
    faces: FacePattern,
    first: usize,
    until: usize,
}

impl Iterator for Iter<'_> {
    type Item = [u32; 3];

    #[inline]
    fn next(&mut self) -> Option<[u32; 3]> {
        if self.next == self.until {
            if self.next == self.end {
                return None;
            }
            let run = self.of.runs[self.run];
            self.run += 1;
            let behind = self.of.runs.get(self.run).map_or(self.end, |run| run.first as usize);
            (self.faces, self.first, self.until) = (run.faces, run.first as usize, behind.min(self.end));
        }
        let index = self.next - self.first;
        self.next += 1;
        let side = index as u32;
        Some(match self.faces {
            FacePattern::Listed(from) => self.of.listed[from as usize + index],
            FacePattern::Band { from, to, sides, stride } => {
                let stride = u32::from(stride);
                match side.checked_sub(u32::from(sides)).map(|side| side * stride) {
                    None => [from + side * stride, from + (side + 1) * stride, to + (side + 1) * stride],
                    Some(corner) => [from + corner, to + corner + stride, to + corner],
                }
            }
            FacePattern::Fan { first, turned, stride } => {
                let next = first + (side + 1) * u32::from(stride);
                let after = next + u32::from(stride);
                if turned { [first, after, next] } else { [first, next, after] }
            }
            FacePattern::Quads { first } => {
                let corner = first + side / 2 * 4;
                let second = side % 2;
                [corner, corner + 1 + second, corner + 2 + second]
            }
        })
    }

    #[inline]
    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = self.end - self.next;
        (left, Some(left))
    }
}

impl ExactSizeIterator for Iter<'_> {}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Addition to a list of triangles: listed triangles, a band, a fan or quads.
    #[derive(Debug, Clone)]
    enum TriangleAddition {
        Listed(Vec<[u32; 3]>),
        Band(u32, u32, u16),
        Fan(u32, u16, bool),
        Quads(u32, u32),
    }

    fn added() -> impl Strategy<Value = TriangleAddition> {
        prop_oneof![
            prop::collection::vec(prop::array::uniform3(0u32..99), 0..4).prop_map(TriangleAddition::Listed),
            (0u32..99, 0u32..99, 0u16..5)
                .prop_map(|(from, to, sides)| TriangleAddition::Band(from, to, sides)),
            (0u32..99, 0u16..6, any::<bool>())
                .prop_map(|(first, corners, turned)| TriangleAddition::Fan(first, corners, turned)),
            // Few places, so that quads often follow those of the last addition.
            (0u32..4, 0u32..4).prop_map(|(place, count)| TriangleAddition::Quads(4 * place, count)),
        ]
    }

    fn both(all: &[TriangleAddition]) -> (Triangles, Vec<[u32; 3]>) {
        let (mut triangles, mut plain) = (Triangles::default(), Vec::new());
        for added in all {
            match added {
                TriangleAddition::Listed(listed) => {
                    triangles.extend(listed.iter().copied());
                    plain.extend(listed);
                }
                TriangleAddition::Band(from, to, sides) => {
                    triangles.band(*from, *to, *sides);
                    let sides = u32::from(*sides);
                    plain.extend((0..sides).map(|i| [from + i, from + i + 1, to + i + 1]));
                    plain.extend((0..sides).map(|i| [from + i, to + i + 1, to + i]));
                }
                TriangleAddition::Fan(first, corners, turned) => {
                    triangles.fan(*first, *corners, *turned);
                    let fan = (2..u32::from(*corners)).map(|i| [*first, first + i - 1, first + i]);
                    plain.extend(fan.map(|[a, b, c]| if *turned { [a, c, b] } else { [a, b, c] }));
                }
                TriangleAddition::Quads(first, count) => {
                    for corner in (0..*count).map(|quad| first + 4 * quad) {
                        triangles.quad(corner);
                        plain.extend([[corner, corner + 1, corner + 2], [corner, corner + 2, corner + 3]]);
                    }
                }
            }
        }
        (triangles, plain)
    }

    #[test]
    fn what_is_kept_as_bands_equals_a_plain_list() {
        let (bands, plain) = both(&[
            TriangleAddition::Band(0, 6, 5),
            TriangleAddition::Listed(vec![[1, 2, 3]]),
            TriangleAddition::Fan(12, 5, true),
            TriangleAddition::Quads(20, 2),
            TriangleAddition::Quads(28, 1),
        ]);
        assert_eq!(bands, Triangles::from(plain.clone()));
        assert_eq!((bands.len(), bands.runs.len()), (20, 4));
        let mut other = plain;
        other[13].reverse();
        assert_ne!(bands, Triangles::from(other));
        assert!(Triangles::default().is_empty() && Triangles::from(Vec::new()).is_empty());
    }

    proptest! {
        #[test]
        fn all_is_as_if_each_were_listed(
            before in prop::collection::vec(added(), 0..8),
            after in prop::collection::vec(added(), 0..4),
            cut in 0usize..60,
            from in 0usize..60,
            to in 0usize..60,
        ) {
            let (mut triangles, mut plain) = both(&before);
            prop_assert_eq!(triangles.len(), plain.len());
            prop_assert_eq!(triangles.iter().len(), plain.len());
            prop_assert!(triangles.iter().eq(plain.iter().copied()));
            prop_assert_eq!(triangles.get(from), plain.get(from).copied());
            let range = plain.iter().copied().enumerate().filter(|(place, _)| (from..to).contains(place));
            prop_assert!(triangles.range(from..to).eq(range.map(|(_, triangle)| triangle)));
            let corners = || plain.iter().take(to).skip(from).flatten().copied();
            prop_assert_eq!(triangles.corner_bounds(from..to), corners().min().zip(corners().max()));
            triangles.truncate(cut);
            plain.truncate(cut);
            prop_assert!(triangles.iter().eq(plain.iter().copied()));
            let (more, rest) = both(&after);
            triangles.extend(more.iter());
            plain.extend(rest);
            prop_assert!(triangles.iter().eq(plain.iter().copied()));
        }
    }
}
