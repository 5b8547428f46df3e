//! Dimensionally extended nine-intersection model of two geometries of one dimension each.
//!
//! Source: E. Clementini and others, "A small set of formal topological relationships suitable for end-user
//! interaction", 1993. The boundary of lines consists of the points where an odd number of lines end.

use std::cmp::Ordering;

use glam::DVec2;

use super::prepared::{PreparedGeometry, TopologyParts, is_among};
use crate::overlay;
use crate::ways::{Contacts, WalkSides, WayEdges, is_on_any, place_in};

/// Indices of the interior, the boundary and the exterior in a row of cells.
const INTERIOR: usize = 0;
const BOUNDARY: usize = 1;
const EXTERIOR: usize = 2;

/// Dimensions in which the interiors, boundaries and exteriors of two geometries intersect, by row of the
/// first geometry: `F`, `0`, `1` or `2`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct RelationCells([[u8; 3]; 3]);

impl RelationCells {
    fn new() -> Self {
        let mut made = Self([[b'F'; 3]; 3]);
        made.note(EXTERIOR, EXTERIOR, b'2');
        made
    }

    fn note(&mut self, first: usize, second: usize, dimension: u8) {
        let cell = &mut self.0[first][second];
        if *cell == b'F' || *cell < dimension {
            *cell = dimension;
        }
    }

    /// Records a dimension if a condition is true.
    fn note_if(&mut self, holds: bool, first: usize, second: usize, dimension: u8) {
        if holds {
            self.note(first, second, dimension);
        }
    }

    fn turned(self) -> Self {
        let [[a, b, c], [d, e, f], [g, h, i]] = self.0;
        Self([[a, d, g], [b, e, h], [c, f, i]])
    }

    fn letters(self) -> [u8; 9] {
        let [[a, b, c], [d, e, f], [g, h, i]] = self.0;
        [a, b, c, d, e, f, g, h, i]
    }
}

/// Computes the dimensions in which the interior, boundary and exterior of the first geometry intersect those
/// of the second, row by row, as characters.
///
/// If the borders of two areas cross, the dimension of their intersection is computed only if `all` is set;
/// otherwise it is 0.
pub(crate) fn relate(one: &PreparedGeometry, two: &PreparedGeometry, all: bool) -> [u8; 9] {
    use TopologyParts::{Areas, Lines, Mixed, None, Points};
    let cells = match (one.parts(), two.parts()) {
        (Mixed, _) | (_, Mixed) => return overlay::relate(&one.whole, &two.whole),
        (Areas(a), Areas(b)) => areas((one, a), (two, b), all),
        (Areas(a), Lines(b, ends)) => area_and_line((one, a), (two, b), ends),
        (Lines(a, ends), Areas(b)) => area_and_line((two, b), (one, a), ends).turned(),
        (Lines(a, first), Lines(b, second)) => lines((one, a, first), (two, b, second)),
        (_, Points(places)) => with_points(one.parts(), places),
        (Points(places), _) => with_points(two.parts(), places).turned(),
        (parts, None) => alone(parts),
        (None, parts) => alone(parts).turned(),
    };
    cells.letters()
}

/// Returns the relation of a geometry to an empty geometry.
fn alone(parts: &TopologyParts) -> RelationCells {
    let mut cells = RelationCells::new();
    match parts {
        TopologyParts::Points(_) => cells.note(INTERIOR, EXTERIOR, b'0'),
        TopologyParts::Lines(_, ends) => {
            cells.note(INTERIOR, EXTERIOR, b'1');
            cells.note_if(!ends.is_empty(), BOUNDARY, EXTERIOR, b'0');
        }
        TopologyParts::Areas(_) => {
            cells.note(INTERIOR, EXTERIOR, b'2');
            cells.note(BOUNDARY, EXTERIOR, b'1');
        }
        TopologyParts::None | TopologyParts::Mixed => {}
    }
    cells
}

fn areas(
    one: (&PreparedGeometry, &WayEdges),
    two: (&PreparedGeometry, &WayEdges),
    all: bool,
) -> RelationCells {
    let mut cells = RelationCells::new();
    let contacts = Contacts::new((one.0.bounds, one.1), (two.0.bounds, two.1), !all);
    let [same, opposite] = contacts.shares;
    cells.note_if(!contacts.is_empty(), BOUNDARY, BOUNDARY, b'0');
    cells.note_if(contacts.has_shared(), BOUNDARY, BOUNDARY, b'1');
    let (first, second) = if contacts.cross() {
        (WalkSides::BOTH, WalkSides::BOTH)
    } else {
        (contacts.of(0).walk(one.1, two.1), contacts.of(1).walk(two.1, one.1))
    };
    cells.note_if(first.inside || second.inside || same, INTERIOR, INTERIOR, b'2');
    cells.note_if(first.outside || second.inside || opposite, INTERIOR, EXTERIOR, b'2');
    cells.note_if(first.inside || second.outside || opposite, EXTERIOR, INTERIOR, b'2');
    cells.note_if(first.inside, BOUNDARY, INTERIOR, b'1');
    cells.note_if(first.outside, BOUNDARY, EXTERIOR, b'1');
    cells.note_if(second.inside, INTERIOR, BOUNDARY, b'1');
    cells.note_if(second.outside, EXTERIOR, BOUNDARY, b'1');
    cells
}

