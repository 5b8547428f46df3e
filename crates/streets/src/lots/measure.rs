//! Measurements of a cell: its bounding box, and its fronts along streets.

use glam::DVec2;

use super::partition::{CornerId, Cut, Partition};
use burgeon_geometry::planar;

/// Tolerance (m) for distances from a street that count as equal.
const AS_NEAR: f64 = 0.5;

/// Oriented bounding box of minimum area around a cell.
#[derive(Debug, Clone, Copy)]
pub(super) struct CellBox {
    pub(super) middle: DVec2,
    /// Direction of the longer sides.
    pub(super) along: DVec2,
    /// Length and width (m), the greater first.
    pub(super) size: DVec2,
}

impl CellBox {
    /// Returns the ratio of length to width.
    pub(super) fn elongation(&self) -> f64 {
        self.size.x / self.size.y.max(1e-9)
    }
}

/// Run of edges along one side of the block.
#[derive(Debug, Clone)]
pub(super) struct FrontRun {
    pub(super) side: u32,
    pub(super) points: Vec<DVec2>,
    pub(super) length: f64,
}

impl FrontRun {
    /// Returns the midpoint (m) of the front, or of its longest part that is nearest to the street, with distances (m)
    /// from `off`.
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

    /// Returns the direction from end to end, with the cell on the left.
    pub(super) fn way(&self) -> DVec2 {
        (self.points[self.points.len() - 1] - self.points[0]).normalize_or_zero()
    }
}

/// Returns the point (m) halfway along a line of at least one point.
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

/// Returns the minimum and maximum (m) of positions along a direction.
pub(super) fn extent(places: impl IntoIterator<Item = DVec2>, way: DVec2) -> [f64; 2] {
    let range = [f64::INFINITY, f64::NEG_INFINITY];
    places.into_iter().fold(range, |[low, high], at| {
        let along = at.dot(way);
        [low.min(along), high.max(along)]
    })
}

impl Partition {
    /// Returns the corners (m) of the outer ring of a cell.
    pub(super) fn outline<'a>(&'a self, rings: &'a [Vec<CornerId>]) -> impl Iterator<Item = DVec2> + 'a {
        rings.first().into_iter().flatten().map(|corner| self.at(*corner))
    }

    /// Returns the smallest bounding box of a cell; `None` if the cell has no area.
    ///
    /// Method: one side of the box is along an edge of the hull (H. Freeman and R. Shapira, "Determining the
    /// minimum-area encasing rectangle for an arbitrary closed curve", 1975).
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

    /// Returns the fronts of a cell: runs of edges, each along one side of the block.
    pub(super) fn fronts(&self, rings: &[Vec<CornerId>], cut: Option<&Cut>) -> Vec<FrontRun> {
        let mut runs = Vec::new();
        for ring in rings {
            let sides: Vec<Option<u32>> = planar::edges(ring).map(|edge| self.side(edge, cut)).collect();
            // Start at the beginning of a run, so that no run is split in two.
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
