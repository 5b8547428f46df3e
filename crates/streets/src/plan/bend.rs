//! Corners of bends: kerb transitions where a street turns and may change its width.
//!
//! Growth reserves no more space for them than for other corners. The free length of the segments next to the bend
//! makes the transition smoother.

use std::f64::consts::PI;

use glam::DVec2;
use smallvec::SmallVec;

use super::corner::{
    Corner, CornerShape, DEVIATION, EVEN, LINES, StreetLine, TAPER_LENGTH, apart, chords, left_of, meeting,
};

/// Start of the wider street's taper on the outside of a bend, as a fraction of the length that the corner takes.
const TAPERED: f64 = 0.75;
/// Distance from a turn on the outside of a bend to the start of its rounding, per metre between centreline and kerb.
/// From 1 on, the rounding would start beyond the junction.
const ROUNDED: f64 = 0.8;
/// Minimum width within a transition, as a fraction of the smaller width.
const NARROW: f64 = 0.75;
/// Minimum sidewalk width (m); narrower sidewalks end in a point.
const LEAST_WALK: f64 = 0.1;

impl Corner {
    /// Returns the desired length (m) of a taper along both streets, for a street that turns and changes its width;
    /// `None` if neither street narrows before the edges meet.
    ///
    /// If the narrower street leaves through the end of the wider one, edges extended to their intersection would form
    /// a lobe.
    pub(crate) fn taper(&self) -> Option<[f64; 2]> {
        let apart = apart(self.arms);
        let meetings = LINES.map(|line| self.meetings(line));
        let is_round = matches!(self.shape, CornerShape::Round { .. });
        let is_lobe = is_round && apart >= EVEN && meetings.as_flattened().iter().any(|at| *at < 0.0);
        let reach = |side: usize| {
            let least = (apart * TAPER_LENGTH).max(self.reaches[side]);
            meetings.iter().map(|meeting| meeting[side] + apart).fold(least, f64::max)
        };
        is_lobe.then(|| [0, 1].map(reach))
    }

    /// Returns the length (m) along both streets that the kerb around the outside of a bend should take, so that it
    /// does not turn back.
    pub(crate) fn around_bend(&self) -> [f64; 2] {
        self.meetings(StreetLine::Kerb).map(|meeting| meeting.max(0.0) / TAPERED)
    }

    /// Returns the corner with the streets starting `reaches` (m) from the junction, for a street that turns and may
    /// change its width.
    pub(crate) fn of_bend(self, reaches: [f64; 2]) -> Self {
        let is_curved = match self.shape {
            CornerShape::Bend => self.is_uneven_bend(),
            CornerShape::Round { .. } => self.taper().is_some(),
            CornerShape::Taper => self.is_narrow(),
            _ => false,
        };
        let meetings = self.meetings(StreetLine::Edge);
        let has_room = self.angle > PI || reaches[0] > meetings[0] && reaches[1] > meetings[1];
        let shape = match (is_curved, has_room) {
            (true, true) => CornerShape::Curve,
            (true, false) => CornerShape::Taper,
            (false, _) => self.shape,
        };
        Self { shape, reaches, ..self }
    }

    /// Returns true if straight tapers on both sides of a bend would leave less than [`NARROW`] of the narrower street.
    fn is_narrow(&self) -> bool {
        let cut = self.reaches[0].max(self.reaches[1]) * ((self.angle - PI) / 2.0).sin().abs();
        LINES.iter().any(|line| {
            let [a, b] = self.arms.map(|arm| arm.aside(*line));
            f64::midpoint(a, b) - cut < a.min(b) * NARROW
        })
    }

    /// Returns the distances (m) along both streets at which their `line`s intersect.
    fn meetings(&self, line: StreetLine) -> [f64; 2] {
        let [a, b] = self.arms.map(|arm| arm.aside(line));
        [meeting(self.angle, a, b), meeting(self.angle, b, a)]
    }

    /// Returns the points (m) of edge and kerb along a curve, in pairs across the sidewalk.
    pub(crate) fn curve(&self) -> Vec<[DVec2; 2]> {
        let [first, second] = self.arms;
        let is_inside = self.angle < PI;
        let widest = first.walk.max(second.walk);
        let parabolas = if is_inside {
            SmallVec::from_iter([self.inner_parabola(StreetLine::Edge)])
        } else {
            self.outer_parabolas()
        };
        let places: Vec<CurvePlace> =
            parabolas.iter().flat_map(|parabola| curve_places(parabola, widest)).collect();
        if is_inside && let Some(kerb) = self.kerb_beside(&places) {
            return places.iter().zip(kerb).map(|(place, kerb)| [place.at, kerb]).collect();
        }
        // The second line is offset by the sidewalk's width from the line with the tighter bend, so it never folds.
        let length: f64 = places.windows(2).map(|pair| pair[0].at.distance(pair[1].at)).sum();
        let (mut gone, mut last) = (0.0, places[0].at);
        let pair = |place: &CurvePlace| {
            gone += std::mem::replace(&mut last, place.at).distance(place.at);
            let share = gone / length.max(EVEN);
            // On the inside, the sidewalk has the narrower street's width from the point where both edges would meet.
            let share = match (is_inside, first.half >= second.half) {
                (false, _) => share,
                (true, true) => (2.0 * share).min(1.0),
                (true, false) => (2.0 * share - 1.0).max(0.0),
            };
            let walk = place.across * (first.walk + (second.walk - first.walk) * share);
            if is_inside { [place.at, place.at - walk] } else { [place.at + walk, place.at] }
        };
        places.iter().map(pair).collect()
    }

