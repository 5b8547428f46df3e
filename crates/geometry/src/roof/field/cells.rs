//! Division of a roof's outline by the borders between its planes.

use glam::DVec2;

use super::faces::FaceGraph;
use super::heights::HeightField;
use crate::overlay::{LayerWay, Subdivision, WayKind};
use crate::planar::{Polygon, edges};
use crate::roof::touching::touching_parts;
use burgeon_base::error::Result;

/// Length (m) below which edges are omitted.
const SHORT: f64 = 1e-4;
/// Maximum sine of the turn at a node that is omitted.
const STRAIGHT: f64 = 1e-6;

/// Position of a place relative to the walls.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Zone {
    /// Beyond the roof.
    Outside,
    /// Between the walls and the outline of the roof.
    Eaves,
    /// Inside the walls.
    Inside,
}

/// One side of an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct CellSide {
    /// Position relative to the walls.
    pub zone: Zone,
    /// Index of the plane of the heights; 0 outside.
    pub plane: usize,
}

/// An edge between two cells, or between a cell and the outside.
#[derive(Debug, Clone, Copy)]
pub(super) struct CellEdge {
    /// Nodes at both ends.
    pub ends: [u32; 2],
    /// Left and right side.
    pub sides: [CellSide; 2],
}

/// A part of the roof with one plane.
#[derive(Debug, Clone)]
pub(super) struct RoofCell {
    /// Position and plane.
    pub side: CellSide,
    /// Nodes of its rings, counter-clockwise, holes clockwise.
    pub rings: Vec<Vec<u32>>,
}

/// Parts of a roof.
#[derive(Debug)]
pub(super) struct RoofCellMap {
    /// Places of the nodes.
    pub places: Vec<DVec2>,
    /// Edges of the cells.
    pub edges: Vec<CellEdge>,
    /// Cells of the upper side.
    pub cells: Vec<RoofCell>,
    /// Cells of the underside, beyond the walls.
    pub undersides: Vec<RoofCell>,
    /// Nodes along each edge of the walls, in the order of the edges.
    pub walls: Vec<Vec<u32>>,
}

impl RoofCellMap {
    /// Divides the area inside `outer`, which contains `walls`. If `keeps_walls` is set, cells end at the walls. Fails if the
    /// work of this thread is cancelled.
    pub(super) fn new(
        walls: &Polygon,
        outer: &Polygon,
        field: &HeightField,
        keeps_walls: bool,
    ) -> Result<Self> {
        let [low, high] = outer.bounds().unwrap_or_default();
        let reach = 2.0 * low.distance(high) + 1.0;
        let rings = |layer: usize, polygon: &Polygon| -> Vec<LayerWay> {
            polygon
                .iter()
                .map(|ring| LayerWay { layer, kind: WayKind::Ring, places: ring.to_vec() })
                .collect()
        };
        let mut ways = rings(0, walls);
        ways.extend(rings(1, outer));
        let lines = field.breaks(low.midpoint(high), reach).into_iter();
        ways.extend(lines.map(|places| LayerWay { layer: 0, kind: WayKind::Line, places }));
        let division = Subdivision::new(&ways)?;
        let graph = FaceGraph::new(&division);
        let sides = graph.sides(&division, field)?;
        let differs = |edge: usize| sides[2 * edge] != sides[2 * edge + 1];
        let is_wall = |edge: usize| {
            let [left, right] = [sides[2 * edge], sides[2 * edge + 1]];
            let is_outside = left.zone == Zone::Outside || right.zone == Zone::Outside;
            left.plane == right.plane && !is_outside
        };
        let kept: Vec<CellEdge> = (0..division.edges.len())
            .filter(|&edge| differs(edge))
            .map(|edge| CellEdge {
                ends: division.edges[edge].ends,
                sides: [sides[2 * edge], sides[2 * edge + 1]],
            })
            .collect();

        let mut corners = vec![false; division.places.len()];
        let mut wall_lines = Vec::with_capacity(walls.size());
        for (number, ring) in walls.iter().chain(outer.iter()).enumerate() {
            for nodes in wall_nodes(&division.way(number), ring, &division.places) {
                nodes.first().into_iter().chain(nodes.last()).for_each(|node| corners[*node as usize] = true);
                if number < walls.len() {
                    wall_lines.push(nodes);
                }
            }
        }
        let nodes = NodeMap::new(&division.places, &kept, &corners);
        let cells = |keeps_walls: bool| -> Result<Vec<RoofCell>> {
            let faces = graph.rings(&division, |edge| differs(edge) && (keeps_walls || !is_wall(edge)))?;
            let cells = faces.into_iter().flat_map(|(half, rings)| {
                let rings: Vec<Vec<u32>> = rings.iter().filter_map(|ring| nodes.ring(ring)).collect();
                let parts = touching_parts(rings, |node| division.places[node as usize]);
                parts.into_iter().map(move |rings| (half, rings))
            });
            let cells = cells.map(|(half, rings)| RoofCell { side: sides[half], rings });
            Ok(cells.filter(|cell| cell.side.zone != Zone::Outside).collect())
        };
        let mut undersides = Vec::new();
        if sides.iter().any(|side| side.zone == Zone::Eaves) {
            undersides = cells(true)?;
            undersides.retain(|cell| cell.side.zone == Zone::Eaves);
        }
        Ok(Self {
            cells: cells(keeps_walls)?,
            undersides,
            walls: wall_lines.iter().map(|line| nodes.line(line)).collect(),
            edges: nodes.edges(&kept),
            places: division.places.clone(),
        })
    }
}

