//! Grid of cells with contents that spread by diffusion.

use burgeon_base::error::{Error, Result};
use burgeon_base::{MemoryOwner, Stop};
use glam::DVec3;

/// Maximum number of cells.
const MOST_CELLS: usize = 1 << 25;
/// Maximum number of cells along an axis.
const LONGEST: f64 = 1e6;
/// Largest absolute coordinate (m) of the grid.
const FARTHEST: f64 = 1e6;
/// Number of cells between two checks for cancellation.
const STRETCH: usize = 1 << 16;

/// Contents of the cells of a box.
#[derive(Debug, Clone)]
pub(super) struct CellGrid {
    /// Lowest corner (m).
    low: DVec3,
    /// Length of the side of a cell (m).
    cell: f64,
    /// Numbers of cells along x, y and z.
    counts: [usize; 3],
    /// Content of each cell, x first and z last.
    contents: Vec<f64>,
}

impl CellGrid {
    /// Creates cells with this content in a box of this size (m), below the centre of its upper side.
    ///
    /// The size is rounded to whole cells, at least one along each axis.
    pub(super) fn new(size: DVec3, top: DVec3, cell: f64, content: f64) -> Result<Self> {
        let refuse = |message: String, help: &str| Err(Error::argument(message).help(help));
        if !(cell > 0.0 && cell <= FARTHEST) {
            return refuse(format!("cell is {cell}"), "give a length (m) above 0");
        }
        let [x, y, z] = size.to_array();
        if !(size.min_element() > 0.0 && size.max_element() <= FARTHEST) {
            return refuse(format!("size is {{{x:?}, {y:?}, {z:?}}}"), "give three lengths (m) above 0");
        }
        if top.abs().max_element() > FARTHEST || !top.is_finite() {
            return refuse(format!("position is {top}"), "give a place (m) near the origin");
        }
        let counts = (size / cell).round().max(DVec3::ONE);
        let too_many = || {
            refuse(
                format!("the grid of {} by {} by {} cells is too large", counts.x, counts.y, counts.z),
                "use larger cells",
            )
        };
        if counts.max_element() > LONGEST {
            return too_many();
        }
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a positive integer of at most a million"
        )]
        let counts_of = counts.to_array().map(|count| count as usize);
        let all = counts_of.iter().fold(1_usize, |all, count| all.saturating_mul(*count));
        if all > MOST_CELLS {
            return too_many();
        }
        MemoryOwner::ensure_room(all * size_of::<f64>())?;
        let low = top - DVec3::new(counts.x / 2.0, counts.y / 2.0, counts.z) * cell;
        Ok(Self { low, cell, counts: counts_of, contents: vec![content; all] })
    }

    /// Returns the length of the side of a cell (m).
    pub(super) fn cell(&self) -> f64 {
        self.cell
    }

    /// Returns the sum of all contents.
    pub(super) fn total(&self) -> f64 {
        self.contents.iter().sum()
    }

    /// Returns the content of the cell at a place (m), 0 outside.
    pub(super) fn content(&self, place: DVec3) -> f64 {
        self.cell_at(place).map_or(0.0, |cell| self.contents[self.index(cell)])
    }

    /// Returns the centre (m) of the cell at a place (m); `None` outside.
    pub(super) fn center_of(&self, place: DVec3) -> Option<DVec3> {
        self.cell_at(place).map(|cell| self.center(cell))
    }

    /// Returns the numbers of the cell at a place; the upper sides belong to the last cells.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked to be in the grid")]
    fn cell_at(&self, place: DVec3) -> Option<[usize; 3]> {
        let at = ((place - self.low) / self.cell).to_array();
        let is_inside = (0..3).all(|axis| (0.0..=self.counts[axis] as f64).contains(&at[axis]));
        is_inside.then(|| [0, 1, 2].map(|axis| (at[axis] as usize).min(self.counts[axis] - 1)))
    }

    fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.counts[1] + y) * self.counts[0] + x
    }

    fn center(&self, cell: [usize; 3]) -> DVec3 {
        self.low + DVec3::from_array(cell.map(|number| number as f64 + 0.5)) * self.cell
    }

    /// Calls `use_cell` with the index and the centre (m) of each cell whose centre is in a ball (m), and of the cell at its
    /// centre.
    fn for_each(&self, center: DVec3, radius: f64, mut use_cell: impl FnMut(usize, DVec3)) -> Result<()> {
        let own = self.cell_at(center);
        // Cells at the same distance count alike, in spite of rounding.
        let square = radius * radius * (1.0 + 1e-9);
        let [from, to] = [-radius, radius].map(|reach| (center + reach - self.low) / self.cell);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the grid")]
        let bound = |at: f64, count: usize| at.floor().clamp(0.0, count as f64) as usize;
        let range = |axis: usize| {
            let count = self.counts[axis];
            bound(from[axis], count)..bound(to[axis] + 1.0, count)
        };
        let mut number = 0;
        for z in range(2) {
            for y in range(1) {
                number += range(0).len() + 1;
                if number >= STRETCH {
                    number = 0;
                    Stop::check_current()?;
                }
                for x in range(0) {
                    let at = self.center([x, y, z]);
                    if at.distance_squared(center) <= square || own == Some([x, y, z]) {
                        use_cell(self.index([x, y, z]), at);
                    }
                }
            }
        }
        Ok(())
    }

    /// Calls `change` with the content of each cell in a ball (m).
    pub(super) fn in_ball(
        &mut self,
        center: DVec3,
        radius: f64,
        mut change: impl FnMut(&mut f64),
    ) -> Result<()> {
        let mut contents = std::mem::take(&mut self.contents);
        let done = self.for_each(center, radius, |index, _| change(&mut contents[index]));
        self.contents = contents;
        done
    }

    /// Calls `read` with the centre (m) and the content of each cell in a ball (m).
    pub(super) fn read_ball(
        &self,
        center: DVec3,
        radius: f64,
        mut read: impl FnMut(DVec3, f64),
    ) -> Result<()> {
        self.for_each(center, radius, |index, at| read(at, self.contents[index]))
    }

    /// Spreads the contents by a diffusion of `rate` (m²): diffusivity multiplied by the duration. Nothing leaves the box.
    ///
    /// Method: backward Euler with one tridiagonal system (L. Thomas, 1949) for each row of cells along each axis. The
    /// systems of the axes commute, so that their order does not matter.
    pub(super) fn diffuse(&mut self, rate: f64) -> Result<()> {
        // Rates above this give the mean value up to rounding.
        let share = (rate / (self.cell * self.cell)).min(1e15);
        if share <= 0.0 {
            return Ok(());
        }
        for axis in 0..3 {
            let count = self.counts[axis];
            if count == 1 {
                continue;
            }
            let (pivots, factors) = elimination(count, share);
            let step = self.counts[..axis].iter().product::<usize>();
            let mut row = vec![0.0; count];
            let mut number = 0;
            for block in (0..self.contents.len()).step_by(step * count) {
                for first in block..block + step {
                    number += count;
                    if number >= STRETCH {
                        number = 0;
                        Stop::check_current()?;
                    }
                    let mut before = 0.0;
                    for at in 0..count {
                        before = (self.contents[first + at * step] + share * before) / pivots[at];
                        row[at] = before;
                    }
                    let mut after = 0.0;
                    for at in (0..count).rev() {
                        after = row[at] + factors[at] * after;
                        self.contents[first + at * step] = after;
                    }
                }
            }
        }
        Ok(())
    }
}

/// Returns the pivots of the elimination of the system of a row, and the factors of its back substitution.
fn elimination(count: usize, share: f64) -> (Vec<f64>, Vec<f64>) {
    let (mut pivots, mut factors) = (Vec::with_capacity(count), Vec::with_capacity(count));
    // The excess of the pivot over `share`, which is more precise than their difference for large shares.
    let mut excess = 1.0;
    for at in 0..count {
        let pivot = if at + 1 < count { excess + share } else { excess };
        pivots.push(pivot);
        factors.push(if at + 1 < count { share / pivot } else { 0.0 });
        excess = 1.0 + share * excess / pivot;
    }
    (pivots, factors)
}
