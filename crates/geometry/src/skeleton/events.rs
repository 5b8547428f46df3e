//! Prediction of the wavefront's events and their times.

use std::cmp::Ordering;

use super::edge::{Direction, short};
use super::fronts::{CornerCourse, EdgeFront};
use super::lines::EventTime;
use super::queue::{WavefrontEvent, WavefrontEventKind};
use super::wavefront::{ANY, CornerKind, Wavefront};

/// Error (m) above which times are computed exactly before they are compared.
const COARSE: f64 = 1e-6;
/// Number of edges that are predicted at once for a reflex corner.
const FORESEEN: usize = 8;

impl Wavefront {
    /// Predicts the time when the edge between two neighbours shrinks to a point.
    pub(super) fn expect_collapse(&mut self, a: usize, b: usize) {
        self.corners[a].shrunk = f64::INFINITY;
        let (from, to) = (&self.corners[a], &self.corners[b]);
        if from.kind == CornerKind::Rushing || to.kind == CornerKind::Rushing {
            return;
        }
        let lines = [from.pin.unwrap_or(from.lines[0]), from.lines[1], to.pin.unwrap_or(to.lines[1])];
        // A line across a straight corner turns off the edge to the right.
        let out = from.pin.is_none() && from.kind == CornerKind::Reflex;
        let off = to.kind == CornerKind::Reflex;
        if let Some(when) = self.lines.nearing(lines, out != off) {
            self.expect(when, WavefrontEventKind::Collapse(short(a), short(b)));
            if self.last.is_none_or(|last| last.high() < when.low()) {
                self.corners[a].shrunk = when.high();
            }
        }
    }

    /// Returns the latest known time at which one of the corner's two edges has shrunk to a point, which ends
    /// the corner.
    fn collapse_time(&self, index: usize) -> f64 {
        let corner = &self.corners[index];
        corner.shrunk.min(self.corners[corner.before].shrunk)
    }

    /// Predicts further events of a corner that lasts longer than assumed when none were found.
    pub(super) fn expect_later_split(&mut self, index: usize) {
        if self.corners[index].alive && self.collapse_time(index) > self.corners[index].foreseen_until {
            self.expect_split(index, ANY);
        }
    }

    /// Predicts the first edge whose line a reflex corner reaches after (time, edge) `last` and before the
    /// corner ends.
    ///
    /// A line is seldom reached within its edge, so the following candidates are stored.
    #[allow(clippy::float_cmp, reason = "equal speeds are given as equal numbers")]
    pub(super) fn expect_split(&mut self, index: usize, last: (f64, usize)) {
        let corner = &self.corners[index];
        if corner.kind != CornerKind::Reflex {
            return;
        }
        let [a, b] = corner.pair();
        let pair = if self.lines.turn(a, b) == Ordering::Less { [b, a] } else { [a, b] };
        let [l, m] = pair.map(|line| *self.lines.line(line));
        let own = pair.map(|line| (self.lines.direction(line), self.lines.line(line).speed));
        let noise = self.lines.noise();
        let course = CornerCourse {
            cross: l.normal.perp_dot(m.normal),
            levels: l.normal * m.level - m.normal * l.level,
            speeds: l.normal * m.speed - m.normal * l.speed,
            slack: noise[0] + l.slack + m.slack,
            noise,
            now: self.now,
            sorts: corner.edges.map(|edge| self.current.sort(edge)),
        };
        let shortly = course.short();
        let over = self.collapse_time(index);
        let mut found: [(f64, usize); FORESEEN] = [(over, usize::MAX); FORESEEN];
        let mut count = 0;
        for block in self.current.blocks_around(corner.edges[1]) {
            let mut within = self.current.within_reach(block, &shortly, found[FORESEEN - 1].0);
            while within > 0 {
                let lane = within.trailing_zeros();
                within &= within - 1;
                let Some(&EdgeFront { line: edge, direction, edge: number }) =
                    self.current.get(block, lane as usize)
                else {
                    break;
                };
                let [rate, sum] = course.sums(&edge);
                let slack = course.slack + edge.slack;
                let low = if rate > 2.0 * noise[1] {
                    let time = -sum / rate;
                    let slack = (slack + time.abs() * noise[1]) / (rate - noise[1]) * (1.0 + 1e-9);
                    if time + slack < self.now {
                        continue;
                    }
                    time - slack
                } else {
                    let is_alike = |&(own, speed): &(Direction, f64)| {
                        speed == edge.speed && (own == direction || own.runs_as(direction))
                    };
                    if own.iter().any(is_alike) || corner.edges.contains(&number) {
                        continue;
                    }
                    let line = self.traced.edges[number].line;
                    let Some(mut when) = self.lines.nearing([pair[0], pair[1], line], false) else {
                        continue;
                    };
                    self.lines.refine(&mut when);
                    if when.high() < self.now {
                        continue;
                    }
                    when.low()
                };
                let candidate = (low, number);
                if candidate < found[FORESEEN - 1] && candidate > last && !corner.edges.contains(&number) {
                    let mut rank = count.min(FORESEEN - 1);
                    count = rank + 1;
                    while rank > 0 && candidate < found[rank - 1] {
                        found[rank] = found[rank - 1];
                        rank -= 1;
                    }
                    found[rank] = candidate;
                }
            }
        }
        let begin = self.foreseen.len();
        self.foreseen.extend(found[..count].iter().rev());
        self.corners[index].foreseen = begin..self.foreseen.len();
        self.corners[index].foreseen_until = if begin == self.foreseen.len() { over } else { f64::INFINITY };
        self.expect_next_split(index);
    }

