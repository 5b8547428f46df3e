//! Division of a roof's outline by the borders between its planes.

use glam::DVec2;

use super::heights::HeightField;
use crate::overlay::{LayerWay, Subdivision, WayKind};
use crate::planar::{Polygon, contains, edges, twice_area};
use burgeon_base::error::Result;

/// Distance (m) from an edge at which its sides are examined.
const BESIDE: f64 = 1e-6;

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
pub(super) struct Cell {
    /// Position and plane.
    pub side: CellSide,
    /// Nodes of its rings, counter-clockwise, holes clockwise.
    pub rings: Vec<Vec<u32>>,
}

/// Parts of a roof.
#[derive(Debug)]
pub(super) struct CellMap {
    /// Places of the nodes.
    pub places: Vec<DVec2>,
    /// Edges of the cells.
    pub edges: Vec<CellEdge>,
    /// Cells of the upper side.
    pub cells: Vec<Cell>,
    /// Cells of the underside, beyond the walls.
    pub undersides: Vec<Cell>,
    /// Nodes along each edge of the walls, in the order of the edges.
    pub walls: Vec<Vec<u32>>,
}

impl CellMap {
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
            polygon.iter().map(|ring| LayerWay { layer, kind: WayKind::Ring, places: ring.to_vec() }).collect()
        };
        let mut ways = rings(0, walls);
        ways.extend(rings(1, outer));
        let lines = field.breaks(low.midpoint(high), reach).into_iter();
        ways.extend(lines.map(|places| LayerWay { layer: 0, kind: WayKind::Line, places }));
        let division = Subdivision::new(&ways)?;
        let mut map = Self { places: division.places.clone(), edges: Vec::new(), cells: Vec::new(), undersides: Vec::new(), walls: Vec::new() };
        // Numbers of the edges that remain.
        let mut numbers = vec![None; division.edges.len()];
        for (index, edge) in division.edges.iter().enumerate() {
            let [from, to] = edge.ends.map(|node| map.places[node as usize]);
            let (middle, way) = (from.midpoint(to), to - from);
            let beside = way.perp().normalize_or_zero() * BESIDE.min(1e-3 * way.length());
            let side = |winding: [i32; 2], at: DVec2| match winding.map(|count| count != 0) {
                [true, _] => CellSide { zone: Zone::Inside, plane: field.plane_at(at) },
                [false, true] => CellSide { zone: Zone::Eaves, plane: field.plane_at(at) },
                [false, false] => CellSide { zone: Zone::Outside, plane: 0 },
            };
            let sides = [side(edge.above, middle + beside), side(edge.below, middle - beside)];
            if sides[0] != sides[1] {
                numbers[index] = Some(map.edges.len());
                map.edges.push(CellEdge { ends: edge.ends, sides });
            }
        }
        for (number, ring) in walls.iter().enumerate() {
            map.walls.extend(wall_nodes(&division.way(number), ring, &map.places));
        }
        map.cells = map.trace(&division, &numbers, keeps_walls);
        if map.edges.iter().any(|edge| edge.sides.iter().any(|side| side.zone == Zone::Eaves)) {
            map.undersides = map.trace(&division, &numbers, true);
            map.undersides.retain(|cell| cell.side.zone == Zone::Eaves);
        }
        Ok(map)
    }

    /// Returns true if a half-edge exists for the purpose of tracing cells.
    fn divides(&self, edge: usize, keeps_walls: bool) -> bool {
        let [left, right] = self.edges[edge].sides;
        let is_wall = left.zone != right.zone && left.zone != Zone::Outside && right.zone != Zone::Outside;
        keeps_walls || !is_wall || left.plane != right.plane
    }

    /// Follows the borders of all cells.
    fn trace(&self, division: &Subdivision, numbers: &[Option<usize>], keeps_walls: bool) -> Vec<Cell> {
        // A half-edge has twice the number of its edge, plus 1 if it runs from the right end to the left end. `next` is the
        // half-edge that follows along the cell to its left.
        let mut next = vec![usize::MAX; 2 * self.edges.len()];
        for (_, star) in division.stars() {
            let out: Vec<usize> = star
                .iter()
                .filter_map(|&(edge, is_end)| Some((numbers[edge as usize]?, is_end)))
                .filter(|(edge, _)| self.divides(*edge, keeps_walls))
                .map(|(edge, is_end)| 2 * edge + usize::from(is_end))
                .collect();
            for (index, half) in out.iter().enumerate() {
                let twin = half ^ 1;
                next[twin] = out[(index + out.len() - 1) % out.len()];
            }
        }
        let mut seen = vec![false; next.len()];
        let mut cells: Vec<Cell> = Vec::new();
        let mut holes: Vec<(usize, Vec<u32>)> = Vec::new();
        let mut parts: Vec<usize> = Vec::new();
        let components = self.components(&next);
        for start in 0..next.len() {
            if seen[start] || next[start] == usize::MAX {
                continue;
            }
            let (mut ring, mut longest) = (Vec::new(), (-1.0, self.side(start)));
            let mut half = start;
            while !seen[half] {
                seen[half] = true;
                let [from, to] = self.ends(half);
                let length = self.places[from as usize].distance_squared(self.places[to as usize]);
                if length > longest.0 {
                    longest = (length, self.side(half));
                }
                ring.push(from);
                half = next[half];
            }
            let side = longest.1;
            if side.zone == Zone::Outside {
                continue;
            }
            let component = components[ring[0] as usize];
            if self.twice_area(&ring) > 0.0 {
                cells.push(Cell { side, rings: vec![ring] });
                parts.push(component);
            } else {
                holes.push((component, ring));
            }
        }
        for (component, hole) in holes {
            let at = self.places[hole[0] as usize];
            let around = (0..cells.len())
                .filter(|&cell| parts[cell] != component)
                .filter(|&cell| contains(&self.corners(&cells[cell].rings[0]), at))
                .min_by(|&one, &other| {
                    let area = |cell: usize| self.twice_area(&cells[cell].rings[0]);
                    area(one).total_cmp(&area(other))
                });
            if let Some(cell) = around {
                cells[cell].rings.push(hole);
            }
        }
        cells
    }

    /// Returns the number of the connected component of each node.
    fn components(&self, next: &[usize]) -> Vec<usize> {
        fn root(parents: &mut [usize], mut index: usize) -> usize {
            while parents[index] != index {
                parents[index] = parents[parents[index]];
                index = parents[index];
            }
            index
        }
        let mut parents: Vec<usize> = (0..self.places.len()).collect();
        for (index, edge) in self.edges.iter().enumerate() {
            if next[2 * index] != usize::MAX {
                let [a, b] = edge.ends.map(|node| root(&mut parents, node as usize));
                parents[a.max(b)] = a.min(b);
            }
        }
        (0..parents.len()).map(|index| root(&mut parents, index)).collect()
    }

    fn ends(&self, half: usize) -> [u32; 2] {
        let [from, to] = self.edges[half / 2].ends;
        if half.is_multiple_of(2) { [from, to] } else { [to, from] }
    }

    fn side(&self, half: usize) -> CellSide {
        self.edges[half / 2].sides[half % 2]
    }

    fn corners(&self, ring: &[u32]) -> Vec<DVec2> {
        ring.iter().map(|node| self.places[*node as usize]).collect()
    }

    fn twice_area(&self, ring: &[u32]) -> f64 {
        let from = self.places[ring[0] as usize];
        twice_area(ring.iter().map(|node| self.places[*node as usize] - from))
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
