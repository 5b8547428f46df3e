//! What is measured on a cell: the box around it, and where it is on streets.

use glam::DVec2;

use super::partition::{CornerId, Cut, Partition};
use burgeon_geometry::planar;

/// Places that are farther from a street by less (m) are as near as others.
const AS_NEAR: f64 = 0.5;

/// A box around a cell, turned so that it is as small as can be.
#[derive(Debug, Clone, Copy)]
pub(super) struct CellBox {
    pub(super) middle: DVec2,
    /// The direction of its longer sides.
    pub(super) along: DVec2,
    /// Its length and its width (m), the greater first.
    pub(super) size: DVec2,
}

impl CellBox {
    /// How many times it is as long as wide.
    pub(super) fn elongation(&self) -> f64 {
        self.size.x / self.size.y.max(1e-9)
    }
}

/// A run of edges on one side of the block.
#[derive(Debug, Clone)]
pub(super) struct FrontRun {
    pub(super) side: u32,
    pub(super) points: Vec<DVec2>,
    pub(super) length: f64,
}

impl FrontRun {
    /// The place (m) half of the way along it, or along the longest part of it that is as near to the street as any, where that
    /// is `off` (m) from it.
    pub(super) fn access(&self, off: impl Fn(DVec2) -> f64) -> DVec2 {
        let middle = middle(&self.points);
        let nearest = self.points.iter().map(|at| off(*at)).fold(f64::INFINITY, f64::min);
        let is_near = |at: DVec2| off(at) <= nearest + AS_NEAR;
        if !nearest.is_finite() || is_near(middle) {
            return middle;
        }
        let mut best: (f64, DVec2) = (-1.0, middle);
        let mut part: Vec<DVec2> = Vec::new();
        for (index, at) in self.points.iter().enumerate() {
            if is_near(*at) {
                part.push(*at);
            }
            if !is_near(*at) || index + 1 == self.points.len() {
                let length = part.windows(2).map(|pair| pair[0].distance(pair[1])).sum::<f64>();
                if !part.is_empty() && length > best.0 {
                    best = (length, self::middle(&part));
                }
                part.clear();
            }
        }
        best.1
    }

    /// Its direction from end to end, with the cell on its left.
    pub(super) fn way(&self) -> DVec2 {
        (self.points[self.points.len() - 1] - self.points[0]).normalize_or_zero()
    }
}

/// The place (m) half of the way along a line of a point or more.
fn middle(points: &[DVec2]) -> DVec2 {
    let mut left = points.windows(2).map(|pair| pair[0].distance(pair[1])).sum::<f64>() / 2.0;
    for pair in points.windows(2) {
        let length = pair[0].distance(pair[1]);
        if left <= length && length > 0.0 {
            return pair[0].lerp(pair[1], left / length);
        }
        left -= length;
    }
    points[0]
}

/// The extent (m) of places along a direction: the least and the greatest.
pub(super) fn extent(places: impl IntoIterator<Item = DVec2>, way: DVec2) -> [f64; 2] {
    let range = [f64::INFINITY, f64::NEG_INFINITY];
    places.into_iter().fold(range, |[low, high], at| {
        let along = at.dot(way);
        [low.min(along), high.max(along)]
    })
}

impl Partition {
    /// The corners (m) of the outer ring of a cell.
    pub(super) fn outline<'a>(&'a self, rings: &'a [Vec<CornerId>]) -> impl Iterator<Item = DVec2> + 'a {
        rings.first().into_iter().flatten().map(|corner| self.at(*corner))
    }

    /// The smallest box around a cell; `None` of one without area.
    ///
    /// Method: one of its sides is along an edge of the hull (H. Freeman and R. Shapira, "Determining the minimum-area
    /// encasing rectangle for an arbitrary closed curve", 1975).
    pub(super) fn box_around(&self, rings: &[Vec<CornerId>]) -> Option<CellBox> {
        let hull = planar::hull(self.outline(rings))?;
        let boxes = planar::edges(&hull).filter_map(|[a, b]| {
            let way = (b - a).try_normalize()?;
            let [x, y] = [way, way.perp()].map(|axis| extent(hull.iter().copied(), axis));
            let size = DVec2::new(x[1] - x[0], y[1] - y[0]);
            let middle = way * (x[0] + x[1]) / 2.0 + way.perp() * (y[0] + y[1]) / 2.0;
            Some(if size.x >= size.y {
                CellBox { middle, along: way, size }
            } else {
                CellBox { middle, along: way.perp(), size: DVec2::new(size.y, size.x) }
            })
        });
        boxes.min_by(|a, b| a.size.element_product().total_cmp(&b.size.element_product()))
    }

    /// Where a cell is on streets: runs of edges, each on one side of the block.
    pub(super) fn fronts(&self, rings: &[Vec<CornerId>], cut: Option<&Cut>) -> Vec<FrontRun> {
        let mut runs = Vec::new();
        for ring in rings {
            let sides: Vec<Option<u32>> = planar::edges(ring).map(|edge| self.side(edge, cut)).collect();
            // Begin where a run begins, so that none is told in two.
            let begins = |index: &usize| sides[*index] != sides[(*index + ring.len() - 1) % ring.len()];
            let start = (0..ring.len()).find(begins).unwrap_or(0);
            let mut last = None;
            for index in (0..ring.len()).map(|offset| (start + offset) % ring.len()) {
                let side = sides[index];
                let [from, to] = [index, index + 1].map(|index| self.at(ring[index % ring.len()]));
                if let Some(number) = side {
                    if last != side {
                        runs.push(FrontRun { side: number, points: vec![from], length: 0.0 });
                    }
                    if let Some(run) = runs.last_mut() {
                        run.points.push(to);
                        run.length += from.distance(to);
                    }
                }
                last = side;
            }
        }
        runs
    }
}