fn area_and_line(
    area: (&PreparedGeometry, &WayEdges),
    line: (&PreparedGeometry, &WayEdges),
    ends: &[DVec2],
) -> RelationCells {
    let mut cells = RelationCells::new();
    let contacts = Contacts::new((area.0.bounds, area.1), (line.0.bounds, line.1), false);
    cells.note(INTERIOR, EXTERIOR, b'2');
    cells.note_if(contacts.of(0).has_own(area.1), BOUNDARY, EXTERIOR, b'1');
    let sides = if contacts.cross() { WalkSides::BOTH } else { contacts.of(1).walk(line.1, area.1) };
    cells.note_if(sides.inside, INTERIOR, INTERIOR, b'1');
    cells.note_if(sides.outside, EXTERIOR, INTERIOR, b'1');
    cells.note_if(contacts.has_shared(), BOUNDARY, INTERIOR, b'1');
    cells.note_if(contacts.cross(), BOUNDARY, INTERIOR, b'0');
    for place in contacts.places() {
        cells.note(BOUNDARY, if is_among(ends, place) { BOUNDARY } else { INTERIOR }, b'0');
    }
    for end in ends {
        cells.note(row_in_area(area.1, *end), BOUNDARY, b'0');
    }
    cells
}

/// Returns the row of a point relative to areas.
fn row_in_area(areas: &WayEdges, place: DVec2) -> usize {
    match place_in(areas, place) {
        Ordering::Greater => INTERIOR,
        Ordering::Equal => BOUNDARY,
        Ordering::Less => EXTERIOR,
    }
}

/// A geometry with the edges of its lines, and the points where an odd number of lines end.
type LineParts<'a> = (&'a PreparedGeometry, &'a WayEdges, &'a [DVec2]);

fn lines(one: LineParts<'_>, two: LineParts<'_>) -> RelationCells {
    let mut cells = RelationCells::new();
    let contacts = Contacts::new((one.0.bounds, one.1), (two.0.bounds, two.1), false);
    cells.note_if(contacts.has_shared(), INTERIOR, INTERIOR, b'1');
    cells.note_if(contacts.cross(), INTERIOR, INTERIOR, b'0');
    cells.note_if(contacts.of(0).has_own(one.1), INTERIOR, EXTERIOR, b'1');
    cells.note_if(contacts.of(1).has_own(two.1), EXTERIOR, INTERIOR, b'1');
    let row = |ends: &[DVec2], place| if is_among(ends, place) { BOUNDARY } else { INTERIOR };
    for place in contacts.places() {
        cells.note(row(one.2, place), row(two.2, place), b'0');
    }
    for end in one.2 {
        cells.note_if(!is_on_any(two.1, *end), BOUNDARY, EXTERIOR, b'0');
    }
    for end in two.2 {
        cells.note_if(!is_on_any(one.1, *end), EXTERIOR, BOUNDARY, b'0');
    }
    cells
}

/// Returns the relation of a geometry to points.
fn with_points(parts: &TopologyParts, places: &[DVec2]) -> RelationCells {
    let mut cells = RelationCells::new();
    for place in places {
        let row = match parts {
            TopologyParts::Points(own) if is_among(own, *place) => INTERIOR,
            TopologyParts::Lines(_, ends) if is_among(ends, *place) => BOUNDARY,
            TopologyParts::Lines(edges, _) if is_on_any(edges, *place) => INTERIOR,
            TopologyParts::Areas(edges) => row_in_area(edges, *place),
            _ => EXTERIOR,
        };
        cells.note(row, INTERIOR, b'0');
    }
    match parts {
        TopologyParts::Points(own) => {
            cells.note_if(own.iter().any(|place| !is_among(places, *place)), INTERIOR, EXTERIOR, b'0');
        }
        TopologyParts::Lines(_, ends) => {
            cells.note(INTERIOR, EXTERIOR, b'1');
            cells.note_if(ends.iter().any(|end| !is_among(places, *end)), BOUNDARY, EXTERIOR, b'0');
        }
        TopologyParts::Areas(_) => {
            cells.note(INTERIOR, EXTERIOR, b'2');
            cells.note(BOUNDARY, EXTERIOR, b'1');
        }
        TopologyParts::None | TopologyParts::Mixed => {}
    }
    cells
}
