//! Curves in space, measured by arc length.

use glam::DVec3;

use super::cubic::{GAUSS_5, point, velocity};
use super::pieces::{b_spline, lines, through};
use crate::limits::MOST;
use burgeon_base::error::{Error, Result};
use burgeon_base::{MemoryOwner, Stop};

/// Number of points between two checks for cancellation.
const STRETCH: usize = 4096;
/// Number of intervals in which the length of each piece is known.
const INTERVALS: usize = 8;
/// Cosine of the angle (20 degrees) between two tangents above which a joint of pieces is a corner.
const CORNER: f64 = 0.94;
/// Number of samples of a mixture of curves with different control points, at least and for each of their pieces.
const SAMPLES: (usize, usize) = (64, 8);

/// Relation of a [`Curve`] to its points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum CurveKind {
    /// A smooth curve through the points.
    #[default]
    Through,
    /// A cubic B-spline with the points as control points; an open one begins and ends at a point.
    BSpline,
    /// Cubic Bezier pieces: a point of the curve and two control points in turn.
    Bezier,
    /// Straight lines between the points.
    Linear,
}

/// A curve in space or in a plane, with positions and tangents by normalised arc length: 0 is the start, 1 the end.
///
/// ```
/// use burgeon_geometry::{Curve, CurveKind};
/// use glam::DVec3;
///
/// let bent = [DVec3::ZERO, DVec3::X * 3.0, DVec3::new(3.0, 1.0, 0.0)];
/// let curve = Curve::new(&bent, CurveKind::Linear, false)?;
/// assert_eq!((curve.length(), curve.tangent(0.9)), (4.0, DVec3::Y));
/// assert!(curve.point(0.5).abs_diff_eq(DVec3::X * 2.0, 1e-12));
/// # Ok::<(), burgeon_base::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    points: Vec<DVec3>,
    kind: CurveKind,
    closed: bool,
    /// Bezier points (m) of each piece.
    pieces: Vec<[DVec3; 4]>,
    /// Length (m) before each interval of each piece, and of all.
    lengths: Vec<f64>,
}

impl Curve {
    /// Creates the curve of `points` (m). A closed curve returns to its first point, which may be repeated at the end.
    ///
    /// Fails if there are too few points for the kind, if a coordinate is not finite or beyond 1e9, if a curve through
    /// points has equal neighbours, or if all points are equal.
    pub fn new(points: &[DVec3], kind: CurveKind, closed: bool) -> Result<Self> {
        let mut points = points.to_vec();
        if closed && points.len() > 1 && points.first() == points.last() {
            points.pop();
        }
        check(&points, kind, closed)?;
        let intervals = points.len() * INTERVALS;
        MemoryOwner::ensure_room(points.len() * size_of::<[DVec3; 4]>() + intervals * size_of::<f64>())?;
        let pieces = match kind {
            CurveKind::Through => through(&points, closed),
            CurveKind::BSpline => b_spline(&points, closed),
            CurveKind::Bezier => bezier(&points),
            CurveKind::Linear => lines(&points, closed),
        };
        let mut lengths = Vec::with_capacity(pieces.len() * INTERVALS + 1);
        let mut sum = 0.0;
        for (index, piece) in pieces.iter().enumerate() {
            if index % STRETCH == STRETCH - 1 {
                Stop::check_current()?;
            }
            for interval in 0..INTERVALS {
                lengths.push(sum);
                let from = interval as f64 / INTERVALS as f64;
                sum += length(piece, from, from + 1.0 / INTERVALS as f64);
            }
        }
        lengths.push(sum);
        if sum <= 0.0 || !sum.is_finite() {
            return Err(Error::argument("all points of the curve are equal")
                .help("give points at different positions"));
        }
        Ok(Self { points, kind, closed, pieces, lengths })
    }

