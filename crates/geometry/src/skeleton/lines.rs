//! Intersections of moving lines: approximate with an error bound, and exact where the bound is not
//! sufficient.

use std::cmp::Ordering;

use glam::{DVec2, I64Vec2};

use super::edge::{Direction, metres};
use super::exact::{self, ExactLine, ExactPlace, Ratio};

/// Relative rounding error of a number.
const UNIT: f64 = f64::EPSILON / 2.0;
/// Maximum error (m) of times and positions in the output.
pub(super) const FINE: f64 = 1e-7;

/// A moving line: the points whose dot product with `normal` is `level` + `speed` * time.
#[derive(Debug, Clone, Copy)]
pub(super) struct MovingLine {
    pub normal: DVec2,
    pub level: f64,
    pub speed: f64,
    /// Error bound of `level` (m).
    pub slack: f64,
    /// Set for an axis-parallel line with an exact level and a speed of 0 or 1: computations with only such
    /// lines are often exact.
    pub is_plain: bool,
}

/// Exact definition of a line.
#[derive(Debug, Clone)]
enum LineOrigin {
    /// A line through a point that starts to move after `rest` (m).
    Edge { through: I64Vec2, rest: f64 },
    /// A stationary line through the intersection of two lines at a time, perpendicular to an edge.
    Pin { pair: [usize; 2], when: EventTime },
}

/// Time of an event.
#[derive(Debug, Clone, Copy)]
pub(super) struct EventTime {
    pub time: f64,
    /// Error bound of `time` (m).
    pub slack: f64,
    /// Lines that intersect in one point at this time, sorted; `NONE` for an explicit time.
    by: [u32; 3],
    /// Index of the exact time, or `NONE`.
    exact: u32,
}

/// Marker for a missing line, exact line or time.
const NONE: u32 = u32::MAX;

impl EventTime {
    pub(super) fn at(time: f64) -> Self {
        Self { time, slack: 0.0, by: [NONE; 3], exact: NONE }
    }

    pub(super) fn low(&self) -> f64 {
        self.time - self.slack
    }

    pub(super) fn high(&self) -> f64 {
        self.time + self.slack
    }

    /// Returns true if a line is one of those that meet at this time.
    #[allow(clippy::cast_possible_truncation, reason = "there are fewer lines")]
    pub(super) fn is_by(&self, line: usize) -> bool {
        self.by.contains(&(line as u32))
    }
}

/// Intersection of two lines at a time.
#[derive(Debug, Clone, Copy)]
pub(super) struct LineMeeting {
    pub pair: [usize; 2],
    pub at: DVec2,
    /// Error bound of `at` (m).
    pub slack: f64,
}

/// Sums over three lines of the levels (m) and of the speeds, each multiplied by the cross product of the
/// other two.
#[derive(Debug, Clone, Copy)]
struct LineSums {
    levels: f64,
    speeds: f64,
    /// Sum of the error bounds of the levels (m).
    slack: f64,
    /// Set if both sums are exact; then the sum of the speeds is at most 2.
    is_exact: bool,
}

/// All lines of a wavefront.
#[derive(Debug, Default)]
pub(super) struct MovingLines {
    lines: Vec<MovingLine>,
    directions: Vec<Direction>,
    origins: Vec<LineOrigin>,
    /// Index of the exact form of each line, or `NONE`.
    numbers: Vec<u32>,
    exact: Vec<ExactLine>,
    times: Vec<Ratio>,
    /// Error bounds of products with levels (m), and of products with speeds.
    noise: [f64; 2],
}

/// Returns the sign of a number with the error bound `slack`, if it is certain.
fn sign(number: f64, slack: f64) -> Option<Ordering> {
    if number > slack {
        Some(Ordering::Greater)
    } else if number < -slack {
        Some(Ordering::Less)
    } else {
        (slack == 0.0).then_some(Ordering::Equal)
    }
}

