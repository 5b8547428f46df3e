//! Carriageway and median of a segment: rows of points across it, and triangles between rows.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec2, DVec3};

use super::parts::{Median, StreetSurface};
use crate::plan::corner::StreetLine;
use crate::plan::network::PieceId;
use crate::shape::profile::StreetProfiles;
use crate::shape::shapes::{ArmShape, SAME, StreetShapes};
use burgeon_geometry::Line;

/// Number of chords in a quarter circle at the round end of a median.
const NOSE: u32 = 4;
/// Minimum length (m) of a median, excluding its round ends.
const LEAST_MEDIAN: f64 = 4.0;
/// Minimum length (m) of a median, in addition to half of its width, if it continues from the next segment.
const LEAST_NOSE: f64 = 0.6;
/// Distance (m) of a median from the end of a segment at a junction where pedestrians cross the street.
pub(crate) const MEDIAN_MARGIN: f64 = 6.0;

/// Segment as rows between its junctions.
pub(crate) struct PieceRows<'a> {
    profiles: &'a StreetProfiles,
    piece: PieceId,
    depth: u32,
    start: DVec2,
    way: DVec2,
    rows: Vec<PieceRow>,
}

/// Points (m) across a segment, on its right and on its left.
#[derive(Debug, Clone, Copy)]
struct PieceRow {
    sides: [DVec2; 2],
    /// Points of the median, if any.
    median: Option<[DVec2; 2]>,
    height: f64,
}

/// Start or end of the median of a segment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum MedianEnd {
    /// Continues in the next segment.
    Through,
    /// Round end at this distance (m) along the segment.
    Round(f64),
}

/// Returns the start and end of the median of a segment; `None` if there is none.
pub(crate) fn median_of(shapes: &StreetShapes<'_>, piece: PieceId) -> Option<[MedianEnd; 2]> {
    let network = shapes.network;
    let median = network.attributes(piece).median;
    if median <= 0.0 {
        return None;
    }
    let (length, ends) = (network.length(piece), network.ends(piece));
    let goes_on = ends.map(|end| {
        let shape = shapes.junction(end);
        let same = |piece| (network.attributes(piece).median - median).abs() < 1e-9;
        // Either both segments continue the median or neither, so each must have space for the other end.
        let fits = |piece| shapes.room(piece) >= median / 2.0 + LEAST_NOSE;
        shape.is_mitred && shape.arms.iter().all(|arm| same(arm.piece) && fits(arm.piece))
    });
    // A median that continues from the next segment ends where its round end fits, even close to the junction.
    let room = match goes_on {
        [false, false] => f64::INFINITY,
        _ => shapes.room(piece) - median / 2.0 - LEAST_NOSE / 2.0,
    };
    let tips = [0, 1].map(|side| {
        let margin = if shapes.junction(ends[side]).arms.len() > 2 { MEDIAN_MARGIN } else { 1.0 };
        shapes.arm(ends[side], piece).map_or(0.0, ArmShape::clear) + margin.min(room)
    });
    if goes_on == [false; 2] && length - tips[0] - tips[1] - median < LEAST_MEDIAN {
        return None;
    }
    Some([0, 1].map(|side| match (goes_on[side], side) {
        (true, _) => MedianEnd::Through,
        (false, 0) => MedianEnd::Round(tips[0]),
        (false, _) => MedianEnd::Round(length - tips[1]),
    }))
}

/// Returns the positions (m) of rows along a segment, excluding its ends, and the range in which its median has full
/// width.
pub(crate) fn alongs_of(
    shapes: &StreetShapes<'_>,
    profiles: &StreetProfiles,
    piece: PieceId,
) -> (Vec<f64>, [f64; 2]) {
    let network = shapes.network;
    let (length, aside) = (network.length(piece), network.attributes(piece).median / 2.0);
    let mut alongs: Vec<f64> = profiles.stations(piece).iter().map(|[along, _]| *along).collect();
    // Range in which the median has full width.
    let mut stretch = [f64::INFINITY, f64::NEG_INFINITY];
    if let Some(ends) = median_of(shapes, piece) {
        stretch = [f64::NEG_INFINITY, f64::INFINITY];
        for (side, end) in ends.into_iter().enumerate() {
            if let MedianEnd::Round(tip) = end {
                stretch[side] = if side == 0 { tip + aside } else { tip - aside };
                alongs.push(stretch[side]);
                // No row is within the round end.
                alongs.retain(|along| {
                    let into = if side == 0 { along - tip } else { tip - along };
                    *along == stretch[side] || !(-SAME..aside + SAME).contains(&into)
                });
            }
        }
    }
    alongs.sort_by(f64::total_cmp);
    alongs.dedup_by(|a, b| (*a - *b).abs() < SAME);
    let begin = network.ends(piece).map(|end| shapes.arm(end, piece).map_or(0.0, ArmShape::first_row));
    let inside = begin[0]..=length - begin[1];
    alongs.retain(|along| inside.contains(along));
    (alongs, stretch)
}

