//! The wavefront: the polygon's edges moving inwards until nothing is left of it.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use glam::DVec2;

use super::Peak;
use crate::error::{Error, Result};

/// Events within this time (m at speed 1) are simultaneous.
const TOGETHER: f64 = 1e-6;
/// Places within this distance (m) are one.
const NEAR: f64 = 2e-6;
/// Directions within this angle (radians) are one.
const ALIGNED: f64 = 2e-6;

/// An edge of the polygon and the line that it lies on at any time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    /// Its direction.
    pub along: DVec2,
    /// To the left, where it moves.
    pub inward: DVec2,
    /// Its distance from the origin at the beginning.
    pub level: f64,
    /// How fast it moves.
    pub speed: f64,
}

impl Edge {
    /// The distance of `at` from its line at `time`, positive where it has not been yet.
    pub(super) fn ahead(&self, at: DVec2, time: f64) -> f64 {
        self.inward.dot(at) - self.level - self.speed * time
    }
}

/// A border between the faces of two edges, as a corner of the wavefront has drawn it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Arc {
    /// The edges before and after the corner.
    pub edges: [usize; 2],
    /// The peaks where the corner began and ended.
    pub ends: [usize; 2],
}

/// What the wavefront leaves behind.
#[derive(Debug, Default)]
pub(super) struct Traced {
    pub edges: Vec<Edge>,
    pub peaks: Vec<Peak>,
    pub arcs: Vec<Arc>,
}

/// A corner of the wavefront.
#[derive(Debug, Clone, Copy)]
struct Corner {
    /// The edges before and after it.
    edges: [usize; 2],
    before: usize,
    after: usize,
    /// The peak where it began.
    peak: usize,
    at: DVec2,
    time: f64,
    velocity: DVec2,
    kind: Kind,
    alive: bool,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    Convex,
    Reflex,
    /// Between two edges that face and touch each other: it goes to their end at once.
    Closing,
}