/// Returns true if the sum of two numbers is exact.
///
/// Method: D. Knuth, "The Art of Computer Programming", volume 2, 4.2.2.
fn is_sum_exact(a: f64, b: f64) -> bool {
    let sum = a + b;
    let part = sum - a;
    a - (sum - part) == 0.0 && b - part == 0.0
}

/// Returns the unit vector in a direction; exact along an axis.
fn unit(way: I64Vec2) -> DVec2 {
    if is_axis(way) { way.signum().as_dvec2() } else { way.as_dvec2().normalize_or_zero() }
}

fn is_axis(way: I64Vec2) -> bool {
    way.x == 0 || way.y == 0
}

impl MovingLines {
    /// Removes all lines; later lines are within `reach` (m) of the origin and at most as fast as `speed`.
    pub(super) fn begin(&mut self, reach: f64, speed: f64) {
        self.lines.clear();
        self.directions.clear();
        self.origins.clear();
        self.numbers.clear();
        self.exact.clear();
        self.times.clear();
        // Normals are off by 8 units, levels by 16 units; a product of three normals and levels has 9 terms.
        self.noise = [128.0 * UNIT * reach, 96.0 * UNIT * speed.max(1.0)];
    }

    /// Adds the line in `direction` through a point of the lattice, which moves after the time `rest` (m).
    pub(super) fn add(&mut self, direction: Direction, through: I64Vec2, speed: f64, rest: f64) -> usize {
        let normal = unit(direction.left().0);
        let late = if speed > 0.0 { speed * rest } else { 0.0 };
        let level = normal.dot(metres(through)) - late;
        let slack = if late > 0.0 { 4.0 * UNIT * late } else { 0.0 };
        let fits = through.abs().max_element() < 1 << f64::MANTISSA_DIGITS;
        let is_plain = fits && late == 0.0 && [0.0, 1.0].contains(&speed) && is_axis(direction.0);
        let line = MovingLine { normal, level, speed, slack, is_plain };
        self.push(line, direction, LineOrigin::Edge { through, rest })
    }

    /// Adds the stationary line perpendicular to another line, through a point on it.
    pub(super) fn pin(&mut self, line: usize, place: &LineMeeting, when: &EventTime) -> usize {
        let direction = self.directions[line];
        let normal = unit(direction.0);
        let level = normal.dot(place.at);
        let slack = 2.0 * place.slack;
        let is_plain = slack == 0.0 && is_axis(direction.0);
        let pinned = MovingLine { normal, level, speed: 0.0, slack, is_plain };
        // The other line comes from the left side.
        let across = Direction(-direction.0.perp());
        self.push(pinned, across, LineOrigin::Pin { pair: place.pair, when: *when })
    }

    fn push(&mut self, line: MovingLine, direction: Direction, origin: LineOrigin) -> usize {
        self.lines.push(line);
        self.directions.push(direction);
        self.origins.push(origin);
        self.numbers.push(NONE);
        self.lines.len() - 1
    }

    pub(super) fn line(&self, line: usize) -> &MovingLine {
        &self.lines[line]
    }

    pub(super) fn direction(&self, line: usize) -> Direction {
        self.directions[line]
    }

    /// Returns the accumulated rounding errors of levels (m) and of speeds.
    pub(super) fn noise(&self) -> [f64; 2] {
        self.noise
    }

    fn exactly(&mut self, lines: &[usize]) {
        for &line in lines {
            if self.numbers[line] != NONE {
                continue;
            }
            let direction = self.directions[line];
            let exact = match self.origins[line].clone() {
                LineOrigin::Edge { through, rest } => {
                    ExactLine::new(direction, through, self.lines[line].speed, rest)
                }
                LineOrigin::Pin { pair, when } => {
                    let place = self.exact_place(pair, &mut { when });
                    ExactLine::pin(direction.left(), &place)
                }
            };
            self.numbers[line] = u32::try_from(self.exact.len()).unwrap_or(NONE);
            self.exact.push(exact);
        }
    }

