//! Noding: divides edges where they intersect, until edges meet only at nodes.
//!
//! Method: crossing edges are divided at their rounded crossing. Edges that pass through a node, or within a
//! few units in the last place of it, are divided at that node. The division moves edges by as little as
//! that, so they may cross others; the process repeats until exact predicates find no intersection. A
//! crossing close to a node uses that node, so nodes keep a minimum distance and the process terminates. If
//! it does not terminate within a number of rounds, it starts again with a greater tolerance; a tolerance as
//! great as the whole input merges everything into one node.
//!
//! Distinct points of one way stay distinct, and no edge of the way is snapped to them, unless termination
//! requires it: the tolerance merges points of different ways, and does not narrow a ring.

use burgeon_base::error::Result;
use burgeon_base::work::WorkLimits;
use glam::DVec2;
use rustc_hash::FxHashMap;

use super::nodes::Nodes;
use super::pairs::{Candidate, for_pairs};
use super::predicates::{crossing, side};

/// Source of an edge that several ways share.
pub(super) const SHARED: u32 = u32::MAX;

/// Number of rounds before the tolerance is increased, and the factor of the increase.
const ROUNDS: usize = 32;
const COARSER: f64 = 8.0;

/// Tolerance in units in the last place of the largest coordinate: the maximum rounding error of a point
/// computed on a line.
const TOLERANCE: f64 = 2.0;
/// Maximum distance of a node on an edge, as a fraction of the tolerance. Up to three quarters, the parts of
/// a divided edge are shorter than the edge.
const ON_EDGE: f64 = 0.75;

/// Maximum nesting depth of divided edges.
const DEEPEST: usize = 64;

/// Type of a way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WayKind {
    /// A ring with an area to its left; its last point is joined to its first.
    Ring,
    /// A line from its first point to its last.
    Line,
    /// A set of points.
    Points,
}

/// A way: a ring, a line or points of one of two layers.
#[derive(Debug, Clone)]
pub struct LayerWay {
    /// Layer: 0 or 1.
    pub layer: usize,
    /// Type of the way.
    pub kind: WayKind,
    /// Points, in order; points that are not finite are skipped.
    pub places: Vec<DVec2>,
}

/// Rings and lines that contain an edge.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct EdgeLoad {
    /// Net number of rings along the edge, by layer: forward minus backward.
    pub(super) net: [i32; 2],
    /// Presence of a line along the edge, by layer.
    pub(super) line: [bool; 2],
    /// Only way that contains the edge, or [`SHARED`].
    pub(super) source: u32,
}

impl EdgeLoad {
    fn reversed(self) -> Self {
        Self { net: self.net.map(|net| -net), ..self }
    }

    fn is_empty(&self) -> bool {
        self.net == [0; 2] && self.line == [false; 2]
    }
}

/// An edge between two nodes, the lower one first.
#[derive(Debug, Clone, Copy)]
pub(super) struct NodedEdge {
    pub(super) ends: [u32; 2],
    pub(super) load: EdgeLoad,
    /// Marks a current edge: not divided, and with rings that do not cancel each other.
    is_alive: bool,
}

/// Edges during their division.
#[derive(Debug)]
pub(super) struct Noding {
    pub(super) nodes: Nodes,
    edges: Vec<NodedEdge>,
    /// Index of the edge between two nodes.
    known: FxHashMap<[u32; 2], u32>,
    /// Nodes along divided edges.
    divided: FxHashMap<[u32; 2], Vec<u32>>,
    /// Nodes of each way.
    ways: Vec<Vec<u32>>,
    /// Way of each node, [`SHARED`] for several; `None` for a crossing.
    owners: Vec<Option<u32>>,
    /// Nodes of ways of points.
    points: Vec<u32>,
    near: f64,
    /// Keeps distinct points of one way distinct, regardless of their distance.
    keeps_ways: bool,
    /// Marks edges that were divided into each other without end.
    is_tangled: bool,
}

/// Returns true if a coordinate lies strictly between two others.
fn is_between(coordinate: f64, one: f64, other: f64) -> bool {
    coordinate > one.min(other) && coordinate < one.max(other)
}

impl Noding {
    /// Divides the edges of ways; fails if the work of this thread is cancelled.
    pub(super) fn new(ways: &[LayerWay]) -> Result<Self> {
        let limits = WorkLimits::current();
        let places = ways.iter().flat_map(|way| &way.places).filter(|place| place.is_finite());
        let most = places.fold(0.0_f64, |most, at| most.max(at.abs().max_element()));
        // Based on the unit in the last place of the largest coordinate.
        let mut tolerance = (TOLERANCE * f64::from_bits(most.to_bits() & !((1 << 52) - 1)) * f64::EPSILON)
            .max(f64::MIN_POSITIVE);
        let mut keeps_ways = true;
        loop {
            let mut made = Self::begin(ways, tolerance, keeps_ways);
            if made.divide(&limits)? {
                return Ok(made);
            }
            if !std::mem::replace(&mut keeps_ways, false) {
                tolerance *= COARSER;
            }
        }
    }

