//! Functions of one variable, defined by points.

use glam::DVec2;

use super::cubic::{GAUSS_3, line, point, velocity};
use super::pieces::b_spline;
use burgeon_base::error::{Error, Result};
use burgeon_base::{MemoryOwner, Stop};

/// Number of points between two checks for cancellation.
pub(super) const STRETCH: usize = 4096;

/// Interpolation of a [`Ramp`] between its points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum RampKind {
    /// A smooth function through the points that rises and falls only where the points do.
    #[default]
    Monotone,
    /// Straight lines between the points.
    Linear,
    /// A cubic B-spline with the points as control points, as function files of cpfg have it.
    Spline,
}

/// A function of one variable: one y for each x, constant before the first point and after the last.
///
/// ```
/// use burgeon_geometry::{Ramp, RampKind};
/// use glam::DVec2;
///
/// let points = [DVec2::new(0.0, 1.0), DVec2::new(2.0, 5.0)];
/// let ramp = Ramp::new(&points, RampKind::Linear)?;
/// assert_eq!((ramp.at(1.0), ramp.slope(1.0), ramp.at(9.0)), (3.0, 2.0, 5.0));
/// assert_eq!(ramp.integral(0.0, 4.0), 6.0 + 10.0);
/// # Ok::<(), burgeon_base::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Ramp {
    /// Bezier points of each piece; x increases along a piece.
    pieces: Vec<[DVec2; 4]>,
    /// Area below the pieces before each piece, and below all pieces.
    areas: Vec<f64>,
}

impl Ramp {
    /// Creates the function of `points`, in the order of increasing x.
    ///
    /// Fails if there are fewer than 2 points, or if a number is not finite or an x not above the x before.
    pub fn new(points: &[DVec2], kind: RampKind) -> Result<Self> {
        check(points)?;
        MemoryOwner::ensure_room(points.len() * size_of::<[DVec2; 5]>())?;
        let pieces = match kind {
            RampKind::Linear => points.windows(2).map(|pair| line(pair[0], pair[1])).collect(),
            RampKind::Monotone => monotone(points),
            RampKind::Spline => b_spline(points, false),
        };
        let sound = |piece: &[DVec2; 4]| {
            piece.iter().all(|it| it.is_finite()) && piece.windows(2).all(|pair| pair[0].x <= pair[1].x)
        };
        if let Some(wrong) = pieces.iter().position(|piece| !sound(piece)) {
            return Err(Error::argument(format!(
                "the numbers of point {} are too large or too close",
                wrong + 1
            ))
            .help("scale the points to numbers from -1e9 to 1e9"));
        }
        Self::of_pieces(pieces)
    }

    /// Creates the function of sound `pieces`, at least one.
    pub(super) fn of_pieces(pieces: Vec<[DVec2; 4]>) -> Result<Self> {
        let mut areas = Vec::with_capacity(pieces.len() + 1);
        let mut sum = 0.0;
        for (index, piece) in pieces.iter().enumerate() {
            if index % STRETCH == STRETCH - 1 {
                Stop::check_current()?;
            }
            areas.push(sum);
            sum += area(piece, 1.0);
        }
        areas.push(sum);
        Ok(Self { pieces, areas })
    }

    /// Returns the y at `x`.
    pub fn at(&self, x: f64) -> f64 {
        self.find(x).map_or_else(|end| end.y, |(piece, t)| point(&self.pieces[piece], t).y)
    }

    /// Returns the slope at `x`; 0 outside of the points, and the slope to the right of a corner.
    pub fn slope(&self, x: f64) -> f64 {
        self.find(x).map_or(0.0, |(piece, t)| {
            let DVec2 { x, y } = velocity(&self.pieces[piece], t);
            y / x
        })
    }

    /// Returns the integral from `from` to `to`; negative if y is positive and `to` is the smaller number.
    pub fn integral(&self, from: f64, to: f64) -> f64 {
        self.area_to(to) - self.area_to(from)
    }

