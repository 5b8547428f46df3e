//! Repair of plans whose rings cross or touch: the enclosed area is computed again.
//!
//! Method: Boolean operations on polygons (i_overlay, through `geo`) around the centre of the rings. If the
//! enclosed area still touches itself, a notch is cut out at that point.

use glam::{DVec2, DVec3};
use rstar::primitives::{GeomWithData, Line};
use rstar::{AABB, PointDistance, RTree};

use super::slits::{self, Slit};
use crate::cross_section::outline::{OutlineOptions, is_hole, numbered_rings};
use crate::cross_section::point::SectionPoint;
use crate::limits::MOST;
use crate::overlay::{self, Fill, PolygonArea, unite};
use crate::planar::{Polygon, Rings, edges, foot, twice_area};
use burgeon_base::Stop;
use burgeon_base::error::Result;

/// Half of the width (m) of the notch where a plan touches itself.
const NOTCH: f64 = 0.05;
/// Minimum area (m²) of a part.
const LEAST: f64 = 0.01;
/// Maximum distance (m) from an edge at which a point touches it; `NEAR` applies if no point is within
/// `TOUCHING`.
const TOUCHING: f64 = 1e-6;
const NEAR: f64 = 0.012;
/// Maximum number of rounds of fills and notches.
const ROUNDS: usize = 6;
/// Maximum distance (m) of an edge of the plan from its input edge.
const ALONG: f64 = 0.02;

/// Maximum number of intersections per edge, other than shared endpoints; small plans may have `FEW_MEETINGS`
/// in total.
const MEETINGS: usize = 8;
const FEW_MEETINGS: usize = 10_000;

/// Note for a plan whose slits were filled.
const SLITS: &str = "slits of at most 1 cm filled";
/// Note for a plan with notches.
const NOTCHED: &str = "a notch cut where it touches itself";
/// Note for an outer ring that crosses itself.
const LOOPS: &str = "loops of the outer ring removed";

/// A repaired plan.
pub(super) struct PlanRepair {
    pub polygon: Polygon<DVec3>,
    /// Input edges that each edge of all rings corresponds to.
    pub given: Vec<Vec<usize>>,
    /// Notes about the repairs.
    pub notes: Vec<&'static str>,
    /// First filled slit, if any.
    pub slit: Option<Slit>,
}

/// Computes the largest part of the first ring minus the other rings; `None` if no valid plan remains, or if
/// the rings intersect too often.
pub(super) fn repair(given: &Rings, manner: &OutlineOptions) -> Option<PlanRepair> {
    let known = |point: &DVec3| point.is_finite() && point.truncate().abs().max_element() <= MOST;
    if !given.iter().flatten().all(known) {
        return None;
    }
    let middle = middle_of(given)?;
    let local = rings_around(given, middle);
    if meets_too_often(&local) {
        return None;
    }
    let mut notes = Vec::new();
    let area = enclosed_area(&local, &mut notes).ok()?;
    settle(area, notes, given, middle, manner)
}

/// Fills the slits of a plan of valid rings; `None` if it has no slits, or if no valid plan remains.
pub(super) fn fill(given: &Rings, sound: &[Vec<DVec2>], manner: &OutlineOptions) -> Option<PlanRepair> {
    if slits::find(sound, manner).is_empty() {
        return None;
    }
    let middle = middle_of(given)?;
    let sound: Rings<DVec2> = sound.iter().map(|ring| ring.iter().map(|at| *at - middle).collect()).collect();
    settle(vec![sound], Vec::new(), given, middle, manner)
}

/// Returns the centre (m) of the bounding box of the first ring.
fn middle_of(given: &Rings) -> Option<DVec2> {
    let mut points = given.first()?.iter().map(|point| point.truncate());
    let first = points.next()?;
    let [low, high] = points.fold([first; 2], |[low, high], point| [low.min(point), high.max(point)]);
    Some(low.midpoint(high))
}

/// Returns the rings projected onto the horizontal plane, relative to `middle`.
fn rings_around(given: &Rings, middle: DVec2) -> Rings<DVec2> {
    given.iter().map(|ring| ring.iter().map(|point| point.truncate() - middle).collect()).collect()
}

