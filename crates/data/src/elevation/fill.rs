//! Smooth filling of holes in heights from their boundaries.

use rayon::prelude::*;

use super::holes::{self, Hole};
use super::spline::SplinePatch;
use burgeon_base::budget::Budget;
use burgeon_base::error::Result;

/// Replaces missing heights (NaN) by a smooth surface, and returns their number. Does nothing if all heights are
/// missing. Filled heights stay within the range of the known heights.
///
/// Each hole is filled by the surface of minimum bending and tension energy that continues the heights and slopes at
/// the hole's boundary.
///
/// Fails if the `budget` is exceeded.
pub(super) fn fill(columns: usize, rows: usize, heights: &mut [f32], budget: &Budget) -> Result<usize> {
    let missing = heights.iter().filter(|height| height.is_nan()).count();
    if missing == 0 || missing == heights.len() {
        return Ok(0);
    }
    budget.check()?;
    let before = budget.used_bytes();
    let holes = holes::find(columns, rows, heights, budget)?;
    let known = heights.iter().copied().filter(|height| !height.is_nan());
    let (low, high) = known
        .fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), height| (low.min(height), high.max(height)));
    let _held = budget.hold(missing * size_of::<f32>())?;
    let source = &*heights;
    let filled = holes.par_iter().map(|hole| surface(columns, source, hole, budget));
    let filled: Vec<Vec<f32>> = filled.collect::<Result<_>>()?;
    for (hole, surface) in holes.iter().zip(filled) {
        let mut surface = surface.into_iter();
        for run in &hole.runs {
            let line = &mut heights[run.row as usize * columns..][run.first as usize..run.end as usize];
            line.iter_mut().zip(&mut surface).for_each(|(height, found)| *height = found.clamp(low, high));
        }
    }
    budget.settle(before, 0);
    Ok(missing)
}

/// Returns the heights in a hole, run by run.
fn surface(columns: usize, heights: &[f32], hole: &Hole, budget: &Budget) -> Result<Vec<f32>> {
    let ([left, top], [right, bottom]) = (hole.low, hole.high);
    let mut patch = SplinePatch::new(right - left, bottom - top, budget, |row| {
        &heights[(top + row) * columns + left..][..right - left]
    })?;
    patch.fill(budget)?;
    let runs = hole.runs.iter().map(|run| [run.row, run.first, run.end].map(|number| number as usize));
    let found = runs.flat_map(|[row, first, end]| {
        patch.heights[(row - top) * (right - left)..][first - left..end - left].iter()
    });
    Ok(found.copied().collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::heights::{count, narrow};

    /// Returns a sloping plane of 200 by 120 samples.
    fn plane() -> Vec<f32> {
        let slope = |index: usize| 0.5 * count(index % 200) - 0.2 * count(index / 200) + 300.0;
        (0..200 * 120).map(|index| narrow(slope(index))).collect()
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
        assert!(worst < 0.1, "{worst}");
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

    /// Returns mountainous terrain: a sum of waves of different lengths, whose amplitude grows with their length.
    fn mountains(side: usize) -> Vec<f32> {
        let height = |x: f64, y: f64| {
            (0..9).map(move |octave| {
                let (scale, turn) = (0.01 * 1.7_f64.powi(octave), f64::from(octave) * 1.1);
                let (u, v) = (x * turn.cos() + y * turn.sin(), y * turn.cos() - x * turn.sin());
                400.0
                    * 0.5_f64.powi(octave)
                    * ((u * scale + turn).sin() + (v * scale * 0.8 + turn * 3.0).cos())
            })
        };
        let at = |index: usize| height(count(index % side), count(index / side)).sum::<f64>();
        (0..side * side).map(|index| narrow(1500.0 + at(index))).collect()
    }

    #[test]
    fn a_large_hole_in_mountains_is_filled_better_than_by_a_membrane() {
        let side = 400;
        let whole = mountains(side);
        let mut sums = [0.0_f64; 2];
        for (x, y) in [(80, 90), (200, 120), (310, 300), (120, 280)] {
            let is_hole = |index: usize| {
                (index % side).abs_diff(x).pow(2) + (index / side).abs_diff(y).pow(2) < 30 * 30
            };
            let mut heights = whole.clone();
            (0..heights.len()).filter(|index| is_hole(*index)).for_each(|index| heights[index] = f32::NAN);
            let mut membrane = heights.clone();
            fill(side, side, &mut heights, &Budget::default()).unwrap();
            let holes: Vec<usize> = (0..heights.len()).filter(|index| is_hole(*index)).collect();
            holes.iter().for_each(|hole| membrane[*hole] = 1500.0);
            for _ in 0..4000 {
                for hole in &holes {
                    let around = [hole - 1, hole + 1, hole - side, hole + side];
                    membrane[*hole] = around.iter().map(|near| membrane[*near]).sum::<f32>() / 4.0;
                }
            }
            for (sum, made) in sums.iter_mut().zip([&heights, &membrane]) {
                *sum += holes.iter().map(|hole| f64::from(made[*hole] - whole[*hole]).powi(2)).sum::<f64>();
            }
        }
        assert!(sums[0] < 0.6 * sums[1], "{sums:?}");
    }

    #[test]
    fn filling_ends_when_the_time_does() {
        let budget = Budget::new(usize::MAX, || Err(burgeon_base::error::Error::cancellation("over")));
        let mut heights = plane();
        heights[5] = f32::NAN;
        assert_eq!(fill(200, 120, &mut heights, &budget).unwrap_err().message(), "over");
    }
}