impl<'a> PieceRows<'a> {
    pub(crate) fn new(shapes: &StreetShapes<'_>, profiles: &'a StreetProfiles, piece: PieceId) -> Self {
        let network = shapes.network;
        let attributes = network.attributes(piece);
        let [start, stop] = network.line(piece);
        let way = (stop - start).normalize_or_zero();
        let half = attributes.arm(way).aside(StreetLine::Kerb);
        let aside = attributes.median / 2.0;
        let ends = network.ends(piece);
        let median = median_of(shapes, piece);
        let (alongs, stretch) = alongs_of(shapes, profiles, piece);
        let row = |along: f64| {
            let at = start + way * along;
            let across = |aside: f64| [at - way.perp() * aside, at + way.perp() * aside];
            PieceRow {
                sides: across(half),
                median: (stretch[0]..=stretch[1]).contains(&along).then(|| across(aside)),
                height: profiles.height_along(piece, along),
            }
        };
        let end = |side: usize| {
            let sign = if side == 0 { 1.0 } else { -1.0 };
            let across =
                |aside: f64| [-aside, aside].map(|aside| shapes.end(ends[side], piece, sign * aside));
            let through = median.is_some_and(|ends| ends[side] == MedianEnd::Through);
            PieceRow {
                sides: across(half),
                median: through.then(|| across(aside)),
                height: profiles.junction(ends[side]),
            }
        };
        let mut rows = vec![end(0)];
        rows.extend(alongs.into_iter().map(row));
        rows.push(end(1));
        Self { profiles, piece, depth: attributes.depth, start, way, rows }
    }

    /// Returns an empty surface for the segment.
    fn surface(&self) -> StreetSurface {
        StreetSurface { piece: Some(self.piece), depth: self.depth, ..StreetSurface::default() }
    }