/// Makes a plan of the largest part of an area around `middle`: fills its slits, and cuts notches where it
/// touches itself.
fn settle(
    mut area: PolygonArea,
    mut notes: Vec<&'static str>,
    given: &Rings,
    middle: DVec2,
    manner: &OutlineOptions,
) -> Option<PlanRepair> {
    let local = rings_around(given, middle);
    let mut slit: Option<Slit> = None;
    for _ in 0..ROUNDS {
        let whole = greatest(area, &mut notes)?;
        let rings = rings_of(&whole, manner);
        if let Some(clean) = clean_polygon(&rings, manner) {
            let slits = slits::find(&clean, manner);
            if let Some(first) = slits.first() {
                slit.get_or_insert(Slit { ends: first.ends.map(|end| end + middle), ..*first });
                let filled = slits.iter().map(|slit| counter_clockwise(slit.corners.to_vec()));
                area = unite(filled.chain([Rings::from(&clean)]).collect()).ok()?;
                note(&mut notes, SLITS);
                continue;
            }
            // Rings that are apart only by rounding would be merged when a roof is built.
            let touching = notches(&Rings::from(&clean), TOUCHING);
            if !touching.is_empty() {
                area = overlay::overlay(&[whole], &touching, |[inside, notch]| inside && !notch).ok()?;
                note(&mut notes, NOTCHED);
                continue;
            }
            let done = finish(&clean, &local, given, middle);
            // An area that touches itself up to rounding may do so again at its original position.
            if let Some((polygon, given)) = done
                && clean_polygon(&Rings::from(&polygon.flat()), manner).is_some()
            {
                if notes.is_empty() {
                    notes.push("edges that cross or touch untangled");
                }
                return Some(PlanRepair { polygon, given, notes, slit });
            }
        }
        let notches = [TOUCHING, NEAR].map(|near| notches(&rings, near));
        let notches = notches.into_iter().find(|notches| !notches.is_empty())?;
        area = overlay::overlay(&[whole], &notches, |[inside, notch]| inside && !notch).ok()?;
        note(&mut notes, NOTCHED);
    }
    None
}

/// Returns true if the edges of rings intersect more often than those of any plausible outline, so that the
/// enclosed area would have many times the size of the input.
///
/// A sweep over the sorted edges ends as soon as the limit is exceeded.
fn meets_too_often(rings: &Rings<DVec2>) -> bool {
    let mut edges: Vec<[DVec2; 2]> = rings.iter().flat_map(|ring| edges(ring)).collect();
    let length = edges.iter().fold(DVec2::ZERO, |sum, [a, b]| sum + (*b - *a).abs());
    if length.x > length.y {
        // Sort along the axis on which the edges overlap less.
        edges.iter_mut().flatten().for_each(|point| *point = DVec2::new(point.y, point.x));
    }
    let low = |[a, b]: &[DVec2; 2]| a.min(*b);
    let high = |[a, b]: &[DVec2; 2]| a.max(*b);
    edges.sort_by(|a, b| low(a).x.total_cmp(&low(b).x));
    let mut left = FEW_MEETINGS.max(MEETINGS * edges.len());
    let stop = Stop::current();
    for (index, a) in edges.iter().enumerate() {
        // The cancelled run ends with its own error.
        if stop.as_ref().is_some_and(|stop| stop.is_stopped()) {
            return true;
        }
        for b in edges[index + 1..].iter().take_while(|b| low(b).x <= high(a).x) {
            if low(a).y > high(b).y || low(b).y > high(a).y {
                continue;
            }
            let side = |[from, to]: &[DVec2; 2], at: DVec2| (*to - *from).perp_dot(at - *from);
            let apart = |one: f64, two: f64| (one > 0.0 && two > 0.0) || (one < 0.0 && two < 0.0);
            let joined = b.iter().any(|end| a.contains(end));
            if joined || apart(side(a, b[0]), side(a, b[1])) || apart(side(b, a[0]), side(b, a[1])) {
                continue;
            }
            if left == 0 {
                return true;
            }
            left -= 1;
        }
    }
    false
}

