//! Triangles of thin tubes, with fewer sides.

use rayon::prelude::*;

use super::{FacePattern, MARK_STEP, TriangleSpan, Triangles, short};

/// Number of runs that a thread works on at a time.
const STRETCH: usize = 4096;

/// The ring of a tube that was tested last.
struct TestedRing {
    first: u32,
    sides: u16,
    is_thin: bool,
}

impl Triangles {
    /// Returns the triangles with fewer sides of thin tubes, three at least, on some of the corners; `None` if no tube gets
    /// fewer sides.
    ///
    /// A tube between two rings is thin if both are. `is_thin` takes four corners of a ring, a quarter of the ring apart from
    /// each other.
    ///
    /// ```
    /// use burgeon_scene::Triangles;
    ///
    /// let mut triangles = Triangles::default();
    /// triangles.band(0, 7, 6);
    /// let thin = triangles.with_fewer_sides(|_| true).expect("6 sides");
    /// assert_eq!((thin.len(), thin.get(0)), (6, Some([0, 2, 9])));
    /// assert!(triangles.with_fewer_sides(|_| false).is_none());
    /// ```
    pub fn with_fewer_sides(&self, is_thin: impl Fn([u32; 4]) -> bool + Sync) -> Option<Self> {
        let runs: Vec<Vec<(FacePattern, usize)>> = self
            .runs
            .par_chunks(STRETCH)
            .enumerate()
            .map(|(number, runs)| self.reduce_runs(number * STRETCH, runs, &is_thin))
            .collect();
        let mut reduced = Self { runs: Vec::with_capacity(self.runs.len()), ..Self::default() };
        for (faces, count) in runs.into_iter().flatten() {
            while reduced.marks.len() * MARK_STEP < reduced.count + count {
                reduced.marks.push(short(reduced.runs.len()));
            }
            reduced.runs.push(TriangleSpan { first: short(reduced.count), faces });
            reduced.count += count;
        }
        (reduced.count < self.count).then(|| Self { listed: self.listed.clone(), ..reduced })
    }

    /// Returns the patterns of some runs, which begin with run `start`, and the numbers of their triangles.
    fn reduce_runs(
        &self,
        start: usize,
        runs: &[TriangleSpan],
        is_thin: &impl Fn([u32; 4]) -> bool,
    ) -> Vec<(FacePattern, usize)> {
        // Tubes mostly share a ring with the one before.
        let mut last = TestedRing { first: u32::MAX, sides: 0, is_thin: false };
        let mut is_thin = |first: u32, sides: u16| {
            if (last.first, last.sides) != (first, sides) {
                let corners = [0, 1, 2, 3].map(|quarter| first + u32::from(sides) * quarter / 4);
                last = TestedRing { first, sides, is_thin: is_thin(corners) };
            }
            last.is_thin
        };
        let reduce = |(number, run): (usize, &TriangleSpan)| {
            let until = self.runs.get(start + number + 1).map_or(self.count, |next| next.first as usize);
            let count = until - run.first as usize;
            match run.faces {
                FacePattern::Band { from, to, sides, stride: 1 } => {
                    let stride = stride(sides);
                    if stride > 1 && is_thin(from, sides) && is_thin(to, sides) {
                        let sides = sides / u16::from(stride);
                        return (FacePattern::Band { from, to, sides, stride }, 2 * usize::from(sides));
                    }
                }
                FacePattern::Fan { first, turned, stride: 1 } => {
                    let sides = u16::try_from(count + 2).unwrap_or(0);
                    let stride = stride(sides);
                    if stride > 1 && is_thin(first, sides) {
                        let count = usize::from(sides / u16::from(stride)) - 2;
                        return (FacePattern::Fan { first, turned, stride }, count);
                    }
                }
                _ => {}
            }
            (run.faces, count)
        };
        runs.iter().enumerate().map(reduce).collect()
    }
}

