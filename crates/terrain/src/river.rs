//! Rivers: flow paths from a point down to standing water or over the boundary.
//!
//! Method: Barnes, Lehman and Mulla, "Priority-flood", 2014. Starting at the outlets, the lowest open cell
//! becomes the downstream cell of its neighbours, so that every cell has a flow direction, also through
//! hollows.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::{DVec2, DVec3};

use crate::tiles::ground::GroundMap;

/// The cells of a map, with their flow directions.
///
/// ```
/// use burgeon_terrain::{Drainage, GroundMap};
/// use glam::DVec2;
///
/// // A valley that falls to the east.
/// let heights = (0..64_i32).map(|cell| f64::from(8 - cell % 8 + 4 * (cell / 8 - 4).abs())).collect();
/// let map = GroundMap { columns: 8, rows: 8, corner: DVec2::ZERO, step: 10.0, heights };
/// let mut drainage = Drainage::new(&map, None);
/// let source = DVec2::new(25.0, 35.0);
/// let river = drainage.river(source).expect("a way to the edge of the map");
/// assert!(river.last().is_some_and(|mouth| mouth.x > 70.0));
/// assert!(river.is_sorted_by(|a, b| a.z >= b.z));
/// assert!(!drainage.is_source(source), "a river is there now");
/// ```
#[derive(Clone)]
pub struct Drainage {
    columns: usize,
    rows: usize,
    corner: DVec2,
    step: f64,
    heights: Vec<f64>,
    /// Downstream cell of each cell; the cell itself for an outlet.
    next: Vec<u32>,
    /// Marks cells with an existing river.
    wet: Vec<bool>,
}

/// Reason why no river starts at a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dry {
    /// The point is on the boundary, at the shore, in standing water, or outside.
    Outlet,
    /// The point is in or next to an earlier river.
    River,
}

/// Maximum number of cells per side of the flow map.
const MOST: usize = 1024;

/// Maximum number of cells of a path that is too short for a river.
const SHORTEST: usize = 2;

impl Drainage {
    /// Computes the flow directions on `map`, to its boundary and to all ground below `water` (m).
    pub fn new(map: &GroundMap, water: Option<f64>) -> Self {
        let every = map.columns.max(map.rows).div_ceil(MOST).max(1);
        let (columns, rows) = (map.columns.div_ceil(every), map.rows.div_ceil(every));
        let at = |cell: usize| {
            let (column, row) = (cell % columns * every, cell / columns * every);
            map.heights[row.min(map.rows - 1) * map.columns + column.min(map.columns - 1)]
        };
        let heights: Vec<f64> = (0..columns * rows).map(at).collect();
        #[allow(clippy::cast_precision_loss, reason = "few cells")]
        let step = map.step * every as f64;
        #[allow(clippy::cast_precision_loss, reason = "few cells")]
        let north = map.corner.y + map.step * map.rows as f64;
        let mut drainage = Self {
            corner: DVec2::new(map.corner.x, north),
            columns,
            rows,
            step,
            next: vec![u32::MAX; heights.len()],
            wet: vec![false; heights.len()],
            heights,
        };
        drainage.flood(water);
        drainage
    }

    fn flood(&mut self, water: Option<f64>) {
        // The bits of non-negative numbers are in ascending order; the bits of negative numbers are inverted.
        let key = |height: f64| {
            let bits = height.to_bits();
            if bits >> 63 == 1 { !bits } else { bits | 1 << 63 }
        };
        let mut open = BinaryHeap::new();
        for cell in 0..self.heights.len() {
            let (column, row) = (cell % self.columns, cell / self.columns);
            let rim = column == 0 || row == 0 || column + 1 == self.columns || row + 1 == self.rows;
            if rim || water.is_some_and(|water| self.heights[cell] <= water) {
                self.next[cell] = to_u32(cell);
                open.push(Reverse((key(self.heights[cell]), to_u32(cell))));
            }
        }
        while let Some(Reverse((level, cell))) = open.pop() {
            let here = cell as usize;
            let (column, row) = (here % self.columns, here / self.columns);
            for (right, down) in [(-1, 0), (1, 0), (0, -1), (0, 1), (-1, -1), (1, -1), (-1, 1), (1, 1)] {
                let (Some(column), Some(row)) =
                    (column.checked_add_signed(right), row.checked_add_signed(down))
                else {
                    continue;
                };
                if column >= self.columns || row >= self.rows {
                    continue;
                }
                let there = row * self.columns + column;
                if self.next[there] == u32::MAX {
                    self.next[there] = cell;
                    // Water in a hollow rises to its rim.
                    open.push(Reverse((level.max(key(self.heights[there])), to_u32(there))));
                }
            }
        }
    }