    #[allow(clippy::cast_possible_truncation, reason = "fewer ways than 2^32 fit into memory")]
    fn begin(ways: &[LayerWay], tolerance: f64, keeps_ways: bool) -> Self {
        let mut made = Self {
            nodes: Nodes::new(tolerance),
            edges: Vec::new(),
            known: FxHashMap::default(),
            divided: FxHashMap::default(),
            ways: Vec::with_capacity(ways.len()),
            owners: Vec::new(),
            points: Vec::new(),
            near: tolerance * ON_EDGE,
            keeps_ways,
            is_tangled: false,
        };
        // Last way that uses each node.
        let mut users: Vec<u32> = Vec::new();
        for (number, way) in ways.iter().enumerate() {
            let number = number as u32;
            let mut nodes: Vec<u32> = Vec::with_capacity(way.places.len() + 1);
            for place in way.places.iter().filter(|place| place.is_finite()) {
                let node = made.nodes.find(*place, |node| !keeps_ways || users[node as usize] != number);
                if node as usize == made.owners.len() {
                    made.owners.push(Some(number));
                    users.push(number);
                } else if made.owners[node as usize] != Some(number) {
                    made.owners[node as usize] = Some(SHARED);
                    users[node as usize] = number;
                }
                nodes.push(node);
            }
            let mut load = EdgeLoad { source: number, ..EdgeLoad::default() };
            match way.kind {
                WayKind::Ring => {
                    nodes.extend(nodes.first().copied());
                    load.net[way.layer] = 1;
                }
                WayKind::Line => load.line[way.layer] = true,
                WayKind::Points => made.points.extend(&nodes),
            }
            if way.kind != WayKind::Points {
                for pair in nodes.windows(2) {
                    made.add(pair[0], pair[1], load, 0);
                }
            }
            made.ways.push(nodes);
        }
        made
    }

    /// Adds a load to the edge between two nodes, or to the edges that it was divided into.
    #[allow(clippy::cast_possible_truncation, reason = "fewer edges than 2^32 fit into memory")]
    fn add(&mut self, from: u32, to: u32, load: EdgeLoad, depth: usize) {
        // A tangled division is discarded, and the number of its edges is not bounded.
        if from == to || self.is_tangled {
            return;
        }
        let (ends, load) = if from < to { ([from, to], load) } else { ([to, from], load.reversed()) };
        if let Some(&index) = self.known.get(&ends) {
            let sum = &mut self.edges[index as usize].load;
            for layer in 0..2 {
                sum.net[layer] += load.net[layer];
                sum.line[layer] |= load.line[layer];
            }
            if sum.source != load.source {
                sum.source = SHARED;
            }
            if sum.is_empty() {
                self.edges[index as usize].is_alive = false;
                self.known.remove(&ends);
            }
            return;
        }
        if let Some(chain) = self.divided.get(&ends) {
            if depth == DEEPEST {
                self.is_tangled = true;
                return;
            }
            let chain = chain.clone();
            for pair in chain.windows(2) {
                self.add(pair[0], pair[1], load, depth + 1);
            }
            return;
        }
        self.known.insert(ends, self.edges.len() as u32);
        self.edges.push(NodedEdge { ends, load, is_alive: true });
    }

    /// Divides edges until they meet only at their ends; returns true if that succeeded.
    fn divide(&mut self, limits: &WorkLimits) -> Result<bool> {
        let mut fresh = 0;
        let mut points = std::mem::take(&mut self.points);
        points.sort_unstable();
        points.dedup();
        for _ in 0..ROUNDS {
            let mut cuts: Vec<(u32, u32)> = Vec::new();
            let mut candidates = self.candidates(fresh);
            // After the first round, points can lie only on new edges.
            candidates.extend(points.iter().map(|node| {
                let place = self.nodes.places[*node as usize];
                Candidate { low: place, high: place, index: *node, is_fresh: fresh == 0, is_point: true }
            }));
            fresh = self.edges.len();
            for_pairs(&mut candidates, self.near, limits, |one, two| self.meet(one, two, &mut cuts))?;
            if cuts.is_empty() {
                return Ok(!self.is_tangled);
            }
            self.apply(cuts);
            if self.is_tangled {
                return Ok(false);
            }
        }
        Ok(false)
    }

    #[allow(clippy::cast_possible_truncation, reason = "fewer edges than 2^32 fit into memory")]
    fn candidates(&self, fresh: usize) -> Vec<Candidate> {
        let alive = self.edges.iter().enumerate().filter(|(_, edge)| edge.is_alive);
        let candidate = |(index, edge): (usize, &NodedEdge)| {
            let [a, b] = self.ends(edge.ends);
            Candidate {
                low: a.min(b),
                high: a.max(b),
                index: index as u32,
                is_fresh: index >= fresh,
                is_point: false,
            }
        };
        alive.map(candidate).collect()
    }

    fn ends(&self, ends: [u32; 2]) -> [DVec2; 2] {
        ends.map(|node| self.nodes.places[node as usize])
    }

