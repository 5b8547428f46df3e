//! Wavefront: the polygon's edges move inwards until no area remains.

use std::cmp::Ordering;
use std::ops::Range;

use glam::I64Vec2;

use super::edge::{Direction, SkeletonEdge, metres};
use super::events::{EventQueue, WavefrontEventKind, short};
use super::fronts::{EdgeFront, EdgeFronts};
use super::lines::{EventTime, LineMeeting, MovingLines};
use super::meeting::{EventPoint, MeetingLists};
use super::{Pace, Peak};
use burgeon_base::Stop;
use burgeon_base::error::{Error, Result};

/// A border between the faces of two edges, traced by a corner of the wavefront.
#[derive(Debug, Clone, Copy)]
pub(super) struct Arc {
    /// Edges before and after the corner.
    pub edges: [usize; 2],
    /// Peaks at the start and the end of the corner.
    pub ends: [usize; 2],
}

/// Result of the propagation.
#[derive(Debug, Default)]
pub(super) struct WavefrontTrace {
    pub edges: Vec<SkeletonEdge>,
    pub peaks: Vec<Peak>,
    pub arcs: Vec<Arc>,
}

/// A corner of the wavefront.
#[derive(Debug)]
pub(super) struct WavefrontCorner {
    /// Edges before and after it.
    pub edges: [usize; 2],
    /// Lines of both edges; if they are the same line, `pin` is a line across it through the corner.
    pub lines: [usize; 2],
    pub pin: Option<usize>,
    pub before: usize,
    pub after: usize,
    /// Peak at its start.
    pub peak: usize,
    /// Position and time of its start.
    pub at: LineMeeting,
    pub born: EventTime,
    pub kind: CornerKind,
    pub alive: bool,
    /// Index of its spot, if it has one.
    pub spot: usize,
    /// Stored candidates in [`Wavefront::foreseen`] for lines that the corner may reach after the next
    /// predicted one, the last one first.
    pub foreseen: Range<usize>,
    /// Time up to which no reachable line exists, if none was found.
    pub foreseen_until: f64,
    /// Latest time at which the edge after it has shrunk to a point, as currently predicted.
    pub shrunk: f64,
    /// Previous corner at the start of a segment of the same edge.
    pub older: Option<usize>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum CornerKind {
    Convex,
    /// Reflex or straight corner.
    Reflex,
    /// Corner between two overlapping edges, or between collinear edges at different speeds: it jumps to an
    /// end of one edge.
    Rushing,
}

impl WavefrontCorner {
    /// Returns the two lines that determine the position.
    pub(super) fn pair(&self) -> [usize; 2] {
        [self.lines[0], self.pin.unwrap_or(self.lines[1])]
    }
}

#[derive(Default)]
pub(super) struct Wavefront {
    pub traced: WavefrontTrace,
    pub lines: MovingLines,
    /// Remaining edges.
    pub current: EdgeFronts,
    /// Number of segments of each edge.
    alive: Vec<u32>,
    /// Number of living corners.
    living: usize,
    /// Total number of corners when the remaining edges were last updated.
    known: usize,
    pub corners: Vec<WavefrontCorner>,
    /// Last corner at the start of a segment of each edge; linked corners may be dead.
    pub pieces: Vec<Option<usize>>,
    /// Lines that corners may reach, each with the earliest time.
    pub foreseen: Vec<(f64, usize)>,
    pub events: EventQueue,
    /// Indices of the next simultaneous events.
    pub ties: Vec<u32>,
    /// Indices of later events that were examined with them.
    pub later: Vec<u32>,
    pub spots: Vec<EventPoint>,
    /// Time of the last event, and a lower bound of it.
    pub last: Option<EventTime>,
    pub now: f64,
    /// Set if an edge has just started to move.
    pub restarted: bool,
    /// A point of each edge.
    through: Vec<I64Vec2>,
}

impl Wavefront {
    /// Moves all edges inwards until no area remains.
    pub(super) fn propagate(
        &mut self,
        rings: &[Vec<I64Vec2>],
        paces: &[Pace],
        lists: &mut MeetingLists,
    ) -> Result<()> {
        let stop = Stop::current();
        let check = || stop.as_ref().map_or(Ok(()), |stop| stop.check());
        check()?;
        self.begin(rings, paces, &check)?;
        for step in 0..16 * paces.len() + 64 {
            if step % STOP_STEPS == 0 {
                check()?;
            }
            // Events that are still in the queue never occur.
            if self.living == 0 {
                return Ok(());
            }
            let Some(mut when) = self.gather() else {
                self.move_on()?;
                continue;
            };
            self.resolve(lists, &mut when)?;
        }
        Err(Error::geometry("the wavefront does not end"))
    }

