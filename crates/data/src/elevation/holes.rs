//! Holes in a raster: separate groups of missing samples.

use burgeon_base::budget::Budget;
use burgeon_base::error::Result;

/// Consecutive missing samples in a row.
#[derive(Clone, Copy)]
pub(super) struct HoleRun {
    pub(super) row: u32,
    pub(super) first: u32,
    /// Column after the last sample.
    pub(super) end: u32,
}

/// Group of missing samples, more than [`REACH`] samples away from any other group.
pub(super) struct Hole {
    pub(super) runs: Vec<HoleRun>,
    /// Minimum column and row, and end column and row, extended by a margin of [`REACH`] within the raster.
    pub(super) low: [usize; 2],
    pub(super) high: [usize; 2],
}

/// Maximum distance (samples) of the known heights that contribute to filling a hole.
pub(super) const REACH: usize = 3;

/// Maximum number of runs that are grouped.
const MOST_RUNS: usize = 4_000_000;

/// Finds the holes of a raster, ordered by their first samples. Returns a single hole if there are too many runs, or if
/// the boxes of the holes overlap too much.
pub(super) fn find(columns: usize, rows: usize, heights: &[f32], budget: &Budget) -> Result<Vec<Hole>> {
    let mut runs: Vec<HoleRun> = Vec::new();
    // Index of the first run of each row.
    let mut begins = Vec::with_capacity(rows + 1);
    for (row, line) in (0u32..).zip(heights.chunks_exact(columns)) {
        begins.push(runs.len());
        budget.tick()?;
        let mut open: Option<HoleRun> = None;
        for (column, height) in (0u32..).zip(line) {
            match (&mut open, height.is_nan()) {
                (Some(run), true) => run.end = column + 1,
                (Some(run), false) => {
                    runs.push(*run);
                    open = None;
                }
                (None, true) => open = Some(HoleRun { row, first: column, end: column + 1 }),
                (None, false) => {}
            }
        }
        runs.extend(open);
    }
    begins.push(runs.len());
    budget.take(runs.len() * 2 * (size_of::<HoleRun>() + 8))?;
    let whole = |runs: Vec<HoleRun>| vec![Hole { runs, low: [0; 2], high: [columns, rows] }];
    if runs.len() > MOST_RUNS {
        return Ok(whole(runs));
    }
    let mut groups = Groups((0..runs.len()).collect());
    for row in 0..rows {
        budget.tick()?;
        let own = begins[row]..begins[row + 1];
        for above in row.saturating_sub(REACH)..=row {
            let mut other = begins[above];
            for run in own.clone() {
                while other < begins[above + 1]
                    && runs[other].end as usize + REACH <= runs[run].first as usize
                {
                    other += 1;
                }
                let mut near = other;
                while near < begins[above + 1] && (runs[near].first as usize) < runs[run].end as usize + REACH
                {
                    groups.join(near, run);
                    near += 1;
                }
            }
        }
    }
    let mut holes: Vec<Hole> = Vec::new();
    // Index of the hole that begins with a run.
    let mut numbers = vec![usize::MAX; runs.len()];
    for (index, run) in runs.iter().enumerate() {
        let first = groups.first(index);
        if first == index {
            numbers[index] = holes.len();
            holes.push(Hole { runs: Vec::new(), low: [usize::MAX; 2], high: [0; 2] });
        }
        let hole = &mut holes[numbers[first]];
        let [first, end, row] = [run.first, run.end, run.row].map(|number| number as usize);
        hole.low = [hole.low[0].min(first.saturating_sub(REACH)), hole.low[1].min(row.saturating_sub(REACH))];
        hole.high =
            [hole.high[0].max((end + REACH).min(columns)), hole.high[1].max((row + 1 + REACH).min(rows))];
        hole.runs.push(*run);
    }
    let boxes = holes.iter().map(|hole| (hole.high[0] - hole.low[0]) * (hole.high[1] - hole.low[1]));
    if boxes.sum::<usize>() > 4 * columns * rows {
        return Ok(whole(runs));
    }
    Ok(holes)
}

/// Union-find structure over runs; the first run of each group is its representative.
struct Groups(Vec<usize>);

impl Groups {
    fn first(&mut self, mut run: usize) -> usize {
        while self.0[run] != run {
            self.0[run] = self.0[self.0[run]];
            run = self.0[run];
        }
        run
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.first(a), self.first(b));
        self.0[a.max(b)] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn holes_that_lie_apart_are_told_apart() {
        let mut heights = vec![0.0_f32; 40 * 30];
        let mut cut = |columns: std::ops::Range<usize>, rows: std::ops::Range<usize>| {
            for row in rows {
                heights[row * 40..][columns.clone()].fill(f32::NAN);
            }
        };
        cut(2..5, 2..4);
        // Two samples between them, which is too close.
        cut(7..9, 3..9);
        cut(20..30, 10..11);
        cut(22..23, 15..20);
        // A ring that contains another hole.
        cut(10..11, 20..30);
        cut(0..11, 20..21);
        cut(3..4, 26..27);
        let holes = find(40, 30, &heights, &Budget::default()).unwrap();
        let sizes: Vec<u32> =
            holes.iter().map(|hole| hole.runs.iter().map(|run| run.end - run.first).sum()).collect();
        assert_eq!(sizes, [3 * 2 + 2 * 6, 10, 5, 10 + 10, 1]);
        assert_eq!((holes[0].low, holes[0].high), ([0, 0], [12, 12]));
        assert_eq!((holes[3].low, holes[3].high), ([0, 17], [14, 30]));
    }
}
