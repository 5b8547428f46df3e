//! Rings around the area that a walk sweeps on its right.
//!
//! Method: to the right of each edge lies a rectangle as wide as the distance, and at each left turn lies a
//! sector, a mitre or a triangle. All are counter-clockwise, so together their rings have a positive winding
//! number exactly where one of them covers the plane. Edges shared by two of them cancel each other, and one
//! ring remains.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::ops::Range;

use glam::DVec2;

use super::predicates::{crossing, side};

/// Style of a buffer's border at corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Join {
    /// A circular arc.
    Round,
    /// A mitre, cut off at this multiple of the distance.
    Mitre(f64),
    /// A straight cut.
    Bevel,
}

/// Style of a buffer's border at the ends of lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cap {
    /// A semicircle.
    Round,
    /// A straight line through the end.
    Flat,
    /// A straight line beyond the end by the distance.
    Square,
}

/// Style of a buffer's border.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BufferStyle {
    /// Style at corners.
    pub join: Join,
    /// Style at the ends of lines.
    pub cap: Cap,
    /// Number of edges per quarter circle.
    pub quadrant_segments: u32,
}

/// Direction in which a walk turns at a corner.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Turn {
    None,
    Left,
    Right,
    /// Half a turn, or nearly half a turn.
    Back,
    /// Half a turn at the end of a line.
    End,
}

/// Maximum deviation (radians) from half a turn, since rotated points are rounded.
const BACK: f64 = 1e-9;

/// A closed walk along edges.
pub(super) struct ClosedWalk {
    /// Points, each different from the previous one.
    places: Vec<DVec2>,
    /// Indices of the points that are ends of a line.
    ends: Option<[usize; 2]>,
}

impl ClosedWalk {
    /// Creates a walk around a ring; `None` if it has no edges.
    pub(super) fn around(ring: impl IntoIterator<Item = DVec2>) -> Option<Self> {
        let places = distinct(ring, true);
        (places.len() > 1).then_some(Self { places, ends: None })
    }

    /// Creates a walk along a line and back, or two walks around a closed line in both directions; `None` if
    /// it has no edges.
    pub(super) fn of_line(line: &[DVec2]) -> Option<Vec<Self>> {
        let mut places = distinct(line.iter().copied(), false);
        let last = places.len().checked_sub(1).filter(|last| *last > 0)?;
        if last > 2 && places.first() == places.last() {
            let ways = [Self::around(places.iter().copied()), Self::around(places.iter().rev().copied())];
            return ways.into_iter().collect();
        }
        places.extend_from_within(1..last);
        places[last + 1..].reverse();
        Some(vec![Self { places, ends: Some([0, last]) }])
    }

    pub(super) fn len(&self) -> usize {
        self.places.len()
    }

    /// Returns the number of edges shorter than a length (m).
    pub(super) fn count_shorter(&self, length: f64) -> usize {
        (0..self.len()).filter(|edge| self.at(*edge).distance(self.at(edge + 1)) < length).count()
    }

    fn at(&self, index: usize) -> DVec2 {
        self.places[index % self.places.len()]
    }

    /// Returns the turn at the end of an edge.
    fn turn(&self, edge: usize) -> Turn {
        let corner = (edge + 1) % self.len();
        if self.ends.is_some_and(|ends| ends.contains(&corner)) {
            return Turn::End;
        }
        let [a, b, c] = [0, 1, 2].map(|step| self.at(edge + step));
        let (from, to) = (self.normal(edge), self.normal(edge + 1));
        if from.dot(to) < 0.0 && from.perp_dot(to).abs() < BACK {
            return Turn::Back;
        }
        match side(a, b, c) {
            turn if turn > 0.0 => Turn::Left,
            turn if turn < 0.0 => Turn::Right,
            _ => Turn::None,
        }
    }

    /// Returns the points to the right of both ends of an edge, at a distance (m).
    fn beside(&self, edge: usize, distance: f64) -> [DVec2; 2] {
        let aside = self.normal(edge) * distance;
        [self.at(edge) + aside, self.at(edge + 1) + aside]
    }

    /// Returns the unit vector to the right of an edge.
    fn normal(&self, edge: usize) -> DVec2 {
        let way = self.at(edge + 1) - self.at(edge);
        // The square of a tiny length would underflow to 0.
        let way = (way / way.abs().max_element()).normalize();
        DVec2::new(way.y, -way.x)
    }
}

/// Drops points equal to the previous point; in a ring, also a last point equal to the first.
fn distinct(places: impl IntoIterator<Item = DVec2>, is_ring: bool) -> Vec<DVec2> {
    let mut distinct: Vec<DVec2> = places.into_iter().map(|place| place + DVec2::ZERO).collect();
    distinct.dedup();
    while is_ring && distinct.len() > 1 && distinct.first() == distinct.last() {
        distinct.pop();
    }
    distinct
}

/// Computes rings at a distance.
pub(super) struct Outliner {
    /// Distance (m), greater than 0.
    pub(super) distance: f64,
    pub(super) style: BufferStyle,
}

impl Outliner {
    /// Returns the ring around the area that a walk sweeps, including the area that it encloses.
    pub(super) fn whole(&self, walk: &ClosedWalk) -> Vec<DVec2> {
        let count = walk.len();
        let mut cuts: Vec<Option<DVec2>> = (0..count).map(|edge| self.cut(walk, edge)).collect();
        for edge in 0..count {
            if self.is_reversed(walk, edge, cuts[(edge + count - 1) % count], cuts[edge]) {
                cuts[edge] = None;
            }
        }
        let mut ring = Vec::with_capacity(2 * count);
        for (edge, cut) in cuts.into_iter().enumerate() {
            self.corner(walk, edge, cut, &mut ring);
        }
        ring
    }

