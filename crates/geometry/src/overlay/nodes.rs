//! The nodes of a subdivision: places of which those within a tolerance of each other are one.

use glam::DVec2;
use rustc_hash::FxHashMap;

/// The end of a list of nodes.
const END: u32 = u32::MAX;

/// The tolerances in the width of a cell: so few places lie near its border that mostly one cell is searched.
const CELL: f64 = 64.0;

/// Places, found by cells of a grid.
#[derive(Debug)]
pub(super) struct Nodes {
    pub(super) places: Vec<DVec2>,
    tolerance: f64,
    /// The first node of each cell.
    cells: FxHashMap<[i64; 2], u32>,
    /// By node: the next one of the same cell.
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

    /// Returns the node at a place, or else the nearest one within the tolerance that `may_be` allows; if there is none, the
    /// place becomes one.
    #[allow(clippy::cast_possible_truncation, reason = "fewer nodes than 2^32 fit into memory")]
    pub(super) fn find(&mut self, place: DVec2, may_be: impl Fn(u32) -> bool) -> u32 {
        // There is only one zero.
        let place = place + DVec2::ZERO;
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
