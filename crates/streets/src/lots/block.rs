//! Blocks: areas enclosed by streets, or areas from data, with their adjacent streets.

use glam::DVec2;

use super::fine::{self, FinePlace};
use crate::plan::network::{PieceId, StreetNetwork};
use crate::surface::parts::SurfaceOptions;
use burgeon_geometry::{Plan, Polygon, Rings};

/// Turn (degrees) of a street above which another side of a block begins.
const TURN: f64 = 35.0;
/// Maximum turn (degrees) of a side away from its first edge.
const BEND: f64 = 55.0;

/// Minimum difference between the distances of an edge's ends from a street, as a fraction of the edge's length, at
/// which the edge leads away from the street.
const LEADS_AWAY: f64 = 0.5;
/// Maximum distance (m) at which an edge that leads away is still adjacent to a street, such as a cut corner.
const BESIDE: f64 = 2.0;

/// Distance (m) within which an edge must be for the block to adjoin its streets. In such a block, edges farther than
/// `BEHIND` (m) are adjacent to no street.
const AT_STREET: f64 = 0.5;
const BEHIND: f64 = 2.0;

/// Side of a block: consecutive edges along a street.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlockSide {
    /// Street segment along most of the side; `None` if unknown.
    pub piece: Option<PieceId>,
    /// Length (m).
    pub length: f64,
}

/// Area to divide into lots.
#[derive(Debug, Clone, PartialEq)]
pub struct StreetBlock {
    /// Identifier, independent of the order of a list: the block's name, or the rounded position (m) of its centre.
    pub id: String,
    /// Rings (m), the outer one first, counter-clockwise.
    pub rings: Rings<DVec2>,
    /// Sides along streets.
    pub sides: Vec<BlockSide>,
    /// Side of each edge of each ring.
    pub(crate) edge_sides: Vec<Vec<Option<u32>>>,
    /// Adjacent street segment of each edge of each ring.
    edge_pieces: Vec<Vec<Option<PieceId>>>,
    /// Centrelines (m) of the adjacent segments, with their half widths (m), by side.
    side_lines: Vec<Vec<([DVec2; 2], f64)>>,
}

impl StreetBlock {
    /// Returns the area (m²) of the intersection with another block.
    pub fn common_area(&self, other: &Self) -> f64 {
        let [Ok(own), Ok(other)] = [self, other].map(|block| Polygon::new(block.rings.clone())) else {
            return 0.0;
        };
        own.area() - own.without(&[other]).iter().map(Polygon::area).sum::<f64>()
    }

    /// Returns the distance (m) of a position on a side from the edge of the adjacent street; 0 if the street is
    /// unknown.
    pub(super) fn off_street(&self, side: u32, place: DVec2) -> f64 {
        let lines = self.side_lines.get(side as usize).into_iter().flatten();
        let off = lines.map(|(line, half)| crate::plan::grid::foot(place, *line).0 - half);
        off.reduce(f64::min).unwrap_or(0.0)
    }

    /// Returns the adjacent street segment at a position on a side.
    pub(super) fn piece_at(&self, side: u32, place: DVec2) -> Option<PieceId> {
        let mut best = (f64::INFINITY, None);
        for (ring, (sides, pieces)) in self.rings.iter().zip(self.edge_sides.iter().zip(&self.edge_pieces)) {
            for (edge, (known, piece)) in burgeon_geometry::planar::edges(ring).zip(sides.iter().zip(pieces))
            {
                if *known == Some(side) {
                    let (distance, _) = crate::plan::grid::foot(place, edge);
                    if distance < best.0 {
                        best = (distance, *piece);
                    }
                }
            }
        }
        best.1
    }
}

/// Street adjacent to an edge.
#[derive(Clone, Copy)]
struct EdgeStreet {
    piece: Option<PieceId>,
    way: DVec2,
    /// Distance (m) of the edge's farther end from the street's edge.
    off: f64,
}

