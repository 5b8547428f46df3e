//! The wavefront: the polygon's edges moving inwards until nothing is left of it.

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
pub(super) struct WavefrontTrace {
    pub edges: Vec<SkeletonEdge>,
    pub peaks: Vec<Peak>,
    pub arcs: Vec<Arc>,
}

/// A corner of the wavefront.
#[derive(Debug)]
pub(super) struct WavefrontCorner {
    /// The edges before and after it.
    pub edges: [usize; 2],
    /// The lines of both; where these are one line, a line across it through the corner.
    pub lines: [usize; 2],
    pub pin: Option<usize>,
    pub before: usize,
    pub after: usize,
    /// The peak where it began.
    pub peak: usize,
    /// Where and when it began.
    pub at: LineMeeting,
    pub born: EventTime,
    pub kind: CornerKind,
    pub alive: bool,
    /// The number of its spot, if it has one.
    pub spot: usize,
    /// Where the lines that it may reach after the one that it is expected to reach next are among those that have been
    /// foreseen, the last one first.
    pub foreseen: Range<usize>,
    /// Until when all that it may reach has been foreseen, if that was nothing.
    pub foreseen_until: f64,
    /// When the edge after it has shrunk to a point at the latest, as things are.
    pub shrunk: f64,
    /// The corner before it where a piece of the same edge began.
    pub older: Option<usize>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum CornerKind {
    Convex,
    /// Reflex, or straight.
    Reflex,
    /// Between two edges that lie on each other, or in one line at different speeds: it goes to an end of one at once.
    Rushing,
}

impl WavefrontCorner {
    /// The two lines that say where it is.
    pub(super) fn pair(&self) -> [usize; 2] {
        [self.lines[0], self.pin.unwrap_or(self.lines[1])]
    }
}

#[derive(Default)]
pub(super) struct Wavefront {
    pub traced: WavefrontTrace,
    pub lines: MovingLines,
    /// The edges that are still there.
    pub current: EdgeFronts,
    /// How many pieces there are of each edge.
    alive: Vec<u32>,
    /// How many corners there are.
    living: usize,
    /// How many corners there had been when it was last asked which edges are still there.
    known: usize,
    pub corners: Vec<WavefrontCorner>,
    /// For each edge the last of the corners where pieces of it begin; some may be dead.
    pub pieces: Vec<Option<usize>>,
    /// Lines that corners may reach, each with the earliest time.
    pub foreseen: Vec<(f64, usize)>,
    pub events: EventQueue,
    /// The numbers of the events that are next.
    pub ties: Vec<u32>,
    /// The numbers of events that were looked at before them.
    pub later: Vec<u32>,
    pub spots: Vec<EventPoint>,
    /// When the last thing happened, and that or a little before.
    pub last: Option<EventTime>,
    pub now: f64,
    /// Whether an edge has just begun to move.
    pub restarted: bool,
    /// A point of each edge.
    through: Vec<I64Vec2>,
}

impl Wavefront {
    /// Moves all edges inwards until the polygon is used up.
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
            // What is still expected then takes place nowhere.
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

    /// Lets the edges around areas that nothing sweeps begin to move, a little later than all that has happened.
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

    /// Puts the wavefront on the polygon, whatever it was before.
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

    /// The place of a corner of the polygon. Where it is straight, the line across is through it.
    fn start_of(&mut self, edges: [usize; 2], at: I64Vec2) -> LineMeeting {
        let [before, after] = edges.map(|edge| self.traced.edges[edge].line);
        let mut pair = [before, after];
        if self.lines.turn(before, after) == Ordering::Equal {
            let across = self.lines.direction(after).left().reversed();
            pair[1] = self.lines.add(across, at, 0.0, 0.0);
        }
        LineMeeting { pair, at: metres(at), slack: 0.0 }
    }

    /// Adds a corner between two edges; its neighbours are still to be set.
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

    /// Lets an edge that stood still move from `time` on; corners along it begin anew.
    ///
    /// Of one that is gone the line stays as it is: corners that were to reach it next would forget what comes after.
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

    /// Where a corner is.
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

    /// Ends rings of two corners among new ones: nothing is between them.
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

    /// Lets new corners that rush meet the ends of pieces that they go to.
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
                // The faster edge sweeps what the slower one has left.
                if a < b {
                    high = low;
                } else {
                    low = high;
                }
            } else {
                let places = [low, high].map(|end| self.place(end, when));
                // Both are in the direction of the second edge; the nearer one is met.
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

    /// Foresees what happens to new corners.
    pub(super) fn go_on(&mut self, fresh: &[usize]) {
        if self.corners.len() > self.known + self.current.len() / 2 {
            self.known = self.corners.len();
            self.current.retain(|edge| self.alive[edge] > 0);
        }
        for &index in fresh {
            let WavefrontCorner { alive, before, after, .. } = self.corners[index];
            if alive {
                self.expect_collapse(before, index);
                // Another new one foresees what happens before it.
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

    /// Foresees anew what all old corners reach, as edges have begun to move.
    pub(super) fn look_again(&mut self) {
        for index in 0..self.corners.len() {
            if self.corners[index].alive {
                self.expect_split(index, ANY);
            }
        }
    }
}

/// Steps after which it is checked again that the run goes on.
const STOP_STEPS: usize = 256;
/// Edges that begin to move as nothing else does so at a time of which there are so many to a metre.
const STEPS: f64 = 64.0;
/// Before all that may happen.
pub(super) const ANY: (f64, usize) = (f64::NEG_INFINITY, 0);