    /// Returns the ring around the area that some edges of a walk sweep, with the corner after them.
    pub(super) fn piece(&self, walk: &ClosedWalk, edges: Range<usize>) -> Vec<DVec2> {
        let last = edges.end - 1;
        let mut ring = vec![walk.at(edges.start), walk.beside(edges.start, self.distance)[0]];
        let mut before = None;
        for edge in edges.start..last {
            let cut = self.cut(walk, edge).filter(|cut| !self.is_reversed(walk, edge, before, Some(*cut)));
            self.corner(walk, edge, cut, &mut ring);
            before = cut;
        }
        self.corner(walk, last, None, &mut ring);
        match walk.turn(last) {
            // The point next to the following edge, which is not part of the piece.
            Turn::Right => drop(ring.pop()),
            Turn::None => ring.extend([walk.beside(last, self.distance)[1], walk.at(last + 1)]),
            _ => ring.extend([walk.beside(last + 1, self.distance)[0], walk.at(last + 1)]),
        }
        ring.extend((edges.start + 1..edges.end).rev().map(|edge| walk.at(edge)));
        ring
    }

    /// Returns the buffer of a single point, with the style of the ends of lines; `None` for flat ends.
    pub(super) fn around(&self, place: DVec2) -> Option<Vec<DVec2>> {
        let right = DVec2::new(self.distance, 0.0);
        match self.style.cap {
            Cap::Flat => None,
            Cap::Square => {
                let corner = DVec2::splat(self.distance);
                let corners = [-corner, -corner.perp(), corner, corner.perp()];
                Some(corners.into_iter().map(|at| place + at).collect())
            }
            Cap::Round => {
                let mut ring = vec![place + right];
                self.arc(place, DVec2::X, TAU, &mut ring);
                Some(ring)
            }
        }
    }

    /// Returns the crossing of the lines beside two consecutive edges at a right turn: beyond it, both lines
    /// cover the same area.
    fn cut(&self, walk: &ClosedWalk, edge: usize) -> Option<DVec2> {
        if walk.turn(edge) != Turn::Right {
            return None;
        }
        crossing(walk.beside(edge, self.distance), walk.beside(edge + 1, self.distance))
    }

    /// Returns true if the cuts at both ends of the line beside an edge are in reverse order. If all corners
    /// of a hole were cut off, no ring would cover the hole.
    fn is_reversed(&self, walk: &ClosedWalk, edge: usize, begin: Option<DVec2>, end: Option<DVec2>) -> bool {
        let way = walk.at(edge + 1) - walk.at(edge);
        begin.zip(end).is_some_and(|(begin, end)| (end - begin).dot(way) <= 0.0)
    }

    /// Connects the line beside an edge to the line beside the next edge.
    fn corner(&self, walk: &ClosedWalk, edge: usize, cut: Option<DVec2>, ring: &mut Vec<DVec2>) {
        if let Some(cut) = cut {
            ring.push(cut);
            return;
        }
        let corner = walk.at(edge + 1);
        let [from, to] = [walk.beside(edge, self.distance)[1], walk.beside(edge + 1, self.distance)[0]];
        let turn = walk.turn(edge);
        if turn == Turn::End && self.style.cap == Cap::Square {
            let ahead = walk.normal(edge).perp() * self.distance;
            ring.extend([from + ahead, to + ahead]);
            return;
        }
        if turn == Turn::None {
            return;
        }
        ring.push(from);
        match turn {
            Turn::Right => ring.push(corner),
            Turn::End if self.style.cap == Cap::Round => self.arc(corner, walk.normal(edge), PI, ring),
            Turn::Left | Turn::Back => self.join(walk, edge, ring),
            Turn::End | Turn::None => {}
        }
        ring.push(to);
    }

    /// Adds the border between the lines beside two edges at a left turn.
    fn join(&self, walk: &ClosedWalk, edge: usize, ring: &mut Vec<DVec2>) {
        let corner = walk.at(edge + 1);
        let (from, to) = (walk.normal(edge), walk.normal(edge + 1));
        let is_back = walk.turn(edge) == Turn::Back;
        match self.style.join {
            Join::Round => {
                let angle = if is_back { PI } else { from.perp_dot(to).atan2(from.dot(to)) };
                self.arc(corner, from, angle, ring);
            }
            Join::Mitre(limit) if !is_back => {
                let cosine = from.dot(to);
                // The distance of the mitre's tip from the corner grows with the angle between the two
                // normals.
                let reach = (2.0 / (1.0 + cosine)).sqrt();
                if reach <= limit {
                    ring.push(corner + (from + to) * (self.distance / (1.0 + cosine)));
                    return;
                }
                let ahead = from.perp();
                let middle = (from + to).try_normalize().unwrap_or(ahead);
                let along = self.distance * (limit - from.dot(middle)) / ahead.dot(middle);
                if along.is_finite() && along > 0.0 {
                    ring.push(corner + from * self.distance + ahead * along);
                    ring.push(corner + to * self.distance - to.perp() * along);
                }
            }
            Join::Mitre(_) | Join::Bevel => {}
        }
    }

    /// Adds the inner points of an arc around a corner, counter-clockwise from a direction.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 4000")]
    fn arc(&self, corner: DVec2, from: DVec2, angle: f64, ring: &mut Vec<DVec2>) {
        let step = FRAC_PI_2 / f64::from(self.style.quadrant_segments);
        let count = (angle.abs() / step).round() as u32;
        for index in 1..count {
            let turned = DVec2::from_angle(angle * f64::from(index) / f64::from(count)).rotate(from);
            ring.push(corner + turned * self.distance);
        }
    }
}