    /// Returns the exact forms of lines, which must have been computed by `exactly`.
    fn exact_lines<const N: usize>(&self, lines: [usize; N]) -> [&ExactLine; N] {
        lines.map(|line| &self.exact[self.numbers[line] as usize])
    }

    /// Compares the turn from one line to another: to the left or to the right; equal if they are parallel.
    pub(super) fn turn(&self, line: usize, other: usize) -> Ordering {
        let cross = self.lines[line].normal.perp_dot(self.lines[other].normal);
        sign(cross, 32.0 * UNIT).unwrap_or_else(|| self.directions[line].turn(self.directions[other]))
    }

    /// Computes the sums that determine when three lines meet.
    fn sums(&self, [l, m, n]: [usize; 3]) -> LineSums {
        let [l, m, n] = [l, m, n].map(|line| &self.lines[line]);
        let crosses = [m.normal.perp_dot(n.normal), n.normal.perp_dot(l.normal), l.normal.perp_dot(m.normal)];
        let [one, two, three] = [l.level * crosses[0], m.level * crosses[1], n.level * crosses[2]];
        let speeds = l.speed * crosses[0] + m.speed * crosses[1] + n.speed * crosses[2];
        let is_plain = l.is_plain && m.is_plain && n.is_plain;
        let is_exact = is_plain && is_sum_exact(one, two) && is_sum_exact(one + two, three);
        LineSums { levels: one + two + three, speeds, slack: l.slack + m.slack + n.slack, is_exact }
    }

    /// Returns true if two lines are parallel and move in the same direction at the same speed.
    #[allow(clippy::float_cmp, reason = "equal speeds are given as equal numbers")]
    fn are_alike(&self, line: usize, other: usize) -> bool {
        let [one, two] = [self.directions[line], self.directions[other]];
        self.lines[line].speed == self.lines[other].speed && one.runs_as(two)
    }

    fn exact_rate(&mut self, lines: [usize; 3]) -> Ordering {
        let speeds = lines.map(|line| self.lines[line].speed);
        if speeds == [0.0; 3] {
            return Ordering::Equal;
        }
        let [l, m, n] = lines;
        // Two lines with the same motion intersect the third line at a constant distance.
        if self.are_alike(l, m) || self.are_alike(m, n) || self.are_alike(n, l) {
            return Ordering::Equal;
        }
        self.exactly(&lines);
        exact::rate(self.exact_lines(lines)).sign()
    }

    /// Returns the time when three approaching lines meet; `None` if they do not approach. `backwards`
    /// reverses the sign if two of the lines are in reverse order.
    pub(super) fn nearing(&mut self, lines: [usize; 3], backwards: bool) -> Option<EventTime> {
        let sums = self.sums(lines);
        let noise = if sums.is_exact { 0.0 } else { self.noise[1] };
        let rate = sign(sums.speeds, noise).unwrap_or_else(|| self.exact_rate(lines));
        let wanted = if backwards { Ordering::Less } else { Ordering::Greater };
        (rate == wanted).then(|| self.when_of(lines, sums))
    }

    /// Returns the time when three lines intersect in one point; they must do so exactly once.
    pub(super) fn meeting_time(&self, lines: [usize; 3]) -> EventTime {
        self.when_of(lines, self.sums(lines))
    }

    fn when_of(&self, lines: [usize; 3], sums: LineSums) -> EventTime {
        let LineSums { levels, speeds, slack, is_exact } = sums;
        #[allow(clippy::cast_possible_truncation, reason = "there are fewer lines")]
        let mut by = lines.map(|line| line as u32);
        for [a, b] in [[0, 1], [1, 2], [0, 1]] {
            if by[a] > by[b] {
                by.swap(a, b);
            }
        }
        let mut when = EventTime { time: -levels / speeds, slack: f64::INFINITY, by, exact: NONE };
        let rest = speeds.abs() - self.noise[1];
        if is_exact && speeds != 0.0 {
            when.slack = 0.0;
        } else if rest > 0.0 {
            when.slack = (self.noise[0] + slack + when.time.abs() * self.noise[1]) / rest
                + 4.0 * UNIT * when.time.abs();
        }
        if when.slack.is_nan() {
            when.slack = f64::INFINITY;
        }
        when
    }

