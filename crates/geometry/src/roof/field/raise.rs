//! Faces of a roof over its cells.

use glam::{DVec2, DVec3};

use super::cells::{CellEdge, CellSide, RoofCell, RoofCellMap, Zone};
use super::heights::HeightField;
use crate::planar::{Ring, triangulate};
use crate::roof::fill::FilledPolygon;
use crate::roof::outset::Outset;
use crate::roof::{Patch, PatchKind, RoofCover, RoofShape, STEEPEST_EAVES, Support};
use burgeon_base::Stop;
use burgeon_base::error::Result;
use rustc_hash::FxHashMap;

/// Difference (m) below which heights at one place are equal.
const LEVEL: f64 = 2e-3;
/// Distance (m) of a corner from the plane of its cell from which the cell is divided into triangles.
const BENT: f64 = 0.02;
/// Distance (m) of a corner from the plane of its cell that is a rounding error.
const FLAT: f64 = 1e-6;
/// Minimum height (m) over the walls between their corners, so that upright faces begin at the corners.
const LEAST: f64 = 0.01;

/// Creates the roof of a height field over a support. Beyond the walls, it continues as a plate.
pub(in crate::roof) fn cover(
    shape: &RoofShape,
    field: &HeightField,
    support: &Support<'_>,
) -> Result<RoofCover> {
    let wanted = support.within_reach(shape.overhang);
    let outset = Outset::new(support.walls, wanted.clone(), |_| false);
    let tight = (0..wanted.len()).filter(|&edge| outset.distances[edge] < wanted[edge]).collect();
    let is_steep = field.steepest() > STEEPEST_EAVES;
    let map = RoofCellMap::new(support.walls, &outset.polygon, field, is_steep && outset.most() > 0.0)?;
    let raised = RaisedCells::new(&map, field, support, shape.slab, outset.most());
    let mut patches = raised.slopes();
    raised.add_walls(&mut patches)?;
    raised.add_steps(&mut patches);
    Ok(RoofCover { patches, overhangs: outset.distances, tight, ..RoofCover::default() })
}

/// Cells with the heights of their corners.
struct RaisedCells<'a> {
    map: &'a RoofCellMap,
    field: &'a HeightField,
    base: f64,
    slab: f64,
    /// Heights (m) above the walls at each node, by plane.
    heights: Vec<Vec<(usize, f64)>>,
    /// All heights (m) of corners above each node, in ascending order.
    columns: Vec<Vec<f64>>,
}

impl<'a> RaisedCells<'a> {
    fn new(
        map: &'a RoofCellMap,
        field: &'a HeightField,
        support: &Support<'_>,
        slab: f64,
        overhang: f64,
    ) -> Self {
        let count = map.places.len();
        // Position of each node: a corner of the walls, elsewhere on the walls, or beyond them.
        let (mut corner, mut between) = (vec![false; count], vec![false; count]);
        for nodes in &map.walls {
            for (index, node) in nodes.iter().enumerate() {
                let place = if index == 0 || index + 1 == nodes.len() { &mut corner } else { &mut between };
                place[*node as usize] = true;
            }
        }
        let mut made = Self {
            map,
            field,
            base: support.base,
            slab,
            heights: vec![Vec::new(); count],
            columns: vec![Vec::new(); count],
        };
        for edge in &map.edges {
            for (node, side) in edge.ends.into_iter().flat_map(|node| edge.sides.map(|side| (node, side))) {
                let index = node as usize;
                if side.zone != Zone::Outside
                    && !made.heights[index].iter().any(|known| known.0 == side.plane)
                {
                    let mut height = field.planes[side.plane].height_at(map.places[index]);
                    if height.abs() < LEVEL {
                        height = 0.0;
                    }
                    if between[index] && !corner[index] {
                        height = height.max(LEAST);
                    } else if !corner[index] {
                        height = height.max(-STEEPEST_EAVES * overhang);
                    } else {
                        height = height.max(0.0);
                    }
                    let equal = made.heights[index].iter().find(|known| (known.1 - height).abs() < LEVEL);
                    let height = equal.map_or(height, |known| known.1);
                    made.heights[index].push((side.plane, height));
                }
            }
        }
        for edge in &map.edges {
            for node in edge.ends {
                for side in edge.sides.into_iter().filter(|side| side.zone != Zone::Outside) {
                    let (top, bottom) = (made.top(node, side), made.bottom(node, side));
                    let column = &mut made.columns[node as usize];
                    column.push(top);
                    if side.zone == Zone::Eaves || edge.sides.iter().any(|side| side.zone != Zone::Inside) {
                        column.push(bottom);
                    }
                }
            }
        }
        for column in &mut made.columns {
            column.sort_by(f64::total_cmp);
            column.dedup();
        }
        made
    }

