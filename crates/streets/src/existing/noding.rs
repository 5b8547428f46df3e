//! Noding: lines meet only at their vertices, and each crossing becomes a vertex of both lines.
//!
//! Method: snap rounding (J. Hobby, "Practical segment intersection with finite precision output", 1999) in integers:
//! each segment is routed through the centre of each hot pixel that it touches. The hot pixels are those of vertices
//! and of crossings. Crossings are rounded exactly, so no two segments of the result cross.

use rstar::primitives::{GeomWithData, Line as IndexLine};
use rstar::{AABB, RTree};
use rustc_hash::FxHashSet;

use super::strand::StreetStrand;
use crate::plan::grid::{GridPlace, PER_METRE, WholePlace, touch};

/// Maximum number of rounds; the method needs one, and the second confirms it.
const ROUNDS: usize = 8;

/// Segment: its strand, the index of its first vertex, and its ends.
#[derive(Clone, Copy)]
struct NodingEdge {
    strand: usize,
    first: usize,
    ends: [GridPlace; 2],
}

type EdgeIndex = RTree<GeomWithData<IndexLine<[f64; 2]>, usize>>;

/// Adds vertices where strands of one level meet. Returns the segments that still cross others, as strand and first
/// vertex; no such case is known.
pub(crate) fn node(strands: &mut [StreetStrand]) -> Vec<(usize, usize)> {
    let mut levels: Vec<i32> = strands.iter().map(|strand| strand.level).collect();
    levels.sort_unstable();
    levels.dedup();
    let mut unresolved = Vec::new();
    for level in levels {
        for round in 0.. {
            let edges = edges_of(strands, level);
            let index = index_of(&edges);
            let mut hot: FxHashSet<GridPlace> = edges.iter().flat_map(|edge| edge.ends).collect();
            let vertices = hot.len();
            let mut faulty = Vec::new();
            for (number, edge) in edges.iter().enumerate() {
                for other in edges_near(&index, edge.ends).filter(|other| *other < number) {
                    if let Some(place) = meeting(edge.ends, edges[other].ends) {
                        hot.insert(place);
                        faulty.push((edge.strand, edge.first));
                    }
                }
            }
            let is_changed = lead_through(strands, level, &edges, &hot);
            if !is_changed && hot.len() == vertices {
                unresolved.extend(faulty);
                break;
            }
            if round >= ROUNDS {
                unresolved.extend(faulty);
                break;
            }
        }
    }
    unresolved.sort_unstable();
    unresolved.dedup();
    unresolved
}

fn edges_of(strands: &[StreetStrand], level: i32) -> Vec<NodingEdge> {
    let of_level = strands.iter().enumerate().filter(|(_, strand)| strand.level == level);
    let edges = of_level.flat_map(|(number, strand)| {
        let pairs = strand.places.windows(2).enumerate();
        pairs.map(move |(first, pair)| NodingEdge { strand: number, first, ends: [pair[0], pair[1]] })
    });
    edges.collect()
}

fn index_of(edges: &[NodingEdge]) -> EdgeIndex {
    let items = edges.iter().enumerate().map(|(number, edge)| {
        let [a, b] = edge.ends.map(|end| end.metres().to_array());
        GeomWithData::new(IndexLine::new(a, b), number)
    });
    RTree::bulk_load(items.collect())
}

/// Returns the sorted indices of the segments whose bounding boxes intersect that of a segment.
fn edges_near(index: &EdgeIndex, ends: [GridPlace; 2]) -> impl Iterator<Item = usize> {
    let [a, b] = ends.map(GridPlace::metres);
    let around = AABB::from_corners(a.min(b).to_array(), a.max(b).to_array());
    let mut found: Vec<usize> =
        index.locate_in_envelope_intersecting(&around).map(|item| item.data).collect();
    found.sort_unstable();
    found.into_iter()
}

