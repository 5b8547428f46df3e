//! Fills holes in heights smoothly from their rims.

use crate::heights::count;
use burgeon_base::budget::Budget;
use burgeon_base::error::Result;

/// How often the heights in a hole are relaxed on each level.
const SWEEPS: usize = 6;

/// Gives each height that is missing (NaN) one that lies smoothly between those around its hole, and says how many
/// these were. Does nothing where all are missing.
///
/// Each level of a pyramid of halves begins with what the level above it found, and relaxes it towards the mean of its
/// neighbours: nearly the membrane over the rim, in linear time. Method: a cascade as in Bornemann and Deuflhard, "The
/// cascadic multigrid method for elliptic problems", 1996.
///
/// Fails if it takes more than the `budget`.
pub(super) fn fill(columns: usize, rows: usize, heights: &mut [f32], budget: &Budget) -> Result<usize> {
    // In each of the levels the numbers of the holes, and the next level.
    let missing = heights.iter().filter(|height| height.is_nan()).count();
    if missing == 0 || missing == heights.len() {
        return Ok(0);
    }
    budget.check()?;
    let _held = budget.hold(missing * size_of::<u32>() + heights.len())?;
    // Half as large as usize, for there may be many.
    let holes: Vec<u32> =
        (0u32..).zip(&*heights).filter(|(_, height)| height.is_nan()).map(|(at, _)| at).collect();
    let (across, down) = (columns.div_ceil(2), rows.div_ceil(2));
    let mut above = halve(columns, rows, heights, across);
    fill(across, down, &mut above, budget)?;
    for hole in holes.iter().map(|hole| *hole as usize) {
        let (column, row) = (hole % columns, hole / columns);
        heights[hole] = between(&above, across, down, (count(column) - 0.5) / 2.0, (count(row) - 0.5) / 2.0);
    }
    for sweep in 0..SWEEPS {
        budget.check()?;
        let mut relax = |hole: &u32| {
            let hole = *hole as usize;
            heights[hole] = mean_around(columns, rows, heights, hole);
        };
        // Back and forth, so that nothing drifts one way.
        if sweep % 2 == 0 {
            holes.iter().for_each(&mut relax);
        } else {
            holes.iter().rev().for_each(&mut relax);
        }
    }
    Ok(holes.len())
}

/// The means of known heights, two by two; NaN where none of the four is known.
fn halve(columns: usize, rows: usize, heights: &[f32], across: usize) -> Vec<f32> {
    let mut halves = Vec::with_capacity(across * rows.div_ceil(2));
    for row in (0..rows).step_by(2) {
        for column in (0..columns).step_by(2) {
            let (mut sum, mut known) = (0.0, 0.0);
            for y in row..rows.min(row + 2) {
                for height in &heights[y * columns + column..y * columns + columns.min(column + 2)] {
                    if !height.is_nan() {
                        sum += height;
                        known += 1.0;
                    }
                }
            }
            halves.push(sum / known);
        }
    }
    halves
}

/// The height between the four samples around a place in columns and rows, which may lie outside.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the samples")]
fn between(heights: &[f32], columns: usize, rows: usize, x: f64, y: f64) -> f32 {
    let (x, y) = (x.clamp(0.0, count(columns - 1)), y.clamp(0.0, count(rows - 1)));
    let (column, row) = (x as usize, y as usize);
    let (right, below) = ((column + 1).min(columns - 1), (row + 1).min(rows - 1));
    let (u, v) = (x.fract() as f32, y.fract() as f32);
    let along = |row: usize| {
        let (a, b) = (heights[row * columns + column], heights[row * columns + right]);
        a + (b - a) * u
    };
    let (a, b) = (along(row), along(below));
    a + (b - a) * v
}

/// The mean of the up to four neighbours of a sample.
fn mean_around(columns: usize, rows: usize, heights: &[f32], index: usize) -> f32 {
    let (column, row) = (index % columns, index / columns);
    let (mut sum, mut found) = (0.0, 0.0);
    let mut add = |there: bool, neighbour: usize| {
        if there {
            sum += heights[neighbour];
            found += 1.0;
        }
    };
    add(column > 0, index.wrapping_sub(1));
    add(column + 1 < columns, index + 1);
    add(row > 0, index.wrapping_sub(columns));
    add(row + 1 < rows, index + columns);
    sum / found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sloping plane of 200 by 120 samples.
    fn plane() -> Vec<f32> {
        let slope = |index: usize| 0.5 * count(index % 200) - 0.2 * count(index / 200) + 300.0;
        (0..200 * 120).map(|index| crate::heights::narrow(slope(index))).collect()
    }

    #[test]
    fn a_large_hole_in_a_slope_is_filled_as_the_slope_goes_on() {
        let (whole, mut heights) = (plane(), plane());
        let mut missing = 0;
        for row in 20..95 {
            for column in 30..150 {
                heights[row * 200 + column] = f32::NAN;
                missing += 1;
            }
        }
        heights[3] = f32::NAN;
        assert_eq!(fill(200, 120, &mut heights, &Budget::default()).unwrap(), missing + 1);
        let worst = heights.iter().zip(&whole).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        // The slope falls by 65 m over the hole.
        assert!(worst < 2.0, "{worst}");
    }

    #[test]
    fn a_hole_never_leaves_the_range_of_what_is_known() {
        let mut heights = vec![f32::NAN; 64 * 33];
        (heights[0], heights[64 * 33 - 1]) = (10.0, 20.0);
        assert_eq!(fill(64, 33, &mut heights, &Budget::default()).unwrap(), 64 * 33 - 2);
        assert!(heights.iter().all(|height| (10.0..=20.0).contains(height)));
        let mut none = vec![f32::NAN; 4];
        assert_eq!(fill(2, 2, &mut none, &Budget::default()).unwrap(), 0);
    }
}
