//! Rings of a cross-section: validated and cleaned user input.

use geo::line_intersection::{LineIntersection, line_intersection};
use geo::{Coord, Orientation};
use glam::DVec2;
use std::borrow::Cow;

use super::point::SectionPoint;
use super::simplify::corners;
use crate::limits::MOST;
use crate::planar::{Point, contains, coord, orientation, twice_area};
use burgeon_base::Stop;
use burgeon_base::error::{Error, Result};

/// A point with its position in the user's list, counted from 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct NumberedPoint {
    pub point: SectionPoint,
    pub number: usize,
}

impl Point for NumberedPoint {
    fn flat(self) -> DVec2 {
        self.point.at
    }
}

/// A ring with its name in error messages.
struct NamedRing {
    name: Cow<'static, str>,
    points: Vec<NumberedPoint>,
}

/// Owner and tolerances of rings.
#[derive(Debug, Clone, Copy)]
pub(crate) struct OutlineOptions {
    /// Name of the owner in error messages.
    pub owner: &'static str,
    /// Distance (m) within which points are merged.
    pub near: f64,
    /// Tolerance (m) of the simplification.
    ///
    /// The simplified ring stays within this distance of the input, except for the tips of spikes that are
    /// not wider and for merged points. If 0, only sharp points exactly between their neighbours are dropped.
    pub straight: f64,
}

/// Maximum width (m) of slits caused by rounding.
const ROUNDING: f64 = 1e-6;

/// Maximum distance (m) of an unnecessary point from the line between its neighbours.
const STRAIGHT: f64 = 1e-9;

/// Fractions of the requested tolerance that are tried in turn until no edges meet.
const FINER: [f64; 3] = [1.0, 0.25, 0.05];

const SECTION: OutlineOptions = OutlineOptions { owner: "cross-section", near: 1e-9, straight: 0.0 };

/// Returns cleaned closed rings: the outer ring counter-clockwise, then the holes clockwise.
///
/// Drops repeated points, and sharp points on a straight line between sharp points. Fails if a coordinate is
/// not finite, if a ring has fewer than 3 distinct points or no area, if rings cross or touch themselves or
/// each other, or if a hole is outside the outer ring or inside another hole.
pub(crate) fn closed(outer: &[SectionPoint], holes: &[Vec<SectionPoint>]) -> Result<Vec<Vec<SectionPoint>>> {
    let rings = numbered_rings(outer, holes, &SECTION)?;
    Ok(rings.into_iter().map(|ring| ring.into_iter().map(|point| point.point).collect()).collect())
}

/// Cleans rings like [`closed`], with the options of another owner, and keeps the numbers of the points.
pub(crate) fn numbered_rings(
    outer: &[SectionPoint],
    holes: &[Vec<SectionPoint>],
    manner: &OutlineOptions,
) -> Result<Vec<Vec<NumberedPoint>>> {
    let rings = rings_within(outer, holes, manner)?;
    refuse_misplaced_holes(&rings, manner)?;
    let turned = rings.into_iter().enumerate().map(|(index, ring)| {
        let mut points = ring.points;
        if (twice_area(points.iter().copied()) > 0.0) != (index == 0) {
            // The first point stays first because texture coordinates begin there.
            points[1..].reverse();
        }
        points
    });
    Ok(turned.collect())
}

/// Simplifies the rings so far that no edges meet; walls thinner than the tolerance need a finer one.
fn rings_within(
    outer: &[SectionPoint],
    holes: &[Vec<SectionPoint>],
    manner: &OutlineOptions,
) -> Result<Vec<NamedRing>> {
    let mut refused = None;
    let count = if manner.straight > 0.0 { FINER.len() } else { 1 };
    for finer in &FINER[..count] {
        let manner = OutlineOptions { straight: manner.straight * finer, ..*manner };
        let mut rings = vec![ring("the outer ring".into(), outer, false, &manner)?];
        for (index, hole) in holes.iter().enumerate() {
            rings.push(ring(format!("hole {}", index + 1).into(), hole, true, &manner)?);
        }
        match refuse_crossings(&rings, true, &manner) {
            Ok(()) => return Ok(rings),
            Err(error) => refused = refused.or(Some(error)),
        }
    }
    Err(refused.unwrap_or_else(|| Error::geometry("the outline cannot be simplified")))
}