    /// Returns the height (m) of a plane at a node.
    fn height(&self, node: u32, plane: usize) -> f64 {
        let known = self.heights[node as usize].iter().find(|known| known.0 == plane);
        known.map_or_else(
            || self.field.planes[plane].height_at(self.map.places[node as usize]),
            |known| known.1,
        )
    }

    /// Returns the height (m) of the upper side at a node.
    fn top(&self, node: u32, side: CellSide) -> f64 {
        self.base + (self.height(node, side.plane) + self.slab)
    }

    /// Returns the height (m) of the underside at a node.
    fn bottom(&self, node: u32, side: CellSide) -> f64 {
        self.base + self.height(node, side.plane)
    }

    fn place(&self, node: u32, height: f64) -> DVec3 {
        self.map.places[node as usize].extend(height)
    }

    /// Returns the corners strictly between two heights (m) above a node, from the first to the second.
    fn between(&self, node: u32, from: f64, to: f64) -> Vec<DVec3> {
        let (low, high) = (from.min(to), from.max(to));
        let column = self.columns[node as usize].iter().filter(|height| **height > low && **height < high);
        let mut corners: Vec<DVec3> = column.map(|height| self.place(node, *height)).collect();
        if from > to {
            corners.reverse();
        }
        corners
    }

    /// Returns the upper sides of all cells, and the undersides beyond the walls.
    fn slopes(&self) -> Vec<Patch> {
        let mut patches = Vec::new();
        let upper = self.map.cells.iter().map(|cell| (cell, true));
        for (cell, is_top) in upper.chain(self.map.undersides.iter().map(|cell| (cell, false))) {
            let gradient = self.field.planes[cell.side.plane].gradient;
            // The left of an edge is uphill.
            let along = -gradient.perp().normalize_or(DVec2::NEG_X);
            let raised = |ring: &Vec<u32>| {
                let height =
                    |node| if is_top { self.top(node, cell.side) } else { self.bottom(node, cell.side) };
                let corners = ring.iter().map(|node| self.place(*node, height(*node)));
                Ring::without_repeats(if is_top { corners.collect() } else { corners.rev().collect() })
            };
            let kind = if is_top { PatchKind::Slope } else { PatchKind::Underside };
            if let Some(triangles) = self.bent(cell, raised) {
                patches.extend(triangles.into_iter().filter_map(|triangle| {
                    Some(Patch { kind, edge: 0, flap: 0, along, rings: vec![raised(&triangle.to_vec())?] })
                }));
                continue;
            }
            let rings: Vec<Ring<DVec3>> = cell.rings.iter().filter_map(raised).collect();
            if !rings.is_empty() {
                patches.push(Patch { kind, edge: 0, flap: 0, along, rings });
            }
        }
        patches
    }

    /// Returns the triangles of a cell whose corners are not in its plane, as where steep eaves end above their slope. A small
    /// difference counts if `raised`, the rings at their heights, overlap seen along their normal, as where a short edge is
    /// steeper than the slope.
    fn bent(
        &self,
        cell: &RoofCell,
        raised: impl Fn(&Vec<u32>) -> Option<Ring<DVec3>>,
    ) -> Option<Vec<[u32; 3]>> {
        let nodes: Vec<u32> = cell.rings.iter().flatten().copied().collect();
        let plane = &self.field.planes[cell.side.plane];
        let off = |node: &u32| {
            (self.height(*node, cell.side.plane) - plane.height_at(self.map.places[*node as usize])).abs()
        };
        let most = nodes.iter().map(off).fold(0.0, f64::max);
        if nodes.len() == 3 || most <= FLAT {
            return None;
        }
        if most <= BENT {
            let rings: Vec<Ring<DVec3>> = cell.rings.iter().filter_map(raised).collect();
            let flat = FilledPolygon::new(&rings, DVec3::X, *rings.first()?.first()?);
            if flat.is_ok_and(|flat| flat.triangles.iter().all(|corners| flat.width(*corners) > 0.0)) {
                return None;
            }
        }
        let ring = |ring: &Vec<u32>| -> Vec<DVec2> {
            ring.iter().map(|node| self.map.places[*node as usize]).collect()
        };
        let triangles = triangulate(&cell.rings.iter().map(ring).collect::<Vec<_>>()).ok()?;
        Some(triangles.into_iter().map(|corners| corners.map(|corner| nodes[corner])).collect())
    }