    /// Refines a time with an error bound greater than `slack` (m); returns true if that was necessary.
    pub(super) fn settle(&mut self, when: &mut EventTime, slack: f64) -> bool {
        let coarse = when.slack > slack && when.exact == NONE;
        if coarse {
            self.refine(when);
        }
        coarse
    }

    /// Computes a time to the full precision of a number.
    pub(super) fn refine(&mut self, when: &mut EventTime) {
        let number = self.ratio(when);
        when.time = self.times[number].metres();
        when.slack = 2.0 * UNIT * when.time.abs() + f64::MIN_POSITIVE;
    }

    /// Returns the index of the exact time.
    fn ratio(&mut self, when: &mut EventTime) -> usize {
        if when.exact != NONE {
            return when.exact as usize;
        }
        let ratio = if when.by[0] == NONE {
            Ratio::of(when.time)
        } else {
            let lines = when.by.map(|line| line as usize);
            self.exactly(&lines);
            exact::time(self.exact_lines(lines)).unwrap_or_else(|| Ratio::of(f64::from(f32::MAX)))
        };
        self.times.push(ratio);
        when.exact = u32::try_from(self.times.len() - 1).unwrap_or(NONE);
        self.times.len() - 1
    }

    /// Compares two times exactly.
    pub(super) fn compare(&mut self, a: &mut EventTime, b: &mut EventTime) -> Ordering {
        if let Some(order) = sign(a.time - b.time, a.slack + b.slack) {
            return order;
        }
        if a.by == b.by && a.by[0] != NONE {
            return Ordering::Equal;
        }
        let [a, b] = [self.ratio(a), self.ratio(b)];
        if a == b { Ordering::Equal } else { self.times[a].compare(&self.times[b]) }
    }

    /// Returns the intersection of two lines at a time; they must not be parallel.
    pub(super) fn place(&self, pair: [usize; 2], when: &EventTime) -> LineMeeting {
        let [l, m] = pair.map(|line| &self.lines[line]);
        let cross = l.normal.perp_dot(m.normal);
        let [one, two] = [l, m].map(|line| line.level + line.speed * when.time);
        let at = DVec2::new(one * m.normal.y - two * l.normal.y, two * l.normal.x - one * m.normal.x) / cross;
        let is_exact = |line: &MovingLine| is_sum_exact(line.level, line.speed * when.time);
        if l.is_plain && m.is_plain && when.slack == 0.0 && is_exact(l) && is_exact(m) {
            return LineMeeting { pair, at, slack: 0.0 };
        }
        let off = self.noise[0] + l.slack + m.slack + (l.speed + m.speed) * when.slack;
        let slack = off / (cross.abs() - 32.0 * UNIT).max(0.0);
        LineMeeting { pair, at, slack: if slack.is_nan() { f64::INFINITY } else { slack } }
    }

    /// Computes a position to the full precision of numbers if its error bound exceeds [`FINE`].
    pub(super) fn settle_place(&mut self, place: &mut LineMeeting, when: &mut EventTime) {
        if place.slack > FINE {
            place.at = self.exact_place(place.pair, when).metres();
            place.slack = 2.0 * UNIT * place.at.abs().element_sum() + f64::MIN_POSITIVE;
        }
    }

    /// Returns the point where three lines meet.
    pub(super) fn meeting(&self, [l, m, n]: [usize; 3], when: &EventTime) -> LineMeeting {
        let [a, b, c] = [l, m, n].map(|line| self.lines[line].normal);
        let [one, two, three] = [a.perp_dot(b), b.perp_dot(c), c.perp_dot(a)].map(f64::abs);
        // The pair with the angle closest to a right angle is the most precise.
        let pair = if three >= one.max(two) {
            [n, l]
        } else if two >= one {
            [m, n]
        } else {
            [l, m]
        };
        self.place(pair, when)
    }

