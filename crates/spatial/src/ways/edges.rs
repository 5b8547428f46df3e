//! Edges of lines and rings, with a tree for large numbers.

use std::sync::OnceLock;

use glam::DVec2;
use rstar::{AABB, RTree, RTreeObject};

/// Minimum number of edges for the search with a tree.
const MANY: usize = 64;

/// A directed edge with a length.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DirectedEdge {
    pub(crate) from: DVec2,
    pub(crate) to: DVec2,
}

/// Edges of consecutive lines or rings.
#[derive(Debug, Clone, Default)]
pub(crate) struct WayEdges {
    pub(crate) edges: Vec<DirectedEdge>,
    /// End index of the edges of each line or ring.
    ends: Vec<usize>,
    tree: OnceLock<RTree<NumberedEdge>>,
}

/// An edge in a tree.
#[derive(Debug, Clone, Copy)]
struct NumberedEdge {
    edge: DirectedEdge,
    number: usize,
}

impl RTreeObject for NumberedEdge {
    type Envelope = AABB<[f64; 2]>;

    fn envelope(&self) -> Self::Envelope {
        AABB::from_corners(self.edge.from.to_array(), self.edge.to.to_array())
    }
}

impl DirectedEdge {
    pub(crate) fn low(&self) -> DVec2 {
        self.from.min(self.to)
    }

    pub(crate) fn high(&self) -> DVec2 {
        self.from.max(self.to)
    }
}

impl WayEdges {
    pub(crate) fn new(ways: &[Vec<DVec2>]) -> Self {
        let mut made = Self::default();
        for way in ways {
            let edges = way.windows(2).filter(|pair| pair[0] != pair[1]);
            made.edges.extend(edges.map(|pair| DirectedEdge { from: pair[0], to: pair[1] }));
            made.ends.push(made.edges.len());
        }
        made
    }

    /// Returns the range of edges of each line or ring.
    pub(crate) fn ways(&self) -> impl Iterator<Item = std::ops::Range<usize>> + '_ {
        let begins = std::iter::once(0).chain(self.ends.iter().copied());
        begins.zip(&self.ends).map(|(begin, end)| begin..*end)
    }

    /// Calls `each` with the edges whose bounding boxes intersect a box, and their indices.
    pub(crate) fn meeting(&self, low: DVec2, high: DVec2, mut each: impl FnMut(usize, &DirectedEdge)) {
        if self.edges.len() < MANY {
            for (number, edge) in self.edges.iter().enumerate() {
                if edge.low().cmple(high).all() && low.cmple(edge.high()).all() {
                    each(number, edge);
                }
            }
            return;
        }
        let numbered =
            || self.edges.iter().enumerate().map(|(number, edge)| NumberedEdge { edge: *edge, number });
        let tree = self.tree.get_or_init(|| RTree::bulk_load(numbered().collect()));
        for found in
            tree.locate_in_envelope_intersecting(&AABB::from_corners(low.to_array(), high.to_array()))
        {
            each(found.number, &found.edge);
        }
    }
}
