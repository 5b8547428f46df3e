//! Parts that cover the streets of a level: a rectangle for each segment, plus bends, corners and ends.

use std::f64::consts::{PI, TAU};

use glam::DVec2;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use crate::plan::corner::{Arm, Corner, LINES, StreetLine, left_of, meeting, pieces, turn};
use crate::plan::merge_cache::MergeOptions;
use crate::plan::network::{JunctionId, PieceId, StreetNetwork};
use crate::shape::shapes::room_around;
use burgeon_geometry::planar::contains;

/// Angle (radians) below which a bend has a mitre instead of an arc.
const MITRED: f64 = 0.35;
/// Radius (m) below which a corner is cut off straight, at this distance (m).
const LEAST_RADIUS: f64 = 1.0;
/// Maximum fraction of a segment that its corners may take.
const SHARE: f64 = 0.9;

/// Area covered by a street.
#[derive(Debug, Clone)]
pub(super) struct CoverPart {
    /// `Kerb` for a part of the carriageway, `Edge` for a part of the whole street.
    pub(super) line: StreetLine,
    pub(super) depth: u32,
    /// Outline (m), counter-clockwise.
    pub(super) ring: Vec<DVec2>,
}

/// Parts of a level, and parts of the streets on the ground at its ends.
pub(super) struct CoverIndex {
    pub(super) parts: Vec<CoverPart>,
    index: RTree<GeomWithData<Rectangle<[f64; 2]>, usize>>,
    /// Number of parts that belong to the level itself; the other parts are subtracted.
    own: usize,
}

/// Surface at a position.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum StreetCover {
    /// No street.
    Free,
    /// Sidewalk.
    Walk,
    /// Carriageway of a street of this depth.
    Carriageway(u32),
}

impl CoverIndex {
    pub(super) fn new(network: &StreetNetwork, level: i32, options: MergeOptions) -> Self {
        let mut parts = parts_of(network, options, |of| of == level, |_| true);
        let own = parts.len();
        if level > 0 {
            // Where the level meets the ground, it ends at the streets there.
            let is_end = |junction: JunctionId| {
                let levels = || {
                    network.junctions[junction as usize]
                        .pieces
                        .iter()
                        .map(|piece| network.attributes(*piece).level)
                };
                levels().any(|of| of == level) && levels().any(|of| (0..level).contains(&of))
            };
            parts.extend(parts_of(network, options, |of| (0..level).contains(&of), is_end));
        }
        let boxes = parts.iter().enumerate().map(|(number, part)| {
            let low = part.ring.iter().copied().fold(DVec2::INFINITY, DVec2::min);
            let high = part.ring.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
            GeomWithData::new(Rectangle::from_corners(low.to_array(), high.to_array()), number)
        });
        let index = RTree::bulk_load(boxes.collect());
        Self { parts, index, own }
    }

    /// Returns the surface at a position.
    pub(super) fn at(&self, place: DVec2) -> StreetCover {
        let mut covered = StreetCover::Free;
        for item in self.index.locate_in_envelope_intersecting(&AABB::from_point(place.to_array())) {
            let part = &self.parts[item.data];
            if !contains(&part.ring, place) {
                continue;
            }
            if item.data >= self.own {
                return StreetCover::Free;
            }
            covered = match (part.line, covered) {
                (StreetLine::Kerb, StreetCover::Carriageway(depth)) => {
                    StreetCover::Carriageway(depth.min(part.depth))
                }
                (StreetLine::Kerb, _) => StreetCover::Carriageway(part.depth),
                (StreetLine::Edge, StreetCover::Free) => StreetCover::Walk,
                (StreetLine::Edge, known) => known,
            };
        }
        covered
    }
}

/// Returns the parts of the streets of some levels at some junctions.
fn parts_of(
    network: &StreetNetwork,
    options: MergeOptions,
    is_level: impl Fn(i32) -> bool,
    is_at: impl Fn(JunctionId) -> bool,
) -> Vec<CoverPart> {
    let mut parts = Vec::new();
    for (piece, known) in network.pieces() {
        let attributes = known.attributes;
        if !is_level(attributes.level) || !known.ends.iter().any(|end| is_at(*end)) {
            continue;
        }
        let [a, b] = network.line(piece);
        let way = (b - a).normalize_or_zero();
        for line in LINES {
            let aside = way.perp() * attributes.arm(way).aside(line);
            let ring = vec![a - aside, b - aside, b + aside, a + aside];
            parts.push(CoverPart { line, depth: attributes.depth, ring });
        }
    }
    for (junction, known) in (0..).zip(&network.junctions) {
        let home = known
            .pieces
            .iter()
            .map(|piece| network.attributes(*piece).level)
            .filter(|level| *level >= 0)
            .min();
        if home.is_some_and(&is_level) && is_at(junction) {
            junction_parts(network, junction, options, &mut parts);
        }
    }
    parts
}