/// Returns the simplified points of valid rings; `None` if the rings intersect.
fn clean_polygon(rings: &Rings<DVec2>, manner: &OutlineOptions) -> Option<Polygon> {
    let sharp: Vec<Vec<SectionPoint>> =
        rings.iter().map(|ring| ring.iter().copied().map(SectionPoint::sharp).collect()).collect();
    let (outer, holes) = sharp.split_first()?;
    let clean = numbered_rings(outer, holes, manner).ok()?;
    let places = clean.iter().map(|ring| ring.iter().map(|point| point.point.at).collect());
    Polygon::new(places.collect::<Rings<DVec2>>()).ok()
}

fn note(notes: &mut Vec<&'static str>, what: &'static str) {
    if !notes.contains(&what) {
        notes.push(what);
    }
}

/// Computes the area enclosed by the first ring minus the areas enclosed by the others. Fails if the work of
/// this thread is cancelled.
fn enclosed_area(rings: &Rings<DVec2>, notes: &mut Vec<&'static str>) -> Result<PolygonArea> {
    let whole = |ring: &Vec<DVec2>| overlay::fill(&[Rings(vec![ring.clone()])], Fill::NonZero);
    let Some((outer, holes)) = rings.split_first() else { return Ok(PolygonArea::new()) };
    let outer = whole(outer)?;
    if outer.len() > 1 {
        note(notes, LOOPS);
    }
    let mut cut = PolygonArea::new();
    for hole in holes {
        let hole = whole(hole)?;
        let size = size(&hole);
        if size <= 0.0 {
            note(notes, "a hole without area removed");
        } else if self::size(&overlay::overlay(&outer, &hole, |is_in| is_in == [true; 2])?) <= 1e-6 * size {
            note(notes, "a hole outside the outer ring removed");
        } else {
            cut.extend(hole);
        }
    }
    if cut.is_empty() {
        return Ok(outer);
    }
    let count = cut.len();
    let together = unite(cut)?;
    if together.len() < count {
        note(notes, "holes that touch merged");
    }
    let rest = overlay::overlay(&outer, &together, |[inside, hole]| inside && !hole)?;
    if rest.iter().map(|part| part.len() - 1).sum::<usize>() < together.len() {
        note(notes, "a hole at the outer ring cut out");
    }
    Ok(rest)
}

/// Returns a polygon as rings, counter-clockwise.
fn counter_clockwise(mut corners: Vec<DVec2>) -> Rings<DVec2> {
    if twice_area(corners.iter().copied()) < 0.0 {
        corners.reverse();
    }
    Rings(vec![corners])
}

/// Returns the size of an area (m²).
fn size(area: &[Rings<DVec2>]) -> f64 {
    area.iter().flat_map(|rings| rings.iter()).map(|ring| twice_area(ring.iter().copied()) / 2.0).sum()
}

/// Returns the largest of several areas; `None` if all are too small.
fn greatest(areas: PolygonArea, notes: &mut Vec<&'static str>) -> Option<Rings<DVec2>> {
    let sized: Vec<(f64, Rings<DVec2>)> = areas
        .into_iter()
        .map(|part| (size(std::slice::from_ref(&part)), part))
        .filter(|(size, _)| *size > LEAST)
        .collect();
    if sized.len() > 1 && !notes.contains(&LOOPS) {
        note(notes, "the largest part kept");
    }
    // The first of equal areas is chosen.
    let greatest = sized.into_iter().reduce(|best, next| if next.0 > best.0 { next } else { best });
    greatest.map(|(_, part)| part)
}

/// Returns the rings of a polygon without invalid holes.
fn rings_of(polygon: &Rings<DVec2>, manner: &OutlineOptions) -> Rings<DVec2> {
    let is_sound = |ring: &Vec<DVec2>| {
        let sharp: Vec<SectionPoint> = ring.iter().copied().map(SectionPoint::sharp).collect();
        is_hole(&sharp, manner)
    };
    let rings = polygon.iter().enumerate();
    rings.filter(|(number, ring)| *number == 0 || is_sound(ring)).map(|(_, ring)| ring.clone()).collect()
}

