//! When lines that move meet, and where: quickly with a bound on the error, and exactly where that does not tell.

use std::cmp::Ordering;

use glam::{DVec2, I64Vec2};

use super::edge::{Direction, metres};
use super::exact::{self, ExactLine, ExactPlace, Ratio};

/// What rounding adds to a number, as a part of it.
const UNIT: f64 = f64::EPSILON / 2.0;
/// How far (m) times and places may be off in what goes out.
pub(super) const FINE: f64 = 1e-7;

/// A line: the points whose product with `normal` is `level` + `speed` * time.
#[derive(Debug, Clone, Copy)]
pub(super) struct MovingLine {
    pub normal: DVec2,
    pub level: f64,
    pub speed: f64,
    /// How far (m) `level` may be off.
    pub slack: f64,
}

/// What a line is, exactly.
#[derive(Debug, Clone)]
enum LineOrigin {
    /// It goes through a point and moves once it has rested (m).
    Edge { through: I64Vec2, rest: f64 },
    /// It goes through the place where two lines are at a time, across the direction of an edge, and never moves.
    Pin { pair: [usize; 2], when: EventTime },
}

/// A time.
#[derive(Debug, Clone, Copy)]
pub(super) struct EventTime {
    pub time: f64,
    /// How far (m) `time` may be off.
    pub slack: f64,
    /// The three lines that go through one point then, in their order; none if the time is given.
    by: [u32; 3],
    /// The number of the exact time, if it is known.
    exact: u32,
}

/// No line, or no number of an exact line or time.
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

    /// Whether a line is one of those that meet then.
    #[allow(clippy::cast_possible_truncation, reason = "there are fewer lines")]
    pub(super) fn is_by(&self, line: usize) -> bool {
        self.by.contains(&(line as u32))
    }
}

/// Where two lines are at a certain time.
#[derive(Debug, Clone, Copy)]
pub(super) struct LineMeeting {
    pub pair: [usize; 2],
    pub at: DVec2,
    /// How far (m) `at` may be off.
    pub slack: f64,
}

/// All lines of a wavefront.
#[derive(Debug, Default)]
pub(super) struct MovingLines {
    lines: Vec<MovingLine>,
    directions: Vec<Direction>,
    origins: Vec<LineOrigin>,
    /// The number of what each is exactly, if it is known.
    numbers: Vec<u32>,
    exact: Vec<ExactLine>,
    times: Vec<Ratio>,
    /// What the rounding of products with levels may add up to (m), and that of products with speeds.
    noise: [f64; 2],
}

/// Whether the sign of a number that may be off by `slack` is known.
fn sign(number: f64, slack: f64) -> Option<Ordering> {
    if number > slack {
        Some(Ordering::Greater)
    } else if number < -slack {
        Some(Ordering::Less)
    } else {
        None
    }
}

impl MovingLines {
    /// Forgets all lines; those to come are within `reach` (m) of the origin, and none is faster than `speed`.
    pub(super) fn begin(&mut self, reach: f64, speed: f64) {
        self.lines.clear();
        self.directions.clear();
        self.origins.clear();
        self.numbers.clear();
        self.exact.clear();
        self.times.clear();
        // Normals are off by 8 units, levels by 16 of them; a product of three normals and levels has 9 terms.
        self.noise = [128.0 * UNIT * reach, 96.0 * UNIT * speed.max(1.0)];
    }

    /// Adds the line in `direction` through a point of the lattice, which moves from `rest` on.
    pub(super) fn add(&mut self, direction: Direction, through: I64Vec2, speed: f64, rest: f64) -> usize {
        let normal = direction.left().0.as_dvec2().normalize_or_zero();
        let late = if speed > 0.0 { speed * rest } else { 0.0 };
        let level = normal.dot(metres(through)) - late;
        let slack = if late > 0.0 { 4.0 * UNIT * late } else { 0.0 };
        self.push(MovingLine { normal, level, speed, slack }, direction, LineOrigin::Edge { through, rest })
    }