    fn exact_place(&mut self, pair: [usize; 2], when: &mut EventTime) -> ExactPlace {
        let time = self.ratio(when);
        self.exactly(&pair);
        let [l, m] = self.exact_lines(pair);
        exact::place(l, m, &self.times[time])
    }

    /// Returns true if two positions at one time are exactly equal.
    pub(super) fn is_one(&mut self, a: &LineMeeting, b: &LineMeeting, when: &mut EventTime) -> bool {
        let apart = (a.at - b.at).abs().max_element();
        let near = a.slack + b.slack;
        if apart > near || near == 0.0 {
            return apart == 0.0;
        }
        // The lines that meet at this time meet in one point.
        let mut lines = a.pair.iter().chain(&b.pair);
        lines.all(|&line| when.is_by(line)) || a.pair == b.pair || {
            let [a, b] = [a, b].map(|place| self.exact_place(place.pair, when));
            a.is(&b)
        }
    }

    /// Compares two positions at one time along a common line, exactly.
    pub(super) fn compare_along(
        &mut self,
        line: usize,
        a: &LineMeeting,
        b: &LineMeeting,
        when: &mut EventTime,
    ) -> Ordering {
        let way = -self.lines[line].normal.perp();
        let slack = a.slack + b.slack;
        let near = if slack == 0.0 && self.lines[line].is_plain { 0.0 } else { 2.0 * slack + self.noise[0] };
        sign(way.dot(a.at) - way.dot(b.at), near).unwrap_or_else(|| {
            if self.is_one(a, b, when) {
                return Ordering::Equal;
            }
            let direction = self.directions[line];
            let [a, b] = [a, b].map(|place| self.exact_place(place.pair, when));
            a.compare_along(&b, direction)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Returns an axis-parallel line on one of few positions, so that many meet at one time.
    fn plain() -> impl Strategy<Value = (Direction, I64Vec2, f64)> {
        let at = prop_oneof![(-4..4i64).prop_map(|at| at << 31), -(1i64 << 54)..1 << 54];
        (0..4usize, at.clone(), at, 0..3u8).prop_map(|(turn, x, y, speed)| {
            let way = [(1, 0), (0, 1), (-1, 0), (0, -1)][turn];
            (Direction(I64Vec2::from(way)), I64Vec2::new(x, y), f64::from(speed.min(1)))
        })
    }

    proptest! {
        #[test]
        fn what_is_told_without_rounding_is_what_fractions_tell(given in prop::array::uniform6(plain())) {
            let mut lines = MovingLines::default();
            lines.begin(2f64.powi(23), 1.0);
            let numbers = given.map(|(direction, through, speed)| lines.add(direction, through, speed, 0.0));
            let mut met = Vec::new();
            for triple in [[0, 1, 2], [3, 4, 5], [0, 2, 4], [1, 3, 5]].map(|of| of.map(|index| numbers[index])) {
                let sums = lines.sums(triple);
                let rate = exact::rate({ lines.exactly(&triple); lines.exact_lines(triple) }).sign();
                if sums.is_exact {
                    prop_assert_eq!(sign(sums.speeds, 0.0), Some(rate));
                }
                if rate != Ordering::Equal {
                    met.push(lines.meeting_time(triple));
                }
            }
            for mut when in met.clone() {
                for mut other in met.clone() {
                    let quick = lines.compare(&mut { when }, &mut { other });
                    let [one, two] = [lines.ratio(&mut when), lines.ratio(&mut other)];
                    prop_assert_eq!(quick, lines.times[one].compare(&lines.times[two]));
                }
                for pair in [[0, 1], [2, 3], [4, 5]].map(|of| of.map(|index| numbers[index])) {
                    if lines.turn(pair[0], pair[1]) != Ordering::Equal {
                        let place = lines.place(pair, &when);
                        let exact = lines.exact_place(pair, &mut when);
                        prop_assert!(place.slack > 0.0 || place.at == exact.metres());
                    }
                }
            }
        }
    }
}
