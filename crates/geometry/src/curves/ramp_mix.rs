//! Interpolation between two functions of one variable.

use glam::DVec2;

use super::cubic::{point, velocity};
use super::ramp::{Ramp, STRETCH, hermite, is_even, parameter};
use burgeon_base::error::Result;
use burgeon_base::{MemoryOwner, Stop};

/// Tolerance of an approximated mixture, as a fraction of the largest absolute y.
const TOLERANCE: f64 = 1e-4;

/// Maximum number of times that a piece of an approximated mixture is halved.
const MOST_HALVINGS: u32 = 16;

impl Ramp {
    /// Returns the function whose y at each x is that of this function times 1 - `t`, and that of `other` times `t`.
    ///
    /// It is exact, except for splines with different x coordinates, whose mixture differs by at most 1/10,000 of the largest
    /// absolute y.
    ///
    /// ```
    /// use burgeon_geometry::{Ramp, RampKind};
    /// use glam::DVec2;
    ///
    /// let young = Ramp::new(&[DVec2::new(0.0, 0.0), DVec2::new(1.0, 1.0)], RampKind::Linear)?;
    /// let mature = Ramp::new(&[DVec2::new(0.0, 4.0), DVec2::new(2.0, 4.0)], RampKind::Linear)?;
    /// assert_eq!(young.mix(&mature, 0.25)?.at(0.5), 0.75 * 0.5 + 0.25 * 4.0);
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn mix(&self, other: &Self, t: f64) -> Result<Self> {
        let (one, two) = (self.pieces(), other.pieces());
        let same =
            |(a, b): (&[DVec2; 4], &[DVec2; 4])| a.iter().zip(b).all(|(a, b)| a.x.to_bits() == b.x.to_bits());
        if one.len() == two.len() && one.iter().zip(two).all(same) {
            let mixed = one
                .iter()
                .zip(two)
                .map(|(a, b)| [0, 1, 2, 3].map(|i| DVec2::new(a[i].x, a[i].y * (1.0 - t) + b[i].y * t)));
            return Self::of_pieces(mixed.collect());
        }
        let breaks = breaks(one, two);
        let tallest = one.iter().chain(two).flatten().fold(0.0, |tallest: f64, at| tallest.max(at.y.abs()));
        let both = [(self, 1.0 - t), (other, t)];
        let is_exact = one.iter().chain(two).all(|piece| is_even(piece.map(|it| it.x)));
        let mut pieces = Vec::with_capacity(breaks.len());
        // Parts of the mixture that are still to be approximated, the first last, with the number of their halvings.
        let mut open = Vec::new();
        for (index, pair) in breaks.windows(2).enumerate() {
            open.push(([pair[0], pair[1]], 0));
            while let Some((ends, halvings)) = open.pop() {
                if (index + pieces.len()) % STRETCH == STRETCH - 1 {
                    Stop::check_current()?;
                    MemoryOwner::ensure_room(pieces.len() * size_of::<[DVec2; 5]>())?;
                }
                let piece = mixed_piece(both, ends);
                if is_exact || halvings == MOST_HALVINGS || is_close(&piece, both, TOLERANCE * tallest) {
                    pieces.push(piece);
                } else {
                    let middle = (ends[0] + ends[1]) / 2.0;
                    open.extend([([middle, ends[1]], halvings + 1), ([ends[0], middle], halvings + 1)]);
                }
            }
        }
        Self::of_pieces(pieces)
    }

    /// Returns y and slope at `x` of the piece that contains `near`, as x and y of a vector.
    fn side(&self, x: f64, near: f64) -> DVec2 {
        let [from, to] = self.span();
        if near <= from || near >= to {
            return DVec2::new(self.at(near), 0.0);
        }
        let pieces = self.pieces();
        let piece = &pieces[pieces.partition_point(|piece| piece[0].x <= near).max(1) - 1];
        let t = parameter(piece, x);
        let speed = velocity(piece, t);
        DVec2::new(point(piece, t).y, speed.y / speed.x)
    }
}

