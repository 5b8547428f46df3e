//! Conversion of control points to Bezier pieces: B-splines, and curves through points.

use glam::DVec3;

use super::cubic::{Blend, line};

/// Returns the pieces of the uniform cubic B-spline with these control `points`, which begins at the first point and
/// ends at the last; `closed` is a periodic one. With 2 or 3 points, an open spline is a line or a parabola.
///
/// Method: W. Boehm, "Inserting new knots into B-spline curves", 1980: the Bezier points of a piece are the control
/// points after each of its ends has become a triple knot.
pub(super) fn b_spline<T: Blend>(points: &[T], closed: bool) -> Vec<[T; 4]> {
    let count = points.len();
    if closed {
        return (0..count)
            .map(|i| {
                let [a, b, c, d] = [0, 1, 2, 3].map(|offset| points[(i + offset) % count]);
                let [first, second] = [b + (c - b) * (1.0 / 3.0), b + (c - b) * (2.0 / 3.0)];
                let [before, after] = [b + (a - b) * (1.0 / 3.0), c + (d - c) * (1.0 / 3.0)];
                [(before + first) * 0.5, first, second, (second + after) * 0.5]
            })
            .collect();
    }
    match *points {
        [] | [_] => Vec::new(),
        [a, b] => vec![line(a, b)],
        [a, b, c] => vec![[a, a + (b - a) * (2.0 / 3.0), c + (b - c) * (2.0 / 3.0), c]],
        _ => (0..count - 3).map(|span| open_piece(points, span)).collect(),
    }
}

/// Returns piece `span` of an open spline of at least 4 control points with the knots 0, 0, 0, 0, 1, 2, 3 and so on.
fn open_piece<T: Blend>(points: &[T], span: usize) -> [T; 4] {
    let last = (points.len() - 3) as f64;
    let knot = |index: usize| (index as f64 - 3.0).clamp(0.0, last);
    // The blossom of the piece: de Boor's algorithm with another argument in each round.
    let blossom = |arguments: [f64; 3]| {
        let mut level: [T; 4] = [0, 1, 2, 3].map(|offset| points[span + offset]);
        for (round, at) in arguments.into_iter().enumerate() {
            for index in 0..3 - round {
                let first = span + index + round + 1;
                let (low, high) = (knot(first), knot(first + 3 - round));
                level[index] = level[index] + (level[index + 1] - level[index]) * ((at - low) / (high - low));
            }
        }
        level[0]
    };
    let (from, to) = (span as f64, span as f64 + 1.0);
    let mut piece = [[from, from, from], [from, from, to], [from, to, to], [to, to, to]].map(blossom);
    if span == 0 {
        piece[0] = points[0];
    }
    if span + 4 == points.len() {
        piece[3] = points[points.len() - 1];
    }
    piece
}

/// Returns the pieces of the smooth curve through `points`, of which neighbours differ.
///
/// Method: centripetal Catmull-Rom splines, which have no cusps and loops within a piece: Yuksel, Schaefer, Keyser,
/// "Parameterization and applications of Catmull-Rom curves", 2011. At open ends, the tangent is that of the parabola
/// through three points.
pub(super) fn through(points: &[DVec3], closed: bool) -> Vec<[DVec3; 4]> {
    let count = points.len();
    let spans = if closed { count } else { count - 1 };
    let interval = |i: usize| points[i % count].distance(points[(i + 1) % count]).sqrt();
    let slope = |i: usize| (points[(i + 1) % count] - points[i % count]) / interval(i);
    let tangent = |i: usize| {
        let (before, after) = match (closed, i) {
            (true, _) => ((i + count - 1) % count, i % count),
            (false, 0) if count > 2 => {
                let (near, far) = (interval(0), interval(1));
                return slope(0) + (slope(0) - slope(1)) * (near / (near + far));
            }
            (false, _) if i == count - 1 && count > 2 => {
                let (near, far) = (interval(i - 1), interval(i - 2));
                return slope(i - 1) + (slope(i - 1) - slope(i - 2)) * (near / (near + far));
            }
            (false, 0) => return slope(0),
            (false, _) if i == count - 1 => return slope(i - 1),
            (false, _) => (i - 1, i),
        };
        let [left, right] = [before, after].map(interval);
        (slope(before) * right + slope(after) * left) / (left + right)
    };
    (0..spans)
        .map(|i| {
            let (from, to, third) = (points[i], points[(i + 1) % count], interval(i) / 3.0);
            [from, from + tangent(i) * third, to - tangent((i + 1) % count) * third, to]
        })
        .collect()
}

