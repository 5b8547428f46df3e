//! The edges of two geometries, divided where they meet, so that each piece lies in one way to both.

use geo::line_intersection::{LineIntersection, line_intersection};
use geo::{Coord, Line};
use glam::DVec2;
use rstar::{AABB, RTree, RTreeObject};
use rustc_hash::FxHashMap;

use crate::plane::Plane;

/// Where a way of edges comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct WayOrigin {
    /// The first geometry or the second.
    pub(super) second: bool,
    /// Whether it is a ring around an area, which lies to its left.
    pub(super) ring: bool,
}

/// A way of edges from place to place.
pub(super) struct Way {
    pub(super) origin: WayOrigin,
    /// Its places; those of a ring end with the first one again.
    pub(super) places: Vec<DVec2>,
}

/// A piece of edges between two nodes, the lesser of which is first.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Piece {
    pub(super) nodes: [usize; 2],
    /// By geometry: whether it is part of a line.
    pub(super) line: [bool; 2],
    /// By geometry: whether a ring of it lies here whose area is to the left of the piece, and to the right.
    pub(super) ring: [[bool; 2]; 2],
}

/// What two geometries look like when all of their edges end where they meet.
pub(super) struct Arrangement {
    /// The places where edges end or meet.
    pub(super) nodes: Vec<DVec2>,
    /// Every piece once.
    pub(super) pieces: Vec<Piece>,
    /// By way: its pieces in their order, and whether each is walked from its first node to its second.
    pub(super) ways: Vec<Vec<(usize, bool)>>,
    /// The places that were asked for, by node.
    pub(super) asked: Vec<usize>,
}

/// The part of the extent within which places are one: what rounding makes of the place where two edges cross.
const SAME: f64 = 1e-12;

struct ArrangedEdge {
    ends: [DVec2; 2],
    number: usize,
}

impl RTreeObject for ArrangedEdge {
    type Envelope = AABB<[f64; 2]>;

    fn envelope(&self) -> Self::Envelope {
        AABB::from_corners(self.ends[0].to_array(), self.ends[1].to_array())
    }
}

impl Arrangement {
    /// That of `ways`; `points` are nodes too.
    ///
    /// Places are one node if they are within 1e-12 of the extent, or the rounding of coordinates in this plane: the place
    /// where two edges cross is that of one of their ends if it is as near.
    pub(super) fn new(ways: &[Way], points: &[DVec2], plane: Plane) -> Self {
        let places = ways.iter().flat_map(|way| &way.places).chain(points);
        let extent = places.fold(0.0_f64, |most, at| most.max(at.abs().max_element()));
        let near = extent * SAME + plane.rounding();
        let edges: Vec<[DVec2; 2]> =
            ways.iter().flat_map(|way| way.places.windows(2).map(|pair| [pair[0], pair[1]])).collect();
        let mut nodes = Nodes::new(near);
        // What was given comes first, so that it stays as it was given.
        for way in ways {
            way.places.iter().for_each(|place| {
                nodes.find(*place);
            });
        }
        let asked: Vec<usize> = points.iter().map(|point| nodes.find(*point)).collect();
        let cuts = cuts(&edges, points, near);
        let mut made = Self { nodes: Vec::new(), pieces: Vec::new(), ways: Vec::new(), asked };
        let mut known: FxHashMap<[usize; 2], usize> = FxHashMap::default();
        let mut first = 0;
        for way in ways {
            let count = way.places.len().saturating_sub(1);
            let mut walked = Vec::with_capacity(count);
            for number in first..first + count {
                let [a, b] = edges[number];
                let along = |at: &DVec2| (*at - a).dot(b - a);
                let mut stops: Vec<DVec2> = cuts[number].clone();
                stops.sort_by(|p, q| along(p).total_cmp(&along(q)));
                stops.push(b);
                let mut from = nodes.find(a);
                for stop in stops {
                    let to = nodes.find(stop);
                    if to == from {
                        continue;
                    }
                    let forwards = from < to;
                    let ends = if forwards { [from, to] } else { [to, from] };
                    let index = *known.entry(ends).or_insert_with(|| {
                        made.pieces.push(Piece { nodes: ends, ..Piece::default() });
                        made.pieces.len() - 1
                    });
                    let geometry = usize::from(way.origin.second);
                    if way.origin.ring {
                        made.pieces[index].ring[geometry][usize::from(!forwards)] = true;
                    } else {
                        made.pieces[index].line[geometry] = true;
                    }
                    walked.push((index, forwards));
                    from = to;
                }
            }
            first += count;
            made.ways.push(walked);
        }
        made.nodes = nodes.places;
        made
    }
}