    /// Adds the upright faces from the walls to the roof.
    fn add_walls(&self, patches: &mut Vec<Patch>) -> Result<()> {
        let mut by_ends: FxHashMap<[u32; 2], usize> = FxHashMap::default();
        for (number, CellEdge { ends: [a, b], .. }) in self.map.edges.iter().enumerate() {
            by_ends.entry([*a.min(b), *a.max(b)]).or_insert(number);
        }
        for (edge, nodes) in self.map.walls.iter().enumerate() {
            Stop::check_current()?;
            let (Some(&first), Some(&last)) = (nodes.first(), nodes.last()) else { continue };
            let along =
                (self.map.places[last as usize] - self.map.places[first as usize]).normalize_or_zero();
            let mut corners = vec![self.place(first, self.base), self.place(last, self.base)];
            let mut height = (last, self.base);
            for pair in nodes.windows(2).rev() {
                let Some(side) = self.wall_side(pair, &by_ends) else { continue };
                for node in [pair[1], pair[0]] {
                    let next = self.bottom(node, side);
                    if height.0 == node {
                        corners.extend(self.between(node, height.1, next));
                    }
                    corners.push(self.place(node, next));
                    height = (node, next);
                }
            }
            corners.extend(self.between(first, height.1, self.base));
            patches.extend(Patch::new(PatchKind::Gable, edge, 0, along, corners));
        }
        Ok(())
    }

    /// Returns the side on which the roof rests on a part of a wall: outside if it has an overhang there.
    fn wall_side(&self, pair: &[u32], by_ends: &FxHashMap<[u32; 2], usize>) -> Option<CellSide> {
        let number = by_ends.get(&[pair[0].min(pair[1]), pair[0].max(pair[1])])?;
        let edge = &self.map.edges[*number];
        let outside = edge.sides.iter().find(|side| side.zone == Zone::Eaves);
        outside.or_else(|| edge.sides.iter().find(|side| side.zone == Zone::Inside)).copied()
    }

    /// Adds the upright faces along the outline of the roof and between cells, and the undersides beyond the walls.
    fn add_steps(&self, patches: &mut Vec<Patch>) {
        for edge in &self.map.edges {
            let [left, right] = edge.sides;
            // Each face is seen from the side that has no roof at its height.
            for (ends, own, other) in [(edge.ends, left, right), ([edge.ends[1], edge.ends[0]], right, left)]
            {
                if own.zone == Zone::Outside {
                    continue;
                }
                let tops = ends.map(|node| self.top(node, own));
                let bottoms = ends.map(|node| self.bottom(node, own));
                if other.zone == Zone::Outside {
                    self.add_face(patches, PatchKind::Fascia, ends, bottoms, tops);
                    continue;
                }
                let other_tops = ends.map(|node| self.top(node, other));
                let is_plate = own.zone == Zone::Eaves && other.zone == Zone::Eaves;
                let other_bottoms = ends.map(|node| self.bottom(node, other));
                let is_above = |low: [f64; 2], high: [f64; 2]| low[0] <= high[0] && low[1] <= high[1];
                if is_plate && (is_above(tops, other_bottoms) || is_above(other_tops, bottoms)) {
                    // One plate is above the other one, so each has an end of its own.
                    self.add_face(patches, PatchKind::Fascia, ends, bottoms, tops);
                    continue;
                }
                if tops[0] + tops[1] > other_tops[0] + other_tops[1] {
                    self.add_face(patches, PatchKind::Gable, ends, other_tops, tops);
                }
                if is_plate && bottoms[0] + bottoms[1] < other_bottoms[0] + other_bottoms[1] {
                    self.add_face(patches, PatchKind::Gable, ends, bottoms, other_bottoms);
                }
            }
        }
    }

    /// Adds an upright face over an edge, between two heights (m) at both ends, seen from the right of the edge.
    fn add_face(
        &self,
        patches: &mut Vec<Patch>,
        kind: PatchKind,
        [a, b]: [u32; 2],
        low: [f64; 2],
        high: [f64; 2],
    ) {
        let mut corners = vec![self.place(a, low[0]), self.place(b, low[1])];
        corners.extend(self.between(b, low[1], high[1]));
        corners.extend([self.place(b, high[1]), self.place(a, high[0])]);
        corners.extend(self.between(a, high[0], low[0]));
        let along = (self.map.places[b as usize] - self.map.places[a as usize]).normalize_or_zero();
        patches.extend(Patch::new(kind, 0, 0, along, corners));
    }
}
