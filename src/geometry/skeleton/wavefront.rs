//! The wavefront: the polygon's edges moving inwards until nothing is left of it.

use std::cell::Cell;
use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;
use std::ops::Range;

use glam::DVec2;
use smallvec::SmallVec;

use super::edge::{Direction, Edge};
use super::events::{Event, Next, What};
use super::meeting::Spot;
use super::{Pace, Peak};
use crate::error::{Error, Result};

/// Events within this time (m at speed 1) are simultaneous.
pub(super) const TOGETHER: f64 = 1e-6;
/// Places within this distance (m) are one.
pub(super) const NEAR: f64 = 2e-6;
/// Directions within this angle (radians) are one.
pub(super) const ALIGNED: f64 = 2e-6;

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
#[derive(Debug)]
pub(super) struct Corner {
    /// The edges before and after it.
    pub edges: [usize; 2],
    pub before: usize,
    pub after: usize,
    /// The peak where it began.
    pub peak: usize,
    pub at: DVec2,
    pub time: f64,
    pub velocity: DVec2,
    pub kind: Kind,
    pub alive: bool,
    /// The number of its spot, if it has one.
    pub spot: usize,
    /// Where the lines that it may reach after the one that it is expected to reach next are among those that have been
    /// foreseen, the last one first.
    pub foreseen: Range<usize>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Kind {
    Convex,
    Reflex,
    /// Between two edges that face and touch each other: it goes to their end at once.
    Closing,
}

impl Corner {
    pub(super) fn place(&self, time: f64) -> DVec2 {
        self.at + self.velocity * (time - self.time)
    }
}

#[derive(Default)]
pub(super) struct Wavefront {
    pub traced: Traced,
    pub directions: Vec<Direction>,
    pub corners: Vec<Corner>,
    /// For each edge the corners where pieces of it begin; some may be dead.
    pub pieces: Vec<SmallVec<[usize; 6]>>,
    /// Lines that corners may reach, each with the time.
    pub foreseen: Vec<(f64, usize)>,
    pub events: BinaryHeap<Reverse<Event>>,
    pub spots: Vec<Spot>,
    /// When an edge last began to move.
    pub started: f64,
}

thread_local! {
    /// The last wavefront of the thread, whose memory the next one uses again: a city has tens of thousands.
    static SPARE: Cell<Option<Box<Wavefront>>> = const { Cell::new(None) };
}

/// Moves all edges inwards until the polygon is used up. The rings lie on the lattice.
pub(super) fn propagate(rings: &[Vec<DVec2>], paces: &[Pace]) -> Result<Traced> {
    let mut front = SPARE.take().unwrap_or_default();
    let done = front.run(rings, paces);
    let traced = std::mem::take(&mut front.traced);
    SPARE.set(Some(front));
    done.map(|()| traced)
}

impl Wavefront {
    fn run(&mut self, rings: &[Vec<DVec2>], paces: &[Pace]) -> Result<()> {
        self.begin(rings, paces)?;
        for _ in 0..16 * paces.len() + 64 {
            match self.gather() {
                Next::Meet(time) => self.resolve(time)?,
                Next::Start(edge, time) => self.start(edge, time)?,
                Next::End if self.corners.iter().any(|corner| corner.alive) => {
                    return Err(Error::new("the wavefront is left with corners that meet nothing"));
                }
                Next::End => return Ok(()),
            }
        }
        Err(Error::new("the wavefront does not end"))
    }

    /// Puts the wavefront on the polygon, whatever it was before.
    fn begin(&mut self, rings: &[Vec<DVec2>], paces: &[Pace]) -> Result<()> {
        let count = paces.len();
        let mut edges = Vec::with_capacity(count);
        self.directions.clear();
        for ring in rings {
            for (index, &from) in ring.iter().enumerate() {
                let to = ring[(index + 1) % ring.len()];
                let along = (to - from).normalize_or_zero();
                let pace = paces.get(edges.len()).copied().unwrap_or_default();
                let speed = if pace.rest > 0.0 { 0.0 } else { pace.speed };
                edges.push(Edge { along, level: along.perp().dot(from), speed, pace });
                self.directions.push(Direction::new(from, to));
            }
        }
        self.traced =
            Traced { edges, peaks: Vec::with_capacity(3 * count), arcs: Vec::with_capacity(3 * count) };
        self.corners.clear();
        self.pieces.clear();
        self.pieces.resize(count, SmallVec::new());
        self.foreseen.clear();
        self.events.clear();
        self.spots.clear();
        self.started = 0.0;
        let mut first = 0;
        for ring in rings {
            let size = ring.len();
            for (index, &at) in ring.iter().enumerate() {
                let (before, after) = ((index + size - 1) % size, (index + 1) % size);
                self.traced.peaks.push(Peak { at, time: 0.0 });
                let corner = self.corner([first + before, first + index], first + index, at, 0.0)?;
                self.corners[corner].before = first + before;
                self.corners[corner].after = first + after;
            }
            first += size;
        }
        for corner in 0..count {
            self.expect_collapse(corner, self.corners[corner].after, 0.0);
            self.expect_split(corner, (f64::NEG_INFINITY, 0));
            let Pace { speed, rest } = self.traced.edges[corner].pace;
            if speed > 0.0 && rest > 0.0 && rest.is_finite() {
                self.expect(rest, What::Start(corner));
            }
        }
        Ok(())
    }

