//! Propagation: the polygon's edges move inwards until no area remains.

use std::cmp::Ordering;

use glam::I64Vec2;

use super::edge::{Direction, SkeletonEdge, metres, short};
use super::fronts::EdgeFront;
use super::lines::{EventTime, LineMeeting};
use super::meeting::MeetingLists;
use super::queue::WavefrontEventKind;
use super::skeleton::{Pace, Peak};
use super::wavefront::{ANY, CornerKind, Wavefront, WavefrontCorner};
use burgeon_base::Stop;
use burgeon_base::error::{Error, Result};

/// Number of steps between two checks for cancellation.
const STOP_STEPS: usize = 16;
/// Time steps per metre for edges that start because nothing else moves.
const STEPS: f64 = 64.0;
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
}