impl StreetNetwork {
    /// Returns the areas between the sidewalks, each with its sides along streets. Faces without remaining area are
    /// omitted.
    pub fn lot_blocks(&self, options: SurfaceOptions) -> Vec<StreetBlock> {
        let rings = self.blocks(options).into_iter();
        let mut blocks: Vec<StreetBlock> =
            rings.filter_map(|rings| self.block(None, &rings, f64::INFINITY)).collect();
        // A block around another may have the same centre.
        let mut known = rustc_hash::FxHashMap::<String, u32>::default();
        for block in &mut blocks {
            let count = known.entry(block.id.clone()).or_default();
            *count += 1;
            if *count > 1 {
                block.id = format!("{}#{count}", block.id);
            }
        }
        blocks
    }

    /// Returns the block enclosed by rings (m). Edges within `reach` (m) of a street are adjacent to it; without
    /// streets, all edges of the outer ring count as adjacent. Rings that intersect are repaired; `None` if they
    /// enclose no area.
    pub fn block(&self, id: Option<&str>, rings: &Rings<DVec2>, reach: f64) -> Option<StreetBlock> {
        let polygon = enclosed_area(rings)?;
        let rings = Rings::from(&polygon);
        let id = match id {
            Some(id) => id.to_owned(),
            None => {
                let middle = middle(&polygon);
                format!("{:.0}:{:.0}", middle.x + 0.0, middle.y + 0.0)
                    .replace("-0:", "0:")
                    .replace(":-0", ":0")
            }
        };
        let mut sides = Vec::new();
        let mut streets: Vec<Vec<Option<EdgeStreet>>> = Vec::new();
        for (number, ring) in rings.iter().enumerate() {
            let of_ring = burgeon_geometry::planar::edges(ring).map(|edge| {
                if self.size() > 0 {
                    return self.street_beside(edge, reach);
                }
                // Edges around a courtyard have no known streets.
                let way = (edge[1] - edge[0]).normalize_or_zero();
                (number == 0).then_some(EdgeStreet { piece: None, way, off: 0.0 })
            });
            streets.push(of_ring.collect());
        }
        // If a block adjoins its streets, edges farther away are behind an obstacle, such as a river along the street.
        let nearest =
            streets.iter().flatten().flatten().map(|street| street.off).fold(f64::INFINITY, f64::min);
        if reach.is_finite() && nearest < AT_STREET {
            let is_near = |street: &EdgeStreet| street.off <= BEHIND;
            streets.iter_mut().flatten().for_each(|street| *street = street.filter(is_near));
        }
        let piece_of = |street: &Option<EdgeStreet>| street.and_then(|street| street.piece);
        let edge_pieces: Vec<Vec<Option<PieceId>>> =
            streets.iter().map(|ring| ring.iter().map(piece_of).collect()).collect();
        let of_rings = rings.iter().zip(&streets);
        let edge_sides: Vec<Vec<Option<u32>>> =
            of_rings.map(|(ring, streets)| sides_of(ring, streets, &mut sides)).collect();
        let mut side_lines = vec![Vec::new(); sides.len()];
        for (side, piece) in edge_sides.iter().flatten().zip(edge_pieces.iter().flatten()) {
            if let (Some(side), Some(piece)) = (side, piece) {
                let line = (self.line(*piece), self.half(*piece));
                let known: &mut Vec<([DVec2; 2], f64)> = &mut side_lines[*side as usize];
                if known.last() != Some(&line) {
                    known.push(line);
                }
            }
        }
        Some(StreetBlock { id, rings, sides, edge_sides, edge_pieces, side_lines })
    }

