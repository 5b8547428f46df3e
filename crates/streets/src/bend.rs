//! The corners of bends: how the kerbs of a street that turns and changes its width there go over from one to the other.
//!
//! Growth asks for no more room than other corners take. What is left of the pieces beside the bend makes it smoother.

use std::f64::consts::PI;

use glam::DVec2;
use smallvec::SmallVec;

use crate::corner::{
    Corner, CornerShape, DEVIATION, EVEN, LINES, StreetLine, TAPER_LENGTH, apart, chords, left, meeting,
};

/// Where on the outside of a bend the wider street begins to taper, as a part of what the corner takes of it.
const TAPERED: f64 = 0.75;
/// How far (m) from a turn on the outside of a bend its rounding begins, for each metre from the middle of the street to its
/// kerb: from one on, it would be beyond the junction.
const ROUNDED: f64 = 0.8;
/// How much of the lesser of two widths there is at least where one goes over to the other.
const NARROW: f64 = 0.75;
/// Sidewalks that are narrower (m) end in a point.
const LEAST_WALK: f64 = 0.1;

impl Corner {
    /// How far (m) along its two streets the taper of one that turns and changes its width should reach; `None` where one
    /// does not narrow before the edges meet.
    ///
    /// Where the narrower street leaves through the end of the wider one, edges that go on until they meet are a lobe.
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

    /// How far (m) along its two streets the kerb around the outside of a bend should reach, so that it does not turn back.
    pub(crate) fn around_bend(&self) -> [f64; 2] {
        self.meetings(StreetLine::Kerb).map(|meeting| meeting.max(0.0) / TAPERED)
    }

    /// The same between streets that begin `reaches` (m) along their ways, where a street turns and may change its width.
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

    /// Whether straight tapers to both sides of a bend would leave less than most of the narrower street.
    fn is_narrow(&self) -> bool {
        let cut = self.reaches[0].max(self.reaches[1]) * ((self.angle - PI) / 2.0).sin().abs();
        LINES.iter().any(|line| {
            let [a, b] = self.arms.map(|arm| arm.aside(*line));
            f64::midpoint(a, b) - cut < a.min(b) * NARROW
        })
    }

    /// How far (m) along its two streets a line of both meets.
    fn meetings(&self, line: StreetLine) -> [f64; 2] {
        let [a, b] = self.arms.map(|arm| arm.aside(line));
        [meeting(self.angle, a, b), meeting(self.angle, b, a)]
    }

    /// The points (m) of both lines along a curve, of the edge and of the kerb, pair by pair across the sidewalk.
    pub(crate) fn curve(&self) -> Vec<[DVec2; 2]> {
        let [first, second] = self.arms;
        let is_inside = self.angle < PI;
        let widest = first.walk.max(second.walk);
        let parabolas =
            if is_inside { SmallVec::from_iter([self.inside(StreetLine::Edge)]) } else { self.outside() };
        let places: Vec<CurvePlace> = parabolas.iter().flat_map(|parabola| along(parabola, widest)).collect();
        if is_inside && let Some(kerb) = self.kerb_beside(&places) {
            return places.iter().zip(kerb).map(|(place, kerb)| [place.at, kerb]).collect();
        }
        // Beside the line that has the tighter bend, by how wide the sidewalk is: so it folds nowhere.
        let length: f64 = places.windows(2).map(|pair| pair[0].at.distance(pair[1].at)).sum();
        let (mut gone, mut last) = (0.0, places[0].at);
        let pair = |place: &CurvePlace| {
            gone += std::mem::replace(&mut last, place.at).distance(place.at);
            let share = gone / length.max(EVEN);
            // On the inside the sidewalk is that of the narrower street from where the edges of both would meet.
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

    /// The kerb (m) on the inside of a bend, by the parabola that touches those of both streets, as it has the directions of
    /// places on the edge; `None` where the sidewalk between would be too narrow.
    fn kerb_beside(&self, edge: &[CurvePlace]) -> Option<Vec<DVec2>> {
        let meetings = self.meetings(StreetLine::Kerb);
        let least = self.arms[0].walk.min(self.arms[1].walk) * NARROW;
        let has_room = least > LEAST_WALK && (0..2).all(|side| self.reaches[side] > meetings[side]);
        let [from, middle, to] = self.inside(StreetLine::Kerb);
        let beside = |place: &CurvePlace| {
            let [before, after] = [middle - from, to - middle].map(|way| way.dot(place.across));
            let part = if before == after { 0.5 } else { before / (before - after) };
            let kerb = on(&[from, middle, to], part);
            ((place.at - kerb).dot(place.across) >= least - EVEN).then_some(kerb)
        };
        if has_room { edge.iter().map(beside).collect() } else { None }
    }

    /// The ends of a parabola that touches a line of both streets on the inside of a bend, and where its tangents meet (m).
    fn inside(&self, line: StreetLine) -> Parabola {
        let ([first, second], [a, b]) = (self.arms, self.arms.map(|arm| arm.aside(line)));
        let middle = left(first, self.meetings(line)[0], a);
        [left(first, self.reaches[0], a), middle, left(second, self.reaches[1], -b)]
    }

    /// The kerb on the outside of a bend: straight from the end of one street's kerb, beside the junction, to that of the
    /// other, with both turns rounded by parabolas. Nothing of it lies outside of what both streets span, nor on the other
    /// side of the junction.
    fn outside(&self) -> SmallVec<[Parabola; 2]> {
        let ([first, second], asides) = (self.arms, self.arms.map(|arm| arm.aside(StreetLine::Kerb)));
        let meetings = self.meetings(StreetLine::Kerb);
        // The wider of two streets tapers before its end if the other one's edge would meet its own there.
        let turns = [0, 1].map(|side| if meetings[side] > 0.0 { self.reaches[side] * TAPERED } else { 0.0 });
        let corners = [left(first, turns[0], asides[0]), left(second, turns[1], -asides[1])];
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

/// The ends of a parabola, and between them where its tangents there meet (m).
type Parabola = [DVec2; 3];

/// A place on a curve.
#[derive(Debug, Clone, Copy)]
struct CurvePlace {
    at: DVec2,
    /// The direction from the street to the block there, of length 1.
    across: DVec2,
}

/// The place (m) on a parabola that is a part of the way from its first end to its last.
fn on([from, middle, to]: &Parabola, part: f64) -> DVec2 {
    from.lerp(*middle, part).lerp(middle.lerp(*to, part), part)
}

/// Places along a parabola, so that chords between them, and between those up to so far (m) beside them, are near it.
fn along(parabola: &Parabola, beside: f64) -> impl Iterator<Item = CurvePlace> + use<> {
    let [from, middle, to] = *parabola;
    let (ahead, onward) = (middle - from, to - middle);
    let turn = ahead.perp_dot(onward).atan2(ahead.dot(onward));
    let bow = (onward - ahead).length() / 4.0 + beside * turn * turn / 8.0;
    let chords = chords((bow / DEVIATION).sqrt());
    (0..=chords).map(move |index| {
        let part = f64::from(index) / f64::from(chords);
        let way = ahead.lerp(onward, part).try_normalize().unwrap_or((to - from).normalize_or_zero());
        // The block lies on the left of who comes by the second street, and so on the right of this way.
        CurvePlace { at: on(&[from, middle, to], part), across: -way.perp() }
    })
}