/// Nodes without those of short edges and those in the middle of straight edges.
struct NodeMap {
    /// Node that represents each node.
    names: Vec<u32>,
    /// Edges at nodes that are omitted.
    passes: Vec<Option<[usize; 2]>>,
}

impl NodeMap {
    #[allow(clippy::cast_possible_truncation, reason = "a subdivision has fewer than 2^32 nodes")]
    fn new(places: &[DVec2], edges: &[CellEdge], corners: &[bool]) -> Self {
        fn root(parents: &mut [u32], mut index: u32) -> u32 {
            while parents[index as usize] != index {
                parents[index as usize] = parents[parents[index as usize] as usize];
                index = parents[index as usize];
            }
            index
        }
        let mut parents: Vec<u32> = (0..places.len() as u32).collect();
        for edge in edges {
            let [a, b] = edge.ends.map(|node| root(&mut parents, node));
            let ends = edge.ends.map(|node| places[node as usize]);
            let are_corners = [a, b].map(|node| corners[node as usize]);
            if a == b || ends[0].distance(ends[1]) >= SHORT || are_corners == [true; 2] {
                continue;
            }
            // A corner represents the nodes near it.
            let (kept, lost) = if are_corners[1] || (!are_corners[0] && b < a) { (b, a) } else { (a, b) };
            parents[lost as usize] = kept;
        }
        let names: Vec<u32> = (0..parents.len() as u32).map(|node| root(&mut parents, node)).collect();
        let mut around: Vec<Vec<usize>> = vec![Vec::new(); places.len()];
        for (index, edge) in edges.iter().enumerate() {
            let [a, b] = edge.ends.map(|node| names[node as usize]);
            if a != b {
                around[a as usize].push(index);
                around[b as usize].push(index);
            }
        }
        let pass = |(node, around): (usize, &Vec<usize>)| {
            let &[one, other] = around.as_slice() else { return None };
            let far = |edge: usize| {
                let [a, b] = edges[edge].ends.map(|end| names[end as usize]);
                places[if a as usize == node { b } else { a } as usize] - places[node]
            };
            let (to, from) = (far(one).normalize_or_zero(), -far(other).normalize_or_zero());
            let is_straight = to.dot(from) > 0.0 && to.perp_dot(from).abs() < STRAIGHT;
            (is_straight && !corners[node]).then_some([one, other])
        };
        let passes = around.iter().enumerate().map(pass).collect();
        Self { names, passes }
    }

    /// Returns the remaining nodes of a line.
    fn line(&self, nodes: &[u32]) -> Vec<u32> {
        let mut line: Vec<u32> = nodes
            .iter()
            .map(|node| self.names[*node as usize])
            .filter(|node| self.passes[*node as usize].is_none())
            .collect();
        line.dedup();
        line
    }

    /// Returns the remaining nodes of a ring, without parts that run back on themselves; `None` if fewer than three remain.
    fn ring(&self, nodes: &[u32]) -> Option<Vec<u32>> {
        let mut ring: Vec<u32> = Vec::with_capacity(nodes.len());
        for node in self.line(nodes) {
            ring.push(node);
            while ring.len() > 2 && ring[ring.len() - 1] == ring[ring.len() - 3] {
                ring.truncate(ring.len() - 2);
            }
        }
        while ring.len() > 2 {
            if ring[0] == ring[ring.len() - 1] {
                ring.pop();
            } else if ring[1] == ring[ring.len() - 1] {
                ring.remove(0);
                ring.pop();
            } else if ring[0] == ring[ring.len() - 2] {
                ring.truncate(ring.len() - 2);
            } else {
                break;
            }
        }
        (ring.len() > 2).then_some(ring)
    }

    /// Returns the edges between remaining nodes.
    fn edges(&self, edges: &[CellEdge]) -> Vec<CellEdge> {
        let mut seen = vec![false; edges.len()];
        let mut joined = Vec::new();
        let name = |node: u32| self.names[node as usize];
        for (index, edge) in edges.iter().enumerate() {
            let [a, b] = edge.ends.map(name);
            let is_begin = |node: u32| self.passes[node as usize].is_none();
            if seen[index] || a == b || !(is_begin(a) || is_begin(b)) {
                continue;
            }
            let (begin, mut end) = if is_begin(a) { (a, b) } else { (b, a) };
            let sides = if begin == a { edge.sides } else { [edge.sides[1], edge.sides[0]] };
            let mut at = index;
            seen[at] = true;
            while let Some([one, other]) = self.passes[end as usize] {
                at = if at == one { other } else { one };
                if seen[at] {
                    break;
                }
                seen[at] = true;
                let [c, d] = edges[at].ends.map(name);
                end = if c == end { d } else { c };
            }
            joined.push(CellEdge { ends: [begin, end], sides });
        }
        joined
    }
}

/// Divides the nodes along a ring at its corners: the nodes of each edge, with both ends.
#[allow(clippy::float_cmp, reason = "nodes are copies of corners")]
fn wall_nodes(way: &[u32], ring: &[DVec2], places: &[DVec2]) -> Vec<Vec<u32>> {
    let mut all = Vec::with_capacity(ring.len());
    let mut at = 0;
    for [_, to] in edges(ring) {
        let mut nodes = vec![way.get(at).copied().unwrap_or_default()];
        while at + 1 < way.len() {
            at += 1;
            nodes.push(way[at]);
            if places[way[at] as usize] == to {
                break;
            }
        }
        all.push(nodes);
    }
    all
}
