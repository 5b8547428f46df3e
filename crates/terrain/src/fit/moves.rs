//! Changes to the symbols of a rule table: another symbol for a quadrant, a split of one symbol into two, a
//! merger of two symbols.

use super::code::{CellLevel, Code};
use super::solve::{MOST, dot, improve, misfit};
use super::targets::{self, number};
use burgeon_base::random::Stream;

/// Target of the fit, scaled to 0..1, along the Z curve.
pub(super) struct Problem {
    /// Number of divisions of the root cell.
    pub levels: usize,
    /// Target height of each cell.
    pub wanted: Vec<f64>,
    /// Sum of the target heights below each cell of each level.
    sums: Vec<Vec<f64>>,
}

/// A possible successor of a quadrant of a rule.
#[derive(Debug, Clone, Copy)]
struct QuadrantChoice {
    symbol: usize,
    change: f64,
    factor: f64,
    /// Reduction of the squared error.
    gain: f64,
}

/// A quadrant of a rule: symbol and index of the quadrant.
type QuadrantPlace = (usize, usize);

impl Problem {
    /// Creates the problem of a map along the Z curve with 4 to the power of `levels` cells.
    pub(super) fn new(wanted: Vec<f64>, levels: usize) -> Self {
        let mut sums = vec![wanted.clone()];
        for _ in 0..levels {
            let below = &sums[sums.len() - 1];
            sums.push(below.chunks_exact(4).map(|four| four.iter().sum()).collect());
        }
        sums.reverse();
        Self { levels, wanted, sums }
    }

    /// Returns the error of the map of `code` relative to the target, each scaled to 0..1.
    pub(super) fn error(&self, code: &Code) -> f64 {
        let cells = code.cells(self.levels);
        targets::error(&self.wanted, &cells[self.levels].heights)
    }

    /// Improves the numbers of `code` in at most `steps` steps.
    pub(super) fn improve(&self, code: &mut Code, steps: usize) {
        improve(code, &self.wanted, self.levels, steps);
    }

    fn misfit(&self, code: &Code) -> f64 {
        misfit(&code.cells(self.levels), &self.wanted)
    }

    /// Computes, for each quadrant of the rules of `wanted` symbols, the best numbers with each symbol; empty
    /// for unused rules.
    ///
    /// The relief of each symbol is assumed to stay the same.
    fn survey(&self, code: &Code, wanted: impl Fn(usize) -> bool) -> Vec<Vec<QuadrantChoice>> {
        let cells = code.cells(self.levels);
        let reliefs = code.reliefs(self.levels - 1);
        let mut sums = vec![Sums::none(code.rules.len()); code.rules.len() * 4];
        for (level, here) in cells.iter().enumerate().take(self.levels) {
            let below = 2 * (self.levels - level - 1);
            let size = 1 << below;
            let relief = &reliefs[below / 2];
            let totals: Vec<(f64, f64)> =
                relief.chunks_exact(size).map(|part| (part.iter().sum(), dot(part, part))).collect();
            for (cell, symbol) in here.symbols.iter().enumerate().filter(|(_, symbol)| wanted(**symbol)) {
                let (base, decay) = (here.heights[cell], here.decays[cell]);
                for quadrant in 0..4 {
                    let child = 4 * cell + quadrant;
                    let wanted = &self.wanted[child << below..][..size];
                    let sums = &mut sums[symbol * 4 + quadrant];
                    sums.cover += decay * decay * number(size);
                    sums.height += decay * (self.sums[level + 1][child] - base * number(size));
                    if below == 0 {
                        continue;
                    }
                    let parts = relief.chunks_exact(size).zip(&totals);
                    for (by, (part, (sum, square))) in sums.by.iter_mut().zip(parts) {
                        by[0] += decay * decay * sum;
                        by[1] += decay * decay * square;
                        by[2] += decay * (dot(wanted, part) - base * sum);
                    }
                }
            }
        }
        sums.iter().map(Sums::choices).collect()
    }

    /// Assigns another promising symbol to a quadrant of a rule.
    pub(super) fn turn(&self, code: &mut Code, stream: &mut Stream) {
        let survey = self.survey(code, |_| true);
        let mut turns: Vec<(f64, QuadrantPlace, QuadrantChoice)> = Vec::new();
        for (place, choices) in survey.iter().enumerate() {
            let place = (place / 4, place % 4);
            let now = code.rules[place.0].symbols[place.1];
            let others = choices.iter().filter(|choice| choice.symbol != now);
            turns.extend(others.map(|choice| (choices[now].gain - choice.gain, place, *choice)));
        }
        turns.sort_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((_, place, choice)) = turns.get(rank(turns.len(), 0.9, stream)) {
            set(code, *place, *choice);
        }
    }

    /// Eliminates one of the used symbols, preferably one that others can replace well, and returns its
    /// index.
    pub(super) fn retire(&self, code: &mut Code, stream: &mut Stream) -> Option<usize> {
        let survey = self.survey(code, |_| true);
        let mut goers = Vec::new();
        for gone in used_symbols(code).into_iter().skip(1) {
            let mut cost = 0.0;
            let mut changes = Vec::new();
            for place in places(code, |symbol| symbol == gone) {
                let choices = &survey[place.0 * 4 + place.1];
                let others = choices.iter().filter(|choice| choice.symbol != gone);
                let best = others.max_by(|a, b| a.gain.total_cmp(&b.gain));
                if let Some(best) = best.filter(|_| place.0 != gone) {
                    cost += choices[gone].gain - best.gain;
                    changes.push((place, *best));
                }
            }
            goers.push((cost, gone, changes));
        }
        goers.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (_, gone, changes) = goers.get(rank(goers.len(), 0.7, stream))?;
        for (place, choice) in changes {
            set(code, *place, *choice);
        }
        Some(*gone)
    }

