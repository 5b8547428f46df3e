//! What a walk sweeps over to its right, as rings that go around it.
//!
//! Method: to the right of each edge there is a rectangle as wide as the distance, and at each corner that turns to the left
//! a piece of a disc, a mitre or a triangle. All are counter-clockwise, so that their rings together go around nothing but
//! what one of them covers; edges that two of them have in common cancel each other, and what is left is one ring.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::ops::Range;

use glam::DVec2;

use super::predicates::{crossing, side};

/// The border of a buffer at corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Join {
    /// An arc.
    Round,
    /// A corner, cut off where it is farther than so many distances.
    Mitre(f64),
    /// A straight cut.
    Bevel,
}

/// The border of a buffer at the ends of lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cap {
    /// Half a circle.
    Round,
    /// A straight line through the end.
    Flat,
    /// A straight line as far beyond the end as the distance.
    Square,
}

/// The course of a buffer's border.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BufferStyle {
    /// At corners.
    pub join: Join,
    /// At the ends of lines.
    pub cap: Cap,
    /// The number of edges of a quarter of a circle.
    pub quadrant_segments: u32,
}

/// The way in which a walk turns at a corner.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Turn {
    None,
    Left,
    Right,
    /// By half a turn, or nearly so.
    Back,
    /// By half a turn at the end of a line.
    End,
}

/// Half a turn but for this (radians) is one: what was turned around a place is rounded.
const BACK: f64 = 1e-9;

/// A walk along edges that ends where it began.
pub(super) struct ClosedWalk {
    /// Its places, each other than the one before.
    places: Vec<DVec2>,
    /// The numbers of places that are ends of a line.
    ends: Option<[usize; 2]>,
}

impl ClosedWalk {
    /// Around a ring; none if it has no edges.
    pub(super) fn around(ring: impl IntoIterator<Item = DVec2>) -> Option<Self> {
        let places = distinct(ring, true);
        (places.len() > 1).then_some(Self { places, ends: None })
    }

    /// Along a line and back; if it is a ring, around it both ways. None if it has no edges.
    pub(super) fn along(line: &[DVec2]) -> Option<Vec<Self>> {
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

    /// How many edges are short, compared to a length (m).
    pub(super) fn count_shorter(&self, length: f64) -> usize {
        (0..self.len()).filter(|edge| self.at(*edge).distance(self.at(edge + 1)) < length).count()
    }

    fn at(&self, index: usize) -> DVec2 {
        self.places[index % self.places.len()]
    }

    /// The turn behind an edge.
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

    /// The places beside both ends of an edge, to the right.
    fn beside(&self, edge: usize, distance: f64) -> [DVec2; 2] {
        let aside = self.normal(edge) * distance;
        [self.at(edge) + aside, self.at(edge + 1) + aside]
    }

    /// The direction to the right of an edge.
    fn normal(&self, edge: usize) -> DVec2 {
        let way = self.at(edge + 1) - self.at(edge);
        // The square of a tiny length would be nothing.
        let way = (way / way.abs().max_element()).normalize();
        DVec2::new(way.y, -way.x)
    }
}

/// Places without those that are as the one before, in a ring also the last one as the first.
fn distinct(places: impl IntoIterator<Item = DVec2>, is_ring: bool) -> Vec<DVec2> {
    let mut distinct: Vec<DVec2> = places.into_iter().map(|place| place + DVec2::ZERO).collect();
    distinct.dedup();
    while is_ring && distinct.len() > 1 && distinct.first() == distinct.last() {
        distinct.pop();
    }
    distinct
}

/// Makes rings at a distance.
pub(super) struct Outliner {
    /// The distance (m), more than 0.
    pub(super) distance: f64,
    pub(super) style: BufferStyle,
}

impl Outliner {
    /// The ring around what a walk sweeps over, and around what it goes around.
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

    /// The ring around what some edges of a walk sweep over, with the corner behind them.
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
            // The place beside the next edge, which is not part of the piece.
            Turn::Right => drop(ring.pop()),
            Turn::None => ring.extend([walk.beside(last, self.distance)[1], walk.at(last + 1)]),
            _ => ring.extend([walk.beside(last + 1, self.distance)[0], walk.at(last + 1)]),
        }
        ring.extend((edges.start + 1..edges.end).rev().map(|edge| walk.at(edge)));
        ring
    }

    /// A disc around a place, or what the ends of lines make of it; none if they make nothing.
    pub(super) fn around(&self, place: DVec2) -> Option<Vec<DVec2>> {
        let right = DVec2::new(self.distance, 0.0);
        match self.style.cap {
            Cap::Flat => None,
            Cap::Square => {
                let corner = DVec2::splat(self.distance);
                Some([-corner, -corner.perp(), corner, corner.perp()].map(|at| place + at).to_vec())
            }
            Cap::Round => {
                let mut ring = vec![place + right];
                self.arc(place, DVec2::X, TAU, &mut ring);
                Some(ring)
            }
        }
    }

    /// The place where the line beside an edge meets that beside the next one, at a corner to the right: what is behind it
    /// on both is covered twice.
    fn cut(&self, walk: &ClosedWalk, edge: usize) -> Option<DVec2> {
        if walk.turn(edge) != Turn::Right {
            return None;
        }
        crossing(walk.beside(edge, self.distance), walk.beside(edge + 1, self.distance))
    }

    /// Whether the line beside an edge is cut off at its begin behind where it is cut off at its end. If all corners of a
    /// hole were cut off, nothing would be left that covers it.
    fn is_reversed(&self, walk: &ClosedWalk, edge: usize, begin: Option<DVec2>, end: Option<DVec2>) -> bool {
        let way = walk.at(edge + 1) - walk.at(edge);
        begin.zip(end).is_some_and(|(begin, end)| (end - begin).dot(way) <= 0.0)
    }

    /// Goes on from the line beside an edge to that beside the next one.
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

    /// What is between the lines beside two edges at a corner to the left.
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
                // The tip is the farther from the corner the less the two normals have in common.
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

    /// The places of an arc around a corner between its ends: from a direction on, counter-clockwise.
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