/// Returns the missing vertex of two segments: the point where they cross or touch other than at shared ends; `None` if
/// no vertex is missing.
fn meeting([a, b]: [GridPlace; 2], [c, d]: [GridPlace; 2]) -> Option<GridPlace> {
    let shared = [a, b].into_iter().filter(|end| *end == c || *end == d).count();
    let lies_on = |end: GridPlace, [from, to]: [GridPlace; 2]| {
        end != from && end != to && end.side_of(from, to) == 0 && end.is_between(from, to)
    };
    if shared > 0 || !touch([a, b], [c, d]) {
        if shared != 1 {
            return None;
        }
        // Two segments that leave one point in the same direction: the nearer end lies on the other segment.
        let on = [a, b].into_iter().find(|end| lies_on(*end, [c, d]));
        return on.or_else(|| [c, d].into_iter().find(|end| lies_on(*end, [a, b])));
    }
    let on = [a, b].into_iter().find(|end| lies_on(*end, [c, d]));
    let on = on.or_else(|| [c, d].into_iter().find(|end| lies_on(*end, [a, b])));
    on.or_else(|| crossing([a, b], [c, d]))
}

/// Returns the grid position nearest to the crossing of two segments; `None` if they are parallel.
fn crossing([a, b]: [GridPlace; 2], [c, d]: [GridPlace; 2]) -> Option<GridPlace> {
    let [[ax, ay], [bx, by], [cx, cy], [dx, dy]] = [a, b, c, d].map(|end| end.steps().map(i128::from));
    let ([east, north], [other_east, other_north]) = ([bx - ax, by - ay], [dx - cx, dy - cy]);
    let below = east * other_north - north * other_east;
    if below == 0 {
        return None;
    }
    let above = (cx - ax) * other_north - (cy - ay) * other_east;
    let (above, below) = (above * below.signum(), below.abs());
    let along = |from: i128, way: i128| -> Option<i64> {
        i64::try_from(from + (2 * way * above + below).div_euclid(2 * below)).ok()
    };
    Some(GridPlace::of_steps([along(ax, east)?, along(ay, north)?]))
}

/// Returns true if a segment touches the pixel around a position.
fn touches([a, b]: [GridPlace; 2], pixel: GridPlace) -> bool {
    // In half steps from its centre, the pixel extends from -1 to 1.
    let [x, y] = pixel.steps();
    let [[ax, ay], [bx, by]] = [a, b]
        .map(GridPlace::steps)
        .map(|[east, north]| [i128::from(2 * (east - x)), i128::from(2 * (north - y))]);
    let (east, north) = (bx - ax, by - ay);
    let within = |a: i128, b: i128| a.min(b) <= 1 && a.max(b) >= -1;
    within(ax, bx) && within(ay, by) && (ax * by - ay * bx).abs() <= east.abs() + north.abs()
}

/// Routes segments through the hot pixels that they touch; returns true if any segment was changed.
fn lead_through(
    strands: &mut [StreetStrand],
    level: i32,
    edges: &[NodingEdge],
    hot: &FxHashSet<GridPlace>,
) -> bool {
    let mut places: Vec<GridPlace> = hot.iter().copied().collect();
    places.sort_unstable();
    let items = places.iter().map(|place| GeomWithData::new(place.metres().to_array(), *place));
    let index = RTree::bulk_load(items.collect());
    let mut is_changed = false;
    let mut led: Vec<Vec<GridPlace>> = vec![Vec::new(); strands.len()];
    for NodingEdge { strand, ends: [a, b], .. } in edges.iter().copied() {
        let [from, to] = [a, b].map(GridPlace::metres);
        let (low, high) = (from.min(to) - 1.0 / PER_METRE, from.max(to) + 1.0 / PER_METRE);
        let around = AABB::from_corners(low.to_array(), high.to_array());
        let mut on: Vec<(i128, GridPlace)> = index
            .locate_in_envelope(&around)
            .map(|item| item.data)
            .filter(|place| *place != a && *place != b && touches([a, b], *place))
            .map(|place| (position_along(a, b, place), place))
            .collect();
        on.sort_unstable();
        is_changed |= !on.is_empty();
        let line = &mut led[strand];
        if line.is_empty() {
            line.push(a);
        }
        line.extend(on.into_iter().map(|(_, place)| place));
        line.push(b);
        line.dedup();
    }
    if is_changed {
        for (strand, line) in strands.iter_mut().zip(led).filter(|(strand, _)| strand.level == level) {
            strand.places = line;
        }
    }
    is_changed
}

/// Returns the position of a point along a segment, multiplied by the segment's length (squared grid steps).
fn position_along(a: GridPlace, b: GridPlace, place: GridPlace) -> i128 {
    let [[ax, ay], [bx, by], [x, y]] = [a, b, place].map(|at| at.steps().map(i128::from));
    (bx - ax) * (x - ax) + (by - ay) * (y - ay)
}