    /// Splits a symbol that occurs in several quadrants: one of these, preferably one with a large error,
    /// gets the copy `spare`, which is unused or the next new symbol. Then both symbols are fitted again.
    pub(super) fn split(&self, code: &mut Code, spare: usize, stream: &mut Stream) {
        let uses = code.uses();
        let several = places(code, |symbol| uses[symbol] > 1);
        if several.is_empty() {
            return;
        }
        let missing = self.missing(code);
        let weight = |place: &QuadrantPlace| missing[place.0 * 4 + place.1];
        let whole: f64 = several.iter().map(weight).sum();
        let mut left = stream.uniform() * whole;
        let found = several.iter().find(|place| {
            left -= weight(place);
            left < 0.0
        });
        let place = *found.unwrap_or(&several[0]);
        let symbol = code.rules[place.0].symbols[place.1];
        let copy = code.rules[symbol];
        match code.rules.get_mut(spare) {
            Some(rule) => *rule = copy,
            None => code.rules.push(copy),
        }
        code.rules[place.0].symbols[place.1] = spare;
        self.refit(code, spare);
        self.refit(code, symbol);
    }

    /// Assigns the best successor to each quadrant of a rule, if that reduces the error.
    pub(super) fn refit(&self, code: &mut Code, symbol: usize) {
        let survey = self.survey(code, |known| known == symbol);
        let mut misfit = self.misfit(code);
        for quadrant in 0..4 {
            let choices = survey[symbol * 4 + quadrant].iter();
            let Some(choice) = choices.max_by(|a, b| a.gain.total_cmp(&b.gain)) else { return };
            let mut made = code.clone();
            set(&mut made, (symbol, quadrant), *choice);
            let found = self.misfit(&made);
            if found < misfit {
                (*code, misfit) = (made, found);
            }
        }
    }

    /// Returns the squared error below each quadrant of each rule, summed over the levels.
    fn missing(&self, code: &Code) -> Vec<f64> {
        let cells: Vec<CellLevel> = code.cells(self.levels);
        let heights = &cells[self.levels].heights;
        let mut below: Vec<f64> = heights.iter().zip(&self.wanted).map(|(a, b)| (a - b).powi(2)).collect();
        let mut missing = vec![0.0; code.rules.len() * 4];
        for level in cells.iter().rev().skip(1) {
            for (child, missed) in below.iter().enumerate() {
                missing[level.symbols[child >> 2] * 4 + (child & 3)] += missed;
            }
            below = below.chunks_exact(4).map(|four| four.iter().sum()).collect();
        }
        missing
    }
}

/// Sums of the equations for the change and the factor of a quadrant, for each possible symbol.
#[derive(Clone)]
struct Sums {
    /// Sum of the squared decays.
    cover: f64,
    /// Sum of the target heights multiplied by the decays.
    height: f64,
    /// For each symbol: the relief and its square, multiplied by the squared decays, and the relief
    /// multiplied by the heights.
    by: Vec<[f64; 3]>,
}

impl Sums {
    fn none(symbols: usize) -> Self {
        Self { cover: 0.0, height: 0.0, by: vec![[0.0; 3]; symbols] }
    }

    /// Returns the best numbers of the quadrant for each symbol.
    fn choices(&self) -> Vec<QuadrantChoice> {
        let (cover, height) = (self.cover, self.height);
        if cover <= 1e-12 {
            return Vec::new();
        }
        let choice = |(symbol, [mixed, square, along]): (usize, &[f64; 3])| {
            let rest = square - mixed * mixed / cover;
            let factor = if rest > 1e-9 * (1.0 + square) {
                ((along - mixed * height / cover) / rest).clamp(-MOST, MOST)
            } else {
                0.5
            };
            let change = (height - mixed * factor) / cover;
            let explained = 2.0 * (change * height + factor * along)
                - (change * change * cover + 2.0 * change * factor * mixed + factor * factor * square);
            QuadrantChoice { symbol, change, factor, gain: explained }
        };
        self.by.iter().enumerate().map(choice).collect()
    }
}

/// Returns a random number below `count`, each value less likely than the previous one by the factor `less`.
fn rank(count: usize, less: f64, stream: &mut Stream) -> usize {
    let mut rank = 0;
    while rank + 1 < count && stream.uniform() < less {
        rank += 1;
    }
    rank
}

fn set(code: &mut Code, (symbol, quadrant): QuadrantPlace, choice: QuadrantChoice) {
    let rule = &mut code.rules[symbol];
    rule.symbols[quadrant] = choice.symbol;
    rule.change[quadrant] = choice.change;
    rule.factor[quadrant] = choice.factor;
}

/// Returns the used symbols; the first is the root.
fn used_symbols(code: &Code) -> Vec<usize> {
    code.uses().iter().enumerate().filter(|(_, uses)| **uses > 0).map(|(symbol, _)| symbol).collect()
}

/// Returns the quadrants of used rules whose symbol satisfies `wanted`.
fn places(code: &Code, wanted: impl Fn(usize) -> bool) -> Vec<QuadrantPlace> {
    let all =
        used_symbols(code).into_iter().flat_map(|symbol| (0..4).map(move |quadrant| (symbol, quadrant)));
    all.filter(|(symbol, quadrant)| wanted(code.rules[*symbol].symbols[*quadrant])).collect()
}
