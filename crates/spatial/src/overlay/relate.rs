//! Dimensionally extended nine-intersection model of two geometries.
//!
//! Source: E. Clementini and others, "A small set of formal topological relationships suitable for end-user
//! interaction", 1993. The boundary of lines consists of the points where an odd number of lines end.

use super::arranged::{OperandArrangement, sides};
use super::operand::Operand;
use crate::Geometry;

/// Position of a point relative to a geometry.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum TopologicalPosition {
    Interior,
    Boundary,
    Exterior,
}

/// State of a node in both geometries.
#[derive(Debug, Clone, Copy, Default)]
struct NodeState {
    is_met: bool,
    /// Edges at the node lie within an area, along a ring, or along a line.
    area: [bool; 2],
    ring: [bool; 2],
    line: [bool; 2],
    /// Number of lines that end here.
    ends: [usize; 2],
    point: [bool; 2],
}

/// Computes the dimensions in which the interior, boundary and exterior of the first geometry intersect those
/// of the second, row by row, as characters. Nothing intersects if the work of this thread is cancelled.
pub(crate) fn relate(one: &Geometry, two: &Geometry) -> [u8; 9] {
    let mut cells = [b'F'; 9];
    cells[8] = b'2';
    let Ok(arranged) = OperandArrangement::new(&[one, two].map(Operand::for_overlay)) else { return cells };
    let subdivision = &arranged.subdivision;
    let mut note = |[first, second]: [TopologicalPosition; 2], dimension: u8| {
        let cell = &mut cells[first as usize * 3 + second as usize];
        if *cell == b'F' || *cell < dimension {
            *cell = dimension;
        }
    };
    let place = |is_inside: bool| {
        if is_inside { TopologicalPosition::Interior } else { TopologicalPosition::Exterior }
    };
    let mut nodes = vec![NodeState::default(); subdivision.places.len()];
    for edge in &subdivision.edges {
        let sides = sides(edge);
        let [first, second] = sides;
        for (first, second) in first.into_iter().zip(second) {
            note([place(first), place(second)], b'2');
        }
        note(
            [0, 1].map(|geometry| match sides[geometry] {
                [true, true] => TopologicalPosition::Interior,
                [false, false] => place(edge.line[geometry]),
                _ => TopologicalPosition::Boundary,
            }),
            b'1',
        );
        for node in edge.ends {
            let node = &mut nodes[node as usize];
            node.is_met = true;
            for (geometry, [above, below]) in sides.into_iter().enumerate() {
                node.area[geometry] |= above && below;
                node.ring[geometry] |= above != below;
                node.line[geometry] |= edge.line[geometry];
            }
        }
    }
    for way in arranged.ways.iter().filter(|way| !way.is_ring) {
        if let [begin, .., end] = way.nodes[..]
            && begin != end
        {
            [begin, end].iter().for_each(|node| nodes[*node as usize].ends[way.geometry] += 1);
        }
    }
    for (geometry, points) in arranged.points.iter().enumerate() {
        points.iter().for_each(|node| nodes[*node as usize].point[geometry] = true);
    }
    for (number, node) in (0..).zip(&nodes) {
        // The corner of a collapsed area is not a node of the geometry.
        if !node.is_met && node.point == [false; 2] {
            continue;
        }
        let around = subdivision.around(number);
        note(
            [0, 1].map(|geometry| {
                if node.ring[geometry] {
                    TopologicalPosition::Boundary
                } else if node.area[geometry] || !node.is_met && around[geometry] != 0 {
                    TopologicalPosition::Interior
                } else if node.line[geometry] {
                    if node.ends[geometry] % 2 == 1 {
                        TopologicalPosition::Boundary
                    } else {
                        TopologicalPosition::Interior
                    }
                } else {
                    place(node.point[geometry])
                }
            }),
            b'0',
        );
    }
    cells
}
