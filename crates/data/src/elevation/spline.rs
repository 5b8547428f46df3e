//! Surface over a hole: a thin plate under tension.
//!
//! Source: Smith and Wessel, "Gridding with continuous curvature splines in tension", 1990. Method: conjugate gradients
//! on each level of a pyramid of halves; each level starts from the result of the next coarser level. This is a cascade
//! as in Bornemann and Deuflhard, "The cascadic multigrid method for elliptic problems", 1996.

use crate::heights::count;
use burgeon_base::budget::Budget;
use burgeon_base::error::Result;

/// Resistance of the surface to stretching, relative to its resistance to bending, for samples at distance 1.
const TENSION: f32 = 0.03;

/// Maximum size of a patch; larger patches are only smoothed on their finest levels.
const MOST: usize = 16_000_000;

/// Number of smoothing sweeps.
const SWEEPS: usize = 6;

/// Approximate number of heights computed in all rounds of a level, and the minimum and maximum number of rounds.
const WORK: usize = 40_000_000;
const ROUNDS: [usize; 2] = [30, 4000];

/// Reduction of the squared residual at which a level ends.
const ACCURACY: f64 = 1e-11;

/// Part of a raster with holes (NaN).
pub(super) struct SplinePatch {
    columns: usize,
    rows: usize,
    pub(super) heights: Vec<f32>,
    tension: f32,
}