    /// Adds a river along its [`course`](Self::course), where later rivers end.
    pub fn river(&mut self, source: DVec2) -> Result<Vec<DVec3>, Dry> {
        let course = self.course(source)?;
        let cells: Vec<usize> = self.cell(source).into_iter().flat_map(|cell| self.way(cell)).collect();
        cells.into_iter().for_each(|cell| self.wet[cell] = true);
        Ok(course)
    }

    /// Returns the path (m) of a river from `source` (m) to an outlet or into an earlier river, never rising.
    /// Fails if it has at most two cells.
    pub fn course(&self, source: DVec2) -> Result<Vec<DVec3>, Dry> {
        let cells: Vec<usize> = self.cell(source).into_iter().flat_map(|cell| self.way(cell)).collect();
        if cells.len() <= SHORTEST {
            let is_wet = cells.last().is_some_and(|cell| self.wet[*cell]);
            return Err(if is_wet { Dry::River } else { Dry::Outlet });
        }
        let mut level = f64::INFINITY;
        let path = cells.into_iter().map(|cell| {
            level = level.min(self.heights[cell]);
            self.middle(cell).extend(level)
        });
        Ok(round_corners(round_corners(path.collect())))
    }

    /// Returns true if a river can start at `source` (m).
    pub fn is_source(&self, source: DVec2) -> bool {
        self.cell(source).is_some_and(|cell| self.way(cell).nth(SHORTEST).is_some())
    }

    /// Returns the cells downstream of a cell, up to an outlet or an earlier river.
    fn way(&self, cell: usize) -> impl Iterator<Item = usize> + '_ {
        std::iter::successors(Some(cell), move |cell| {
            let next = self.next[*cell] as usize;
            (!self.wet[*cell] && next != *cell && next < self.heights.len()).then_some(next)
        })
    }

    /// Returns the cell that contains a point (m).
    fn cell(&self, place: DVec2) -> Option<usize> {
        let along = DVec2::new(place.x - self.corner.x, self.corner.y - place.y) / self.step;
        if along.min_element() < 0.0 {
            return None;
        }
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "not below 0")]
        let (column, row) = (along.x as usize, along.y as usize);
        (column < self.columns && row < self.rows).then_some(row * self.columns + column)
    }

    #[allow(clippy::cast_precision_loss, reason = "few cells")]
    fn middle(&self, cell: usize) -> DVec2 {
        let (column, row) = (cell % self.columns, cell / self.columns);
        self.corner + DVec2::new(column as f64 + 0.5, -(row as f64 + 0.5)) * self.step
    }
}

fn to_u32(cell: usize) -> u32 {
    u32::try_from(cell).unwrap_or(u32::MAX)
}

/// Returns a path with rounded corners and the same ends.
///
/// Method: Chaikin, "An algorithm for high-speed curve generation", 1974.
fn round_corners(way: Vec<DVec3>) -> Vec<DVec3> {
    let (Some(&first), Some(&last)) = (way.first(), way.last()) else { return way };
    let pieces = way.windows(2).flat_map(|pair| [pair[0].lerp(pair[1], 0.25), pair[0].lerp(pair[1], 0.75)]);
    std::iter::once(first).chain(pieces).chain([last]).collect()
}