    /// Returns the x of the first and the last point.
    pub fn span(&self) -> [f64; 2] {
        [self.first().x, self.last().x]
    }

    /// Returns the approximate memory (bytes).
    pub fn memory(&self) -> usize {
        self.pieces.len() * size_of::<[DVec2; 4]>() + self.areas.len() * size_of::<f64>()
    }

    /// Returns the Bezier points of the pieces.
    pub fn pieces(&self) -> &[[DVec2; 4]] {
        &self.pieces
    }

    fn first(&self) -> DVec2 {
        self.pieces.first().map_or(DVec2::ZERO, |piece| piece[0])
    }

    fn last(&self) -> DVec2 {
        self.pieces.last().map_or(DVec2::ZERO, |piece| piece[3])
    }

    /// Returns the piece at `x` and the parameter in it, or the point at the end beyond which `x` lies.
    fn find(&self, x: f64) -> std::result::Result<(usize, f64), DVec2> {
        let (first, last) = (self.first(), self.last());
        if x < first.x || x.is_nan() {
            return Err(first);
        }
        if x > last.x {
            return Err(last);
        }
        let piece = self.pieces.partition_point(|piece| piece[0].x <= x).max(1) - 1;
        Ok((piece, parameter(&self.pieces[piece], x)))
    }

    /// Returns the area from the first point to `x`.
    fn area_to(&self, x: f64) -> f64 {
        match self.find(x) {
            Ok((piece, t)) => self.areas[piece] + area(&self.pieces[piece], t),
            Err(end) => {
                let before = if x > end.x { self.areas[self.areas.len() - 1] } else { 0.0 };
                before + (x - end.x) * end.y
            }
        }
    }
}

/// Returns the area below a piece from its start to the parameter `t`: exact, because the integrand has degree 5.
fn area(piece: &[DVec2; 4], t: f64) -> f64 {
    let part = |(at, weight): &(f64, f64)| weight * point(piece, at * t).y * velocity(piece, at * t).x;
    GAUSS_3.iter().map(part).sum::<f64>() * t
}

/// Returns the parameter of a piece at `x`, by Newton's method within a shrinking interval.
pub(super) fn parameter(piece: &[DVec2; 4], x: f64) -> f64 {
    let [a, b, c, d] = piece.map(|point| point.x);
    let mut t = ((x - a) / (d - a)).clamp(0.0, 1.0);
    if is_even([a, b, c, d]) {
        return t;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let error = point(&[a, b, c, d], t) - x;
        if error.abs() <= 1e-15 * (d - a) {
            break;
        }
        *if error < 0.0 { &mut low } else { &mut high } = t;
        let next = t - error / velocity(&[a, b, c, d], t);
        let next = if next > low && next < high { next } else { (low + high) / 2.0 };
        if (next - t).abs() < 1e-16 {
            break;
        }
        t = next;
    }
    t
}

/// Returns true if x is proportional to the parameter in a piece with these x coordinates.
pub(super) fn is_even([a, b, c, d]: [f64; 4]) -> bool {
    let third = (d - a) / 3.0;
    (b - a - third).abs() <= 1e-12 * third && (d - c - third).abs() <= 1e-12 * third
}

/// Fails unless there are points with finite numbers and increasing x.
fn check(points: &[DVec2]) -> Result<()> {
    let enough = "give at least 2 points, such as { { 0, 0.1 }, { 1, 0.8 } }";
    if points.len() < 2 {
        return Err(
            Error::argument(format!("a function needs at least 2 points, not {}", points.len())).help(enough)
        );
    }
    for (index, at) in points.iter().enumerate() {
        if !at.is_finite() {
            return Err(
                Error::argument(format!("point {} is not finite", index + 1)).help("give finite numbers")
            );
        }
        if index > 0 && at.x <= points[index - 1].x {
            let (before, number) = (points[index - 1].x, index + 1);
            let message =
                format!("the x of point {number} is {}, which is not above {before}, the x before", at.x);
            return Err(Error::argument(message)
                .help("a function has one y for each x: order the points by x, and remove repeated x"));
        }
    }
    Ok(())
}

