//! Lines and rings of two geometries in a subdivision of the plane.

use burgeon_base::error::Result;
use burgeon_geometry::overlay::{Subdivision, SubdivisionEdge, WayKind};
use rustc_hash::FxHashMap;

use super::operand::Operand;

/// Two geometries whose edges end where they meet.
pub(super) struct OperandArrangement {
    pub(super) subdivision: Subdivision,
    /// Lines and rings.
    pub(super) ways: Vec<ArrangedWay>,
    /// Nodes of the points of each geometry.
    pub(super) points: [Vec<u32>; 2],
}

/// A line or ring.
pub(super) struct ArrangedWay {
    /// Index of the geometry: 0 or 1.
    pub(super) geometry: usize,
    pub(super) is_ring: bool,
    /// Nodes along the line or ring.
    pub(super) nodes: Vec<u32>,
}

impl OperandArrangement {
    /// Arranges two operands; fails if the work of this thread is cancelled.
    pub(super) fn new(operands: &[Operand; 2]) -> Result<Self> {
        let ways: Vec<_> = operands.iter().enumerate().flat_map(|(layer, it)| it.ways(layer)).collect();
        let subdivision = Subdivision::new(&ways)?;
        let mut made = Self { subdivision, ways: Vec::new(), points: [Vec::new(), Vec::new()] };
        for (number, way) in ways.iter().enumerate() {
            match way.kind {
                WayKind::Points => made.points[way.layer].extend(made.subdivision.points(number)),
                kind => made.ways.push(ArrangedWay {
                    geometry: way.layer,
                    is_ring: kind == WayKind::Ring,
                    nodes: made.subdivision.way(number),
                }),
            }
        }
        Ok(made)
    }

    /// Returns the index of each edge by its nodes, the lower one first.
    #[allow(
        clippy::cast_possible_truncation,
        reason = "nodes are numbered by 32 bits, and edges are as many"
    )]
    pub(super) fn edges_by_nodes(&self) -> FxHashMap<[u32; 2], u32> {
        let edges = self.subdivision.edges.iter().enumerate();
        edges.map(|(number, edge)| (key(edge.ends), number as u32)).collect()
    }
}

/// Returns two nodes, the lower one first.
pub(super) fn key([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// Returns, for each geometry, whether it lies above and below an edge.
pub(super) fn sides(edge: &SubdivisionEdge) -> [[bool; 2]; 2] {
    [0, 1].map(|geometry| [edge.above[geometry] != 0, edge.below[geometry] != 0])
}
