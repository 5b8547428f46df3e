//! The dimensionally extended nine-intersection model of two geometries.
//!
//! Source: E. Clementini and others, "A small set of formal topological relationships suitable for end-user
//! interaction", 1993; the boundary of lines is made of places where an odd number of them end.

use geo::Coord;
use glam::DVec2;

use super::arrangement::Arrangement;
use super::inside::Inside;
use super::operand::Operand;
use crate::Geometry;
use crate::plane::Plane;

/// Where something lies to a geometry.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum TopologicalPosition {
    Interior,
    Boundary,
    Exterior,
}

/// What is known of a node, by geometry.
#[derive(Debug, Clone, Copy, Default)]
struct NodeState {
    is_met: bool,
    /// A piece here lies within an area, along a ring, or along a line.
    area: [bool; 2],
    ring: [bool; 2],
    line: [bool; 2],
    /// How many lines end here.
    ends: [usize; 2],
    point: [bool; 2],
}

/// By interior, boundary and exterior of the first geometry and then of the second, row by row: the dimension in which
/// they meet, as a letter.
pub(crate) fn relate(one: &Geometry, two: &Geometry) -> [u8; 9] {
    let plane = Plane::of(&[one, two]);
    let operands = [Operand::new(plane, one), Operand::new(plane, two)];
    let ways: Vec<_> = operands.iter().zip([false, true]).flat_map(|(it, second)| it.ways(second)).collect();
    let points: Vec<DVec2> = operands.iter().flat_map(|it| it.points.iter().copied()).collect();
    let arrangement = Arrangement::new(&ways, &points, plane);
    let inside = [0, 1].map(|index| Inside::new(&operands[index].areas));
    let coord = |at: DVec2| Coord { x: at.x, y: at.y };
    let mut cells = [b'F'; 9];
    cells[8] = b'2';
    let mut note = |[first, second]: [TopologicalPosition; 2], dimension: u8| {
        let cell = &mut cells[first as usize * 3 + second as usize];
        if *cell == b'F' || *cell < dimension {
            *cell = dimension;
        }
    };
    let mut nodes = vec![NodeState::default(); arrangement.nodes.len()];
    for piece in &arrangement.pieces {
        let [from, to] = piece.nodes.map(|node| arrangement.nodes[node]);
        let sides = [0, 1].map(|geometry| match piece.ring[geometry] {
            [false, false] => [inside[geometry].holds(coord((from + to) / 2.0)); 2],
            sides => sides,
        });
        let place = |is_inside: bool| {
            if is_inside { TopologicalPosition::Interior } else { TopologicalPosition::Exterior }
        };
        let [first, second] = sides;
        for (one, two) in first.into_iter().zip(second) {
            note([place(one), place(two)], b'2');
        }
        note(
            [0, 1].map(|geometry| match sides[geometry] {
                [true, true] => TopologicalPosition::Interior,
                [false, false] => place(piece.line[geometry]),
                _ => TopologicalPosition::Boundary,
            }),
            b'1',
        );
        for node in piece.nodes {
            let node = &mut nodes[node];
            node.is_met = true;
            for (geometry, [left, right]) in sides.into_iter().enumerate() {
                node.area[geometry] |= left && right;
                node.ring[geometry] |= left != right;
                node.line[geometry] |= piece.line[geometry];
            }
        }
    }
    for (way, walked) in ways.iter().zip(&arrangement.ways) {
        let end = |index: usize, is_last: bool| {
            let (piece, forwards) = walked[index];
            arrangement.pieces[piece].nodes[usize::from(forwards == is_last)]
        };
        if let (false, Some(last)) = (way.origin.ring, walked.len().checked_sub(1)) {
            let (begin, end) = (end(0, false), end(last, true));
            if begin != end {
                [begin, end].iter().for_each(|node| nodes[*node].ends[usize::from(way.origin.second)] += 1);
            }
        }
    }
    let first = operands[0].points.len();
    for (number, node) in arrangement.asked.iter().enumerate() {
        nodes[*node].point[usize::from(number >= first)] = true;
    }
    for (node, place) in nodes.iter().zip(&arrangement.nodes) {
        // The corner of an area without width is none.
        if !node.is_met && node.point == [false; 2] {
            continue;
        }
        note(
            [0, 1].map(|geometry| {
                if node.ring[geometry] {
                    TopologicalPosition::Boundary
                } else if node.area[geometry] || !node.is_met && inside[geometry].holds(coord(*place)) {
                    TopologicalPosition::Interior
                } else if node.line[geometry] {
                    if node.ends[geometry] % 2 == 1 {
                        TopologicalPosition::Boundary
                    } else {
                        TopologicalPosition::Interior
                    }
                } else if node.point[geometry] {
                    TopologicalPosition::Interior
                } else {
                    TopologicalPosition::Exterior
                }
            }),
            b'0',
        );
    }
    cells
}