/// Returns the pieces of the cubic through `points` that keeps their monotonicity.
///
/// Method: slopes as harmonic means of the slopes of the neighbouring lines: F. N. Fritsch and J. Butland, "A method
/// for constructing local monotone piecewise cubic interpolants", 1984.
fn monotone(points: &[DVec2]) -> Vec<[DVec2; 4]> {
    let step = |i: usize| points[i + 1].x - points[i].x;
    let slope = |i: usize| (points[i + 1].y - points[i].y) / step(i);
    let last = points.len() - 1;
    let tangent = |i: usize| {
        let (near, far) = match i {
            _ if last == 1 => return slope(0),
            0 => (0, 1),
            _ if i == last => (i - 1, i - 2),
            _ => {
                let [before, after] = [slope(i - 1), slope(i)];
                if before * after <= 0.0 {
                    return 0.0;
                }
                let [wide, high] = [step(i - 1), step(i)];
                let weights = [wide + 2.0 * high, 2.0 * wide + high];
                return (weights[0] + weights[1]) / (weights[0] / before + weights[1] / after);
            }
        };
        // The end of the parabola through three points, limited so that the first piece is monotone.
        let [slopes, steps] = [[near, far].map(slope), [near, far].map(step)];
        let end = ((2.0 * steps[0] + steps[1]) * slopes[0] - steps[0] * slopes[1]) / (steps[0] + steps[1]);
        if end * slopes[0] <= 0.0 {
            0.0
        } else if slopes[0] * slopes[1] <= 0.0 && end.abs() > 3.0 * slopes[0].abs() {
            3.0 * slopes[0]
        } else {
            end
        }
    };
    (0..last).map(|i| hermite([points[i], points[i + 1]], [tangent(i), tangent(i + 1)])).collect()
}

