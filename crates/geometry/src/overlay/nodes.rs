//! Nodes of a subdivision: points, merged within a tolerance.

use glam::DVec2;
use rustc_hash::FxHashMap;

/// Marker for the end of a list of nodes.
const END: u32 = u32::MAX;

/// Width of a cell in units of the tolerance: few points lie near a border, so that a search mostly visits
/// one cell.
const CELL: f64 = 64.0;

/// Coordinates nearer to 0 count as 0. Products of smaller differences underflow, so that predicates are not exact.
const SMALLEST: f64 = 1e-100;

/// Returns 0 for -0 and for coordinates that are too small.
fn flush(coordinate: f64) -> f64 {
    if coordinate.abs() < SMALLEST { 0.0 } else { coordinate }
}

/// Points, indexed by the cells of a grid.
#[derive(Debug)]
pub(super) struct Nodes {
    pub(super) places: Vec<DVec2>,
    tolerance: f64,
    /// First node of each cell.
    cells: FxHashMap<[i64; 2], u32>,
    /// Next node of the same cell, by node.
    next: Vec<u32>,
}

impl Nodes {
    pub(super) fn new(tolerance: f64) -> Self {
        let tolerance = tolerance.max(f64::MIN_POSITIVE);
        Self { places: Vec::new(), tolerance, cells: FxHashMap::default(), next: Vec::new() }
    }

    #[allow(clippy::cast_possible_truncation, reason = "a conversion to integers saturates")]
    fn cell(&self, place: DVec2) -> [i64; 2] {
        let place = place / (self.tolerance * CELL);
        [place.x.floor() as i64, place.y.floor() as i64]
    }

    /// Returns the node at a point, or the closest node within the tolerance for which `may_be` returns true.
    ///
    /// If no such node exists, the point becomes a new node.
    #[allow(clippy::cast_possible_truncation, reason = "fewer nodes than 2^32 fit into memory")]
    pub(super) fn find(&mut self, place: DVec2, may_be: impl Fn(u32) -> bool) -> u32 {
        let place = DVec2::from_array(place.to_array().map(flush));
        let (low, high) = (self.cell(place - self.tolerance), self.cell(place + self.tolerance));
        let mut best: Option<(f64, u32)> = None;
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                let mut node = self.cells.get(&[x, y]).copied().unwrap_or(END);
                while node != END {
                    let far = self.places[node as usize].distance(place);
                    let is_near = far == 0.0 || far <= self.tolerance && may_be(node);
                    if is_near && best.is_none_or(|best| (far, node) < best) {
                        best = Some((far, node));
                    }
                    node = self.next[node as usize];
                }
            }
        }
        if let Some((_, node)) = best {
            return node;
        }
        let node = self.places.len() as u32;
        self.places.push(place);
        self.next.push(self.cells.insert(self.cell(place), node).unwrap_or(END));
        node
    }
}
