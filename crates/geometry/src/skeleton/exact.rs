//! Moving lines in integers: exact times and positions of their intersections, and exact comparisons.

use std::cmp::Ordering;

use dashu_int::ops::SquareRoot;
use dashu_int::{IBig, UBig};
use glam::{DVec2, I64Vec2};

use super::edge::{CELLS, Direction};
use super::whole::Whole;

/// A moving line: the points (x, y) of the lattice with a x + b y = c + w t, where t is the time in cells.
#[derive(Debug, Clone)]
pub(super) struct ExactLine {
    pub a: Whole,
    pub b: Whole,
    pub c: Whole,
    pub w: Whole,
}

/// A fraction with a positive denominator.
#[derive(Debug, Clone)]
pub(super) struct Ratio {
    pub over: Whole,
    pub under: Whole,
}

/// A point (cells) with a common positive denominator for both coordinates.
#[derive(Debug, Clone)]
pub(super) struct ExactPlace {
    pub x: Whole,
    pub y: Whole,
    pub under: Whole,
}

/// Decomposes a number into an integer and a power of two.
fn parts(number: f64) -> (i64, i64) {
    let bits = number.to_bits();
    #[allow(clippy::cast_possible_wrap, reason = "11 and 52 bits")]
    let (exponent, fraction) = ((bits >> 52 & 0x7ff) as i64, (bits & ((1 << 52) - 1)) as i64);
    let (mut whole, mut power) =
        if exponent == 0 { (fraction, -1074) } else { (fraction | 1 << 52, exponent - 1075) };
    if whole == 0 {
        return (0, 0);
    }
    power += i64::from(whole.trailing_zeros());
    whole >>= whole.trailing_zeros();
    (if number < 0.0 { -whole } else { whole }, power)
}

#[allow(clippy::cast_sign_loss, clippy::cast_possible_truncation, reason = "callers make it positive")]
fn shift_left(number: &Whole, by: i64) -> Whole {
    number.shifted(by as usize)
}

/// Returns the length of a vector as the product of an integer and a power of two.
///
/// Nearly parallel lines separate as slowly as their speeds differ, so lengths must be far more precise than
/// directions.
fn length(x: i64, y: i64) -> (Whole, i64) {
    let [x, y] = [x, y].map(|number| u128::from(number.unsigned_abs()));
    let square = x * x + y * y;
    let whole = square.isqrt();
    if whole * whole == square {
        #[allow(clippy::cast_possible_wrap, reason = "no more than 2^64")]
        return (Whole::from(whole as i128), 0);
    }
    let more = whole.leading_zeros();
    let longer = (UBig::from(square) << (2 * more as usize)).sqrt();
    (IBig::from(longer).into(), -i64::from(more))
}

impl ExactLine {
    /// Creates the line in `direction` through a point, which moves to the left after the time `rest` (m).
    ///
    /// Its speed has a precision of 128 bits, and is equal for all parallel lines of the same speed.
    pub(super) fn new(direction: Direction, through: I64Vec2, speed: f64, rest: f64) -> Self {
        let I64Vec2 { x, y } = direction.shortest().0;
        let (length, length_power) = length(x, y);
        let (speed, speed_power) = parts(speed);
        let (w, w_power) = (&length * &Whole::from(speed), length_power + speed_power);
        let (rest, rest_power) = parts(if speed > 0 { rest * CELLS } else { 0.0 });
        let scale = 0.max(-w_power).max(-(w_power + rest_power));
        let c = i128::from(-y) * i128::from(through.x) + i128::from(x) * i128::from(through.y);
        let gone = &w * &Whole::from(rest);
        Self {
            a: shift_left(&Whole::from(-y), scale),
            b: shift_left(&Whole::from(x), scale),
            c: shift_left(&Whole::from(c), scale) - shift_left(&gone, scale + w_power + rest_power),
            w: shift_left(&w, scale + w_power),
        }
    }

    /// Creates the stationary line through a point, perpendicular to `direction`.
    pub(super) fn pin(direction: Direction, at: &ExactPlace) -> Self {
        let I64Vec2 { x, y } = direction.shortest().0;
        let (x, y) = (Whole::from(x), Whole::from(y));
        let c = &at.x * &x + &at.y * &y;
        Self { a: &at.under * &x, b: &at.under * &y, c, w: Whole::ZERO }
    }

    fn cross(&self, other: &Self) -> Whole {
        &self.a * &other.b - &self.b * &other.a
    }
}

/// Computes a number with the sign of the rate at which three lines approach each other.
pub(super) fn rate([l, m, n]: [&ExactLine; 3]) -> Whole {
    &l.w * &m.cross(n) + &m.w * &n.cross(l) + &n.w * &l.cross(m)
}

