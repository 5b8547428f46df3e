//! Lots by strips: a strip along each side of a block is cut across into lots; a court may remain behind the strips.
//!
//! Method: the faces of the straight skeleton, joined per side, form the strips. If two strips meet at a corner, the
//! longer one takes the area behind the other (C. Vanegas and others, "Procedural generation of parcels in urban
//! modeling", 2012).

use glam::DVec2;

use super::block::StreetBlock;
use super::divide::Division;
use super::measure::FrontRun;
use super::options::LotPattern;
use super::partition::{CellId, CellRings, CornerId};
use burgeon_geometry::skeleton::{Pace, Skeleton};
use burgeon_geometry::{Polygon, Rings};

/// Minimum half width of a court, as a fraction of the lot depth.
const COURT: f64 = 0.35;

impl Division<'_> {
    /// Divides a block; returns `None` without changes if the skeleton cannot be computed.
    pub(super) fn by_strips(&mut self, block: &StreetBlock) -> Option<()> {
        let polygon = Polygon::new(Rings::clone(&block.rings)).ok()?;
        let sides: Vec<Option<u32>> = block.edge_sides.iter().flatten().copied().collect();
        let paces: Vec<Pace> =
            sides.iter().map(|side| if side.is_some() { Pace::default() } else { Pace::STILL }).collect();
        let skeleton = Skeleton::for_mesh(&polygon, &paces).ok()?;
        let places: Vec<DVec2> = skeleton.peaks.iter().map(|peak| peak.at).collect();
        let cells = self.partition.tile(&places, &skeleton.faces)?;
        let depth = self.strip_depth(skeleton.duration());
        let mut parts: Vec<Vec<CellId>> = vec![Vec::new(); block.sides.len()];
        for ((cell, side), face) in cells.into_iter().zip(sides).zip(&skeleton.faces) {
            if let (Some(cell), Some(side)) = (cell, side) {
                let ends = [face[0], face[1]].map(|corner| places[corner]);
                parts[side as usize].push(self.before_court(cell, ends, depth));
            }
        }
        let mut strips: Vec<Option<CellId>> = parts.into_iter().map(|parts| self.strip(parts)).collect();
        self.settle_corners(&mut strips, block);
        for (side, strip) in (0..).zip(strips) {
            if let Some(strip) = strip {
                self.slice(strip, side);
            }
        }
        // A lot at a short side of its strip may extend far behind it, and a shallow strip far along its street.
        let cells = self.partition.cells();
        let great = cells
            .filter(|(_, rings)| self.partition.area(rings) > self.options.area * 1.3 || self.is_long(rings));
        for cell in great.map(|(cell, _)| cell).collect::<Vec<_>>() {
            if self.has_access(self.partition.rings(cell), None) {
                self.by_boxes(cell);
            }
        }
        Some(())
    }

    /// Joins the cells of a side in any order in which they touch.
    fn strip(&mut self, mut parts: Vec<CellId>) -> Option<CellId> {
        if let Some(strip) = self.partition.join(&parts) {
            return Some(strip);
        }
        let mut strip = (!parts.is_empty()).then(|| parts.remove(0))?;
        let mut left = usize::MAX;
        while parts.len() < left {
            left = parts.len();
            parts.retain(|part| match self.partition.join(&[strip, *part]) {
                Some(joined) => {
                    strip = joined;
                    false
                }
                None => true,
            });
        }
        Some(strip)
    }

    /// Returns the depth (m) of strips in a block whose points are all within `half` (m) of its border.
    fn strip_depth(&mut self, half: f64) -> f64 {
        let usual = match self.options.pattern {
            LotPattern::Skeleton => self.options.width * self.options.elongation * 0.75,
            _ => self.options.depth,
        };
        if half > usual * (1.0 + COURT) { usual } else { f64::INFINITY }
    }

    /// Cuts off the area beyond `depth` (m) from an edge of the block; returns the remaining cell.
    fn before_court(&mut self, cell: CellId, [a, b]: [DVec2; 2], depth: f64) -> CellId {
        let way = (b - a).normalize_or_zero();
        if !depth.is_finite() {
            return cell;
        }
        let Some(cut) = self.partition.cut(cell, a + way.perp() * depth, way) else { return cell };
        let fronts: Vec<bool> =
            cut.pieces.iter().map(|piece| !self.partition.fronts(piece, Some(&cut)).is_empty()).collect();
        if fronts.iter().filter(|is_front| **is_front).count() != 1 {
            return cell;
        }
        let pieces = self.partition.commit(cut);
        pieces.into_iter().zip(fronts).find(|(_, is_front)| *is_front).map_or(cell, |(piece, _)| piece)
    }

    /// Gives the corner between two adjacent strips to the strip of the longer side.
    fn settle_corners(&mut self, strips: &mut [Option<CellId>], block: &StreetBlock) {
        for index in 0..strips.len() {
            let Some(strip) = strips[index] else { continue };
            let beside: Vec<CellId> =
                self.partition.neighbors(strip).into_iter().map(|(cell, _)| cell).collect();
            let others: Vec<usize> = (index + 1..strips.len())
                .filter(|other| strips[*other].is_some_and(|cell| beside.contains(&cell)))
                .collect();
            for other in others {
                let length = |side: usize| block.sides[side].length;
                let pair = if length(index) >= length(other) { [index, other] } else { [other, index] };
                if let Some([joined, left]) = self.give_corner(strips, pair) {
                    strips[pair[0]] = joined;
                    strips[pair[1]] = left;
                }
            }
        }
    }

    /// Cuts the loser's strip across at the inner end of the border, and joins the corner to the winner's strip;
    /// returns both. If too little would remain, the winner takes the whole strip.
    fn give_corner(
        &mut self,
        strips: &[Option<CellId>],
        [winner, loser]: [usize; 2],
    ) -> Option<[Option<CellId>; 2]> {
        let (taker, giver) = (strips[winner]?, strips[loser]?);
        let border = self.border(giver, taker);
        let ends = [*border.first()?, *border.last()?];
        // One end of the border is at or near a corner of the block; the other is inside.
        let on_front = |corner: CornerId| self.is_on_front(corner, giver) && self.is_on_front(corner, taker);
        let [outer, inner] = match ends.map(on_front) {
            [true, false] => ends,
            [false, true] => [ends[1], ends[0]],
            _ => return None,
        };
        let side = u32::try_from(loser).ok()?;
        let fronts = self.partition.fronts(self.partition.rings(giver), None);
        let own = fronts.iter().filter(|front| front.side == side);
        let front = own.max_by(|a, b| a.length.total_cmp(&b.length))?;
        let place = self.partition.at(inner);
        let (way, along) = nearest_way(front, place)?;
        let begins = front.points[0].distance(self.partition.at(outer)) < front.length / 2.0;
        let left = if begins { front.length - along } else { along };
        let most = self.options.depth * self.options.depth * 1.5;
        if left < self.options.min_width {
            let is_small = self.partition.area(self.partition.rings(giver)) <= most;
            return is_small
                .then(|| self.partition.join(&[taker, giver]))
                .flatten()
                .map(|all| [Some(all), None]);
        }
        let cut = self.partition.cut(giver, place, way.perp())?;
        let corner = cut.pieces.iter().position(|piece| piece.iter().flatten().any(|at| *at == outer))?;
        let [a, b] = &cut.pieces[..] else { return None };
        let rest = if corner == 0 { b } else { a };
        let is_small = self.partition.area(&cut.pieces[corner]) <= most;
        let keeps = self.partition.fronts(rest, Some(&cut)).iter().any(|run| run.side == side);
        if !is_small || !keeps || rest.iter().flatten().any(|at| *at == outer) {
            return None;
        }
        let pieces = self.partition.commit(cut);
        let joined = self.partition.join(&[taker, pieces[corner]]).unwrap_or(taker);
        Some([Some(joined), Some(pieces[1 - corner])])
    }

    /// Returns the corners along which two cells meet, in the order of the first cell's ring; empty if they meet along
    /// several borders.
    fn border(&self, a: CellId, b: CellId) -> Vec<CornerId> {
        let mut chain: Vec<CornerId> = Vec::new();
        for ring in self.partition.rings(a) {
            let count = ring.len();
            let shared = |index: usize| {
                self.partition.cell_beside([ring[(index + 1) % count], ring[index % count]]) == Some(b)
            };
            let Some(start) = (0..count).find(|index| shared(*index) && !shared(index + count - 1)) else {
                continue;
            };
            let run = (start..start + count).take_while(|index| shared(*index));
            chain.extend(
                std::iter::once(start).chain(run.map(|index| index + 1)).map(|index| ring[index % count]),
            );
        }
        chain
    }

    /// Returns true if a corner of a cell is an end of one of its edges along a street.
    fn is_on_front(&self, corner: CornerId, cell: CellId) -> bool {
        let edges = self.partition.rings(cell).iter().flat_map(|ring| burgeon_geometry::planar::edges(ring));
        edges.into_iter().any(|edge| edge.contains(&corner) && self.partition.side(edge, None).is_some())
    }

    /// Cuts a strip across into lots of about the usual width.
    fn slice(&mut self, strip: CellId, side: u32) {
        let mut due = vec![strip];
        while let Some(cell) = self.next(&mut due) {
            let fronts = self.partition.fronts(self.partition.rings(cell), None).into_iter();
            let own = fronts.filter(|front| front.side == side);
            let Some(front) = own.max_by(|a, b| a.length.total_cmp(&b.length)) else { continue };
            let count = (front.length / self.options.width).round();
            if count < 2.0 {
                continue;
            }
            let half = (count / 2.0).floor();
            let jitter = (self.draw() - 0.5) * self.options.jitter;
            for shift in [0.0, 0.25, -0.25, 0.4, -0.4] {
                let place = (half + jitter + shift) / count * front.length;
                let Some((at, way)) = point_along(&front, place) else { continue };
                let Some(cut) = self.partition.cut(cell, at, way.perp()) else { continue };
                let is_wide = |piece: &CellRings| {
                    self.has_access(piece, Some(&cut)) && self.partition.area(piece) >= self.options.min_area
                };
                if cut.pieces.iter().all(is_wide) {
                    let pieces = self.partition.commit(cut);
                    due.extend(pieces.into_iter().rev());
                    break;
                }
            }
        }
    }
}

/// Returns the direction of the edge of a front that is nearest to a position, and its distance (m) along the front.
fn nearest_way(front: &FrontRun, place: DVec2) -> Option<(DVec2, f64)> {
    let mut passed = 0.0;
    let mut best: Option<(f64, DVec2, f64)> = None;
    for pair in front.points.windows(2) {
        let length = pair[0].distance(pair[1]);
        if length > 0.0 {
            let (distance, part) = crate::plan::grid::foot(place, [pair[0], pair[1]]);
            if best.is_none_or(|(known, ..)| distance < known) {
                best = Some((distance, (pair[1] - pair[0]) / length, passed + part * length));
            }
        }
        passed += length;
    }
    best.map(|(_, way, along)| (way, along))
}

/// Returns the position (m) at a distance along a front, and the direction there.
fn point_along(front: &FrontRun, along: f64) -> Option<(DVec2, DVec2)> {
    let mut left = along;
    for pair in front.points.windows(2) {
        let length = pair[0].distance(pair[1]);
        if left <= length && length > 0.0 {
            return Some((pair[0].lerp(pair[1], left / length), (pair[1] - pair[0]) / length));
        }
        left -= length;
    }
    None
}