    /// Returns true if a node that is not an end of an edge lies on the edge.
    fn is_on(&self, edge: u32, node: u32) -> bool {
        let NodedEdge { ends, load, .. } = self.edges[edge as usize];
        let ([a, b], place) = (self.ends(ends), self.nodes.places[node as usize]);
        let aside = side(a, b, place);
        if aside == 0.0 {
            // Distances are rounded, and the order of coordinates is exact.
            return if a.x == b.x { is_between(place.y, a.y, b.y) } else { is_between(place.x, a.x, b.x) };
        }
        let way = b - a;
        let (along, squared) = ((place - a).dot(way), way.length_squared());
        if along <= 0.0 || along >= squared {
            return false;
        }
        let is_own = self.keeps_ways && self.owners[node as usize] == Some(load.source);
        aside.abs() <= self.near * squared.sqrt() && (!is_own || load.source == SHARED)
    }

    /// Records the nodes at which two candidates must be divided.
    fn meet(&mut self, one: &Candidate, two: &Candidate, cuts: &mut Vec<(u32, u32)>) {
        if one.is_point || two.is_point {
            let (point, edge) = if one.is_point { (one, two) } else { (two, one) };
            if !edge.is_point {
                let ends = self.edges[edge.index as usize].ends;
                if !ends.contains(&point.index) && self.is_on(edge.index, point.index) {
                    cuts.push((edge.index, point.index));
                }
            }
            return;
        }
        let [first, second] = [one, two].map(|it| self.edges[it.index as usize].ends);
        let before = cuts.len();
        for (ends, index, others) in [(first, one.index, second), (second, two.index, first)] {
            for node in others {
                if !ends.contains(&node) && self.is_on(index, node) {
                    cuts.push((index, node));
                }
            }
        }
        if cuts.len() > before || first.iter().any(|node| second.contains(node)) {
            return;
        }
        let Some(place) = crossing(self.ends(first), self.ends(second)) else { return };
        let node = self.nodes.find(place, |_| true);
        if node as usize == self.owners.len() {
            self.owners.push(None);
        }
        for (ends, index) in [(first, one.index), (second, two.index)] {
            if !ends.contains(&node) {
                cuts.push((index, node));
            }
        }
    }

    /// Divides edges at the recorded nodes.
    fn apply(&mut self, mut cuts: Vec<(u32, u32)>) {
        cuts.sort_unstable();
        cuts.dedup();
        let groups: Vec<(u32, Vec<u32>)> = cuts
            .chunk_by(|one, two| one.0 == two.0)
            .map(|group| {
                let [from, to] = self.edges[group[0].0 as usize].ends;
                let [a, b] = self.ends([from, to]);
                let along = |node: u32| (self.nodes.places[node as usize] - a).dot(b - a);
                let mut chain: Vec<u32> = group.iter().map(|(_, node)| *node).collect();
                chain.sort_by(|one, two| along(*one).total_cmp(&along(*two)).then(one.cmp(two)));
                chain.insert(0, from);
                chain.push(to);
                (group[0].0, chain)
            })
            .collect();
        for (index, chain) in &groups {
            let edge = &mut self.edges[*index as usize];
            edge.is_alive = false;
            self.known.remove(&edge.ends);
            self.divided.insert(edge.ends, chain.clone());
        }
        for (index, chain) in groups {
            let load = self.edges[index as usize].load;
            for pair in chain.windows(2) {
                self.add(pair[0], pair[1], load, 0);
            }
        }
    }

    /// Returns the remaining edges, in an order that depends only on the ways.
    pub(super) fn edges(&self) -> impl Iterator<Item = &NodedEdge> {
        self.edges.iter().filter(|edge| edge.is_alive)
    }

    /// Returns the points of nodes, the way of each node, and the divided ways.
    pub(super) fn into_parts(self) -> (Vec<DVec2>, Vec<Option<u32>>, NodedWays) {
        (self.nodes.places, self.owners, NodedWays { ways: self.ways, divided: self.divided })
    }
}

/// Ways with the nodes of their divided edges.
#[derive(Debug)]
pub(super) struct NodedWays {
    ways: Vec<Vec<u32>>,
    divided: FxHashMap<[u32; 2], Vec<u32>>,
}

impl NodedWays {
    /// Returns the nodes along a way.
    pub(super) fn nodes(&self, way: usize) -> Vec<u32> {
        let nodes = &self.ways[way];
        let mut found: Vec<u32> = nodes.first().copied().into_iter().collect();
        // Stack of remaining steps, the next one last.
        let mut steps: Vec<[u32; 2]> = nodes.windows(2).rev().map(|pair| [pair[0], pair[1]]).collect();
        while let Some([from, to]) = steps.pop() {
            if from == to {
                continue;
            }
            match self.divided.get(&[from.min(to), from.max(to)]) {
                Some(chain) if from < to => steps.extend(chain.windows(2).rev().map(|it| [it[0], it[1]])),
                Some(chain) => steps.extend(chain.windows(2).map(|it| [it[1], it[0]])),
                None => found.push(to),
            }
        }
        found
    }

    /// Returns the nodes of a way of points, in their order.
    pub(super) fn points(&self, way: usize) -> &[u32] {
        &self.ways[way]
    }
}
