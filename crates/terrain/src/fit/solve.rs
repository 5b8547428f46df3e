//! Optimization of the numbers of a rule table with fixed symbols.
//!
//! Method: damped least squares (Levenberg and Marquardt). The relief of a quadrant within a cell below it is
//! the scaled and raised relief of the cell's symbol, so the equations are accumulated over the cells of the
//! tree instead of its leaves.

use smallvec::SmallVec;

use super::code::{CellLevel, Code};
use super::targets::number;

/// Maximum factor of a decay: less than 1, so that heights converge at any depth.
pub(super) const MOST: f64 = 0.95;

/// Returns the mean squared difference between a map and `target`.
pub(super) fn misfit(cells: &[CellLevel], target: &[f64]) -> f64 {
    let heights = &cells[cells.len() - 1].heights;
    let squares: f64 = heights.iter().zip(target).map(|(height, wanted)| (height - wanted).powi(2)).sum();
    squares / number(target.len())
}

/// Reduces the difference between the map of `code` and `target`, along the Z curve, in at most `steps`
/// steps; never increases it.
pub(super) fn improve(code: &mut Code, target: &[f64], levels: usize, steps: usize) {
    let mut best = misfit(&code.cells(levels), target);
    let mut damping = 1e-3;
    for _ in 0..steps {
        code.balance();
        let equations = Equations::gather(code, &code.cells(levels), target, levels);
        let before = best;
        for _ in 0..4 {
            let found = equations.solve(damping).map(|step| {
                let code = apply_step(code, &step);
                (misfit(&code.cells(levels), target), code)
            });
            match found {
                Some((misfit, found)) if misfit < best => {
                    (best, *code) = (misfit, found);
                    damping = (damping * 0.1).max(1e-9);
                    break;
                }
                _ => damping *= 10.0,
            }
        }
        if before - best < 1e-3 * before {
            return;
        }
    }
}

/// Returns `code` with its numbers after a step.
fn apply_step(code: &Code, step: &[f64]) -> Code {
    let mut made = code.clone();
    made.height += step[0];
    let numbers = made.rules.iter_mut().flat_map(|rule| rule.change.iter_mut().zip(&mut rule.factor));
    for ((change, factor), step) in numbers.zip(step[1..].chunks_exact(2)) {
        *change += step[0];
        *factor = (*factor + step[1]).clamp(-MOST, MOST);
    }
    made
}

/// Normal equations of all numbers: the height of the root, then the change and the factor of each quadrant
/// of each rule.
struct Equations {
    size: usize,
    matrix: Vec<f64>,
    right: Vec<f64>,
}

/// Input of the equations.
struct EquationSource<'a> {
    code: &'a Code,
    cells: &'a [CellLevel],
    reliefs: &'a [Vec<f64>],
    /// Sum of each relief and of its squares.
    sums: &'a [Vec<(f64, f64)>],
    /// Missing height of each cell.
    missing: &'a [f64],
}

/// A quadrant on the path to a cell.
#[derive(Clone, Copy)]
struct PathQuadrant {
    /// Index of its change among the numbers; its factor follows.
    change: usize,
    decay: f64,
    /// Linear relation: its relief within the cell is `base` plus `scale` times the relief of the cell.
    base: f64,
    scale: f64,
}

impl PathQuadrant {
    fn within(self, change: f64, factor: f64) -> Self {
        Self { base: self.base + self.scale * change, scale: self.scale * factor, ..self }
    }
}

impl Equations {
    fn gather(code: &Code, cells: &[CellLevel], target: &[f64], levels: usize) -> Self {
        let size = 1 + code.rules.len() * 8;
        let mut all = Self { size, matrix: vec![0.0; size * size], right: vec![0.0; size] };
        let heights = &cells[levels].heights;
        let missing: Vec<f64> = target.iter().zip(heights).map(|(wanted, height)| wanted - height).collect();
        all.matrix[0] = number(target.len());
        all.right[0] = missing.iter().sum();
        let reliefs = code.reliefs(levels.saturating_sub(1));
        let sums = |(level, reliefs): (usize, &Vec<f64>)| {
            let parts = reliefs.chunks_exact(1 << (2 * level));
            parts.map(|part| (part.iter().sum(), dot(part, part))).collect()
        };
        let sums: Vec<Vec<(f64, f64)>> = reliefs.iter().enumerate().map(sums).collect();
        let known = EquationSource { code, cells, reliefs: &reliefs, sums: &sums, missing: &missing };
        all.descend(&known, 0, 0, &[]);
        all
    }