    /// Adds a corner between two edges; its neighbours are still to be set.
    pub(super) fn corner(&mut self, edges: [usize; 2], peak: usize, at: DVec2, time: f64) -> Result<usize> {
        let [a, b] = edges.map(|edge| &self.traced.edges[edge]);
        let (cross, dot) = (a.along.perp_dot(b.along), a.along.dot(b.along));
        let turn = self.directions[edges[0]].turn(self.directions[edges[1]]);
        let mut kind = if turn == Ordering::Less { Kind::Reflex } else { Kind::Convex };
        #[allow(clippy::float_cmp, reason = "equal speeds are given as equal numbers")]
        let velocity = if dot < 0.0 && cross.abs() < ALIGNED {
            kind = Kind::Closing;
            DVec2::ZERO
        } else if a.speed == b.speed && dot > 0.0 {
            (a.inward() + b.inward()) * (a.speed / (1.0 + dot))
        } else if cross.abs() < ALIGNED {
            return Err(Error::new("two edges in one line move at different speeds"));
        } else {
            // Between edges that almost face each other this loses no digits.
            (b.along * a.speed - a.along * b.speed) / cross
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
            spot: usize::MAX,
            foreseen: 0..0,
        });
        self.pieces[edges[1]].push(index);
        Ok(index)
    }

    /// Lets an edge that stood still begin to move.
    fn start(&mut self, edge: usize, time: f64) -> Result<()> {
        self.traced.edges[edge].speed = self.traced.edges[edge].pace.speed;
        self.started = time;
        let mut fresh = Vec::new();
        for number in 0..self.pieces[edge].len() {
            let from = self.pieces[edge][number];
            if !self.corners[from].alive {
                continue;
            }
            for old in [from, self.corners[from].after] {
                let Corner { edges, before, after, .. } = self.corners[old];
                let peak = self.traced.peaks.len();
                let at = self.corners[old].place(time);
                self.traced.peaks.push(Peak { at, time });
                self.end(old, peak);
                let new = self.corner(edges, peak, at, time)?;
                (self.corners[new].before, self.corners[new].after) = (before, after);
                (self.corners[before].after, self.corners[after].before) = (new, new);
                fresh.push(new);
            }
        }
        self.go_on(&fresh, time);
        // Corners that were to reach it will do so earlier.
        for index in 0..self.corners.len() {
            if self.corners[index].alive {
                self.expect_split(index, (f64::NEG_INFINITY, 0));
            }
        }
        Ok(())
    }

    /// Ends a corner at a peak.
    pub(super) fn end(&mut self, index: usize, peak: usize) {
        let corner = &mut self.corners[index];
        corner.alive = false;
        if corner.peak != peak {
            self.traced.arcs.push(Arc { edges: corner.edges, ends: [corner.peak, peak] });
        }
    }

    /// Foresees what happens to new corners; closes pairs of edges that lie on each other.
    pub(super) fn go_on(&mut self, fresh: &[usize], time: f64) {
        for &index in fresh {
            let Corner { alive, before, after, .. } = self.corners[index];
            if !alive {
                continue;
            }
            if after == index {
                self.corners[index].alive = false;
                continue;
            }
            if after == before {
                let other = &self.corners[after];
                let mut peak = other.peak;
                if time - other.time > 0.0 {
                    peak = self.traced.peaks.len();
                    let at = other.place(time);
                    self.traced.peaks.push(Peak { at, time });
                }
                self.end(after, peak);
                self.end(index, peak);
            }
        }
        for &index in fresh {
            let Corner { alive, kind, before, after, .. } = self.corners[index];
            if !alive {
                continue;
            }
            if kind == Kind::Closing {
                self.expect(time, What::Close(index));
                continue;
            }
            self.expect_collapse(before, index, time);
            self.expect_collapse(index, after, time);
            self.expect_split(index, (f64::NEG_INFINITY, 0));
        }
    }
}