/// Returns a cleaned open line of at least 2 distinct points; fails if it crosses or touches itself.
pub(crate) fn open(points: &[SectionPoint]) -> Result<Vec<SectionPoint>> {
    let name = "the line";
    let mut points = number_points(name, points, &SECTION)?;
    drop_repeated(&mut points, SECTION.near, false);
    if points.len() < 2 {
        return Err(Error::geometry("the line of an open cross-section has fewer than 2 distinct points")
            .help("give at least 2 distinct points"));
    }
    drop_straight(&mut points, false);
    let line = NamedRing { name: name.into(), points };
    refuse_crossings(std::slice::from_ref(&line), false, &SECTION)?;
    Ok(line.points.into_iter().map(|point| point.point).collect())
}

/// Returns true if the points form a valid hole, regardless of other rings.
pub(crate) fn is_hole(points: &[SectionPoint], manner: &OutlineOptions) -> bool {
    ring("".into(), points, true, manner).is_ok()
}

fn ring(
    name: Cow<'static, str>,
    points: &[SectionPoint],
    is_hole: bool,
    manner: &OutlineOptions,
) -> Result<NamedRing> {
    let owner = manner.owner;
    let mut points = number_points(&name, points, manner)?;
    let simplifies = manner.straight > 0.0;
    // The simplification compares with all input points.
    drop_repeated(&mut points, if simplifies { 0.0 } else { manner.near }, true);
    if points.len() < 3 {
        let count = points.len();
        return Err(Error::geometry(format!("{name} of the {owner} has {count} distinct points"))
            .help("give at least 3 points that differ"));
    }
    let [a, b] = [points[0].point.at, points[1].point.at];
    if points.iter().all(|point| orientation(a, b, point.point.at) == Orientation::Collinear) {
        return Err(Error::geometry(format!(
            "{name} of the {owner} has no area: its points lie on one line"
        ))
        .help(if simplifies {
            "move a point off the line"
        } else {
            "move a point off the line, or use an open cross-section"
        }));
    }
    if !simplifies {
        drop_straight(&mut points, true);
        return Ok(NamedRing { name, points });
    }
    points = corners(&points, manner.straight).into_iter().map(|place| points[place]).collect();
    let mut width = manner.straight;
    if points.len() > 2 {
        drop_repeated(&mut points, manner.near, true);
        width = if points.len() < 3 { manner.near } else { width };
        drop_spikes(&mut points, is_hole, manner);
    }
    if points.len() < 3 {
        return Err(Error::geometry(format!(
            "{name} of the {owner} is nowhere wider than {width} m, which is too narrow"
        ))
        .help("remove it"));
    }
    Ok(NamedRing { name, points })
}

fn number_points(name: &str, points: &[SectionPoint], manner: &OutlineOptions) -> Result<Vec<NumberedPoint>> {
    let owner = manner.owner;
    let number = |(index, &point): (usize, &SectionPoint)| {
        if point.at.is_finite() && point.at.abs().max_element() <= MOST {
            return Ok(NumberedPoint { point, number: index + 1 });
        }
        let (number, DVec2 { x, y }) = (index + 1, point.at);
        Err(Error::geometry(format!("point {number} of {name} of the {owner} is ({x}, {y})"))
            .help("give coordinates in metres, up to 1e9"))
    };
    points.iter().enumerate().map(number).collect()
}