impl SplinePatch {
    /// Creates a patch; `line` returns its rows.
    pub(super) fn new<'h>(
        columns: usize,
        rows: usize,
        budget: &Budget,
        line: impl Fn(usize) -> &'h [f32],
    ) -> Result<Self> {
        let _held = budget.hold(columns * rows * 2 * size_of::<f32>())?;
        let heights = (0..rows).flat_map(|row| line(row).iter().copied()).collect();
        Ok(Self { columns, rows, heights, tension: TENSION })
    }

    /// Fills the holes. At least one height must be known.
    pub(super) fn fill(&mut self, budget: &Budget) -> Result<()> {
        let missing = self.heights.iter().filter(|height| height.is_nan()).count();
        if missing == 0 {
            return Ok(());
        }
        budget.check()?;
        let _held = budget.hold(missing * size_of::<u32>() + self.heights.len() * size_of::<f32>() / 4)?;
        let holes: Vec<u32> =
            (0u32..).zip(&self.heights).filter(|(_, height)| height.is_nan()).map(|(at, _)| at).collect();
        let mut above = self.halve();
        above.fill(budget)?;
        for hole in holes.iter().map(|hole| *hole as usize) {
            let (column, row) = (count(hole % self.columns), count(hole / self.columns));
            self.heights[hole] = above.interpolate((column - 0.5) / 2.0, (row - 0.5) / 2.0);
        }
        drop(above);
        if self.heights.len() <= MOST { self.bend(&holes, budget) } else { self.smooth(&holes, budget) }
    }

    /// Returns the means of two by two heights; NaN if none of the four is known. Missing heights among the four are
    /// [extrapolated](Self::continued), so slopes keep their position.
    fn halve(&self) -> Self {
        let (columns, rows) = (self.columns.div_ceil(2), self.rows.div_ceil(2));
        let mut heights = Vec::with_capacity(columns * rows);
        for row in (0..self.rows).step_by(2) {
            for column in (0..self.columns).step_by(2) {
                let places = || {
                    let down = row..self.rows.min(row + 2);
                    down.flat_map(|y| (column..self.columns.min(column + 2)).map(move |x| (x, y)))
                };
                let is_known = |(x, y): (usize, usize)| !self.heights[y * self.columns + x].is_nan();
                let (mut sum, mut known) = (0.0, 0.0);
                if places().any(is_known) {
                    for (x, y) in places() {
                        let height = self.extrapolate(x, y);
                        if !height.is_nan() {
                            sum += height;
                            known += 1.0;
                        }
                    }
                }
                heights.push(sum / known);
            }
        }
        Self { columns, rows, heights, tension: self.tension * 4.0 }
    }

    /// Returns the height of a sample. If it is missing, returns the mean of the linear extrapolations of its row and
    /// its column from each side, or NaN if there is none.
    fn extrapolate(&self, x: usize, y: usize) -> f32 {
        let height = self.heights[y * self.columns + x];
        if !height.is_nan() {
            return height;
        }
        let at = |right: isize, down: isize| {
            let (x, y) = (x.checked_add_signed(right)?, y.checked_add_signed(down)?);
            (x < self.columns && y < self.rows).then(|| self.heights[y * self.columns + x])
        };
        let (mut sum, mut count) = (0.0, 0.0);
        for (right, down) in [(-1, 0), (1, 0), (0, -1), (0, 1)] {
            if let (Some(near), Some(far)) = (at(right, down), at(2 * right, 2 * down))
                && !(near + far).is_nan()
            {
                sum += 2.0 * near - far;
                count += 1.0;
            }
        }
        sum / count
    }

    /// Interpolates the height between the four samples around a position in columns and rows, which may be outside.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the samples")]
    fn interpolate(&self, x: f64, y: f64) -> f32 {
        let (x, y) = (x.clamp(0.0, count(self.columns - 1)), y.clamp(0.0, count(self.rows - 1)));
        let (column, row) = (x as usize, y as usize);
        let (right, below) = ((column + 1).min(self.columns - 1), (row + 1).min(self.rows - 1));
        let (u, v) = (x.fract() as f32, y.fract() as f32);
        let along = |row: usize| {
            let line = &self.heights[row * self.columns..];
            line[column] + (line[right] - line[column]) * u
        };
        let (a, b) = (along(row), along(below));
        a + (b - a) * v
    }

    /// Returns the up to four neighbours of a sample.
    #[inline]
    fn around(&self, index: usize) -> impl Iterator<Item = usize> + use<> {
        let (column, row) = (index % self.columns, index / self.columns);
        let (right, below) = (column + 1 < self.columns, row + 1 < self.rows);
        let columns = self.columns;
        [
            (column > 0).then(|| index - 1),
            right.then_some(index + 1),
            (row > 0).then(|| index - columns),
            below.then_some(index + columns),
        ]
        .into_iter()
        .flatten()
    }

    /// Returns the sum of the height differences between a sample's neighbours and the sample.
    #[inline]
    fn rise(&self, values: &[f32], index: usize) -> f32 {
        self.around(index).map(|near| values[near] - values[index]).sum()
    }

    /// Moves the heights in `holes` towards the surface of minimum energy.
    fn bend(&mut self, holes: &[u32], budget: &Budget) -> Result<()> {
        let size = self.heights.len();
        let _held = budget.hold(size * (2 * size_of::<f32>() + 1) + holes.len() * 4 * size_of::<f32>())?;
        // Samples whose bending depends on the holes.
        let mut bends = vec![false; size];
        for hole in holes.iter().map(|hole| *hole as usize) {
            bends[hole] = true;
            self.around(hole).for_each(|near| bends[near] = true);
        }
        let bends: Vec<u32> = (0u32..).zip(bends).filter(|(_, bends)| *bends).map(|(at, _)| at).collect();
        let mut rises = vec![0.0_f32; size];
        let tension = self.tension;
        let force = |patch: &Self, values: &[f32], rises: &mut [f32], into: &mut [f32]| {
            for at in &bends {
                rises[*at as usize] = patch.rise(values, *at as usize);
            }
            for (force, hole) in into.iter_mut().zip(holes) {
                let hole = *hole as usize;
                *force = patch.rise(rises, hole) - tension * rises[hole];
            }
        };
        let mut residual = vec![0.0_f32; holes.len()];
        force(self, &self.heights, &mut rises, &mut residual);
        residual.iter_mut().for_each(|value| *value = -*value);
        let mut way = vec![0.0_f32; size];
        for (value, hole) in residual.iter().zip(holes) {
            way[*hole as usize] = *value;
        }
        let mut pull = vec![0.0_f32; holes.len()];
        let square = |values: &[f32]| values.iter().map(|value| f64::from(*value).powi(2)).sum::<f64>();
        let mut left = square(&residual);
        let enough = left * ACCURACY;
        for _ in 0..(WORK / holes.len()).clamp(ROUNDS[0], ROUNDS[1]) {
            budget.check()?;
            if left <= enough {
                break;
            }
            force(self, &way, &mut rises, &mut pull);
            let along =
                pull.iter().zip(holes).map(|(pull, hole)| f64::from(*pull) * f64::from(way[*hole as usize]));
            let step = (left / along.sum::<f64>()) as f32;
            if !step.is_finite() {
                break;
            }
            for ((residual, pull), hole) in residual.iter_mut().zip(&pull).zip(holes) {
                self.heights[*hole as usize] += step * way[*hole as usize];
                *residual -= step * pull;
            }
            let before = std::mem::replace(&mut left, square(&residual));
            let turn = (left / before) as f32;
            for (residual, hole) in residual.iter().zip(holes) {
                let way = &mut way[*hole as usize];
                *way = residual + turn * *way;
            }
        }
        Ok(())
    }

    /// Moves the heights in `holes` towards the means of their neighbours.
    fn smooth(&mut self, holes: &[u32], budget: &Budget) -> Result<()> {
        for sweep in 0..SWEEPS {
            budget.check()?;
            let mut relax = |hole: &u32| {
                let hole = *hole as usize;
                self.heights[hole] += self.rise(&self.heights, hole) / count_around(self.around(hole));
            };
            // Alternating directions avoid a drift in one direction.
            if sweep % 2 == 0 {
                holes.iter().for_each(&mut relax);
            } else {
                holes.iter().rev().for_each(&mut relax);
            }
        }
        Ok(())
    }
}

fn count_around(around: impl Iterator<Item = usize>) -> f32 {
    around.map(|_| 1.0_f32).sum::<f32>().max(1.0)
}
