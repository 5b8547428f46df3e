//! Positions on an integer grid, with exact orientation and crossing tests.

use burgeon_geometry::planar;
use glam::DVec2;

/// Number of grid steps per metre.
pub(crate) const PER_METRE: f64 = 1024.0;
/// Maximum coordinate (m) of a position: products of two differences fit in 64 bits.
pub const FARTHEST: f64 = 500_000.0;

/// Position on a grid with steps of 1/1024 m.
///
/// ```
/// use burgeon_streets::GridPlace;
/// use glam::DVec2;
///
/// let place = GridPlace::nearest(DVec2::new(0.5, 1.0 / 3.0)).expect("a finite position");
/// assert_eq!(place.metres(), DVec2::new(0.5, 341.0 / 1024.0));
/// assert_eq!(GridPlace::nearest(DVec2::splat(f64::NAN)), None);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct GridPlace {
    x: i64,
    y: i64,
}

impl GridPlace {
    /// Returns the grid position nearest to `place` (m); `None` if a coordinate is not finite or exceeds [`FARTHEST`].
    pub fn nearest(place: DVec2) -> Option<Self> {
        let within = place.is_finite() && place.abs().max_element() <= FARTHEST;
        #[allow(clippy::cast_possible_truncation, reason = "within 2^30 steps")]
        within.then(|| {
            let steps = (place * PER_METRE).round();
            Self { x: steps.x as i64, y: steps.y as i64 }
        })
    }

    /// Returns the position with these steps to the east and to the north.
    pub(crate) fn of_steps([x, y]: [i64; 2]) -> Self {
        Self { x, y }
    }

    /// Returns the exact coordinates (m).
    #[allow(clippy::cast_precision_loss, reason = "within 2^30 steps")]
    pub fn metres(self) -> DVec2 {
        DVec2::new(self.x as f64, self.y as f64) / PER_METRE
    }
}

/// Position in integer steps with exact orientation tests.
pub(crate) trait WholePlace: Copy {
    /// Returns the steps to the east and to the north.
    fn steps(self) -> [i64; 2];

    /// Returns the side of the directed line from `a` to `b`: 1 on the left, 0 on the line, -1 on the right.
    fn side_of(self, a: Self, b: Self) -> i32;

    /// Returns true if a position on the line through two others is between them or equal to one of them.
    fn is_between(self, a: Self, b: Self) -> bool {
        let ([ax, ay], [bx, by], [x, y]) = (a.steps(), b.steps(), self.steps());
        let within = |a: i64, b: i64, at: i64| a.min(b) <= at && at <= a.max(b);
        within(ax, bx, x) && within(ay, by, y)
    }
}

impl WholePlace for GridPlace {
    fn steps(self) -> [i64; 2] {
        [self.x, self.y]
    }

    fn side_of(self, a: Self, b: Self) -> i32 {
        let turn = (b.x - a.x) * (self.y - a.y) - (b.y - a.y) * (self.x - a.x);
        i32::from(turn > 0) - i32::from(turn < 0)
    }
}

/// Returns true if two segments share a point, including their ends.
pub(crate) fn touch<P: WholePlace>([a, b]: [P; 2], [c, d]: [P; 2]) -> bool {
    let [of_c, of_d] = [c, d].map(|end| end.side_of(a, b));
    let [of_a, of_b] = [a, b].map(|end| end.side_of(c, d));
    if of_c * of_d < 0 && of_a * of_b < 0 {
        return true;
    }
    (of_c == 0 && c.is_between(a, b))
        || (of_d == 0 && d.is_between(a, b))
        || (of_a == 0 && a.is_between(c, d))
        || (of_b == 0 && b.is_between(c, d))
}

/// Returns the parameter, from 0 at `a` to 1 at `b`, at which the line through them meets the line through `c` and `d`;
/// `None` if they are parallel.
pub(crate) fn crossing([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> Option<f64> {
    let (way, other) = (b - a, d - c);
    let turn = way.perp_dot(other);
    (turn != 0.0).then(|| (c - a).perp_dot(other) / turn)
}

/// Returns the distance (m) from a point to a segment, and the parameter of the nearest point, from 0 to 1.
pub(crate) fn foot(place: DVec2, [a, b]: [DVec2; 2]) -> (f64, f64) {
    let along = planar::foot([a, b], place);
    (place.distance(a + (b - a) * along), along)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn place(x: i64, y: i64) -> GridPlace {
        GridPlace { x, y }
    }

    #[test]
    fn pieces_meet_where_they_touch_and_cross() {
        let across = [place(0, 0), place(10, 10)];
        assert!(touch(across, [place(0, 10), place(10, 0)]));
        assert!(touch(across, [place(10, 10), place(20, 0)]), "end to end");
        assert!(touch(across, [place(5, 5), place(20, 0)]), "an end on the other");
        assert!(touch(across, [place(5, 5), place(20, 20)]), "on one line");
        assert!(!touch(across, [place(11, 11), place(20, 20)]), "on one line, apart");
        assert!(!touch(across, [place(0, 1), place(9, 10)]), "parallel");
    }

    #[test]
    fn places_are_kept_to_half_a_step() {
        let far = DVec2::new(499_999.123_4, -0.000_4);
        let there = GridPlace::nearest(far).expect("near enough").metres();
        assert!(there.distance(far) < 1.0 / PER_METRE);
        assert_eq!(GridPlace::nearest(DVec2::new(f64::NAN, 0.0)), None);
        assert_eq!(GridPlace::nearest(DVec2::new(0.0, 500_001.0)), None);
    }

    proptest! {
        #[test]
        fn sides_are_exact_at_any_distance(
            a in (-(1_i64 << 29)..1 << 29, -(1_i64 << 29)..1 << 29),
            b in (-(1_i64 << 29)..1 << 29, -(1_i64 << 29)..1 << 29),
            c in (-(1_i64 << 29)..1 << 29, -(1_i64 << 29)..1 << 29),
        ) {
            let wide = |a: (i64, i64), b: (i64, i64), c: (i64, i64)| {
                let [ax, ay, bx, by, cx, cy] = [a.0, a.1, b.0, b.1, c.0, c.1].map(i128::from);
                ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)).signum()
            };
            let found = place(c.0, c.1).side_of(place(a.0, a.1), place(b.0, b.1));
            prop_assert_eq!(i128::from(found), wide(a, b, c));
        }
    }
}