    fn expect_next_split(&mut self, index: usize) {
        let corner = &mut self.corners[index];
        if let Some(last) = corner.foreseen.next_back() {
            let (low, edge) = self.foreseen[last];
            let [a, b] = corner.pair();
            let when = self.lines.meeting_time([a, b, self.traced.edges[edge].line]);
            let what = WavefrontEventKind::Split(short(index), short(edge));
            self.events.push(WavefrontEvent { low, when, what, leads: true });
        }
    }

    /// Collects the next events and returns their time.
    ///
    /// All events at exactly the same time are collected together.
    pub(super) fn gather(&mut self) -> Option<EventTime> {
        let (mut ties, mut later) = (std::mem::take(&mut self.ties), std::mem::take(&mut self.later));
        let next = loop {
            ties.clear();
            while let Some(number) = self.events.first() {
                let mut event = self.events.events[number as usize];
                let first = ties.first().map(|&first| self.events.events[first as usize].when);
                if first.is_some_and(|first| event.low > first.high()) {
                    break;
                }
                self.events.order.pop();
                if !self.stands(&event) {
                    continue;
                }
                if let (WavefrontEventKind::Split(corner, edge), true) = (event.what, event.leads) {
                    event.leads = false;
                    let (corner, edge) = (corner as usize, edge as usize);
                    if self.corners[corner].foreseen.is_empty() {
                        self.expect_split(corner, (event.low, edge));
                    } else {
                        self.expect_next_split(corner);
                    }
                }
                if self.lines.settle(&mut event.when, COARSE) || event.low < event.when.low() {
                    event.low = event.when.low();
                    self.events.events[number as usize] = event;
                    self.events.put_back(number);
                    continue;
                }
                let mut order = Ordering::Less;
                if let Some(mut first) = first {
                    order = self.lines.compare(&mut event.when, &mut first);
                    self.events.events[ties[0] as usize].when = first;
                }
                self.events.events[number as usize] = event;
                match order {
                    Ordering::Less => {
                        later.append(&mut ties);
                        ties.push(number);
                    }
                    Ordering::Equal => ties.push(number),
                    Ordering::Greater => later.push(number),
                }
            }
            later.drain(..).for_each(|number| self.events.put_back(number));
            let event = |number: u32| &self.events.events[number as usize];
            ties.sort_unstable_by(|&a, &b| event(a).compare(event(b)));
            let Some(&first) = ties.first() else { break None };
            let mut when = event(first).when;
            self.spots.clear();
            // Events that were predicted twice have already occurred.
            if self.last.as_mut().is_some_and(|last| self.lines.compare(&mut when, last) != Ordering::Greater)
            {
                continue;
            }
            for &number in &ties {
                self.note(self.events.events[number as usize].what, &mut when);
            }
            if !self.spots.is_empty() {
                break Some(when);
            }
        };
        (self.ties, self.later) = (ties, later);
        next
    }

    /// Returns true if an event may still occur.
    fn stands(&self, event: &WavefrontEvent) -> bool {
        match event.what {
            WavefrontEventKind::Start(_) => true,
            WavefrontEventKind::Collapse(a, b) => {
                let from = &self.corners[a as usize];
                from.alive && self.corners[b as usize].alive && from.after == b as usize
            }
            WavefrontEventKind::Split(corner, edge) => {
                let line = self.traced.edges[edge as usize].line;
                self.corners[corner as usize].alive && event.when.is_by(line)
            }
        }
    }

    /// Records the points that meet in an event.
    fn note(&mut self, what: WavefrontEventKind, when: &mut EventTime) {
        match what {
            WavefrontEventKind::Start(edge) => self.start(edge as usize, when),
            WavefrontEventKind::Collapse(a, b) => {
                let [a, b] = [a as usize, b as usize];
                let (from, to) = (&self.corners[a], &self.corners[b]);
                let [one, two] = [from.pair(), to.pair()];
                let third = if two.contains(&one[0]) { one[1] } else { one[0] };
                let place = self.lines.meeting([two[0], two[1], third], when);
                let [a, b] = [a, b].map(|corner| self.spot(corner, place));
                self.join(a, b);
            }
            WavefrontEventKind::Split(corner, edge) => self.hit(corner as usize, edge as usize, when),
        }
    }

    /// Records that a reflex corner reaches a segment of `edge`, if the edge exists at that position.
    fn hit(&mut self, index: usize, edge: usize, when: &mut EventTime) {
        let corner = &mut self.corners[index];
        // Meetings at the start of the corner have already been resolved.
        if self.lines.compare(&mut corner.born, when) != Ordering::Less {
            return;
        }
        let ([a, b], before, after) = (corner.pair(), corner.before, corner.after);
        let line = self.traced.edges[edge].line;
        let place = self.lines.meeting([a, b, line], when);
        let mut piece = self.pieces[edge];
        while let Some(from) = piece {
            piece = self.corners[from].older;
            let to = self.corners[from].after;
            // A corner reaches its neighbours' other edges only if its own edges have collapsed.
            if !self.corners[from].alive || from == after || to == before {
                continue;
            }
            let low = self.lines.place(self.corners[from].pair(), when);
            let behind_low = self.lines.compare_along(line, &low, &place, when);
            if behind_low == Ordering::Greater {
                continue;
            }
            let high = self.lines.place(self.corners[to].pair(), when);
            let before_high = self.lines.compare_along(line, &place, &high, when);
            if before_high == Ordering::Greater {
                continue;
            }
            let own = self.spot(index, place);
            let other = if behind_low == Ordering::Equal {
                self.spot(from, place)
            } else if before_high == Ordering::Equal {
                self.spot(to, place)
            } else {
                self.spot_between(from, place)
            };
            self.join(own, other);
        }
    }
}