    /// Adds the line across another one through a place on it.
    pub(super) fn pin(&mut self, line: usize, place: &LineMeeting, when: &EventTime) -> usize {
        let direction = self.directions[line];
        let normal = direction.0.as_dvec2().normalize_or_zero();
        let level = normal.dot(place.at);
        let pinned = MovingLine { normal, level, speed: 0.0, slack: 2.0 * place.slack };
        // To its left is where the other line came from.
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

    /// What may be added up by rounding: of levels (m) and of speeds.
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

    /// What lines are, for which that has been asked.
    fn known<const N: usize>(&self, lines: [usize; N]) -> [&ExactLine; N] {
        lines.map(|line| &self.exact[self.numbers[line] as usize])
    }

    /// Whether two lines that cross do so to the left or to the right; equal if they are parallel.
    pub(super) fn turn(&self, line: usize, other: usize) -> Ordering {
        let cross = self.lines[line].normal.perp_dot(self.lines[other].normal);
        sign(cross, 32.0 * UNIT).unwrap_or_else(|| self.directions[line].turn(self.directions[other]))
    }

    /// The sum of the levels and the sum of the speeds of three lines, each times the cross product of the others.
    fn sums(&self, [l, m, n]: [usize; 3]) -> [f64; 2] {
        let [l, m, n] = [l, m, n].map(|line| &self.lines[line]);
        let crosses = [m.normal.perp_dot(n.normal), n.normal.perp_dot(l.normal), l.normal.perp_dot(m.normal)];
        [
            l.level * crosses[0] + m.level * crosses[1] + n.level * crosses[2],
            l.speed * crosses[0] + m.speed * crosses[1] + n.speed * crosses[2],
        ]
    }

    /// Whether two lines are parallel and move the same way at the same speed.
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
        // Two lines that move alike cross the third one alike.
        if self.are_alike(l, m) || self.are_alike(m, n) || self.are_alike(n, l) {
            return Ordering::Equal;
        }
        self.exactly(&lines);
        exact::rate(self.known(lines)).sign()
    }

    /// When three lines that near each other meet; none if they do not, at least where two of them turn so that they
    /// near each other backwards.
    pub(super) fn nearing(&mut self, lines: [usize; 3], backwards: bool) -> Option<EventTime> {
        let sums = self.sums(lines);
        let rate = sign(sums[1], self.noise[1]).unwrap_or_else(|| self.exact_rate(lines));
        let wanted = if backwards { Ordering::Less } else { Ordering::Greater };
        (rate == wanted).then(|| self.when_of(lines, sums))
    }

    /// When three lines go through one point. They do so at one time only.
    pub(super) fn when(&self, lines: [usize; 3]) -> EventTime {
        self.when_of(lines, self.sums(lines))
    }

    fn when_of(&self, lines: [usize; 3], [levels, speeds]: [f64; 2]) -> EventTime {
        #[allow(clippy::cast_possible_truncation, reason = "there are fewer lines")]
        let mut by = lines.map(|line| line as u32);
        for [a, b] in [[0, 1], [1, 2], [0, 1]] {
            if by[a] > by[b] {
                by.swap(a, b);
            }
        }
        let mut when = EventTime { time: -levels / speeds, slack: f64::INFINITY, by, exact: NONE };
        let rest = speeds.abs() - self.noise[1];
        if rest > 0.0 {
            let levels = self.noise[0] + lines.iter().map(|&line| self.lines[line].slack).sum::<f64>();
            when.slack = (levels + when.time.abs() * self.noise[1]) / rest + 4.0 * UNIT * when.time.abs();
        }
        if when.slack.is_nan() {
            when.slack = f64::INFINITY;
        }
        when
    }

    /// Refines a time that may be off by more than `slack` (m); whether it was one.
    pub(super) fn settle(&mut self, when: &mut EventTime, slack: f64) -> bool {
        let coarse = when.slack > slack && when.exact == NONE;
        if coarse {
            self.refine(when);
        }
        coarse
    }