    /// Returns the carriageway.
    pub(crate) fn carriageway(&self) -> StreetSurface {
        let mut into = self.surface();
        for pair in self.rows.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            if from.sides == to.sides {
                continue;
            }
            let [right, left] = from.sides.map(|at| add(&mut into, at, from.height));
            let [far_right, far_left] = to.sides.map(|at| add(&mut into, at, to.height));
            match (from.median, to.median) {
                (None, None) => quad(&mut into, [right, far_right, far_left, left]),
                (Some(here), Some(there)) => {
                    let [a, b] = here.map(|at| add(&mut into, at, from.height));
                    let [c, d] = there.map(|at| add(&mut into, at, to.height));
                    quad(&mut into, [right, far_right, c, a]);
                    quad(&mut into, [b, d, far_left, left]);
                }
                (None, Some(there)) => {
                    let nose = self.nose(there, -1.0, &mut into);
                    let tip = nose.len() / 2;
                    into.triangles.push([right, nose[tip], left]);
                    // From the tip to the left and to the right.
                    into.triangles.extend(nose[tip..].windows(2).map(|pair| [left, pair[0], pair[1]]));
                    into.triangles.push([left, nose[nose.len() - 1], far_left]);
                    into.triangles.extend(nose[..=tip].windows(2).map(|pair| [right, pair[0], pair[1]]));
                    into.triangles.push([right, far_right, nose[0]]);
                }
                (Some(here), None) => {
                    let nose = self.nose(here, 1.0, &mut into);
                    let tip = nose.len() / 2;
                    into.triangles.push([far_left, nose[tip], far_right]);
                    into.triangles.extend(nose[tip..].windows(2).map(|pair| [far_left, pair[1], pair[0]]));
                    into.triangles.push([left, nose[nose.len() - 1], far_left]);
                    into.triangles.extend(nose[..=tip].windows(2).map(|pair| [far_right, pair[1], pair[0]]));
                    into.triangles.push([right, far_right, nose[0]]);
                }
            }
        }
        into
    }

    /// Returns the median.
    pub(crate) fn median(&self) -> Option<Median> {
        let mut median = Median { top: self.surface(), kerbs: vec![] };
        let mut lines = [Vec::new(), Vec::new()];
        let mut noses = [Vec::new(), Vec::new()];
        for pair in self.rows.windows(2) {
            match (pair[0].median, pair[1].median) {
                (Some(here), Some(there)) => {
                    let [a, b] = here.map(|at| add(&mut median.top, at, pair[0].height));
                    let [c, d] = there.map(|at| add(&mut median.top, at, pair[1].height));
                    quad(&mut median.top, [a, c, d, b]);
                    if lines[0].is_empty() {
                        lines = [0, 1].map(|side| vec![here[side].extend(pair[0].height)]);
                    }
                    for side in 0..2 {
                        lines[side].push(there[side].extend(pair[1].height));
                    }
                }
                (None, Some(there)) => {
                    let nose = self.nose(there, -1.0, &mut median.top);
                    // From the left around the tip to the right.
                    median
                        .top
                        .triangles
                        .extend((1..nose.len() - 1).map(|index| [nose[0], nose[index + 1], nose[index]]));
                    noses[0] = nose.iter().rev().map(|at| median.top.points[*at as usize]).collect();
                }
                (Some(here), None) => {
                    let nose = self.nose(here, 1.0, &mut median.top);
                    median
                        .top
                        .triangles
                        .extend((1..nose.len() - 1).map(|index| [nose[0], nose[index], nose[index + 1]]));
                    noses[1] = nose.iter().map(|at| median.top.points[*at as usize]).collect();
                }
                (None, None) => {}
            }
        }
        if median.top.triangles.is_empty() {
            return None;
        }
        // Counter-clockwise around the median: along its right side, around the far end, back along its left side,
        // around the near end.
        let [right, mut left] = lines;
        left.reverse();
        let [near, far] = noses;
        let mut ring: Vec<DVec3> = Vec::new();
        let mut open = Vec::new();
        let has_far = !far.is_empty();
        for (part, is_there) in [(right, true), (far, has_far), (left, true)] {
            if !is_there {
                open.push(std::mem::take(&mut ring));
            }
            ring.extend(part);
        }
        if near.is_empty() {
            open.push(ring);
        } else {
            ring.extend(near);
            match open.first_mut() {
                // The ring began in the middle of the line that the near end continues.
                Some(first) => {
                    ring.append(first);
                    *first = ring;
                }
                None => {
                    if let Some(first) = ring.first().copied() {
                        ring.push(first);
                    }
                    open.push(ring);
                }
            }
        }
        for line in &mut open {
            line.dedup_by(|a, b| a.distance(*b) < 1e-9);
        }
        median.kerbs = open.into_iter().filter_map(Line::without_repeats).collect();
        Some(median)
    }

    /// Returns the round end of a median, from right to left; the two points bound its full width. The sign of `ahead`
    /// gives the direction in which the end extends.
    fn nose(&self, [right, left]: [DVec2; 2], ahead: f64, into: &mut StreetSurface) -> Vec<u32> {
        let (middle, radius) = ((right + left) / 2.0, right.distance(left) / 2.0);
        let count = 2 * NOSE;
        let at = |index: u32| match index {
            0 => right,
            _ if index == count => left,
            _ => {
                let angle = (f64::from(index) / f64::from(NOSE) - 1.0) * FRAC_PI_2;
                middle + self.way * (angle.cos() * radius * ahead) + self.way.perp() * (angle.sin() * radius)
            }
        };
        (0..=count)
            .map(|index| {
                let at = at(index);
                let height = self.profiles.height_along(self.piece, (at - self.start).dot(self.way));
                add(into, at, height)
            })
            .collect()
    }
}

fn add(into: &mut StreetSurface, at: DVec2, height: f64) -> u32 {
    let at = at.extend(height);
    // A row shares its points with the previous row.
    let from = into.points.len().saturating_sub(2 * (2 * NOSE as usize + 1) + 8);
    if let Some(known) = into.points[from..].iter().position(|known| *known == at) {
        return u32::try_from(from + known).unwrap_or(u32::MAX);
    }
    into.points.push(at);
    u32::try_from(into.points.len() - 1).unwrap_or(u32::MAX)
}

fn quad(into: &mut StreetSurface, [a, b, c, d]: [u32; 4]) {
    // Next to a bend, a side may collapse to a single point.
    let triangles = [[a, b, c], [a, c, d]];
    into.triangles.extend(triangles.into_iter().filter(|[a, b, c]| a != b && b != c && c != a));
}