    /// Adds the terms of the cells below `cell`; `above` are the quadrants on the path to it.
    fn descend(&mut self, known: &EquationSource<'_>, level: usize, cell: usize, above: &[PathQuadrant]) {
        let below = known.cells.len() - level - 2;
        let count = 1 << (2 * below);
        let (symbol, decay) = (known.cells[level].symbols[cell], known.cells[level].decays[cell]);
        let rule = &known.code.rules[symbol];
        for quadrant in 0..4 {
            let child = 4 * cell + quadrant;
            let of = rule.symbols[quadrant];
            let relief = &known.reliefs[below][of * count..][..count];
            let (sum, square) = known.sums[below][of];
            let missing = &known.missing[child * count..][..count];
            let change = 1 + (symbol * 4 + quadrant) * 2;
            let factor = change + 1;
            self.right[change] += decay * missing.iter().sum::<f64>();
            self.right[factor] += decay * dot(missing, relief);
            self.add(change, 0, decay * number(count));
            self.add(factor, 0, decay * sum);
            let mut path: SmallVec<[PathQuadrant; 8]> =
                above.iter().map(|one| one.within(rule.change[quadrant], rule.factor[quadrant])).collect();
            for one in &path {
                let both = decay * one.decay;
                let relief = one.base * number(count) + one.scale * sum;
                self.add(change, one.change, both * number(count));
                self.add(change, one.change + 1, both * relief);
                if below > 0 {
                    self.add(factor, one.change, both * sum);
                    self.add(factor, one.change + 1, both * (one.base * sum + one.scale * square));
                }
            }
            let own = decay * decay;
            self.matrix[change * self.size + change] += own * number(count);
            self.matrix[factor * self.size + change] += own * sum;
            self.matrix[factor * self.size + factor] += own * square;
            if below > 0 {
                path.push(PathQuadrant { change, decay, base: 0.0, scale: 1.0 });
                self.descend(known, level + 1, child, &path);
            }
        }
    }

    /// Adds the product of the effects of two numbers, of which one is above the other on a path.
    fn add(&mut self, one: usize, other: usize, product: f64) {
        // A number that occurs twice on a path contributes both products.
        let product = if one == other { 2.0 * product } else { product };
        self.matrix[one.max(other) * self.size + one.min(other)] += product;
    }

    /// Solves the equations for a step; more `damping` makes it shorter. `None` if they are not positive
    /// definite.
    ///
    /// Method: Cholesky decomposition.
    fn solve(&self, damping: f64) -> Option<Vec<f64>> {
        let size = self.size;
        let mut lower = self.matrix.clone();
        for at in 0..size {
            lower[at * size + at] += damping * lower[at * size + at] + 1e-9;
        }
        for row in 0..size {
            let (done, rest) = lower.split_at_mut(row * size);
            let own = &mut rest[..size];
            for column in 0..row {
                let above = &done[column * size..][..size];
                own[column] = (own[column] - dot(&own[..column], &above[..column])) / above[column];
            }
            let square = own[row] - dot(&own[..row], &own[..row]);
            if square.is_nan() || square <= 0.0 {
                return None;
            }
            own[row] = square.sqrt();
        }
        let mut step = self.right.clone();
        for row in 0..size {
            let own = &lower[row * size..][..size];
            step[row] = (step[row] - dot(&own[..row], &step[..row])) / own[row];
        }
        for row in (0..size).rev() {
            step[row] /= lower[row * size + row];
            let known = step[row];
            for column in 0..row {
                step[column] -= lower[row * size + column] * known;
            }
        }
        step.iter().all(|number| number.is_finite()).then_some(step)
    }
}

/// Returns the dot product, in eight partial sums for SIMD instructions.
pub(super) fn dot(one: &[f64], other: &[f64]) -> f64 {
    let mut sums = [0.0; 8];
    let (ones, others) = (one.chunks_exact(8), other.chunks_exact(8));
    let rest: f64 = ones.remainder().iter().zip(others.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in ones.zip(others) {
        for at in 0..8 {
            sums[at] += a[at] * b[at];
        }
    }
    sums.iter().sum::<f64>() + rest
}