/// Returns the piece between two points with these slopes.
pub(super) fn hermite([from, to]: [DVec2; 2], slopes: [f64; 2]) -> [DVec2; 4] {
    let third = (to.x - from.x) / 3.0;
    [from, from + DVec2::new(third, slopes[0] * third), to - DVec2::new(third, slopes[1] * third), to]
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn ramp(points: &[(f64, f64)], kind: RampKind) -> Ramp {
        let points: Vec<DVec2> = points.iter().copied().map(DVec2::from).collect();
        Ramp::new(&points, kind).expect("a function")
    }

    const KINDS: [RampKind; 3] = [RampKind::Monotone, RampKind::Linear, RampKind::Spline];

    #[test]
    fn a_function_of_two_points_is_a_line_that_continues_level() {
        for kind in KINDS {
            let line = ramp(&[(1.0, 4.0), (3.0, 0.0)], kind);
            for (x, y) in [(-5.0, 4.0), (1.0, 4.0), (2.0, 2.0), (2.5, 1.0), (3.0, 0.0), (9.0, 0.0)] {
                assert!((line.at(x) - y).abs() < 1e-12, "{kind:?} {x}");
            }
            assert!(
                (line.slope(2.0) + 2.0).abs() < 1e-12 && line.slope(0.0) == 0.0 && line.slope(4.0) == 0.0
            );
            assert!((line.integral(0.0, 4.0) - 8.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_spline_follows_the_definition_of_a_b_spline() {
        // In the middle of even control points, x is proportional to the parameter, and y is the uniform B-spline.
        let points: Vec<_> = (0..11).map(|i| (f64::from(i), if i == 5 { 6.0 } else { 0.0 })).collect();
        let spline = ramp(&points, RampKind::Spline);
        for (x, y) in [(3.0, 0.0), (4.0, 1.0), (5.0, 4.0), (6.0, 1.0), (7.0, 0.0)] {
            assert!((spline.at(x) - y).abs() < 1e-12, "{x}");
        }
        assert!((spline.integral(0.0, 10.0) - 6.0).abs() < 1e-12);
    }

    #[test]
    fn bad_points_are_refused_with_a_remedy() {
        let refuse = |points: &[(f64, f64)]| {
            let points: Vec<DVec2> = points.iter().copied().map(DVec2::from).collect();
            Ramp::new(&points, RampKind::Monotone).expect_err("refused").to_string()
        };
        insta::assert_snapshot!(refuse(&[]), @r"
        a function needs at least 2 points, not 0
          help: give at least 2 points, such as { { 0, 0.1 }, { 1, 0.8 } }
        ");
        insta::assert_snapshot!(refuse(&[(0.0, 1.0), (0.5, 1.0), (0.5, 2.0)]), @r"
        the x of point 3 is 0.5, which is not above 0.5, the x before
          help: a function has one y for each x: order the points by x, and remove repeated x
        ");
        insta::assert_snapshot!(refuse(&[(0.0, 1.0), (0.5, f64::NAN)]), @r"
        point 2 is not finite
          help: give finite numbers
        ");
        insta::assert_snapshot!(refuse(&[(0.0, -1e308), (1e-300, 1e308), (2e-300, 1e308)]), @r"
        the numbers of point 1 are too large or too close
          help: scale the points to numbers from -1e9 to 1e9
        ");
    }

    fn points() -> impl Strategy<Value = Vec<(f64, f64)>> {
        prop::collection::vec((0.01f64..2.0, -3.0f64..3.0), 2..12).prop_map(|steps| {
            let mut x = -1.0;
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
        #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn a_monotone_function_meets_its_points_and_never_overshoots(points in points(), at in 0.0f64..1.0) {
            let ramp = ramp(&points, RampKind::Monotone);
            for (x, y) in &points {
                prop_assert!((ramp.at(*x) - y).abs() < 1e-9);
            }
            for pair in points.windows(2) {
                let [(x, y), (next, other)] = [pair[0], pair[1]];
                let between = ramp.at(x + at * (next - x));
                prop_assert!(between >= y.min(other) - 1e-12 && between <= y.max(other) + 1e-12);
            }
        }

        #[test]
        fn slope_and_integral_agree_with_differences_and_sums(points in points(), at in 0.02f64..0.98) {
            for kind in KINDS {
                let ramp = ramp(&points, kind);
                let [from, to] = ramp.span();
                let x = from + at * (to - from);
                let h = 1e-6;
                let difference = (ramp.at(x + h) - ramp.at(x - h)) / (2.0 * h);
                // A difference across a corner lies between both slopes.
                let slopes = [x - h, x, x + h].map(|x| ramp.slope(x));
                let (low, high) = (slopes[0].min(slopes[1]).min(slopes[2]), slopes[0].max(slopes[1]).max(slopes[2]));
                let slack = 1e-3 * (1.0 + high.abs().max(low.abs()));
                prop_assert!(difference > low - slack && difference < high + slack, "{kind:?} {difference} {slopes:?}");
                let steps = 4000;
                let width = (x - from + 1.0) / f64::from(steps);
                let sum: f64 = (0..steps).map(|i| ramp.at(from - 1.0 + (f64::from(i) + 0.5) * width) * width).sum();
                let exact = ramp.integral(from - 1.0, x);
                prop_assert!((sum - exact).abs() < 1e-4 * (1.0 + points.len() as f64), "{kind:?} {sum} {exact}");
                prop_assert!((ramp.integral(x, from - 1.0) + exact).abs() < 1e-12);
            }
        }

        #[test]
        fn a_spline_stays_within_its_points(points in points(), at in -0.2f64..1.2) {
            let ramp = ramp(&points, RampKind::Spline);
            let [from, to] = ramp.span();
            let y = ramp.at(from + at * (to - from));
            let low = points.iter().map(|it| it.1).fold(f64::MAX, f64::min);
            let high = points.iter().map(|it| it.1).fold(f64::MIN, f64::max);
            prop_assert!(y >= low - 1e-9 && y <= high + 1e-9);
        }
    }
}