    /// Returns the kerb (m) on the inside of a bend: the parabola that touches the kerbs of both streets, at the points
    /// whose directions match the edge's points. `None` if the sidewalk between would be too narrow.
    fn kerb_beside(&self, edge: &[CurvePlace]) -> Option<Vec<DVec2>> {
        let meetings = self.meetings(StreetLine::Kerb);
        let least = self.arms[0].walk.min(self.arms[1].walk) * NARROW;
        let has_room = least > LEAST_WALK && (0..2).all(|side| self.reaches[side] > meetings[side]);
        let [from, middle, to] = self.inner_parabola(StreetLine::Kerb);
        let beside = |place: &CurvePlace| {
            let [before, after] = [middle - from, to - middle].map(|way| way.dot(place.across));
            let part = if before == after { 0.5 } else { before / (before - after) };
            let kerb = on(&[from, middle, to], part);
            ((place.at - kerb).dot(place.across) >= least - EVEN).then_some(kerb)
        };
        if has_room { edge.iter().map(beside).collect() } else { None }
    }

    /// Returns the parabola (m) that touches a line of both streets on the inside of a bend.
    fn inner_parabola(&self, line: StreetLine) -> Parabola {
        let ([first, second], [a, b]) = (self.arms, self.arms.map(|arm| arm.aside(line)));
        let middle = left_of(first, self.meetings(line)[0], a);
        [left_of(first, self.reaches[0], a), middle, left_of(second, self.reaches[1], -b)]
    }

    /// Returns the kerb on the outside of a bend: a straight line past the junction from the end of one street's kerb
    /// to the end of the other's, with both turns rounded by parabolas. The kerb stays inside the convex hull of both
    /// streets and on its own side of the junction.
    fn outer_parabolas(&self) -> SmallVec<[Parabola; 2]> {
        let ([first, second], asides) = (self.arms, self.arms.map(|arm| arm.aside(StreetLine::Kerb)));
        let meetings = self.meetings(StreetLine::Kerb);
        // The wider street tapers before its end if the other street's edge would intersect its own edge there.
        let turns = [0, 1].map(|side| if meetings[side] > 0.0 { self.reaches[side] * TAPERED } else { 0.0 });
        let corners = [left_of(first, turns[0], asides[0]), left_of(second, turns[1], -asides[1])];
        let half = corners[0].distance(corners[1]) / 2.0;
        let legs =
            [0, 1].map(|side| (asides[side] * ROUNDED).min(half).min(self.reaches[side] - turns[side]));
        let toward = (corners[1] - corners[0]).normalize_or_zero();
        SmallVec::from_iter([
            [corners[0] + first.way * legs[0], corners[0], corners[0] + toward * legs[0]],
            [corners[1] - toward * legs[1], corners[1], corners[1] + second.way * legs[1]],
        ])
    }
}

/// Parabola: first end, intersection of the tangents at both ends, last end (m).
type Parabola = [DVec2; 3];

/// Point on a curve.
#[derive(Debug, Clone, Copy)]
struct CurvePlace {
    at: DVec2,
    /// Unit vector from the street to the block at this point.
    across: DVec2,
}

/// Returns the point (m) on a parabola at parameter `part`, from 0 at the first end to 1 at the last.
fn on([from, middle, to]: &Parabola, part: f64) -> DVec2 {
    from.lerp(*middle, part).lerp(middle.lerp(*to, part), part)
}

/// Returns points along a parabola, close enough that chords between them, and chords offset by up to `beside` (m),
/// deviate by at most [`DEVIATION`].
fn curve_places(parabola: &Parabola, beside: f64) -> impl Iterator<Item = CurvePlace> + use<> {
    let [from, middle, to] = *parabola;
    let (ahead, onward) = (middle - from, to - middle);
    let turn = ahead.perp_dot(onward).atan2(ahead.dot(onward));
    let bow = (onward - ahead).length() / 4.0 + beside * turn * turn / 8.0;
    let chords = chords((bow / DEVIATION).sqrt());
    (0..=chords).map(move |index| {
        let part = f64::from(index) / f64::from(chords);
        let way = ahead.lerp(onward, part).try_normalize().unwrap_or((to - from).normalize_or_zero());
        // The block is on the left of the second street as it arrives, so it is on the right in this direction.
        CurvePlace { at: on(&[from, middle, to], part), across: -way.perp() }
    })
}