    /// Starts the edges around areas that nothing sweeps, a little later than the last event.
    fn move_on(&mut self) -> Result<()> {
        let last = self.last.map_or(0.0, |last| last.high());
        let rest = ((last * STEPS).floor() + 1.0) / STEPS;
        let mut found = false;
        for index in 0..self.corners.len() {
            let WavefrontCorner { alive, edges: [_, edge], .. } = self.corners[index];
            let Pace { speed, rest: known } = self.traced.edges[edge].pace;
            if alive && (speed <= 0.0 || known == f64::INFINITY) {
                self.traced.edges[edge].pace = Pace { speed: 1.0, rest };
                self.expect(EventTime::at(rest), WavefrontEventKind::Start(short(edge)));
                found = true;
            }
        }
        if found {
            Ok(())
        } else {
            Err(Error::geometry("the wavefront is left with corners that meet nothing"))
        }
    }

    /// Initializes the wavefront at the polygon.
    fn begin(
        &mut self,
        rings: &[Vec<I64Vec2>],
        paces: &[Pace],
        check: &impl Fn() -> Result<()>,
    ) -> Result<()> {
        let count: usize = rings.iter().map(Vec::len).sum();
        let reach = rings.iter().flatten().map(|&at| metres(at).length_squared()).fold(0.0, f64::max).sqrt();
        let finite = |rest: f64| if rest.is_finite() { rest.max(0.0) } else { 0.0 };
        let late = paces.iter().map(|pace| pace.speed * finite(pace.rest)).fold(0.0, f64::max);
        let fastest = paces.iter().map(|pace| pace.speed).fold(0.0, f64::max);
        self.lines.begin(reach + late, fastest);
        self.traced.edges.clear();
        self.traced.peaks.clear();
        self.traced.arcs.clear();
        self.through.clear();
        self.current.clear();
        self.alive.clear();
        self.alive.resize(count, 0);
        self.living = 0;
        self.known = count;
        self.corners.clear();
        self.pieces.clear();
        self.pieces.resize(count, None);
        self.foreseen.clear();
        self.events.clear();
        self.spots.clear();
        self.last = None;
        self.now = 0.0;
        self.restarted = false;
        for (ring, index) in rings.iter().flat_map(|ring| (0..ring.len()).map(move |index| (ring, index))) {
            let (from, to) = (ring[index], ring[(index + 1) % ring.len()]);
            if from == to {
                return Err(Error::geometry("two corners of the outline are in one place"));
            }
            let pace = paces.get(self.through.len()).copied().unwrap_or_default();
            let speed = if pace.rest > 0.0 { 0.0 } else { pace.speed };
            let direction = Direction(to - from);
            let number = self.lines.add(direction, from, speed, 0.0);
            let line = *self.lines.line(number);
            self.current.push(EdgeFront { line, direction, edge: self.through.len() });
            let along = -line.normal.perp();
            self.traced.edges.push(SkeletonEdge { along, level: line.level, pace, line: number });
            self.through.push(from);
        }
        let mut first = 0;
        for ring in rings {
            let size = ring.len();
            for (index, &at) in ring.iter().enumerate() {
                let (before, after) = ((index + size - 1) % size, (index + 1) % size);
                let edges = [first + before, first + index];
                let at = self.start_of(edges, at);
                self.traced.peaks.push(Peak { at: at.at, time: 0.0 });
                let corner = self.corner(edges, first + index, &at, &EventTime::at(0.0));
                if self.corners[corner].kind == CornerKind::Rushing {
                    return Err(Error::geometry(
                        "two edges in one line turn back or move at different speeds",
                    ));
                }
                self.corners[corner].before = first + before;
                self.corners[corner].after = first + after;
            }
            first += size;
        }
        for corner in 0..count {
            self.expect_collapse(corner, self.corners[corner].after);
        }
        for corner in 0..count {
            if corner % STOP_STEPS == 0 {
                check()?;
            }
            self.expect_split(corner, ANY);
            let Pace { speed, rest } = self.traced.edges[corner].pace;
            if speed > 0.0 && rest > 0.0 && rest.is_finite() {
                self.expect(EventTime::at(rest), WavefrontEventKind::Start(short(corner)));
            }
        }
        Ok(())
    }