    /// Makes a time as exact as a number can be.
    pub(super) fn refine(&mut self, when: &mut EventTime) {
        let number = self.ratio(when);
        when.time = self.times[number].metres();
        when.slack = 2.0 * UNIT * when.time.abs() + f64::MIN_POSITIVE;
    }

    /// The number of the exact time.
    fn ratio(&mut self, when: &mut EventTime) -> usize {
        if when.exact != NONE {
            return when.exact as usize;
        }
        let ratio = if when.by[0] == NONE {
            Ratio::of(when.time)
        } else {
            let lines = when.by.map(|line| line as usize);
            self.exactly(&lines);
            exact::time(self.known(lines)).unwrap_or_else(|| Ratio::of(f64::from(f32::MAX)))
        };
        self.times.push(ratio);
        when.exact = u32::try_from(self.times.len() - 1).unwrap_or(NONE);
        self.times.len() - 1
    }

    /// The order of two times. Exact.
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

    /// Where two lines cross at a time. Not for parallel ones.
    pub(super) fn place(&self, pair: [usize; 2], when: &EventTime) -> LineMeeting {
        let [l, m] = pair.map(|line| &self.lines[line]);
        let cross = l.normal.perp_dot(m.normal);
        let [one, two] = [l, m].map(|line| line.level + line.speed * when.time);
        let at = DVec2::new(one * m.normal.y - two * l.normal.y, two * l.normal.x - one * m.normal.x) / cross;
        let off = self.noise[0] + l.slack + m.slack + (l.speed + m.speed) * when.slack;
        let slack = off / (cross.abs() - 32.0 * UNIT).max(0.0);
        LineMeeting { pair, at, slack: if slack.is_nan() { f64::INFINITY } else { slack } }
    }

    /// Makes a place as exact as numbers can be, if it may be far off.
    pub(super) fn settle_place(&mut self, place: &mut LineMeeting, when: &mut EventTime) {
        if place.slack > FINE {
            place.at = self.exact_place(place.pair, when).metres();
            place.slack = 2.0 * UNIT * place.at.abs().element_sum() + f64::MIN_POSITIVE;
        }
    }

    /// Where three lines meet.
    pub(super) fn meeting(&self, [l, m, n]: [usize; 3], when: &EventTime) -> LineMeeting {
        let cross = |[a, b]: [usize; 2]| self.lines[a].normal.perp_dot(self.lines[b].normal).abs();
        let pairs = [[l, m], [m, n], [n, l]];
        let widest = pairs.into_iter().max_by(|&a, &b| cross(a).total_cmp(&cross(b)));
        self.place(widest.unwrap_or([l, m]), when)
    }

    fn exact_place(&mut self, pair: [usize; 2], when: &mut EventTime) -> ExactPlace {
        let time = self.ratio(when);
        self.exactly(&pair);
        let [l, m] = self.known(pair);
        exact::place(l, m, &self.times[time])
    }

    /// Whether two places at one time are one. Exact.
    pub(super) fn is_one(&mut self, a: &LineMeeting, b: &LineMeeting, when: &mut EventTime) -> bool {
        let apart = (a.at - b.at).abs().max_element();
        if apart > a.slack + b.slack {
            return false;
        }
        // The lines that meet at this time do so in one place.
        let mut lines = a.pair.iter().chain(&b.pair);
        lines.all(|&line| when.is_by(line)) || a.pair == b.pair || {
            let [a, b] = [a, b].map(|place| self.exact_place(place.pair, when));
            a.is(&b)
        }
    }

    /// The order of two places at one time along a line that both are on. Exact.
    pub(super) fn compare_along(
        &mut self,
        line: usize,
        a: &LineMeeting,
        b: &LineMeeting,
        when: &mut EventTime,
    ) -> Ordering {
        let way = -self.lines[line].normal.perp();
        let near = 2.0 * (a.slack + b.slack) + self.noise[0];
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
