//! Road markings: lines along lanes, crossings, and stop lines.
//!
//! Markings are on the carriageways of segments, beyond the corners of junctions, and never overlap.

use glam::{DVec2, DVec3};

use crate::kinds::{LaneLine, StreetKind};
use crate::plan::network::{PieceId, StreetNetwork};
use crate::shape::profile::StreetProfiles;
use crate::shape::shapes::StreetShapes;
use crate::surface::parts::SurfaceOptions;
use crate::surface::rows::{MEDIAN_MARGIN, median_of};

/// Start and end (m) of a crossing beyond a junction, and of the stop line before it.
const CROSSING: [f64; 2] = [0.6, 3.6];
const STOP: [f64; 2] = [4.5, 4.9];
/// Distance (m) from a crossing to the start of lines, and from a junction without one.
const LINES: f64 = 5.3;
const LINES_ALONE: f64 = 0.6;
/// Minimum length (m) of lines.
const LEAST_LINES: f64 = 5.0;
/// Width (m) of a stripe of a crossing, and of the gap next to it.
const STRIPE: f64 = 0.5;
/// Length (m) of a parking space, and width of the line between two.
const PARKED: f64 = 5.6;
const PARKED_LINE: f64 = 0.1;

/// Painted area.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Marking {
    /// Corners (m), counter-clockwise, at the height of the street.
    pub corners: [DVec3; 4],
    /// Segment that the marking is on.
    pub piece: PieceId,
}

/// Objects at one end of a segment.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct PieceEnd {
    /// Distance (m) from the junction beyond which the segment has its full width.
    pub(crate) clear: f64,
    /// Marks a pedestrian crossing.
    pub(crate) is_crossed: bool,
    /// Marks a mere turn of the street, at which its lines continue.
    pub(crate) goes_on: bool,
    /// Distance (m) from the junction at which lines begin.
    pub(crate) lines: f64,
}

/// Returns the objects at both ends of a segment.
pub(crate) fn piece_ends(shapes: &StreetShapes<'_>, piece: PieceId) -> [PieceEnd; 2] {
    let network = shapes.network;
    let ends = network.ends(piece);
    let degree = ends.map(|end| network.junctions[end as usize].degree());
    let clear = ends.map(|end| shapes.arm(end, piece).map_or(0.0, |arm| arm.clear()));
    let room = network.length(piece) - clear[0] - clear[1];
    let mut crossed = degree.map(|degree| degree > 2 && network.attributes(piece).carriageway() >= 4.0);
    if room < 2.0 * MEDIAN_MARGIN + 3.0 && crossed[0] && crossed[1] {
        crossed[usize::from(degree[0] >= degree[1])] = false;
    }
    if room < MEDIAN_MARGIN + 3.0 {
        crossed = [false; 2];
    }
    [0, 1].map(|side| {
        let goes_on = shapes.junction(ends[side]).is_mitred;
        let lines = match (crossed[side], degree[side]) {
            (true, _) => clear[side] + LINES,
            (false, 3..) => clear[side] + LINES_ALONE,
            _ if goes_on => 0.0,
            _ => clear[side],
        };
        PieceEnd { clear: clear[side], is_crossed: crossed[side], goes_on, lines }
    })
}

impl StreetNetwork {
    /// Returns the markings of the streets; `kinds` contains the street types by depth.
    pub fn markings(
        &self,
        options: SurfaceOptions,
        profiles: &StreetProfiles,
        kinds: &[StreetKind],
    ) -> Vec<Marking> {
        let shapes = StreetShapes::new(self, options.turning);
        let mut markings = Vec::new();
        for (piece, found) in self.pieces().filter(|(_, piece)| piece.attributes.level >= 0) {
            let kind = StreetKind::of(kinds, found.attributes.depth).adapt_to(found.attributes);
            let mut painter = Painter::new(&shapes, profiles, piece, kind, &mut markings);
            painter.paint();
        }
        markings
    }
}

struct Painter<'a> {
    shapes: &'a StreetShapes<'a>,
    profiles: &'a StreetProfiles,
    piece: PieceId,
    kind: StreetKind,
    start: DVec2,
    way: DVec2,
    length: f64,
    ends: [PieceEnd; 2],
    markings: &'a mut Vec<Marking>,
}

impl<'a> Painter<'a> {
    fn new(
        shapes: &'a StreetShapes<'a>,
        profiles: &'a StreetProfiles,
        piece: PieceId,
        kind: StreetKind,
        markings: &'a mut Vec<Marking>,
    ) -> Self {
        let [start, stop] = shapes.network.line(piece);
        let (way, length) = ((stop - start).normalize_or_zero(), start.distance(stop));
        let ends = piece_ends(shapes, piece);
        Self { shapes, profiles, piece, kind, start, way, length, ends, markings }
    }

