//! The ways of two geometries in a subdivision of the plane.

use burgeon_base::error::Result;
use burgeon_geometry::overlay::{Subdivision, SubdivisionEdge, WayKind};
use rustc_hash::FxHashMap;

use super::operand::Operand;

/// Two geometries whose edges all end where they meet.
pub(super) struct OperandArrangement {
    pub(super) subdivision: Subdivision,
    /// The lines and rings.
    pub(super) ways: Vec<ArrangedWay>,
    /// By geometry: the nodes that are its points.
    pub(super) points: [Vec<u32>; 2],
}

/// A line or ring.
pub(super) struct ArrangedWay {
    /// The first geometry or the second.
    pub(super) geometry: usize,
    pub(super) is_ring: bool,
    /// The nodes along it.
    pub(super) nodes: Vec<u32>,
}

impl OperandArrangement {
    /// Fails if the work of this thread is to stop.
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

    /// The numbers of edges by their nodes, the lesser one first.
    #[allow(
        clippy::cast_possible_truncation,
        reason = "nodes are numbered by 32 bits, and edges are as many"
    )]
    pub(super) fn edges_by_nodes(&self) -> FxHashMap<[u32; 2], u32> {
        let edges = self.subdivision.edges.iter().enumerate();
        edges.map(|(number, edge)| (key(edge.ends), number as u32)).collect()
    }
}

/// Nodes, the lesser one first.
pub(super) fn key([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// By geometry: whether it is above an edge, and below.
pub(super) fn sides(edge: &SubdivisionEdge) -> [[bool; 2]; 2] {
    [0, 1].map(|geometry| [edge.above[geometry] != 0, edge.below[geometry] != 0])
}