    /// Returns the position of a corner of the polygon, with a line across it if the corner is straight.
    fn start_of(&mut self, edges: [usize; 2], at: I64Vec2) -> LineMeeting {
        let [before, after] = edges.map(|edge| self.traced.edges[edge].line);
        let mut pair = [before, after];
        if self.lines.turn(before, after) == Ordering::Equal {
            let across = self.lines.direction(after).left().reversed();
            pair[1] = self.lines.add(across, at, 0.0, 0.0);
        }
        LineMeeting { pair, at: metres(at), slack: 0.0 }
    }

    /// Adds a corner between two edges, without its neighbours.
    #[allow(clippy::float_cmp, reason = "equal speeds are given as equal numbers")]
    pub(super) fn corner(
        &mut self,
        edges: [usize; 2],
        peak: usize,
        place: &LineMeeting,
        born: &EventTime,
    ) -> usize {
        let lines = edges.map(|edge| self.traced.edges[edge].line);
        let mut pin = None;
        let kind = match self.lines.turn(lines[0], lines[1]) {
            Ordering::Less => CornerKind::Reflex,
            Ordering::Greater => CornerKind::Convex,
            Ordering::Equal => {
                let agree = self.lines.direction(lines[0]).agrees(self.lines.direction(lines[1]));
                let [one, two] = lines.map(|line| self.lines.line(line).speed);
                if agree && one == two {
                    pin = Some(self.lines.pin(lines[0], place, born));
                    CornerKind::Reflex
                } else {
                    CornerKind::Rushing
                }
            }
        };
        let index = self.corners.len();
        self.corners.push(WavefrontCorner {
            edges,
            lines,
            pin,
            before: index,
            after: index,
            peak,
            at: *place,
            born: *born,
            kind,
            alive: true,
            spot: usize::MAX,
            foreseen: 0..0,
            foreseen_until: f64::INFINITY,
            shrunk: f64::INFINITY,
            older: self.pieces[edges[1]].replace(index),
        });
        self.alive[edges[1]] += 1;
        self.living += 1;
        index
    }

    /// Starts an edge that stood still, with new corners along it.
    ///
    /// The line of a vanished edge does not change: corners that reach it next would lose the following
    /// candidates.
    pub(super) fn start(&mut self, edge: usize, when: &mut EventTime) {
        if self.alive[edge] == 0 {
            return;
        }
        let mut piece = self.pieces[edge];
        while let Some(from) = piece {
            piece = self.corners[from].older;
            if self.corners[from].alive {
                for end in [from, self.corners[from].after] {
                    let place = self.place(end, when);
                    self.spot(end, place);
                }
            }
        }
        let Pace { speed, rest } = self.traced.edges[edge].pace;
        let direction = self.lines.direction(self.traced.edges[edge].line);
        let line = self.lines.add(direction, self.through[edge], speed, rest);
        self.current.turn_to(edge, *self.lines.line(line));
        self.traced.edges[edge].line = line;
        self.restarted = true;
    }