/// Adds the parts between the rectangles of the streets at a junction.
fn junction_parts(
    network: &StreetNetwork,
    junction: JunctionId,
    options: MergeOptions,
    parts: &mut Vec<CoverPart>,
) {
    let at = network.at(junction);
    let all = network.corner_arms(junction);
    let arms: Vec<(PieceId, Arm)> =
        all.iter().copied().filter(|(piece, _)| network.attributes(*piece).level >= 0).collect();
    let depth = |index: usize| network.attributes(arms[index].0).depth;
    if let [(piece, arm)] = arms[..] {
        // The mouth of a tunnel remains open.
        if all.len() == 1 && !network.constraints.square_ends {
            let far = network.across(piece, junction);
            let room = network.length(piece)
                * if network.junctions[far as usize].degree() == 1 { 0.45 } else { 0.8 };
            let radius = options.turning.min(room).min(room_around(network, junction, options.turning));
            let corner = Corner::around(arm, radius);
            for line in LINES {
                let ring: Vec<DVec2> = corner.points(line).into_iter().map(|point| at + point).collect();
                parts.push(CoverPart { line, depth: depth(0), ring });
            }
        }
        return;
    }
    for index in 0..arms.len() {
        let next = (index + 1) % arms.len();
        let ((piece, first), (beside, second)) = (arms[index], arms[next]);
        let angle = if arms.len() == 1 { TAU } else { turn(first.way, second.way) };
        let room = [piece, beside].map(|piece| network.length(piece) * SHARE);
        for line in LINES {
            let ring = if angle > PI {
                wedge(first, second, angle, line)
            } else {
                let radius = match line {
                    StreetLine::Edge => network.constraints.corner,
                    StreetLine::Kerb => network.constraints.corner + first.walk.min(second.walk),
                };
                match fillet([first, second], angle, line, radius, room) {
                    Some(ring) => ring,
                    None => continue,
                }
            };
            let ring = ring.into_iter().map(|point| at + point).collect();
            parts.push(CoverPart { line, depth: depth(index).min(depth(next)), ring });
        }
    }
}

/// Returns the part added by the outside of a bend, relative to the junction.
fn wedge(first: Arm, second: Arm, angle: f64, line: StreetLine) -> Vec<DVec2> {
    let (a, b) = (first.aside(line), second.aside(line));
    let swept = angle - PI;
    let from = first.way.perp().to_angle();
    let mut ring = vec![DVec2::ZERO, left_of(first, 0.0, a)];
    if swept < MITRED && (a - b).abs() < 0.01 {
        ring.push(DVec2::from_angle(from + swept / 2.0) * (a / (swept / 2.0).cos()));
    } else {
        let chords = pieces(swept, first.half.max(second.half));
        ring.extend((1..chords).map(|index| {
            let part = f64::from(index) / f64::from(chords);
            DVec2::from_angle(from + swept * part) * (a + (b - a) * part)
        }));
    }
    ring.push(left_of(second, 0.0, -b));
    ring
}

/// Returns the part added by the rounding of a corner, relative to the junction; `None` if there is no space.
fn fillet(
    [first, second]: [Arm; 2],
    angle: f64,
    line: StreetLine,
    radius: f64,
    room: [f64; 2],
) -> Option<Vec<DVec2>> {
    if !(0.02..=PI - MITRED).contains(&angle) {
        return None;
    }
    let (a, b) = (first.aside(line), second.aside(line));
    let meets = [meeting(angle, a, b), meeting(angle, b, a)];
    let free = (room[0] - meets[0]).min(room[1] - meets[1]);
    if meets.iter().any(|along| *along < 0.0) || free <= 0.0 {
        return None;
    }
    let tangent = (angle / 2.0).tan();
    let round = radius.min(free * tangent);
    let corner = left_of(first, meets[0], a);
    if round < LEAST_RADIUS {
        // At this distance from the corner, the area behind is wide enough to be visible.
        let along = free.min(LEAST_RADIUS / tangent);
        return Some(vec![
            corner,
            left_of(first, meets[0] + along, a),
            left_of(second, meets[1] + along, -b),
        ]);
    }
    let along = round / tangent;
    let center = left_of(first, meets[0] + along, a + round);
    let swept = PI - angle;
    let from = (-first.way.perp()).to_angle();
    let chords = pieces(swept, radius);
    let mut ring = vec![corner, left_of(first, meets[0] + along, a)];
    ring.extend((1..chords).map(|index| {
        center + DVec2::from_angle(from - swept * f64::from(index) / f64::from(chords)) * round
    }));
    ring.push(left_of(second, meets[1] + along, -b));
    Some(ring)
}
