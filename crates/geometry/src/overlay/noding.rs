//! Divides edges where they meet, until none crosses or touches another one but at nodes.
//!
//! Method: edges that cross are divided at the crossing, rounded, and edges that a node lies on, or within a few units in
//! the last place, at that node. What is divided is moved by as little, and may cross others: so it is looked at again,
//! until exact predicates find nothing more. A crossing near a node is that node, hence nodes keep a distance, and an end
//! is reached; where it is not within a number of rounds, all is done again with a greater tolerance, at last one as great
//! as the whole, for which there is one node.
//!
//! Places of one way that differ stay apart, and no edge of it is drawn to them, unless that is needed for an end to be
//! reached: the tolerance brings together what was given apart, and takes no width from a ring.

use burgeon_base::error::Result;
use burgeon_base::work::WorkLimits;
use glam::DVec2;
use rustc_hash::FxHashMap;

use super::nodes::Nodes;
use super::pairs::{Candidate, for_pairs};
use super::predicates::{crossing, side};

/// The source of an edge that several ways share.
pub(super) const SHARED: u32 = u32::MAX;

/// The rounds until a greater tolerance is taken, and the factor between the two.
const ROUNDS: usize = 32;
const COARSER: f64 = 8.0;

/// The tolerance in units in the last place of the greatest coordinate: rounding leaves a place that was computed on a
/// line as far beside it.
const TOLERANCE: f64 = 2.0;
/// The part of the tolerance within which a node is on an edge. With three quarters or less the parts of the edge are
/// shorter than the whole.
const ON_EDGE: f64 = 0.75;

/// The deepest that divided edges may be made of others.
const DEEPEST: usize = 64;

/// How a way counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WayKind {
    /// A ring, with an area to its left. Its last place is joined to its first one.
    Ring,
    /// A line from its first place to its last.
    Line,
    /// A number of places.
    Points,
}

/// A ring, a line or points of one of two layers.
#[derive(Debug, Clone)]
pub struct LayerWay {
    /// The layer: 0 or 1.
    pub layer: usize,
    /// The kind.
    pub kind: WayKind,
    /// The places, in order. Those that are not finite are left out.
    pub places: Vec<DVec2>,
}

/// The rings and lines that an edge is part of.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct EdgeLoad {
    /// By layer: the rings that lead from its first end to its second, less those that lead back.
    pub(super) net: [i32; 2],
    /// By layer: whether a line is there.
    pub(super) line: [bool; 2],
    /// The only way that it is part of, or [`SHARED`].
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

/// An edge between two nodes, the lesser one first.
#[derive(Debug, Clone, Copy)]
pub(super) struct NodedEdge {
    pub(super) ends: [u32; 2],
    pub(super) load: EdgeLoad,
    /// Whether it still is an edge: it was neither divided nor do its rings cancel each other.
    is_alive: bool,
}

/// Edges that are being divided.
#[derive(Debug)]
pub(super) struct Noding {
    pub(super) nodes: Nodes,
    edges: Vec<NodedEdge>,
    /// The edge between two nodes.
    known: FxHashMap<[u32; 2], u32>,
    /// The nodes along edges that were divided.
    divided: FxHashMap<[u32; 2], Vec<u32>>,
    /// By way: its nodes.
    ways: Vec<Vec<u32>>,
    /// By node: the way of which it is a place, [`SHARED`] if there are several, none if it is a crossing.
    owners: Vec<Option<u32>>,
    /// Nodes that are points.
    points: Vec<u32>,
    near: f64,
    /// Whether places of one way stay apart however near they are.
    keeps_ways: bool,
    /// Whether edges are made of others without end.
    is_tangled: bool,
}

impl Noding {
    /// Divides the edges of ways; fails if the work of this thread is to stop.
    pub(super) fn new(ways: &[LayerWay]) -> Result<Self> {
        let limits = WorkLimits::current();
        let places = ways.iter().flat_map(|way| &way.places).filter(|place| place.is_finite());
        let most = places.fold(0.0_f64, |most, at| most.max(at.abs().max_element()));
        // The unit in the last place of the greatest coordinate.
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
        // By node: the last way that has it.
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

    /// Adds to the edge from one node to another, or to those that it was divided into.
    #[allow(clippy::cast_possible_truncation, reason = "fewer edges than 2^32 fit into memory")]
    fn add(&mut self, from: u32, to: u32, load: EdgeLoad, depth: usize) {
        // Once edges are made of one another, there are more of them than could be added.
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

    /// Divides edges until none meets another but at its ends; returns whether that was reached.
    fn divide(&mut self, limits: &WorkLimits) -> Result<bool> {
        let mut fresh = 0;
        let mut points = std::mem::take(&mut self.points);
        points.sort_unstable();
        points.dedup();
        for _ in 0..ROUNDS {
            let mut cuts: Vec<(u32, u32)> = Vec::new();
            let mut candidates = self.candidates(fresh);
            // After the first round points lie on edges only where those are new.
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

    /// Whether a node that is no end of an edge lies on it.
    fn is_on(&self, edge: u32, node: u32) -> bool {
        let NodedEdge { ends, load, .. } = self.edges[edge as usize];
        let ([a, b], place) = (self.ends(ends), self.nodes.places[node as usize]);
        let way = b - a;
        let (along, squared) = ((place - a).dot(way), way.length_squared());
        if along <= 0.0 || along >= squared {
            return false;
        }
        let aside = side(a, b, place);
        let is_own = self.keeps_ways && self.owners[node as usize] == Some(load.source);
        aside == 0.0 || aside * aside <= self.near * self.near * squared && (!is_own || load.source == SHARED)
    }

    /// Notes at which nodes two candidates are to be divided.
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

    /// Divides edges, each at a node.
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

    /// The edges that are left, in an order that only depends on the ways.
    pub(super) fn edges(&self) -> impl Iterator<Item = &NodedEdge> {
        self.edges.iter().filter(|edge| edge.is_alive)
    }

    /// Takes it apart: the places of nodes, by node the way of which it is a place, and the ways.
    pub(super) fn into_parts(self) -> (Vec<DVec2>, Vec<Option<u32>>, NodedWays) {
        (self.nodes.places, self.owners, NodedWays { ways: self.ways, divided: self.divided })
    }
}

/// Ways that were divided.
#[derive(Debug)]
pub(super) struct NodedWays {
    ways: Vec<Vec<u32>>,
    divided: FxHashMap<[u32; 2], Vec<u32>>,
}

impl NodedWays {
    /// The nodes along a way.
    pub(super) fn nodes(&self, way: usize) -> Vec<u32> {
        let nodes = &self.ways[way];
        let mut found: Vec<u32> = nodes.first().copied().into_iter().collect();
        // Steps that are left, the next one last.
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

    /// The nodes of points, in their order.
    pub(super) fn points(&self, way: usize) -> &[u32] {
        &self.ways[way]
    }
}