    /// Returns the length (m).
    pub fn length(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    /// Returns the position (m) at `t` of the length. Beyond the ends, an open curve stays there, and a closed one
    /// continues.
    pub fn point(&self, t: f64) -> DVec3 {
        let (piece, at) = self.locate(t);
        point(&self.pieces[piece], at)
    }

    /// Returns the unit tangent at `t` of the length, that after a corner.
    pub fn tangent(&self, t: f64) -> DVec3 {
        let (piece, at) = self.locate(t);
        direction(&self.pieces[piece], at)
    }

    /// Returns true if the curve returns to its start.
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// Returns the points that define the curve (m).
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// Returns the relation of the curve to its points.
    pub fn kind(&self) -> CurveKind {
        self.kind
    }

    /// Returns the Bezier points (m) of the pieces.
    pub fn pieces(&self) -> &[[DVec3; 4]] {
        &self.pieces
    }

    /// Returns the number of polynomial pieces.
    pub fn piece_count(&self) -> usize {
        self.pieces.len()
    }

    /// Returns the approximate memory (bytes).
    pub fn memory(&self) -> usize {
        self.points.len() * size_of::<DVec3>()
            + self.pieces.len() * size_of::<[DVec3; 4]>()
            + self.lengths.len() * size_of::<f64>()
    }

    /// Returns the places of the corners, where the tangent turns by more than 20 degrees, as parts of the length from
    /// 0 to below 1, in order. The ends of an open curve are no corners.
    pub fn corners(&self) -> Vec<f64> {
        let count = self.pieces.len();
        let joints = (usize::from(!self.closed)..count).filter(|&index| {
            let before = direction(&self.pieces[(index + count - 1) % count], 1.0);
            before.dot(direction(&self.pieces[index], 0.0)) < CORNER
        });
        joints.map(|index| self.lengths[index * INTERVALS] / self.length()).collect()
    }

    /// Returns the places where the pieces begin, as parts of the length, and 1.
    pub(crate) fn joints(&self) -> Vec<f64> {
        self.lengths.iter().step_by(INTERVALS).map(|length| length / self.length()).collect()
    }

    /// Returns the curve between this one (`t` = 0) and `other` (`t` = 1).
    ///
    /// Curves of the same kind with the same number of points are mixed point by point. Others are resampled by arc
    /// length. Fails if only one of both is closed.
    ///
    /// ```
    /// use burgeon_geometry::{Curve, CurveKind};
    /// use glam::DVec3;
    ///
    /// let low = Curve::new(&[DVec3::ZERO, DVec3::X], CurveKind::Linear, false)?;
    /// let high = Curve::new(&[DVec3::ZERO, DVec3::X + DVec3::Z], CurveKind::Linear, false)?;
    /// assert_eq!(low.mix(&high, 0.5)?.point(1.0), DVec3::new(1.0, 0.0, 0.5));
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn mix(&self, other: &Self, t: f64) -> Result<Self> {
        if self.closed != other.closed {
            return Err(Error::argument("a closed and an open curve cannot be mixed")
                .help("set closed = true for both, or for none"));
        }
        let blend = |(a, b): (DVec3, DVec3)| a * (1.0 - t) + b * t;
        if self.kind == other.kind && self.points.len() == other.points.len() {
            let points = self.points.iter().copied().zip(other.points.iter().copied()).map(blend);
            return Self::new(&points.collect::<Vec<_>>(), self.kind, self.closed);
        }
        let count = SAMPLES.0.max(SAMPLES.1 * self.pieces.len().max(other.pieces.len()));
        MemoryOwner::ensure_room(count * size_of::<[DVec3; 6]>())?;
        // A closed curve does not repeat its start.
        let steps = if self.closed { count } else { count - 1 };
        let at = |i: usize| i as f64 / steps as f64;
        let mut points: Vec<DVec3> = Vec::with_capacity(count);
        for index in 0..count {
            if index % STRETCH == STRETCH - 1 {
                Stop::check_current()?;
            }
            let mixed = blend((self.point(at(index)), other.point(at(index))));
            // Opposite parts of two curves may cancel each other.
            if points.last() != Some(&mixed) {
                points.push(mixed);
            }
        }
        Self::new(&points, CurveKind::Through, self.closed)
    }

    /// Returns the piece at `t` of the length, and the parameter in it.
    fn locate(&self, t: f64) -> (usize, f64) {
        let t = if t.is_nan() { 0.0 } else { t };
        let t = if self.closed && !(0.0..=1.0).contains(&t) { t.rem_euclid(1.0) } else { t.clamp(0.0, 1.0) };
        let last = self.pieces.len() - 1;
        if t >= 1.0 {
            return (last, 1.0);
        }
        let wanted = t * self.length();
        let interval = self.lengths.partition_point(|length| *length <= wanted).max(1) - 1;
        let interval = interval.min(self.lengths.len() - 2);
        let (piece, number) = (interval / INTERVALS, interval % INTERVALS);
        let (from, step) = (number as f64 / INTERVALS as f64, 1.0 / INTERVALS as f64);
        let bezier = &self.pieces[piece];
        let (rest, whole) =
            (wanted - self.lengths[interval], self.lengths[interval + 1] - self.lengths[interval]);
        if rest <= 0.0 || whole <= 0.0 {
            return (piece, from);
        }
        // Newton's method for the length from the start of the interval, within a shrinking interval.
        let (mut low, mut high) = (from, from + step);
        let mut at = from + step * (rest / whole);
        for _ in 0..20 {
            let error = length(bezier, from, at) - rest;
            if error.abs() <= 1e-13 * whole {
                break;
            }
            *if error < 0.0 { &mut low } else { &mut high } = at;
            let next = at - error / velocity(bezier, at).length();
            at = if next > low && next < high { next } else { (low + high) / 2.0 };
        }
        (piece, at)
    }
}

/// Returns the length (m) of a piece between two parameters.
fn length(piece: &[DVec3; 4], from: f64, to: f64) -> f64 {
    let part = |(at, weight): &(f64, f64)| weight * velocity(piece, from + at * (to - from)).length();
    GAUSS_5.iter().map(part).sum::<f64>() * (to - from)
}

/// Returns the unit tangent of a piece, of its neighbourhood if the curve stands still there.
fn direction(piece: &[DVec3; 4], at: f64) -> DVec3 {
    let beside = if at < 0.5 { at + 1e-4 } else { at - 1e-4 };
    let candidates = [velocity(piece, at), velocity(piece, beside), piece[3] - piece[0]];
    let scale = piece[0].distance(piece[1]) + piece[1].distance(piece[2]) + piece[2].distance(piece[3]);
    let found = candidates.into_iter().find(|it| it.length() > 1e-9 * scale);
    found.and_then(DVec3::try_normalize).unwrap_or(DVec3::X)
}

/// Returns the pieces of Bezier points; the last piece of a closed curve ends at the first point.
fn bezier(points: &[DVec3]) -> Vec<[DVec3; 4]> {
    let pieces = (0..points.len() - 1).step_by(3);
    pieces.map(|first| [0, 1, 2, 3].map(|offset| points[(first + offset) % points.len()])).collect()
}

/// Fails if the points do not fit the kind.
fn check(points: &[DVec3], kind: CurveKind, closed: bool) -> Result<()> {
    let count = points.len();
    let least = if closed { 3 } else { 2 };
    if count < least {
        let what = if closed { "a closed curve" } else { "a curve" };
        return Err(Error::argument(format!("{what} needs at least {least} points, not {count}"))
            .help("give points = { vec(0, 0, 0), vec(0, 1, 2), vec(0, 1, 4) }"));
    }
    let found = points.iter().position(|at| !at.is_finite() || at.abs().max_element() > MOST);
    if let Some(index) = found {
        return Err(Error::argument(format!("point {} is not within 1e9 m of the origin", index + 1))
            .help("give finite coordinates in metres"));
    }
    if kind == CurveKind::Bezier && (count + usize::from(closed)) % 3 != 1 {
        let (what, some) = if closed { ("closed", "3, 6, 9") } else { ("open", "4, 7, 10") };
        return Err(Error::argument(format!("{what} Bezier pieces do not have {count} points"))
            .help(format!("give {some} and so on: a point of the curve and two control points in turn")));
    }
    if kind == CurveKind::Through {
        let next = |index: usize| (index + 1) % count;
        let pairs = if closed { count } else { count - 1 };
        if let Some(index) = (0..pairs).find(|index| points[*index] == points[next(*index)]) {
            let message = format!("point {} is equal to point {}", next(index) + 1, index + 1);
            return Err(Error::argument(message).help("remove one of them"));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, TAU};

    use proptest::prelude::*;

    use super::*;

    const KINDS: [CurveKind; 4] =
        [CurveKind::Through, CurveKind::BSpline, CurveKind::Bezier, CurveKind::Linear];

    fn circle(count: u32) -> Vec<DVec3> {
        let angle = |i: u32| TAU * f64::from(i) / f64::from(count);
        (0..count).map(|i| DVec3::new(angle(i).cos(), angle(i).sin(), 0.0)).collect()
    }

    #[test]
    fn a_closed_curve_through_points_of_a_circle_is_nearly_that_circle() {
        let curve = Curve::new(&circle(16), CurveKind::Through, true).expect("a circle");
        assert!((curve.length() - TAU).abs() < 2e-3, "{}", curve.length());
        for i in 0..100 {
            let t = f64::from(i) / 100.0;
            let (at, along) = (curve.point(t), curve.tangent(t));
            assert!((at.length() - 1.0).abs() < 1e-3 && at.dot(along).abs() < 5e-3);
            // The arc length is even.
            assert!(at.distance(DVec3::new((t * TAU).cos(), (t * TAU).sin(), 0.0)) < 2e-3);
        }
        assert!(curve.corners().is_empty());
        assert!(curve.point(1.25).distance(curve.point(0.25)) < 1e-12);
    }

    #[test]
    fn a_bezier_quarter_has_its_known_length() {
        // Quarter of a circle, radius 1: the known approximation with the factor 0.5523.
        let k = 0.552_284_749_831;
        let points = [(1.0, 0.0), (1.0, k), (k, 1.0), (0.0, 1.0)].map(|(x, y)| DVec3::new(x, y, 0.0));
        let curve = Curve::new(&points, CurveKind::Bezier, false).expect("a quarter");
        assert!((curve.length() - FRAC_PI_2).abs() < 5e-4);
        assert!(curve.point(0.5).distance(DVec3::new(0.5f64.sqrt(), 0.5f64.sqrt(), 0.0)) < 5e-4);
        assert_eq!((curve.point(0.0), curve.point(1.0)), (points[0], points[3]));
        assert_eq!((curve.tangent(0.0), curve.point(7.0)), (DVec3::Y, points[3]));
    }

    #[test]
    fn a_square_has_corners_and_a_circle_has_none() {
        let square = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)].map(|(x, y)| DVec3::new(x, y, 0.0));
        let closed = Curve::new(&square, CurveKind::Linear, true).expect("a square");
        assert_eq!((closed.length(), closed.corners()), (8.0, vec![0.0, 0.25, 0.5, 0.75]));
        let open = Curve::new(&square, CurveKind::Linear, false).expect("three sides");
        assert_eq!((open.length(), open.corners().len()), (6.0, 2));
        assert!(Curve::new(&square, CurveKind::BSpline, true).expect("round").corners().is_empty());
    }