/// By edge: the places where others meet it.
fn cuts(edges: &[[DVec2; 2]], points: &[DVec2], near: f64) -> Vec<Vec<DVec2>> {
    let mut cuts: Vec<Vec<DVec2>> = vec![Vec::new(); edges.len()];
    let tree = RTree::bulk_load(
        edges.iter().enumerate().map(|(number, ends)| ArrangedEdge { ends: *ends, number }).collect(),
    );
    let around =
        |a: DVec2, b: DVec2| AABB::from_corners((a.min(b) - near).to_array(), (a.max(b) + near).to_array());
    for (number, [a, b]) in edges.iter().enumerate() {
        let others = tree.locate_in_envelope_intersecting(&around(*a, *b));
        let mut others: Vec<usize> = others.map(|other| other.number).filter(|it| *it > number).collect();
        others.sort_unstable();
        for other in others {
            meet(edges, number, other, near, &mut cuts);
        }
    }
    for point in points {
        let mut others: Vec<usize> =
            tree.locate_in_envelope_intersecting(&around(*point, *point)).map(|other| other.number).collect();
        others.sort_unstable();
        for number in others {
            if is_on(edges[number], *point, near) {
                cuts[number].push(*point);
            }
        }
    }
    cuts
}

/// Whether a place lies on an edge.
fn is_on([a, b]: [DVec2; 2], place: DVec2, near: f64) -> bool {
    let way = b - a;
    let along = (place - a).dot(way);
    let squared = way.length_squared();
    if along <= 0.0 || along >= squared {
        return false;
    }
    (a + way * (along / squared)).distance_squared(place) <= near * near
}

/// Notes where two edges meet each other.
fn meet(edges: &[[DVec2; 2]], one: usize, two: usize, near: f64, cuts: &mut [Vec<DVec2>]) {
    let (first, second) = (edges[one], edges[two]);
    let mut touched = false;
    for (edge, number, other) in [(first, one, second), (second, two, first)] {
        for end in other {
            if is_on(edge, end, near) {
                cuts[number].push(end);
                touched = true;
            }
        }
    }
    if touched {
        return;
    }
    let line = |[a, b]: [DVec2; 2]| Line::new(Coord { x: a.x, y: a.y }, Coord { x: b.x, y: b.y });
    if let Some(LineIntersection::SinglePoint { intersection, is_proper: true }) =
        line_intersection(line(first), line(second))
    {
        let place = DVec2::new(intersection.x, intersection.y);
        cuts[one].push(place);
        cuts[two].push(place);
    }
}

/// Places that are told apart if they are farther from each other than rounding brings them.
struct Nodes {
    places: Vec<DVec2>,
    near: f64,
    cells: FxHashMap<[i64; 2], Vec<usize>>,
}

impl Nodes {
    fn new(near: f64) -> Self {
        Self { places: Vec::new(), near, cells: FxHashMap::default() }
    }

    fn cell(&self, place: DVec2) -> [i64; 2] {
        let size = (self.near * 4.0).max(f64::MIN_POSITIVE);
        #[allow(clippy::cast_possible_truncation, reason = "at most 1e12 cells to each side")]
        (place / size).floor().to_array().map(|number| number as i64)
    }

    /// The node at a place, which is new if there is none.
    fn find(&mut self, place: DVec2) -> usize {
        let [x, y] = self.cell(place);
        let mut best: Option<(f64, usize)> = None;
        for cell in (-1..=1).flat_map(|i| (-1..=1).map(move |j| [x.saturating_add(i), y.saturating_add(j)])) {
            for &known in self.cells.get(&cell).into_iter().flatten() {
                let far = self.places[known].distance(place);
                if far <= self.near && best.is_none_or(|best| (far, known) < best) {
                    best = Some((far, known));
                }
            }
        }
        if let Some((_, known)) = best {
            return known;
        }
        self.places.push(place);
        self.cells.entry([x, y]).or_default().push(self.places.len() - 1);
        self.places.len() - 1
    }
}