/// Drops points within `near` (m) of the previous point; in a ring also across its end.
fn drop_repeated(points: &mut Vec<NumberedPoint>, near: f64, closed: bool) {
    points.dedup_by(|next, kept| is_same(next, kept, near));
    while closed && points.len() > 1 && is_same(&points[0], &points[points.len() - 1], near) {
        points.pop();
    }
}

/// Returns true if two points are within `near` (m) of each other.
fn is_same(a: &NumberedPoint, b: &NumberedPoint, near: f64) -> bool {
    a.point.at.distance_squared(b.point.at) <= near * near
}

/// Drops sharp points on a straight line between sharp points; they affect neither shape nor shading.
fn drop_straight(points: &mut Vec<NumberedPoint>, closed: bool) {
    let mut index = usize::from(!closed);
    while points.len() > 2 && index < points.len() - usize::from(!closed) {
        let [before, here, after] = around(points, index).map(|point| point.point);
        let sharp = !(before.smooth || here.smooth || after.smooth);
        let is_straight = || {
            orientation(before.at, here.at, after.at) == Orientation::Collinear
                && (here.at - before.at).dot(after.at - here.at) > 0.0
        };
        if sharp && is_straight() {
            points.remove(index);
        } else {
            index += 1;
        }
    }
}

/// Drops collinear points that remain after other points were dropped, and the tips of spikes.
///
/// A spike is a corner where one side lies along the other within the tolerance. Spikes into the area are
/// slits: other code fills them, unless they are only rounding errors.
fn drop_spikes(points: &mut Vec<NumberedPoint>, is_hole: bool, manner: &OutlineOptions) {
    let outwards = if (twice_area(points.iter().copied()) > 0.0) == is_hole { -1.0 } else { 1.0 };
    let mut index = 0;
    while points.len() > 2 && index < points.len() {
        let [before, here, after] = around(points, index).map(|point| point.point.at);
        let (a, b) = (here - before, after - here);
        let turn = a.perp_dot(b) * outwards;
        let width = if turn > 0.0 { manner.straight } else { ROUNDING };
        let longer = a.length().max(b.length());
        let is_tip = a.dot(b) < 0.0 && turn.abs() <= width * longer;
        let is_straight = a.dot(b) > 0.0 && turn.abs() <= STRAIGHT * longer;
        if is_tip || is_straight || a.length().min(b.length()) <= manner.near {
            points.remove(index);
            // The neighbours of a dropped tip may be new tips.
            index = index.saturating_sub(2);
        } else {
            index += 1;
        }
    }
}

/// Returns a point of a ring between its neighbours.
fn around(points: &[NumberedPoint], index: usize) -> [NumberedPoint; 3] {
    let count = points.len();
    [(index + count - 1) % count, index, (index + 1) % count].map(|index| points[index])
}

/// Number of edges between two checks for cancellation.
const STOP_EDGES: usize = 64;

/// An edge of a ring, identified by the indices of the ring and of its first point.
struct OutlineEdge {
    ring: usize,
    index: usize,
    line: geo::Line,
}