/// Returns the largest step from corner to corner of a ring with this number of sides that leaves four or more, or else three: a
/// tube with three looks a sixth thinner than a round one, with four a tenth.
fn stride(sides: u16) -> u8 {
    let leaving = |least: u16| {
        let most = u8::try_from(sides / least).unwrap_or(u8::MAX);
        (2..=most).rev().find(|stride| sides.is_multiple_of(u16::from(*stride)))
    };
    leaving(4).or_else(|| leaving(3)).unwrap_or(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tube of three rings with a cap at each end: corners of the rings, then those of the caps.
    fn tube(sides: u16) -> Triangles {
        let ring = u32::from(sides) + 1;
        let mut triangles = Triangles::default();
        triangles.fan(3 * ring, sides, true);
        triangles.band(0, ring, sides);
        triangles.band(ring, 2 * ring, sides);
        triangles.fan(3 * ring + u32::from(sides), sides, false);
        triangles
    }

    #[test]
    fn thin_tubes_keep_every_other_corner_and_stay_closed() {
        for (sides, left) in [(6, 3), (8, 4), (9, 3), (10, 5), (12, 4), (7, 7), (5, 5), (3, 3usize)] {
            let whole = tube(sides);
            let reduced = whole.with_fewer_sides(|_| true).unwrap_or_else(|| whole.clone());
            assert_eq!(reduced.len(), 2 * (left - 2) + 4 * left, "{sides}");
            let (least, most) = reduced.corner_bounds(0..reduced.len()).expect("triangles");
            let listed: Vec<u32> = reduced.iter().flatten().collect();
            assert_eq!((Some(&least), Some(&most)), (listed.iter().min(), listed.iter().max()));
            for part in 0..reduced.len() {
                let corners = || reduced.range(part..part + 3).flatten();
                assert_eq!(reduced.corner_bounds(part..part + 3), corners().min().zip(corners().max()));
            }
            // Corners of one point have one number: each edge has a face on both sides.
            let ring = u32::from(sides) + 1;
            let point = |corner: u32| match corner.checked_sub(3 * ring) {
                None => corner / ring * ring + corner % ring % u32::from(sides),
                Some(cap) => cap / u32::from(sides) * 2 * ring + cap % u32::from(sides),
            };
            let mut edges: Vec<[u32; 2]> = reduced
                .iter()
                .map(|corners| corners.map(point))
                .flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]])
                .collect();
            let count = edges.len();
            edges.sort_unstable();
            edges.dedup();
            assert_eq!(edges.len(), count, "{sides}");
            assert!(edges.iter().all(|[a, b]| edges.binary_search(&[*b, *a]).is_ok()), "{sides}");
        }
    }

    #[test]
    fn a_long_list_is_read_in_order_and_from_any_place() {
        let mut whole = Triangles::default();
        for ring in 0..400 {
            whole.band(7 * ring, 7 * ring + 7, 6);
            if ring % 5 == 0 {
                whole.push([ring, ring + 1, ring + 2]);
            }
        }
        let mut reduced = whole.with_fewer_sides(|[first, ..]| first / 7 % 100 < 60).expect("thin tubes");
        let list: Vec<[u32; 3]> = reduced.iter().collect();
        assert!(list.len() == reduced.len() && list.len() < whole.len());
        for (place, triangle) in list.iter().enumerate() {
            assert_eq!(reduced.get(place), Some(*triangle));
        }
        reduced.band(9, 2, 6);
        let end = reduced.len();
        assert_eq!((end, reduced.get(end - 12)), (list.len() + 12, Some([9, 10, 3])));
        reduced.truncate(1000);
        assert!(reduced.iter().eq(list[..1000].iter().copied()) && reduced.get(1000).is_none());
        assert_eq!(reduced.get(999), Some(list[999]));
    }

    #[test]
    fn only_tubes_between_thin_rings_change() {
        let mut whole = tube(6);
        whole.push([0, 1, 2]);
        let last = |[first, second, third, fourth]: [u32; 4]| {
            assert_eq!([second - first, third - first, fourth - first], [1, 3, 4]);
            first >= 7
        };
        let reduced = whole.with_fewer_sides(last).expect("thin tubes");
        // Both caps have few corners of their own; the first band keeps its sides.
        assert_eq!(reduced.len(), 1 + 12 + 6 + 1 + 1);
        assert!(reduced.range(1..13).eq(whole.range(4..16)));
        assert_eq!(reduced.get(reduced.len() - 1), Some([0, 1, 2]));
        let again = reduced.with_fewer_sides(|_| true).expect("the first band");
        assert_eq!(again.len(), 1 + 6 + 6 + 1 + 1);
    }
}