type IndexedEdge = GeomWithData<Line<[f64; 2]>, usize>;

/// Returns a spatial index of the ring edges with a length, each with its number over all rings.
fn edge_tree(rings: &Rings<DVec2>) -> RTree<IndexedEdge> {
    let ends = rings.iter().flat_map(|ring| edges(ring));
    let lines = ends.enumerate().filter(|(_, [from, to])| from.distance_squared(*to) > 0.0);
    RTree::bulk_load(
        lines
            .map(|(number, [from, to])| GeomWithData::new(Line::new(from.to_array(), to.to_array()), number))
            .collect(),
    )
}

/// Returns squares around the points within `near` (m) of an edge that does not begin or end there.
fn notches(rings: &Rings<DVec2>, near: f64) -> PolygonArea {
    let tree = edge_tree(rings);
    let mut found = PolygonArea::new();
    let mut number = 0;
    for ring in &**rings {
        for index in 0..ring.len() {
            let own = [number + index, number + (index + ring.len() - 1) % ring.len()];
            let at = ring[index];
            let around = AABB::from_corners((at - near).to_array(), (at + near).to_array());
            let touches = tree.locate_in_envelope_intersecting(&around).any(|edge| {
                !own.contains(&edge.data) && edge.geom().distance_2(&at.to_array()) <= near * near
            });
            if touches {
                let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
                let corners = corners.into_iter().map(|(x, y)| at + DVec2::new(x, y) * NOTCH);
                found.push(Rings(vec![corners.collect()]));
            }
        }
        number += ring.len();
    }
    found
}

/// Returns the polygon with ground heights, and the input edges of each edge; `None` if it is invalid at its
/// original position.
fn finish(
    clean: &Polygon,
    local: &Rings<DVec2>,
    rings: &Rings,
    middle: DVec2,
) -> Option<(Polygon<DVec3>, Vec<Vec<usize>>)> {
    let tree = edge_tree(local);
    let ends: Vec<[DVec3; 2]> = rings.iter().flat_map(|ring| edges(ring)).collect();
    let on_ground = |at: DVec2| {
        let Some(edge) = tree.nearest_neighbor(&at.to_array()) else { return at.extend(0.0) };
        let [from, to] = ends[edge.data];
        // A point that stems from an input point keeps its exact position and height.
        for given in [from, to] {
            if (given.truncate() - middle).distance(at) < 1e-4 {
                return given - middle.extend(0.0);
            }
        }
        let part = foot([from, to].map(|end| end.truncate() - middle), at);
        at.extend(from.z + (to.z - from.z) * part)
    };
    let mut given = Vec::new();
    for ring in clean {
        for [a, b] in ring.edges() {
            let low = (a.min(b) - ALONG).to_array();
            let around = AABB::from_corners(low, (a.max(b) + ALONG).to_array());
            let along = (b - a).normalize_or_zero();
            let mut stands_for: Vec<usize> = tree
                .locate_in_envelope_intersecting(&around)
                .filter(|edge| {
                    let [from, to] = [edge.geom().from, edge.geom().to].map(DVec2::from);
                    let beside = |point: DVec2| along.perp_dot(point - a).abs() <= ALONG;
                    let [one, two] = [from, to].map(|point| along.dot(point - a));
                    let shared = one.max(two).min(a.distance(b)) - one.min(two).max(0.0);
                    beside(from) && beside(to) && shared > ALONG
                })
                .map(|edge| edge.data)
                .collect();
            if stands_for.is_empty() {
                let nearest = tree.nearest_neighbor(&a.midpoint(b).to_array());
                stands_for.extend(nearest.map(|edge| edge.data));
            }
            stands_for.sort_unstable();
            given.push(stands_for);
        }
    }
    let rings = clean.iter().map(|ring| ring.iter().map(|at| on_ground(*at) + middle.extend(0.0)).collect());
    Some((Polygon::new(rings.collect::<Rings>()).ok()?, given))
}

#[cfg(test)]
#[path = "repair_tests.rs"]
mod tests;