    #[test]
    fn curves_of_one_shape_mix_exactly_and_others_by_their_length() {
        let one = Curve::new(&circle(8), CurveKind::BSpline, true).expect("a circle");
        let large: Vec<DVec3> = circle(8).iter().map(|at| *at * 3.0).collect();
        let two = Curve::new(&large, CurveKind::BSpline, true).expect("a circle");
        for i in 0..10 {
            let t = f64::from(i) / 10.0;
            assert!(one.mix(&two, 0.5).expect("a curve").point(t).distance(one.point(t) * 2.0) < 1e-9);
        }
        let fine: Vec<DVec3> = circle(40).iter().map(|at| *at * 3.0).collect();
        let fine = Curve::new(&fine, CurveKind::Through, true).expect("a circle");
        let unit = Curve::new(&circle(16), CurveKind::Through, true).expect("a circle");
        let mixed = unit.mix(&fine, 0.5).expect("a curve");
        assert!((0..50).all(|i| (mixed.point(f64::from(i) / 50.0).length() - 2.0).abs() < 5e-3));
        let open = Curve::new(&circle(8), CurveKind::Through, false).expect("an arc");
        insta::assert_snapshot!(open.mix(&unit, 0.5).expect_err("refused"), @r"
        a closed and an open curve cannot be mixed
          help: set closed = true for both, or for none
        ");
    }

    #[test]
    fn bad_points_are_refused_with_a_remedy() {
        let refuse = |points: &[DVec3], kind, closed| {
            Curve::new(points, kind, closed).expect_err("refused").to_string()
        };
        insta::assert_snapshot!(refuse(&[], CurveKind::Through, false), @r"
        a curve needs at least 2 points, not 0
          help: give points = { vec(0, 0, 0), vec(0, 1, 2), vec(0, 1, 4) }
        ");
        insta::assert_snapshot!(refuse(&[DVec3::X, DVec3::NAN], CurveKind::Linear, false), @r"
        point 2 is not within 1e9 m of the origin
          help: give finite coordinates in metres
        ");
        insta::assert_snapshot!(refuse(&[DVec3::X; 2], CurveKind::BSpline, false), @r"
        all points of the curve are equal
          help: give points at different positions
        ");
        insta::assert_snapshot!(refuse(&[DVec3::X, DVec3::Y, DVec3::Y], CurveKind::Through, false), @r"
        point 3 is equal to point 2
          help: remove one of them
        ");
        insta::assert_snapshot!(refuse(&circle(5), CurveKind::Bezier, false), @r"
        open Bezier pieces do not have 5 points
          help: give 4, 7, 10 and so on: a point of the curve and two control points in turn
        ");
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn equal_steps_of_t_are_equal_lengths(
            coordinates in prop::collection::vec((-5.0f64..5.0, -5.0f64..5.0, -5.0f64..5.0), 7),
            closed in any::<bool>(),
        ) {
            // Equal neighbours are refused.
            let points = (0..).zip(&coordinates).map(|(i, (x, y, z))| DVec3::new(*x, *y, *z + 0.01 * f64::from(i)));
            let points: Vec<DVec3> = points.collect();
            for kind in KINDS {
                let points = if kind == CurveKind::Bezier && closed { &points[..6] } else { &points[..] };
                let curve = Curve::new(points, kind, closed).expect("a curve");
                let steps = 3000u32;
                let at = |i: u32| curve.point(f64::from(i) / f64::from(steps));
                let chords: Vec<f64> = (0..steps).map(|i| at(i).distance(at(i + 1))).collect();
                let sum: f64 = chords.iter().sum();
                prop_assert!((sum - curve.length()).abs() < 2e-3 * curve.length(), "{kind:?} {sum} {}", curve.length());
                let (mut walked, step) = (0.0, curve.length() / f64::from(steps));
                for (i, chord) in (1..).zip(&chords) {
                    walked += chord;
                    let wrong = (walked - f64::from(i) * step).abs();
                    prop_assert!(wrong < 3e-3 * curve.length(), "{kind:?} {i}");
                }
                let along = curve.tangent(0.3);
                let difference = (curve.point(0.3 + 1e-6) - curve.point(0.3 - 1e-6)).normalize();
                prop_assert!((along.length() - 1.0).abs() < 1e-9);
                prop_assert!(kind == CurveKind::Linear || along.distance(difference) < 2e-2, "{along} {difference}");
            }
        }
    }
}
