//! Rivers: where water runs from a place, down to the standing water or over the rim.
//!
//! Method: Barnes, Lehman and Mulla, "Priority-flood", 2014: from the outlets on, the lowest cell that is reached next
//! tells its neighbours the way down, so that every cell has one, through hollows as well.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::{DVec2, DVec3};

use super::ground::GroundMap;

/// The cells of a map and the way down from each.
#[derive(Clone)]
pub struct Drainage {
    columns: usize,
    rows: usize,
    corner: DVec2,
    step: f64,
    heights: Vec<f64>,
    /// The cell that water runs to; itself for an outlet.
    next: Vec<u32>,
    /// The cells where a river runs already.
    wet: Vec<bool>,
}

/// Why no river runs from a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dry {
    /// It is at the rim, at the shore or in standing water, or outside.
    Outlet,
    /// It is in an earlier river, or beside one: water runs there already.
    River,
}

/// The most cells along a side that are looked at.
const MOST: usize = 1024;

/// As many cells as this are no river.
const SHORTEST: usize = 2;

impl Drainage {
    /// The ways down on `map`, to its rim and to all ground below `water` (m).
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
        // Heights from 0 on have the order of their bits; those below 0 are turned around.
        let key = |height: f64| {
            let bits = height.to_bits();
            if bits >> 63 == 1 { !bits } else { bits | 1 << 63 }
        };
        let mut open = BinaryHeap::new();
        for cell in 0..self.heights.len() {
            let (column, row) = (cell % self.columns, cell / self.columns);
            let rim = column == 0 || row == 0 || column + 1 == self.columns || row + 1 == self.rows;
            if rim || water.is_some_and(|water| self.heights[cell] <= water) {
                self.next[cell] = narrow(cell);
                open.push(Reverse((key(self.heights[cell]), narrow(cell))));
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
                    open.push(Reverse((level.max(key(self.heights[there])), narrow(there))));
                }
            }
        }
    }

    /// Lets a river run: its [`course`](Self::course), where later rivers end.
    pub fn river(&mut self, source: DVec2) -> Result<Vec<DVec3>, Dry> {
        let course = self.course(source)?;
        let cells: Vec<usize> = self.cell(source).into_iter().flat_map(|cell| self.way(cell)).collect();
        cells.into_iter().for_each(|cell| self.wet[cell] = true);
        Ok(course)
    }

    /// Path (m) of a river from `source` (m) to an outlet or into an earlier river, never rising. Fails if it is shorter than
    /// two cells.
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
        Ok(rounded(rounded(path.collect())))
    }

    /// Whether a river has a way from `source` (m).
    pub fn is_source(&self, source: DVec2) -> bool {
        self.cell(source).is_some_and(|cell| self.way(cell).nth(SHORTEST).is_some())
    }

    /// The cells that water runs through from one, until an outlet or an earlier river.
    fn way(&self, cell: usize) -> impl Iterator<Item = usize> + '_ {
        std::iter::successors(Some(cell), move |cell| {
            let next = self.next[*cell] as usize;
            (!self.wet[*cell] && next != *cell && next < self.heights.len()).then_some(next)
        })
    }

    /// The cell that a place (m) is in.
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

fn narrow(cell: usize) -> u32 {
    u32::try_from(cell).unwrap_or(u32::MAX)
}

/// A way whose corners are cut, with the same ends.
///
/// Method: Chaikin, "An algorithm for high-speed curve generation", 1974.
fn rounded(way: Vec<DVec3>) -> Vec<DVec3> {
    let (Some(&first), Some(&last)) = (way.first(), way.last()) else { return way };
    let pieces = way.windows(2).flat_map(|pair| [pair[0].lerp(pair[1], 0.25), pair[0].lerp(pair[1], 0.75)]);
    std::iter::once(first).chain(pieces).chain([last]).collect()
}