/// Fails if two edges share a point other than the common endpoint of consecutive edges.
fn refuse_crossings(rings: &[NamedRing], closed: bool, manner: &OutlineOptions) -> Result<()> {
    let owner = manner.owner;
    let mut edges = Vec::new();
    for (ring, NamedRing { points, .. }) in rings.iter().enumerate() {
        for index in 0..points.len() - usize::from(!closed) {
            let [start, end] = [points[index], points[(index + 1) % points.len()]].map(|p| coord(p.point.at));
            edges.push(OutlineEdge { ring, index, line: geo::Line::new(start, end) });
        }
    }
    // Sweep from left to right: each edge is compared only with edges that begin before it ends.
    let left = |edge: &OutlineEdge| edge.line.start.x.min(edge.line.end.x);
    edges.sort_by(|a, b| left(a).total_cmp(&left(b)));
    let stop = Stop::current();
    for (i, a) in edges.iter().enumerate() {
        if let Some(stop) = stop.as_ref().filter(|_| i % STOP_EDGES == 0) {
            stop.check()?;
        }
        let right = a.line.start.x.max(a.line.end.x);
        let [low, high] = [a.line.start.y.min(a.line.end.y), a.line.start.y.max(a.line.end.y)];
        for b in edges[i + 1..].iter().take_while(|b| left(b) <= right) {
            if b.line.start.y.min(b.line.end.y) > high || b.line.start.y.max(b.line.end.y) < low {
                continue;
            }
            let Some(place) = meeting(a, b, rings[a.ring].points.len(), closed) else { continue };
            let (a, b) = if (a.ring, a.index) < (b.ring, b.index) { (a, b) } else { (b, a) };
            let (first, second) = (edge_name(a, rings), edge_name(b, rings));
            let DVec2 { x, y } = place;
            let message = if a.ring == b.ring {
                let name = &rings[a.ring].name;
                format!("edges {first} and {second} of {name} of the {owner} meet at ({x:.3}, {y:.3})")
            } else {
                let (one, two) = (&rings[a.ring].name, &rings[b.ring].name);
                format!(
                    "edge {second} of {two} meets edge {first} of {one} of the {owner} at ({x:.3}, {y:.3})"
                )
            };
            return Err(Error::geometry(message)
                .help("edges are numbered by their points, from 1; move these points apart or remove some"));
        }
    }
    Ok(())
}

/// Returns the position (m) of a forbidden intersection of two edges.
fn meeting(a: &OutlineEdge, b: &OutlineEdge, count: usize, closed: bool) -> Option<DVec2> {
    let follows = |a: &OutlineEdge, b: &OutlineEdge| {
        b.index == a.index + 1 || (closed && b.index == 0 && a.index + 1 == count)
    };
    let neighbours = a.ring == b.ring && (follows(a, b) || follows(b, a));
    // Most pairs of edges are consecutive and share only their corner.
    if neighbours && turns(a.line, b.line) {
        return None;
    }
    match line_intersection(a.line, b.line)? {
        LineIntersection::SinglePoint { .. } if neighbours => None,
        LineIntersection::SinglePoint { intersection, .. } => Some(vector(intersection)),
        LineIntersection::Collinear { intersection } => Some(vector(intersection.start)),
    }
}

/// Returns true if two lines differ in direction by more than rounding errors.
fn turns(a: geo::Line, b: geo::Line) -> bool {
    let [u, v] = [a, b].map(|line| vector(line.end) - vector(line.start));
    let cross = u.perp_dot(v);
    cross * cross > 1e-18 * u.length_squared() * v.length_squared()
}

fn edge_name(edge: &OutlineEdge, rings: &[NamedRing]) -> String {
    let points = &rings[edge.ring].points;
    format!("{}-{}", points[edge.index].number, points[(edge.index + 1) % points.len()].number)
}

/// Fails if a hole is outside the first ring or inside another hole; rings do not intersect.
fn refuse_misplaced_holes(rings: &[NamedRing], manner: &OutlineOptions) -> Result<()> {
    for (index, hole) in rings.iter().enumerate().skip(1) {
        let DVec2 { x, y } = hole.points[0].point.at;
        for (other, around) in rings.iter().enumerate().filter(|&(other, _)| other != index) {
            if contains(&around.points, DVec2 { x, y }) == (other == 0) {
                continue;
            }
            let side = if other == 0 { "outside" } else { "inside" };
            let message = format!("{} of the {} is {side} {}", hole.name, manner.owner, around.name);
            return Err(Error::geometry(format!("{message}: it begins at ({x:.3}, {y:.3})"))
                .help("a hole lies inside the outer ring and outside the other holes"));
        }
    }
    Ok(())
}

fn vector(coord: Coord) -> DVec2 {
    DVec2::new(coord.x, coord.y)
}
