//! Subdivision of the plane by rings and lines, with the winding numbers on both sides of each edge.
//!
//! Method: edges that meet only at nodes are swept from left to right. For each edge, the sweep finds the
//! edge directly below it, and so the winding number of each layer below and above it. All decisions use
//! exact predicates.

use burgeon_base::error::Result;
use glam::DVec2;
use rustc_hash::FxHashMap;

use super::noding::{LayerWay, NodedWays, Noding, WayKind};
use super::predicates::{by_angle, side};

/// An edge of a subdivision, from its left end to its right end, or from its lower to its upper end if it is
/// vertical.
#[derive(Debug, Clone, Copy)]
pub struct SubdivisionEdge {
    /// Nodes at both ends.
    pub ends: [u32; 2],
    /// Winding number above (to the left), by layer; counter-clockwise rings count positive.
    pub above: [i32; 2],
    /// Winding number below (to the right), by layer.
    pub below: [i32; 2],
    /// Presence of a line along the edge, by layer.
    pub line: [bool; 2],
    /// Only way that contains the edge, or `u32::MAX`.
    pub(super) source: u32,
    /// Edge directly below it.
    pub(super) under: Option<u32>,
}

/// Subdivision of the plane by rings, lines and points of two layers.
///
/// Exact predicates guarantee that edges neither cross nor overlap, and that no node lies on an edge.
#[derive(Debug)]
pub struct Subdivision {
    /// Coordinates of the nodes.
    pub places: Vec<DVec2>,
    /// Edges, each after the edges below it.
    pub edges: Vec<SubdivisionEdge>,
    /// Way of each node.
    pub(super) owners: Vec<Option<u32>>,
    ways: NodedWays,
    /// Winding numbers by layer of nodes without edges.
    lone: FxHashMap<u32, [i32; 2]>,
    /// Edges around each node, in sweep order of the nodes: counter-clockwise from the lower right; `true`
    /// for an edge's right end.
    around: Vec<(u32, bool)>,
    /// Nodes with the end index of their edges in `around`.
    spokes: Vec<(u32, u32)>,
}

/// An edge that the sweep has not reached: ends, net windings of both layers to the right, lines, and source.
type WaitingEdge = ([u32; 2], [i32; 2], [bool; 2], u32);

impl Subdivision {
    /// Divides the plane by ways; fails if the work of this thread is cancelled.
    pub fn new(ways: &[LayerWay]) -> Result<Self> {
        let noding = Noding::new(ways)?;
        let edges: Vec<_> = noding.edges().copied().collect();
        let (places, owners, noded) = noding.into_parts();
        let mut made = Self {
            places,
            edges: Vec::with_capacity(edges.len()),
            owners,
            ways: noded,
            lone: FxHashMap::default(),
            around: Vec::with_capacity(2 * edges.len()),
            spokes: Vec::new(),
        };
        let points = (0..).zip(ways).filter(|(_, way)| way.kind == WayKind::Points);
        let points: Vec<u32> = points.flat_map(|(number, _)| made.points(number)).copied().collect();
        let edges = edges.iter().map(|edge| (edge.ends, edge.load.net, edge.load.line, edge.load.source));
        made.sweep(edges, points);
        Ok(made)
    }

    /// Returns the nodes along a way, by its index; a ring ends with its first node again.
    pub fn way(&self, number: usize) -> Vec<u32> {
        self.ways.nodes(number)
    }

    /// Returns the nodes of a way of points, by its index.
    pub fn points(&self, number: usize) -> &[u32] {
        self.ways.points(number)
    }

    /// Returns the winding numbers by layer at a node that is a point without edges; 0 for other nodes.
    pub fn around(&self, node: u32) -> [i32; 2] {
        self.lone.get(&node).copied().unwrap_or_default()
    }

    /// Iterates over the nodes with edges from left to right, with the edges around each, counter-clockwise;
    /// `true` for an edge that ends there.
    pub(crate) fn stars(&self) -> impl Iterator<Item = (u32, &[(u32, bool)])> {
        let mut begin = 0;
        self.spokes.iter().map(move |(node, end)| {
            let star = &self.around[begin..*end as usize];
            begin = *end as usize;
            (*node, star)
        })
    }

    #[allow(clippy::cast_possible_truncation, reason = "fewer edges than 2^32 fit into memory")]
    fn sweep(&mut self, edges: impl Iterator<Item = WaitingEdge>, mut nodes: Vec<u32>) {
        let before = |one: DVec2, two: DVec2| one.x < two.x || one.x == two.x && one.y < two.y;
        // From left to right: left end, right end, net to the right, lines, source.
        let mut waiting: Vec<WaitingEdge> = edges
            .map(|([a, b], net, line, source)| {
                if before(self.places[a as usize], self.places[b as usize]) {
                    ([a, b], net, line, source)
                } else {
                    ([b, a], net.map(|it| -it), line, source)
                }
            })
            .collect();
        let order = |one: u32, two: u32| {
            let [one, two] = [one, two].map(|node| self.places[node as usize]);
            one.x.total_cmp(&two.x).then(one.y.total_cmp(&two.y))
        };
        waiting.sort_unstable_by(|one, two| {
            // Edges that begin at one node are sorted from bottom to top.
            order(one.0[0], two.0[0]).then_with(|| {
                let place = |node: u32| self.places[node as usize];
                by_angle(place(one.0[0]), place(one.0[1]), place(two.0[1]))
            })
        });
        nodes.extend(waiting.iter().flat_map(|it| it.0));
        nodes.sort_unstable_by(|one, two| order(*one, *two));
        nodes.dedup();
        // Number of edges that end at each node.
        let mut endings: Vec<u32> = vec![0; self.places.len()];
        waiting.iter().for_each(|it| endings[it.0[1] as usize] += 1);
        // Edges that cross the sweep line at the current node, from bottom to top.
        let mut status: Vec<u32> = Vec::new();
        let mut rest = waiting.into_iter().peekable();
        for node in nodes {
            let place = self.places[node as usize];
            let is_below = |edge: &u32| {
                let [left, right] = self.edges[*edge as usize].ends;
                right != node && side(self.places[left as usize], self.places[right as usize], place) > 0.0
            };
            let first = status.partition_point(is_below);
            // Edges that are divided completely end next to each other. The minimum prevents a panic for all others.
            let end = (first + endings[node as usize] as usize).min(status.len());
            let mut under = first.checked_sub(1).map(|index| status[index]);
            let mut below = under.map_or([0; 2], |edge| self.edges[edge as usize].above);
            let begun = self.edges.len() as u32;
            while let Some((ends, net, line, source)) = rest.next_if(|it| it.0[0] == node) {
                let above = [below[0] + net[0], below[1] + net[1]];
                self.around.push((self.edges.len() as u32, false));
                self.edges.push(SubdivisionEdge { ends, above, below, line, source, under });
                (under, below) = (Some(self.edges.len() as u32 - 1), above);
            }
            if first == end && begun == self.edges.len() as u32 {
                self.lone.insert(node, below);
                continue;
            }
            self.around.extend(status[first..end].iter().rev().map(|edge| (*edge, true)));
            self.spokes.push((node, self.around.len() as u32));
            status.splice(first..end, begun..self.edges.len() as u32);
        }
    }
}
