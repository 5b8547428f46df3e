//! Lots by boxes: a cell is repeatedly cut across its smallest bounding box.
//!
//! Method: C. Vanegas and others, "Procedural generation of parcels in urban modeling", 2012, with one difference: a
//! cut is made only if all resulting pieces are good.

use super::divide::Division;
use super::measure::{CellBox, extent};
use super::options::LotPattern;
use super::partition::{CellId, CellRings, CornerId, Cut};

/// Positions of a cut along a box, in the order in which they are tried.
const SHARES: [f64; 5] = [0.5, 0.42, 0.58, 0.33, 0.67];

impl Division<'_> {
    /// Divides a cell and the resulting pieces until all are small and short enough or cannot be cut.
    pub(super) fn by_boxes(&mut self, cell: CellId) {
        let mut due = vec![cell];
        while let Some(cell) = self.next(&mut due) {
            let rings = self.partition.rings(cell).to_vec();
            let is_great = self.partition.area(&rings) > self.options.area;
            if !is_great && !self.is_long(&rings) {
                continue;
            }
            let mut found = self.across_box(cell, &rings);
            if found.is_none() && is_great && self.options.pattern != LotPattern::Skeleton {
                found = self.behind_front(cell, &rings);
            }
            if let Some(cut) = found {
                let pieces = self.partition.commit(cut);
                due.extend(pieces.into_iter().rev());
            }
        }
    }

    /// Returns true if the elongation of a cell exceeds the maximum for a lot.
    pub(super) fn is_long(&self, rings: &[Vec<CornerId>]) -> bool {
        let around = self.partition.box_around(rings);
        around.is_some_and(|around| around.elongation() > self.options.elongation)
    }

    /// Returns a cut across the box of a cell, or otherwise along it, whose pieces are all good.
    fn across_box(&mut self, cell: CellId, rings: &CellRings) -> Option<Cut> {
        let around = self.partition.box_around(rings)?;
        let jitter = (self.draw() - 0.5) * self.options.jitter * 0.5;
        // A long or thin cell may be cut into pieces that are less so.
        let longest = (around.elongation() * 0.8).max(self.options.elongation);
        let bounds = [longest, self.options.min_width.min(around.size.y * 0.99)];
        for (axis, length) in [(around.along, around.size.x), (around.along.perp(), around.size.y)] {
            let middle = around.middle.dot(axis);
            let shares = SHARES.iter().map(|share| middle + (share + jitter - 0.5) * length);
            // A cell with holes, such as an area around streets, is first cut through the holes.
            let holes = rings[1..].iter().map(|hole| {
                let [low, high] = extent(hole.iter().map(|corner| self.partition.at(*corner)), axis);
                low + (high - low) * (0.5 + jitter)
            });
            for along in holes.chain(shares).collect::<Vec<_>>() {
                let place = around.middle + axis * (along - middle);
                let Some(cut) = self.partition.cut(cell, place, axis.perp()) else { continue };
                if cut.pieces.iter().all(|piece| self.is_good(piece, &cut, bounds)) {
                    return Some(cut);
                }
            }
        }
        None
    }

    /// Returns the cut that leaves lots of the usual depth along the front, and a court behind them.
    fn behind_front(&mut self, cell: CellId, rings: &CellRings) -> Option<Cut> {
        let fronts = self.partition.fronts(rings, None);
        let front = fronts.iter().max_by(|a, b| a.length.total_cmp(&b.length))?;
        let way = front.way();
        let inwards = way.perp();
        let reach = extent(self.partition.outline(rings), inwards)[1];
        let start = extent(front.points.iter().copied(), inwards)[1];
        let depth = self.options.depth * (1.0 + (self.draw() - 0.5) * self.options.jitter);
        if reach - start < depth * 1.6 {
            return None;
        }
        let at = front.points[0] + inwards * (start + depth - front.points[0].dot(inwards));
        let cut = self.partition.cut(cell, at, way)?;
        let bounds = [f64::INFINITY, self.options.min_width];
        let is_court = |piece: &CellRings| {
            self.partition.fronts(piece, Some(&cut)).is_empty()
                && self.partition.area(piece) >= self.options.min_area
        };
        let has_lot = cut.pieces.iter().any(|piece| self.is_good(piece, &cut, bounds));
        let all = |piece: &CellRings| self.is_good(piece, &cut, bounds) || is_court(piece);
        (has_lot && cut.pieces.iter().all(all)).then_some(cut)
    }

    /// Returns true if a piece can be one or more lots: it has access to a street, at most the elongation `longest`,
    /// and at least the width `least` (m).
    fn is_good(&self, piece: &CellRings, cut: &Cut, [longest, least]: [f64; 2]) -> bool {
        let area = self.partition.area(piece);
        let fits = |around: CellBox| around.elongation() <= longest && around.size.y >= least;
        area >= self.options.min_area
            && (piece.len() == 1 || area > self.options.area)
            && self.has_access(piece, Some(cut))
            && self.partition.box_around(piece).is_some_and(fits)
    }
}
