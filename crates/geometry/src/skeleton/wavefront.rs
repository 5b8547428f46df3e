//! State of the wavefront: the edges, their corners, and the spots of the next events.

use std::cmp::Ordering;
use std::ops::Range;

use glam::I64Vec2;

use super::edge::SkeletonEdge;
use super::fronts::EdgeFronts;
use super::lines::{EventTime, LineMeeting, MovingLines};
use super::queue::{EventQueue, WavefrontEvent, WavefrontEventKind};
use super::skeleton::{Pace, Peak};

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

/// A corner that an event moves, or a point of an edge (identified by the corner at the start of the edge's
/// segment).
#[derive(Debug, Clone, Copy)]
pub(super) struct EventPoint {
    pub corner: usize,
    pub cut: bool,
    pub place: LineMeeting,
    /// Representative of all spots at the same position.
    pub leader: usize,
    /// Index of its meeting, once it is assigned.
    pub meeting: usize,
}

#[derive(Default)]
pub(super) struct Wavefront {
    pub traced: WavefrontTrace,
    pub lines: MovingLines,
    /// Remaining edges.
    pub current: EdgeFronts,
    /// Number of segments of each edge.
    pub alive: Vec<u32>,
    /// Number of living corners.
    pub living: usize,
    /// Total number of corners when the remaining edges were last updated.
    pub known: usize,
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
    pub through: Vec<I64Vec2>,
}

impl Wavefront {
    /// Adds an event to the queue.
    pub(super) fn expect(&mut self, when: EventTime, what: WavefrontEventKind) {
        self.events.push(WavefrontEvent { low: when.low(), when, what, leads: false });
    }

    /// Returns the spot of a corner; adds it if necessary.
    pub(super) fn spot(&mut self, corner: usize, place: LineMeeting) -> usize {
        if let Some(known) = self.spot_of(corner) {
            return known;
        }
        self.corners[corner].spot = self.spots.len();
        self.add_spot(corner, false, place)
    }

    pub(super) fn spot_of(&self, corner: usize) -> Option<usize> {
        let known = self.corners[corner].spot;
        self.spots.get(known).filter(|spot| spot.corner == corner && !spot.cut).map(|_| known)
    }

    /// Adds a spot on the segment of an edge that begins at a corner.
    pub(super) fn spot_between(&mut self, corner: usize, place: LineMeeting) -> usize {
        self.add_spot(corner, true, place)
    }

    fn add_spot(&mut self, corner: usize, cut: bool, place: LineMeeting) -> usize {
        let leader = self.spots.len();
        self.spots.push(EventPoint { corner, cut, place, leader, meeting: 0 });
        leader
    }

    pub(super) fn leader(&self, mut spot: usize) -> usize {
        while self.spots[spot].leader != spot {
            spot = self.spots[spot].leader;
        }
        spot
    }

    pub(super) fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.leader(a), self.leader(b));
        self.spots[a.max(b)].leader = a.min(b);
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
    pub(super) fn place(&mut self, index: usize, when: &mut EventTime) -> LineMeeting {
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
}

/// Lower bound before all events.
pub(super) const ANY: (f64, usize) = (f64::NEG_INFINITY, 0);
