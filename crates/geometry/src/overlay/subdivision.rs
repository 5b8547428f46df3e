//! The plane as rings and lines divide it, with what lies to both sides of each edge.
//!
//! Method: edges that meet only at nodes are swept from left to right; of each it is known which lies right below it, and
//! so how often the rings of each layer go around what is below and above it (winding numbers). All is decided by exact
//! predicates.

use burgeon_base::error::Result;
use glam::DVec2;
use rustc_hash::FxHashMap;

use super::noding::{LayerWay, NodedWays, Noding, WayKind};
use super::predicates::{by_angle, side};

/// An edge of a subdivision, from its left end to its right one, or from its lower to its upper one if it is upright.
#[derive(Debug, Clone, Copy)]
pub struct SubdivisionEdge {
    /// The nodes at its ends.
    pub ends: [u32; 2],
    /// By layer: how often its rings go around what is above (to the left), counter-clockwise ones less clockwise ones.
    pub above: [i32; 2],
    /// By layer: the same of what is below (to the right).
    pub below: [i32; 2],
    /// By layer: whether a line is there.
    pub line: [bool; 2],
    /// The only way that it is part of, or `u32::MAX`.
    pub(super) source: u32,
    /// The edge right below it.
    pub(super) under: Option<u32>,
}

/// What rings, lines and points of two layers look like when all of their edges end where they meet.
///
/// Edges neither cross nor overlap, and no node lies on an edge, which exact predicates have found.
#[derive(Debug)]
pub struct Subdivision {
    /// The places of nodes.
    pub places: Vec<DVec2>,
    /// The edges, each above those that are below it.
    pub edges: Vec<SubdivisionEdge>,
    /// By node: the way of which it is a place.
    pub(super) owners: Vec<Option<u32>>,
    ways: NodedWays,
    /// By node that has no edges: how often the rings of each layer go around it.
    lone: FxHashMap<u32, [i32; 2]>,
    /// By node in the order of the sweep: the edges around it, counter-clockwise from below on the right; `true` if it is the
    /// edge's right end.
    around: Vec<(u32, bool)>,
    /// Where those of each node end in `around`, with the node.
    spokes: Vec<(u32, u32)>,
}

/// An edge that the sweep has not reached: its ends, net windings of both layers to its right, lines on it, and its source.
type WaitingEdge = ([u32; 2], [i32; 2], [bool; 2], u32);

impl Subdivision {
    /// Divides the plane by ways; fails if the work of this thread is to stop.
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
        let points: Vec<u32> = points.flat_map(|(number, _)| made.points(number).to_vec()).collect();
        let edges = edges.iter().map(|edge| (edge.ends, edge.load.net, edge.load.line, edge.load.source));
        made.sweep(edges, points);
        Ok(made)
    }

    /// The nodes along a way, by its number; a ring ends with its first node again.
    pub fn way(&self, number: usize) -> Vec<u32> {
        self.ways.nodes(number)
    }

    /// The nodes of a way of points.
    pub fn points(&self, number: usize) -> &[u32] {
        self.ways.points(number)
    }

    /// How often the rings of each layer go around a node that is a point and has no edges; not at all around others.
    pub fn around(&self, node: u32) -> [i32; 2] {
        self.lone.get(&node).copied().unwrap_or_default()
    }

    /// By node that has edges, from left to right: the edges around it, counter-clockwise, each with whether it ends there.
    pub(super) fn stars(&self) -> impl Iterator<Item = (u32, &[(u32, bool)])> {
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
            // Edges that begin at one node, from below to above.
            order(one.0[0], two.0[0]).then_with(|| {
                let place = |node: u32| self.places[node as usize];
                by_angle(place(one.0[0]), place(one.0[1]), place(two.0[1]))
            })
        });
        nodes.extend(waiting.iter().flat_map(|it| it.0));
        nodes.sort_unstable_by(|one, two| order(*one, *two));
        nodes.dedup();
        // How many edges end at each node.
        let mut endings: Vec<u32> = vec![0; self.places.len()];
        waiting.iter().for_each(|it| endings[it.0[1] as usize] += 1);
        // The edges above the present node's line, from below to above.
        let mut status: Vec<u32> = Vec::new();
        let mut rest = waiting.into_iter().peekable();
        for node in nodes {
            let place = self.places[node as usize];
            let is_below = |edge: &u32| {
                let [left, right] = self.edges[*edge as usize].ends;
                right != node && side(self.places[left as usize], self.places[right as usize], place) > 0.0
            };
            let first = status.partition_point(is_below);
            let end = first + endings[node as usize] as usize;
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