impl Corner {
    fn place(&self, time: f64) -> DVec2 {
        self.at + self.velocity * (time - self.time)
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum What {
    /// The edge between two corners shrinks to a point.
    Collapse(usize, usize),
    /// A reflex corner reaches the line of an edge.
    Split(usize, usize),
    /// A closing corner goes to the nearer end.
    Close(usize),
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Event {
    time: f64,
    what: What,
}

impl Event {
    fn rank(&self) -> (u8, usize, usize) {
        match self.what {
            What::Close(corner) => (0, corner, 0),
            What::Collapse(a, b) => (1, a, b),
            What::Split(corner, edge) => (2, corner, edge),
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

/// A corner, or a point of an edge (by the corner where the piece of the edge begins), that an event moves.
#[derive(Debug, Clone, Copy)]
struct Spot {
    corner: usize,
    cut: bool,
    place: DVec2,
    /// The spot that stands for all at its place.
    leader: usize,
}

/// Where a piece of an edge ends: at a corner that stays, or at what meets in a place.
#[derive(Debug, Clone, Copy, PartialEq)]
enum End {
    Corner(usize),
    Meeting(usize),
}

#[derive(Debug, Clone, Copy)]
struct Piece {
    edge: usize,
    ends: [End; 2],
}

/// An end of a piece, as seen from the place where it meets others.
#[derive(Debug, Clone, Copy)]
struct Ray {
    angle: f64,
    leaves: bool,
    piece: usize,
}

struct Wavefront {
    traced: Traced,
    corners: Vec<Corner>,
    /// For each edge the corners where pieces of it begin; some may be dead.
    pieces: Vec<Vec<usize>>,
    events: BinaryHeap<Reverse<Event>>,
    spots: Vec<Spot>,
}

/// Moves all edges inwards until the polygon is used up.
pub(super) fn propagate(rings: &[Vec<DVec2>], speeds: &[f64]) -> Result<Traced> {
    let mut front = Wavefront::new(rings, speeds)?;
    let most = 16 * speeds.len() + 64;
    for _ in 0..most {
        let Some(time) = front.gather() else {
            return if front.corners.iter().any(|corner| corner.alive) {
                Err(Error::new("the wavefront is left with corners that meet nothing"))
            } else {
                Ok(front.traced)
            };
        };
        front.resolve(time)?;
    }
    Err(Error::new("the wavefront does not end"))
}

impl Wavefront {
    fn new(rings: &[Vec<DVec2>], speeds: &[f64]) -> Result<Self> {
        let mut edges = Vec::with_capacity(speeds.len());
        for ring in rings {
            for (index, &from) in ring.iter().enumerate() {
                let along = (ring[(index + 1) % ring.len()] - from).normalize_or_zero();
                let inward = along.perp();
                let speed = speeds.get(edges.len()).copied().unwrap_or(1.0);
                edges.push(Edge { along, inward, level: inward.dot(from), speed });
            }
        }
        let count = edges.len();
        let mut front = Self {
            traced: Traced {
                edges,
                peaks: Vec::with_capacity(3 * count),
                arcs: Vec::with_capacity(3 * count),
            },
            corners: Vec::with_capacity(3 * count),
            pieces: vec![Vec::new(); count],
            events: BinaryHeap::with_capacity(3 * count),
            spots: Vec::new(),
        };
        let mut first = 0;
        for ring in rings {
            let size = ring.len();
            for (index, &at) in ring.iter().enumerate() {
                let (before, after) = ((index + size - 1) % size, (index + 1) % size);
                front.traced.peaks.push(Peak { at, time: 0.0 });
                let corner = front.corner([first + before, first + index], first + index, at, 0.0)?;
                front.corners[corner].before = first + before;
                front.corners[corner].after = first + after;
            }
            first += size;
        }
        for corner in 0..count {
            front.expect_collapse(corner, front.corners[corner].after, 0.0);
            front.expect_split(corner, (f64::NEG_INFINITY, 0));
        }
        Ok(front)
    }

    /// Adds a corner between two edges; its neighbours are still to be set.
    fn corner(&mut self, edges: [usize; 2], peak: usize, at: DVec2, time: f64) -> Result<usize> {
        let [a, b] = edges.map(|edge| self.traced.edges[edge]);
        let (cross, dot) = (a.along.perp_dot(b.along), a.along.dot(b.along));
        let mut kind = if cross < 0.0 { Kind::Reflex } else { Kind::Convex };
        #[allow(clippy::float_cmp, reason = "equal speeds are given as equal numbers")]
        let velocity = if dot < 0.0 && cross.abs() < ALIGNED {
            kind = Kind::Closing;
            DVec2::ZERO
        } else if a.speed == b.speed {
            (a.inward + b.inward) * (a.speed / (1.0 + dot))
        } else if cross.abs() < ALIGNED {
            return Err(Error::new("two edges in one line move at different speeds"));
        } else {
            (a.inward.perp() * b.speed - b.inward.perp() * a.speed) / cross
        };
        let index = self.corners.len();
        self.corners.push(Corner {
            edges,
            before: index,
            after: index,
            peak,
            at,
            time,
            velocity,
            kind,
            alive: true,
        });
        self.pieces[edges[1]].push(index);
        Ok(index)
    }

    fn expect_collapse(&mut self, a: usize, b: usize, now: f64) {
        let (from, to) = (&self.corners[a], &self.corners[b]);
        let along = self.traced.edges[from.edges[1]].along;
        let length = (to.place(now) - from.place(now)).dot(along);
        let shrinks = (from.velocity - to.velocity).dot(along);
        if from.kind != Kind::Closing && to.kind != Kind::Closing && shrinks > 1e-12 {
            let time = now + (length / shrinks).max(0.0);
            self.events.push(Reverse(Event { time, what: What::Collapse(a, b) }));
        }
    }

    /// The first edge whose line a reflex corner reaches, after the one that it was told to reach at `last`.
    fn expect_split(&mut self, index: usize, last: (f64, usize)) {
        let corner = &self.corners[index];
        if corner.kind != Kind::Reflex {
            return;
        }
        let mut first: Option<(f64, usize)> = None;
        for (number, edge) in self.traced.edges.iter().enumerate() {
            let nears = edge.speed - edge.inward.dot(corner.velocity);
            let ahead = edge.ahead(corner.at, corner.time);
            if nears <= 1e-12 || ahead < -NEAR || corner.edges.contains(&number) {
                continue;
            }
            let candidate = (corner.time + (ahead / nears).max(0.0), number);
            if candidate > last && first.is_none_or(|first| candidate < first) {
                first = Some(candidate);
            }
        }
        if let Some((time, edge)) = first {
            self.events.push(Reverse(Event { time, what: What::Split(index, edge) }));
        }
    }

    /// Collects what the next simultaneous events move; their time, if there are any.
    fn gather(&mut self) -> Option<f64> {
        self.spots.clear();
        let mut begin: Option<f64> = None;
        while let Some(&Reverse(event)) = self.events.peek() {
            if begin.is_some_and(|begin| event.time > begin + TOGETHER) {
                break;
            }
            self.events.pop();
            if self.happens(event) && begin.is_none() {
                begin = Some(event.time);
            }
        }
        begin
    }

    /// Notes what `event` moves; false if it has become void.
    fn happens(&mut self, event: Event) -> bool {
        match event.what {
            What::Collapse(a, b) => {
                let (from, to) = (&self.corners[a], &self.corners[b]);
                if !from.alive || !to.alive || from.after != b {
                    return false;
                }
                // The slower one knows the place better.
                let slower =
                    if from.velocity.length_squared() < to.velocity.length_squared() { from } else { to };
                let place = slower.place(event.time);
                let (a, b) = (self.spot(a, false, place), self.spot(b, false, place));
                self.join(a, b);
                true
            }
            What::Close(index) => {
                let corner = &self.corners[index];
                if !corner.alive {
                    return false;
                }
                let ends =
                    [corner.before, corner.after].map(|end| (end, self.corners[end].place(event.time)));
                let [one, two] = ends.map(|(_, place)| place.distance(corner.at));
                let (end, place) = if one < two { ends[0] } else { ends[1] };
                let (a, b) = (self.spot(index, false, place), self.spot(end, false, place));
                self.join(a, b);
                true
            }
            What::Split(index, edge) => {
                if !self.corners[index].alive {
                    return false;
                }
                let hit = self.hit(index, edge, event.time);
                if !hit {
                    self.expect_split(index, (event.time, edge));
                }
                hit
            }
        }
    }

    /// Notes that a reflex corner reaches a piece of `edge`; false if there is no piece where it does.
    fn hit(&mut self, index: usize, edge: usize, time: f64) -> bool {
        let corner = self.corners[index];
        let (place, along) = (corner.place(time), self.traced.edges[edge].along);
        for number in 0..self.pieces[edge].len() {
            let from = self.pieces[edge][number];
            let a = &self.corners[from];
            if !a.alive {
                continue;
            }
            let b = &self.corners[a.after];
            let born_together =
                (a.peak == corner.peak || b.peak == corner.peak) && time - corner.time < TOGETHER;
            if from == index || a.after == index || born_together {
                continue;
            }
            let [before, behind] = [a, b].map(|end| (place - end.place(time)).dot(along));
            let [near_a, near_b] = [a, b].map(|end| (NEAR + TOGETHER * end.velocity.length()).min(1e-3));
            if before < -near_a || behind > near_b {
                continue;
            }
            let to = a.after;
            let other = if before <= near_a {
                self.spot(from, false, place)
            } else if behind >= -near_b {
                self.spot(to, false, place)
            } else {
                self.spots.push(Spot { corner: from, cut: true, place, leader: self.spots.len() });
                self.spots.len() - 1
            };
            let own = self.spot(index, false, place);
            self.join(own, other);
            return true;
        }
        false
    }

    /// The spot of a corner.
    fn spot(&mut self, corner: usize, cut: bool, place: DVec2) -> usize {
        if let Some(known) = self.spots.iter().position(|spot| spot.corner == corner && spot.cut == cut) {
            return known;
        }
        self.spots.push(Spot { corner, cut, place, leader: self.spots.len() });
        self.spots.len() - 1
    }

    fn leader(&self, mut spot: usize) -> usize {
        while self.spots[spot].leader != spot {
            spot = self.spots[spot].leader;
        }
        spot
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.leader(a), self.leader(b));
        self.spots[a.max(b)].leader = a.min(b);
    }

    /// Makes the new wavefront of what the spots' corners and edges meet.
    fn resolve(&mut self, time: f64) -> Result<()> {
        let mut order: Vec<usize> = (0..self.spots.len()).collect();
        order.sort_by(|&a, &b| self.spots[a].place.x.total_cmp(&self.spots[b].place.x));
        for (rank, &a) in order.iter().enumerate() {
            for &b in &order[rank + 1..] {
                if self.spots[b].place.x - self.spots[a].place.x > NEAR {
                    break;
                }
                if self.spots[a].place.distance(self.spots[b].place) <= NEAR {
                    self.join(a, b);
                }
            }
        }
        let (mut pieces, meetings) = self.cut(time);
        self.retire(time, &meetings);
        let mut rays: Vec<Vec<Ray>> = vec![Vec::new(); meetings.len()];
        for (index, piece) in pieces.iter().enumerate() {
            let along = self.traced.edges[piece.edge].along;
            for (end, direction) in piece.ends.into_iter().zip([along, -along]) {
                if let End::Meeting(meeting) = end {
                    let leaves = direction == along;
                    rays[meeting].push(Ray { angle: direction.to_angle(), leaves, piece: index });
                }
            }
        }
        let mut fresh = Vec::new();
        for (rays, &(_, peak)) in rays.iter_mut().zip(&meetings) {
            pair(rays)?;
            for (number, ray) in rays.iter().enumerate().filter(|(_, ray)| ray.leaves) {
                let arriving = rays[(number + 1) % rays.len()].piece;
                let edges = [pieces[arriving].edge, pieces[ray.piece].edge];
                let corner = self.corner(edges, peak, self.traced.peaks[peak].at, time)?;
                pieces[arriving].ends[1] = End::Corner(corner);
                pieces[ray.piece].ends[0] = End::Corner(corner);
                fresh.push(corner);
            }
        }
        for piece in &pieces {
            if let [End::Corner(a), End::Corner(b)] = piece.ends {
                self.corners[a].after = b;
                self.corners[b].before = a;
            }
        }
        self.go_on(&fresh, time);
        Ok(())
    }

    /// The pieces of edges that the spots touch, cut there, and the meetings: each a leader with its new peak.
    fn cut(&mut self, time: f64) -> (Vec<Piece>, Vec<(usize, usize)>) {
        let mut meetings: Vec<(usize, usize)> = Vec::new();
        let mut meeting_of = vec![0; self.spots.len()];
        for index in 0..self.spots.len() {
            let leader = self.leader(index);
            if leader == index {
                meeting_of[index] = meetings.len();
                meetings.push((index, self.traced.peaks.len()));
                self.traced.peaks.push(Peak { at: self.spots[index].place, time });
            } else {
                meeting_of[index] = meeting_of[leader];
            }
        }
        // Where pieces begin, and the meetings on them by their distance along.
        let mut begins: Vec<usize> = Vec::new();
        let mut whole: Vec<(usize, usize)> = Vec::new();
        let mut cuts: Vec<(usize, f64, usize)> = Vec::new();
        for (index, spot) in self.spots.iter().enumerate() {
            begins.push(spot.corner);
            if spot.cut {
                let along = self.traced.edges[self.corners[spot.corner].edges[1]].along;
                cuts.push((spot.corner, spot.place.dot(along), meeting_of[index]));
            } else {
                begins.push(self.corners[spot.corner].before);
                whole.push((spot.corner, meeting_of[index]));
            }
        }
        begins.sort_unstable();
        begins.dedup();
        whole.sort_unstable();
        cuts.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let end = |corner: usize| match whole.binary_search_by_key(&corner, |entry| entry.0) {
            Ok(found) => End::Meeting(whole[found].1),
            Err(_) => End::Corner(corner),
        };
        let mut pieces = Vec::with_capacity(begins.len() + cuts.len());
        for &from in &begins {
            let corner = &self.corners[from];
            let mut last = end(from);
            let between = cuts.partition_point(|cut| cut.0 < from)..cuts.partition_point(|cut| cut.0 <= from);
            let between = cuts[between].iter().map(|cut| End::Meeting(cut.2));
            for next in between.chain([end(corner.after)]) {
                if next != last || matches!(next, End::Corner(_)) {
                    pieces.push(Piece { edge: corner.edges[1], ends: [last, next] });
                }
                last = next;
            }
        }
        (pieces, meetings)
    }

    /// Ends the corners that have met.
    fn retire(&mut self, _time: f64, meetings: &[(usize, usize)]) {
        for index in 0..self.spots.len() {
            let spot = self.spots[index];
            if spot.cut {
                continue;
            }
            let leader = self.leader(index);
            let peak = meetings.iter().find(|meeting| meeting.0 == leader).map_or(0, |meeting| meeting.1);
            self.end(spot.corner, peak);
        }
    }

    fn end(&mut self, index: usize, peak: usize) {
        let corner = &mut self.corners[index];
        corner.alive = false;
        if corner.peak != peak {
            self.traced.arcs.push(Arc { edges: corner.edges, ends: [corner.peak, peak] });
        }
    }

    /// Foresees what happens to new corners; closes pairs of edges that lie on each other.
    fn go_on(&mut self, fresh: &[usize], time: f64) {
        for &index in fresh {
            let corner = self.corners[index];
            if !corner.alive {
                continue;
            }
            if corner.after == index {
                self.corners[index].alive = false;
                continue;
            }
            if corner.after == corner.before {
                let other = self.corners[corner.after];
                let mut peak = other.peak;
                if time - other.time > 0.0 {
                    peak = self.traced.peaks.len();
                    self.traced.peaks.push(Peak { at: other.place(time), time });
                }
                self.end(corner.after, peak);
                self.end(index, peak);
            }
        }
        for &index in fresh {
            let corner = self.corners[index];
            if !corner.alive {
                continue;
            }
            if corner.kind == Kind::Closing {
                self.events.push(Reverse(Event { time, what: What::Close(index) }));
                continue;
            }
            self.expect_collapse(corner.before, index, time);
            self.expect_collapse(index, corner.after, time);
            self.expect_split(index, (f64::NEG_INFINITY, 0));
        }
    }
}

/// Sorts the rays around a place so that each that leaves is followed by the one that arrives across the area
/// between them, counter-clockwise.
fn pair(rays: &mut [Ray]) -> Result<()> {
    rays.sort_by(|a, b| a.angle.total_cmp(&b.angle));
    let count = rays.len();
    for index in 0..count {
        let [before, next, behind] = [index, (index + 1) % count, (index + 2) % count];
        // Two edges that lie on each other have no area between them: the one that leaves comes first.
        let turn = (rays[behind].angle - rays[next].angle).rem_euclid(std::f64::consts::TAU);
        if !rays[before].leaves && !rays[next].leaves && rays[behind].leaves && turn < ALIGNED {
            rays.swap(next, behind);
        }
    }
    let alternate = (0..count).all(|index| rays[index].leaves != rays[(index + 1) % count].leaves);
    if alternate { Ok(()) } else { Err(Error::new("the edges that meet in a place do not enclose areas")) }
}