/// Returns the cubic piece between the x coordinates `ends` that has the mixed y and slopes of weighted functions there.
fn mixed_piece(both: [(&Ramp, f64); 2], ends: [f64; 2]) -> [DVec2; 4] {
    let middle = (ends[0] + ends[1]) / 2.0;
    let [from, to] = ends.map(|x| {
        let parts = both.map(|(ramp, weight)| ramp.side(x, middle) * weight);
        parts[0] + parts[1]
    });
    hermite([DVec2::new(ends[0], from.x), DVec2::new(ends[1], to.x)], [from.y, to.y])
}

/// Returns true if a piece of a mixture is within `tolerance` of the mixed y at seven places between its ends.
fn is_close(piece: &[DVec2; 4], both: [(&Ramp, f64); 2], tolerance: f64) -> bool {
    (1..8).all(|eighth| {
        let at = point(piece, f64::from(eighth) / 8.0);
        let expected: f64 = both.iter().map(|(ramp, weight)| ramp.at(at.x) * weight).sum();
        (at.y - expected).abs() <= tolerance
    })
}

/// Returns the x coordinates between which both functions are smooth.
fn breaks(one: &[[DVec2; 4]], two: &[[DVec2; 4]]) -> Vec<f64> {
    let mut all: Vec<f64> = one.iter().chain(two).flat_map(|piece| [piece[0].x, piece[3].x]).collect();
    all.sort_by(f64::total_cmp);
    let width = all.last().zip(all.first()).map_or(0.0, |(last, first)| last - first);
    all.dedup_by(|next, kept| *next - *kept <= 1e-12 * width);
    all
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::ramp::RampKind;
    use super::*;

    fn ramp(points: &[(f64, f64)], kind: RampKind) -> Ramp {
        let points: Vec<DVec2> = points.iter().copied().map(DVec2::from).collect();
        Ramp::new(&points, kind).expect("a function")
    }

    fn kind() -> impl Strategy<Value = RampKind> {
        prop_oneof![Just(RampKind::Monotone), Just(RampKind::Linear), Just(RampKind::Spline)]
    }

    fn points() -> impl Strategy<Value = Vec<(f64, f64)>> {
        prop::collection::vec((0.1f64..1.0, -3.0f64..3.0), 2..7).prop_map(|steps| {
            let mut x = 0.0;
            steps
                .into_iter()
                .map(|(step, y)| {
                    x += step;
                    (x, y)
                })
                .collect()
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn a_mixture_has_the_mixed_y_at_each_x(
            (one, first) in (points(), kind()),
            (two, second) in (points(), kind()),
            t in 0.0f64..1.0,
            x in -0.5f64..6.0,
        ) {
            let exact = first != RampKind::Spline && second != RampKind::Spline;
            let (one, two) = (ramp(&one, first), ramp(&two, second));
            let mixed = one.mix(&two, t).expect("a mixture");
            let expected = one.at(x) * (1.0 - t) + two.at(x) * t;
            let slack = if exact { 1e-9 } else { 4e-4 };
            prop_assert!((mixed.at(x) - expected).abs() < slack, "{} {expected}", mixed.at(x));
        }

        #[test]
        fn splines_with_the_same_x_mix_exactly(one in points(), t in 0.0f64..1.0, x in -0.5f64..6.0) {
            let two: Vec<_> = one.iter().map(|(x, y)| (*x, y * y - 1.0)).collect();
            let (one, two) = (ramp(&one, RampKind::Spline), ramp(&two, RampKind::Spline));
            let mixed = one.mix(&two, t).expect("a mixture");
            prop_assert!((mixed.at(x) - (one.at(x) * (1.0 - t) + two.at(x) * t)).abs() < 1e-12);
            prop_assert_eq!(one.mix(&two, 0.0).expect("the first"), one);
        }
    }
}