    /// Returns the position of a corner.
    fn place(&mut self, index: usize, when: &mut EventTime) -> LineMeeting {
        let corner = &mut self.corners[index];
        match self.lines.compare(&mut corner.born, when) {
            Ordering::Less => self.lines.place(corner.pair(), when),
            _ => corner.at,
        }
    }

    /// Ends a corner at a peak.
    pub(super) fn end(&mut self, index: usize, peak: usize) {
        let corner = &mut self.corners[index];
        corner.alive = false;
        self.alive[corner.edges[1]] -= 1;
        self.living -= 1;
        if corner.peak != peak {
            self.traced.arcs.push(Arc { edges: corner.edges, ends: [corner.peak, peak] });
        }
    }

    /// Ends rings of two new corners, which enclose no area.
    pub(super) fn close(&mut self, fresh: &[usize], when: &mut EventTime) {
        for &index in fresh {
            let WavefrontCorner { alive, before, after, .. } = self.corners[index];
            if !alive {
                continue;
            }
            if after == index {
                self.end(index, self.corners[index].peak);
            } else if after == before {
                let mut peak = self.corners[after].peak;
                if self.lines.compare(&mut self.corners[after].born, when) == Ordering::Less {
                    peak = self.traced.peaks.len();
                    let mut place = self.place(after, when);
                    self.lines.settle_place(&mut place, when);
                    let at = place.at;
                    self.traced.peaks.push(Peak { at, time: when.time });
                }
                self.end(after, peak);
                self.end(index, peak);
            }
        }
    }

    /// Lets new rushing corners meet the ends of the segments that they jump to.
    pub(super) fn rush(&mut self, fresh: &[usize], when: &mut EventTime) {
        self.spots.clear();
        for &index in fresh {
            let WavefrontCorner { alive, kind, before, after, lines, .. } = self.corners[index];
            if !alive || kind != CornerKind::Rushing {
                continue;
            }
            let [mut low, mut high] = [before, after];
            let [a, b] = lines.map(|line| self.lines.line(line).speed);
            if self.lines.direction(lines[0]).agrees(self.lines.direction(lines[1])) {
                // The faster edge sweeps the area behind the slower edge.
                if a < b {
                    high = low;
                } else {
                    low = high;
                }
            } else {
                let places = [low, high].map(|end| self.place(end, when));
                // Both ends are in the direction of the second edge; the corner meets the nearer end.
                match self.lines.compare_along(lines[1], &places[0], &places[1], when) {
                    Ordering::Less => high = low,
                    Ordering::Greater => low = high,
                    Ordering::Equal => {}
                }
            }
            for end in [low, high] {
                let place = self.place(end, when);
                let [own, other] = [self.spot(index, place), self.spot(end, place)];
                self.join(own, other);
            }
        }
    }

    /// Predicts the events of new corners.
    pub(super) fn go_on(&mut self, fresh: &[usize]) {
        if self.corners.len() > self.known + self.current.len() / 2 {
            self.known = self.corners.len();
            self.current.retain(|edge| self.alive[edge] > 0);
        }
        for &index in fresh {
            let WavefrontCorner { alive, before, after, .. } = self.corners[index];
            if alive {
                self.expect_collapse(before, index);
                // If the next corner is new as well, its own iteration predicts the edge before it.
                if after < fresh[0] {
                    self.expect_collapse(index, after);
                }
            }
        }
        for &index in fresh {
            let WavefrontCorner { alive, before, after, .. } = self.corners[index];
            if alive {
                self.expect_split(index, ANY);
                for beside in [before, after] {
                    self.expect_later_split(beside);
                }
            }
        }
    }

    /// Predicts the events of all old corners again, because edges have started to move.
    pub(super) fn look_again(&mut self) {
        for index in 0..self.corners.len() {
            if self.corners[index].alive {
                self.expect_split(index, ANY);
            }
        }
    }
}

/// Number of steps between two checks for cancellation.
const STOP_STEPS: usize = 256;
/// Time steps per metre for edges that start because nothing else moves.
const STEPS: f64 = 64.0;
/// Lower bound before all events.
pub(super) const ANY: (f64, usize) = (f64::NEG_INFINITY, 0);