    /// Returns the street adjacent to an edge: the street with the edge nearest to the midpoint.
    fn street_beside(&self, [a, b]: [DVec2; 2], reach: f64) -> Option<EdgeStreet> {
        let middle = (a + b) / 2.0;
        let along = (b - a).normalize_or_zero();
        let beyond = |piece: PieceId| {
            let (distance, _) = crate::plan::grid::foot(middle, self.line(piece));
            // Of streets at the same distance, the one parallel to the edge is preferred.
            let [from, to] = self.line(piece);
            let turned = along.perp_dot((to - from).normalize_or_zero()).abs();
            distance - self.half(piece) + turned * 0.5
        };
        let margin = self.widest() / 2.0 + reach.min(30.0);
        let near = self.ground_near([middle, middle], margin);
        let near =
            near.map(|piece| (beyond(piece), piece)).min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let (distance, piece) = match near {
            Some(found) => found,
            None => {
                let (piece, _) = self.nearest_on_ground(middle).filter(|_| reach.is_infinite())?;
                (0.0, piece)
            }
        };
        let [from, to] = self.line(piece);
        // An edge that starts at a street and leads away from it, such as a river bank, is not adjacent to it.
        let off = |at: DVec2| crate::plan::grid::foot(at, [from, to]).0 - self.half(piece);
        let [begin, end] = [off(a), off(b)];
        if reach.is_finite() {
            let leads_away = (begin - end).abs() > LEADS_AWAY * a.distance(b);
            if begin.max(end) > reach + 0.5 || (leads_away && begin.max(end) > BESIDE) {
                return None;
            }
        }
        let way = (to - from).normalize_or_zero();
        let way = if way.dot(along) < 0.0 { -way } else { way };
        let off = begin.max(end);
        (distance <= reach + 0.5).then_some(EdgeStreet { piece: Some(piece), way, off })
    }
}

/// Returns the area enclosed by rings; the rings themselves if they are simple.
fn enclosed_area(rings: &Rings<DVec2>) -> Option<Polygon> {
    let polygon = Polygon::new(rings.clone()).ok();
    let places =
        |ring: &Vec<DVec2>| ring.iter().map(|at| FinePlace::nearest(*at)).collect::<Option<Vec<_>>>();
    let fine: Option<Vec<Vec<FinePlace>>> = rings.iter().map(places).collect();
    if fine.is_some_and(|rings| fine::are_simple(&rings)) && polygon.is_some() {
        return polygon;
    }
    // A ring with the wrong orientation encloses no area.
    Polygon::new(Rings(vec![rings.first()?.clone()])).ok()?;
    Some(Plan::new(&rings.at_height(0.0)).ok()?.flat())
}

/// Returns the centroid (m) of the area inside the outer ring.
fn middle(polygon: &Polygon) -> DVec2 {
    let Some(outer) = polygon.outer() else { return DVec2::ZERO };
    let from = outer[0];
    let (mut sum, mut area) = (DVec2::ZERO, 0.0);
    for pair in outer[1..].windows(2) {
        let [a, b] = [pair[0] - from, pair[1] - from];
        let twice = a.perp_dot(b);
        sum += (a + b) * twice / 3.0;
        area += twice;
    }
    from + sum / area
}

/// Joins edges along streets to sides; returns the side of each edge.
fn sides_of(ring: &[DVec2], streets: &[Option<EdgeStreet>], sides: &mut Vec<BlockSide>) -> Vec<Option<u32>> {
    let count = ring.len();
    let length = |index: usize| ring[index].distance(ring[(index + 1) % count]);
    let turn = |a: DVec2, b: DVec2| a.angle_to(b).abs().to_degrees();
    let breaks = |index: usize| {
        let (before, here) = (streets[(index + count - 1) % count], streets[index]);
        match (before, here) {
            (Some(before), Some(here)) => turn(before.way, here.way) > TURN,
            _ => true,
        }
    };
    let start = (0..count).find(|index| breaks(*index)).unwrap_or(0);
    let mut found = vec![None; count];
    let mut first = DVec2::ZERO;
    // Longest edge of the current side; its street becomes the street of the side.
    let mut longest = 0.0;
    for offset in 0..count {
        let index = (start + offset) % count;
        let Some(street) = streets[index] else { continue };
        if offset == 0 || breaks(index) || turn(first, street.way) > BEND || sides.is_empty() {
            sides.push(BlockSide { piece: street.piece, length: 0.0 });
            first = street.way;
            longest = 0.0;
        }
        let number = sides.len() - 1;
        let side = &mut sides[number];
        side.length += length(index);
        if length(index) > longest {
            longest = length(index);
            side.piece = street.piece;
        }
        found[index] = u32::try_from(number).ok();
    }
    found
}
