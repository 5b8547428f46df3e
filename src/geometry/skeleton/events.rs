//! What is going to happen to the wavefront, and when.

use std::cmp::{Ordering, Reverse};

use glam::DVec2;

use super::wavefront::{Kind, NEAR, TOGETHER, Wavefront};

/// How far (m) from its line an edge is no longer where it was expected.
const ASTRAY: f64 = 1e-3;
/// How many edges that a reflex corner may reach are foreseen at once.
const FORESEEN: usize = 8;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum What {
    /// The edge between two corners shrinks to a point.
    Collapse(usize, usize),
    /// A reflex corner reaches the line of an edge.
    Split(usize, usize),
    /// A closing corner goes to the nearer end.
    Close(usize),
    /// An edge that stood still begins to move.
    Start(usize),
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Event {
    pub time: f64,
    pub what: What,
}

impl Event {
    fn rank(&self) -> (u8, usize, usize) {
        match self.what {
            What::Close(corner) => (0, corner, 0),
            What::Collapse(a, b) => (1, a, b),
            What::Split(corner, edge) => (2, corner, edge),
            What::Start(edge) => (3, edge, 0),
        }
    }
}

impl Eq for Event {}

impl Ord for Event {
    fn cmp(&self, other: &Self) -> Ordering {
        self.time.total_cmp(&other.time).then_with(|| self.rank().cmp(&other.rank()))
    }
}

impl PartialOrd for Event {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// What becomes of an event.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Outcome {
    /// It takes place.
    Now,
    /// Another one comes before it.
    Later,
    /// It does not take place any more.
    Void,
}

/// What the wavefront has to do next.
pub(super) enum Next {
    /// To resolve what the noted spots meet at this time.
    Meet(f64),
    /// To let this edge begin to move at this time.
    Start(usize, f64),
    /// Nothing.
    End,
}

impl Wavefront {
    pub(super) fn expect(&mut self, time: f64, what: What) {
        self.events.push(Reverse(Event { time, what }));
    }

    pub(super) fn expect_collapse(&mut self, a: usize, b: usize, now: f64) {
        let (from, to) = (&self.corners[a], &self.corners[b]);
        let along = self.traced.edges[from.edges[1]].along;
        let length = (to.place(now) - from.place(now)).dot(along);
        let shrinks = (from.velocity - to.velocity).dot(along);
        if from.kind != Kind::Closing && to.kind != Kind::Closing && shrinks > 1e-12 {
            let time = now + (length / shrinks).max(0.0);
            self.expect(time, What::Collapse(a, b));
        }
    }

    /// Foresees the first edge whose line a reflex corner reaches after (time, edge) `last`.
    ///
    /// Few of these lines are reached where the edge is, so the next ones are kept for then.
    pub(super) fn expect_split(&mut self, index: usize, last: (f64, usize)) {
        let corner = &self.corners[index];
        if corner.kind != Kind::Reflex {
            return;
        }
        let now = corner.time.max(self.started);
        let at = corner.place(now);
        let mut found: [(f64, usize); FORESEEN] = [(f64::INFINITY, usize::MAX); FORESEEN];
        for (number, edge) in self.traced.edges.iter().enumerate() {
            let nears = edge.speed - edge.inward().dot(corner.velocity);
            if nears <= 1e-12 {
                continue;
            }
            let ahead = edge.ahead(at, now);
            let candidate = (now + (ahead / nears).max(0.0), number);
            if ahead < -NEAR || candidate >= found[FORESEEN - 1] || candidate <= last {
                continue;
            }
            if !corner.edges.contains(&number) {
                let rank = found.partition_point(|known| *known < candidate);
                found[rank..].rotate_right(1);
                found[rank] = candidate;
            }
        }
        let begin = self.foreseen.len();
        self.foreseen.extend(found.into_iter().rev().filter(|candidate| candidate.1 != usize::MAX));
        self.corners[index].foreseen = begin..self.foreseen.len();
        self.expect_next_split(index);
    }

    fn expect_next_split(&mut self, index: usize) {
        if let Some(last) = self.corners[index].foreseen.next_back() {
            let (time, edge) = self.foreseen[last];
            self.expect(time, What::Split(index, edge));
        }
    }

    /// Collects what the next simultaneous events move.
    pub(super) fn gather(&mut self) -> Next {
        self.spots.clear();
        let mut begin: Option<f64> = None;
        let mut later = Vec::new();
        while let Some(&Reverse(event)) = self.events.peek() {
            if begin.is_some_and(|begin| event.time > begin + TOGETHER) {
                break;
            }
            if let What::Start(edge) = event.what {
                if begin.is_some() {
                    break;
                }
                self.events.pop();
                self.events.extend(later.into_iter().map(Reverse));
                return Next::Start(edge, event.time);
            }
            self.events.pop();
            match self.happens(event) {
                Outcome::Void => {}
                Outcome::Later => later.push(event),
                Outcome::Now => begin = begin.or(Some(event.time)),
            }
        }
        self.events.extend(later.into_iter().map(Reverse));
        begin.map_or(Next::End, Next::Meet)
    }

    /// Notes what `event` moves.
    fn happens(&mut self, event: Event) -> Outcome {
        match event.what {
            What::Start(_) => Outcome::Void,
            What::Collapse(a, b) => {
                let (from, to) = (&self.corners[a], &self.corners[b]);
                if !from.alive || !to.alive || from.after != b {
                    return Outcome::Void;
                }
                // The slower one knows the place better.
                let slower =
                    if from.velocity.length_squared() < to.velocity.length_squared() { from } else { to };
                self.meet([a, b], slower.place(event.time))
            }
            What::Close(index) => {
                let corner = &self.corners[index];
                if !corner.alive {
                    return Outcome::Void;
                }
                let ends =
                    [corner.before, corner.after].map(|end| (end, self.corners[end].place(event.time)));
                let [one, two] = ends.map(|(_, place)| place.distance(corner.at));
                let (end, place) = if one < two { ends[0] } else { ends[1] };
                self.meet([index, end], place)
            }
            What::Split(index, edge) => {
                let corner = &self.corners[index];
                let line = &self.traced.edges[edge];
                // An edge that has begun to move is not where it was expected.
                let missed = line.ahead(corner.place(event.time), event.time).abs() > ASTRAY;
                if !corner.alive || missed {
                    return Outcome::Void;
                }
                let outcome = self.hit(index, edge, event.time);
                if outcome == Outcome::Void && self.corners[index].foreseen.is_empty() {
                    self.expect_split(index, (event.time, edge));
                } else if outcome == Outcome::Void {
                    self.expect_next_split(index);
                }
                outcome
            }
        }
    }

    /// Notes that two corners meet.
    fn meet(&mut self, corners: [usize; 2], place: DVec2) -> Outcome {
        if !corners.iter().all(|&corner| self.may_be_at(corner, place)) {
            return Outcome::Later;
        }
        let [a, b] = corners.map(|corner| self.spot(corner, place));
        self.join(a, b);
        Outcome::Now
    }

    /// Notes that a reflex corner reaches a piece of `edge`, if there is one where it does.
    fn hit(&mut self, index: usize, edge: usize, time: f64) -> Outcome {
        let corner = &self.corners[index];
        let (place, peak, fresh) = (corner.place(time), corner.peak, time - corner.time < TOGETHER);
        let along = self.traced.edges[edge].along;
        for number in 0..self.pieces[edge].len() {
            let from = self.pieces[edge][number];
            let a = &self.corners[from];
            if !a.alive {
                continue;
            }
            let b = &self.corners[a.after];
            let born_together = (a.peak == peak || b.peak == peak) && fresh;
            if from == index || a.after == index || born_together {
                continue;
            }
            let [before, behind] = [a, b].map(|end| (place - end.place(time)).dot(along));
            let [near_a, near_b] = [a, b].map(|end| (NEAR + TOGETHER * end.velocity.length()).min(1e-3));
            if before < -near_a || behind > near_b {
                continue;
            }
            let to = a.after;
            let end = if before <= near_a {
                Some(from)
            } else if behind >= -near_b {
                Some(to)
            } else {
                None
            };
            if let Some(end) = end {
                return self.meet([index, end], place);
            }
            if !self.may_be_at(index, place) {
                return Outcome::Later;
            }
            let (own, other) = (self.spot(index, place), self.spot_between(from, place));
            self.join(own, other);
            return Outcome::Now;
        }
        Outcome::Void
    }
}