    fn paint(&mut self) {
        for side in 0..2 {
            if self.ends[side].is_crossed {
                self.crossing(side);
            }
        }
        let [from, to] = [self.ends[0].lines, self.length - self.ends[1].lines];
        if to - from < LEAST_LINES {
            return;
        }
        let has_median = median_of(self.shapes, self.piece);
        for line in self.kind.lines() {
            if self.kind.median > 0.0 && has_median.is_none() && line.aside.abs() < self.kind.median {
                continue;
            }
            match line.dash {
                Some(dash) => self.dashes(line, dash, [from, to]),
                None => self.solid(line, [from, to]),
            }
        }
        if self.kind.parking > 0.0 {
            self.parking([from + 2.0, to - 2.0]);
        }
    }

    /// Paints the crossing at an end, and the stop line for oncoming traffic.
    fn crossing(&mut self, side: usize) {
        let clear = self.ends[side].clear;
        let along = |at: f64| if side == 0 { clear + at } else { self.length - clear - at };
        let (stripes, stop) = (CROSSING.map(along), STOP.map(along));
        let half = self.kind.carriageway() / 2.0 - 0.3;
        #[allow(clippy::cast_possible_truncation, reason = "few stripes")]
        let count = (half / STRIPE - 0.5).floor() as i32;
        for stripe in (-count..=count).filter(|stripe| (stripe - count) % 2 == 0) {
            let aside = f64::from(stripe) * STRIPE;
            self.rectangle(stripes, [aside - STRIPE / 2.0, aside + STRIPE / 2.0]);
        }
        if self.kind.lanes() > 1 {
            // The stop line is on the left in the direction away from the junction.
            let [begin, end] = self.kind.left_lanes();
            let sign = if side == 0 { 1.0 } else { -1.0 };
            self.rectangle(stop, [begin + 0.2, end - 0.2].map(|aside| aside * sign));
        }
    }

    /// Paints evenly spaced dashes between two positions, with half a gap at each end.
    fn dashes(&mut self, line: LaneLine, [dash, gap]: [f64; 2], [from, to]: [f64; 2]) {
        let count = ((to - from) / (dash + gap)).round().max(1.0);
        let period = (to - from) / count;
        let dash = dash.min(period * 0.6);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a street has few dashes")]
        for index in 0..count as u32 {
            let begin = from + period * f64::from(index) + (period - dash) / 2.0;
            self.rectangle([begin, begin + dash], self.across(line));
        }
    }

    fn across(&self, line: LaneLine) -> [f64; 2] {
        [line.aside - line.width / 2.0, line.aside + line.width / 2.0]
    }

    /// Paints a solid line; where the street only turns, the line extends to the next segment.
    fn solid(&mut self, line: LaneLine, [from, to]: [f64; 2]) {
        let across = self.across(line);
        let ends = self.shapes.network.ends(self.piece);
        let at = |side: usize, along: f64| {
            let sign = if side == 0 { 1.0 } else { -1.0 };
            if self.ends[side].goes_on {
                across.map(|aside| self.shapes.end(ends[side], self.piece, sign * aside))
            } else {
                self.places(along, across)
            }
        };
        self.strip([at(0, from), at(1, to)], [from, to], across);
    }

    /// Paints the lines between parking spaces on both sides.
    fn parking(&mut self, [from, to]: [f64; 2]) {
        let outer = self.kind.carriageway() / 2.0;
        let inner = outer - self.kind.parking + PARKED_LINE;
        let count = ((to - from) / PARKED).floor();
        if count < 1.0 {
            return;
        }
        let first = f64::midpoint(from, to) - count * PARKED / 2.0;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a street has few places")]
        for index in 0..=count as u32 {
            let at = first + PARKED * f64::from(index);
            for across in [[inner, outer - 0.05], [0.05 - outer, -inner]] {
                self.rectangle([at - PARKED_LINE / 2.0, at + PARKED_LINE / 2.0], across);
            }
        }
    }

    fn places(&self, along: f64, across: [f64; 2]) -> [DVec2; 2] {
        across.map(|aside| self.start + self.way * along + self.way.perp() * aside)
    }

    fn rectangle(&mut self, along: [f64; 2], across: [f64; 2]) {
        let along = [along[0].min(along[1]), along[0].max(along[1])];
        let across = [across[0].min(across[1]), across[0].max(across[1])];
        let ends = along.map(|along| self.places(along, across));
        self.strip(ends, along, across);
    }

    /// Paints from one pair of points to another, divided at each change of slope.
    fn strip(&mut self, [first, last]: [[DVec2; 2]; 2], [from, to]: [f64; 2], across: [f64; 2]) {
        let stations = self.profiles.stations(self.piece);
        let between = stations.iter().filter(|[at, _]| *at > from + 1e-3 && *at < to - 1e-3);
        let mut rows: Vec<([DVec2; 2], f64)> = vec![(first, self.profiles.height_along(self.piece, from))];
        rows.extend(between.map(|&[at, height]| (self.places(at, across), height)));
        rows.push((last, self.profiles.height_along(self.piece, to)));
        for pair in rows.windows(2) {
            let ([right, left], low) = pair[0];
            let ([far_right, far_left], high) = pair[1];
            let corners = [(right, low), (far_right, high), (far_left, high), (left, low)];
            let corners = corners.map(|(at, height)| at.extend(height));
            self.markings.push(Marking { corners, piece: self.piece });
        }
    }
}