/// Returns the pieces of the straight lines between `points`.
pub(super) fn lines(points: &[DVec3], closed: bool) -> Vec<[DVec3; 4]> {
    let next = points.iter().skip(1).chain(closed.then(|| &points[0]));
    points.iter().zip(next).map(|(from, to)| line(*from, *to)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::cubic::{point, velocity};
    use super::*;

    /// Evaluates a B-spline by the recurrence of Cox and de Boor, independently of the pieces.
    fn reference(controls: &[f64], knots: &[f64], degree: usize, at: f64) -> f64 {
        fn basis(knots: &[f64], i: usize, degree: usize, at: f64) -> f64 {
            if degree == 0 {
                return f64::from(u8::from(knots[i] <= at && at < knots[i + 1]));
            }
            let part = |from: f64, to: f64, value: f64| if to > from { value / (to - from) } else { 0.0 };
            part(knots[i], knots[i + degree], at - knots[i]) * basis(knots, i, degree - 1, at)
                + part(knots[i + 1], knots[i + degree + 1], knots[i + degree + 1] - at)
                    * basis(knots, i + 1, degree - 1, at)
        }
        controls.iter().enumerate().map(|(i, control)| control * basis(knots, i, degree, at)).sum()
    }

    #[test]
    fn the_pieces_of_an_open_b_spline_are_those_of_its_definition() {
        for count in 4..12usize {
            let controls: Vec<f64> = (0..count).map(|i| ((i * i) as f64 * 0.7).sin() * 3.0).collect();
            let last = (count - 3) as f64;
            let knots: Vec<f64> = (0..count + 4).map(|i| (i as f64 - 3.0).clamp(0.0, last)).collect();
            let pieces = b_spline(&controls, false);
            assert_eq!(pieces.len(), count - 3);
            for (span, piece) in pieces.iter().enumerate() {
                for t in [0.0, 0.25, 0.5, 0.999] {
                    let expected = reference(&controls, &knots, 3, span as f64 + t);
                    assert!((point(piece, t) - expected).abs() < 1e-12, "{count} {span} {t}");
                }
            }
        }
    }

    #[test]
    fn a_closed_b_spline_is_smooth_everywhere() {
        let controls = [0.0, 3.0, -1.0, 4.0, 2.0];
        let pieces = b_spline(&controls, true);
        let knots: Vec<f64> = (0..20).map(f64::from).collect();
        let repeated: Vec<f64> = controls.iter().chain(&controls).copied().collect();
        for (index, piece) in pieces.iter().enumerate() {
            let next = &pieces[(index + 1) % pieces.len()];
            assert!((piece[3] - next[0]).abs() < 1e-12);
            assert!((velocity(piece, 1.0) - velocity(next, 0.0)).abs() < 1e-12);
            // Piece 0 is the span of the points 0 to 3.
            let expected = reference(&repeated, &knots, 3, index as f64 + 3.5);
            assert!((point(piece, 0.5) - expected).abs() < 1e-12, "{index}");
        }
    }

    #[test]
    fn a_curve_through_points_meets_them_with_one_tangent() {
        let points = [(0.0, 0.0), (1.0, 0.0), (1.2, 3.0), (-2.0, 4.0), (-2.5, 4.1)]
            .map(|(x, y)| DVec3::new(x, y, x * y));
        for closed in [false, true] {
            let pieces = through(&points, closed);
            assert_eq!(pieces.len(), if closed { 5 } else { 4 });
            for (index, pair) in pieces.windows(2).enumerate() {
                assert_eq!((pair[0][3], pair[1][0]), (points[index + 1], points[index + 1]));
                let [before, after] = [velocity(&pair[0], 1.0), velocity(&pair[1], 0.0)];
                assert!(before.normalize().distance(after.normalize()) < 1e-12);
            }
            if closed {
                let [end, start] = [velocity(&pieces[4], 1.0), velocity(&pieces[0], 0.0)];
                assert_eq!(pieces[4][3], points[0]);
                assert!(end.normalize().distance(start.normalize()) < 1e-12);
            }
        }
    }

    #[test]
    fn a_curve_through_even_points_of_a_line_has_constant_speed() {
        let points: Vec<DVec3> = (0..5).map(|i| DVec3::X * f64::from(i)).collect();
        for piece in through(&points, false) {
            assert!((0..=4).all(|i| {
                let t = f64::from(i) / 4.0;
                point(&piece, t).distance(piece[0] + DVec3::X * t) < 1e-12
            }));
        }
    }
}