/// Returns the time when three lines intersect in one point; `None` if that is never or always.
pub(super) fn time([l, m, n]: [&ExactLine; 3]) -> Option<Ratio> {
    let crosses = [m.cross(n), n.cross(l), l.cross(m)];
    let under = &l.w * &crosses[0] + &m.w * &crosses[1] + &n.w * &crosses[2];
    let over = &l.c * &crosses[0] + &m.c * &crosses[1] + &n.c * &crosses[2];
    match under.sign() {
        Ordering::Less => Some(Ratio { over, under: -under }),
        Ordering::Equal => None,
        Ordering::Greater => Some(Ratio { over: -over, under }),
    }
}

/// Returns the intersection of two lines that are not parallel, at a time.
pub(super) fn place(l: &ExactLine, m: &ExactLine, time: &Ratio) -> ExactPlace {
    let [level, other] = [l, m].map(|line| &line.c * &time.under + &line.w * &time.over);
    let cross = l.cross(m);
    let x = &level * &m.b - &other * &l.b;
    let y = &other * &l.a - &level * &m.a;
    let under = &cross * &time.under;
    if cross.sign() == Ordering::Less {
        ExactPlace { x: -x, y: -y, under: -under }
    } else {
        ExactPlace { x, y, under }
    }
}

impl Ratio {
    /// Converts a time (m) to a fraction.
    pub(super) fn of(time: f64) -> Self {
        let (whole, power) = parts(time * CELLS);
        let [up, down] = [power.max(0), (-power).max(0)];
        Self { over: shift_left(&Whole::from(whole), up), under: shift_left(&Whole::ONE, down) }
    }

    pub(super) fn compare(&self, other: &Self) -> Ordering {
        (&self.over * &other.under).cmp(&(&other.over * &self.under))
    }

    /// Converts to metres, rounded.
    pub(super) fn metres(&self) -> f64 {
        self.over.quotient(&self.under) / CELLS
    }
}

impl ExactPlace {
    pub(super) fn is(&self, other: &Self) -> bool {
        &self.x * &other.under == &other.x * &self.under && &self.y * &other.under == &other.y * &self.under
    }

    /// Compares the positions of two points along a direction.
    pub(super) fn compare_along(&self, other: &Self, direction: Direction) -> Ordering {
        let (x, y) = (Whole::from(direction.0.x), Whole::from(direction.0.y));
        let [own, others] = [self, other].map(|place| &place.x * &x + &place.y * &y);
        (&own * &other.under).cmp(&(&others * &self.under))
    }

    /// Converts to metres, rounded.
    pub(super) fn metres(&self) -> DVec2 {
        DVec2::new(self.x.quotient(&self.under), self.y.quotient(&self.under)) / CELLS
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(way: (i64, i64), through: (i64, i64), speed: f64, rest: f64) -> ExactLine {
        ExactLine::new(Direction(way.into()), I64Vec2::from(through), speed, rest)
    }

    #[test]
    fn the_sides_of_a_square_meet_in_its_middle_when_half_of_it_is_gone() {
        const SIDE: i64 = 3 << 32;
        let sides = [
            line((0, -7), (0, 5), 1.0, 0.0),
            line((9, 0), (1, 0), 1.0, 0.0),
            line((0, 2), (SIDE, 0), 1.0, 0.0),
        ];
        let found = time([&sides[0], &sides[1], &sides[2]]).expect("a time");
        assert_eq!((found.metres(), found.compare(&Ratio::of(1.5))), (1.5, Ordering::Equal));
        let at = place(&sides[0], &sides[1], &found);
        assert_eq!(at.metres(), DVec2::splat(1.5));
        assert!(at.is(&place(&sides[1], &sides[2], &found)));
        assert!(time([&sides[0], &sides[2], &sides[0]]).is_none());
    }

    #[test]
    fn a_line_that_rests_at_first_is_late_by_that() {
        let sides = [
            line((0, -1), (0, 0), 1.0, 0.0),
            line((1, 0), (0, 0), 1.0, 0.0),
            line((0, 1), (4 << 32, 0), 1.0, 0.3),
        ];
        let found = time([&sides[0], &sides[1], &sides[2]]).expect("a time");
        assert!((found.metres() - 2.15).abs() < 1e-15);
    }

    #[test]
    fn numbers_fall_into_a_whole_one_and_a_power_of_two() {
        for number in [0.0, 1.0, -0.75, 1e300, 5e-324, 1.0 / 3.0] {
            let (whole, power) = parts(number);
            #[allow(clippy::cast_precision_loss, clippy::cast_possible_truncation, reason = "53 bits")]
            let (whole, power) = (whole as f64, power as i32);
            assert_eq!(whole * 2f64.powi(power / 2) * 2f64.powi(power - power / 2), number);
        }
    }
}
