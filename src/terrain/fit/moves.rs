//! Changes of which symbols a rule table has: another symbol for a quadrant, two symbols out of one, one out of two.

use super::code::{Code, Level};
use super::solve::{MOST, dot, improve, misfit};
use super::targets::{self, number};
use crate::random::Stream;

/// What is to be fitted, scaled to 0..1, along the Z curve.
pub(super) struct Problem {
    /// How often the whole is divided.
    pub levels: usize,
    /// The height of each cell.
    pub wanted: Vec<f64>,
    /// The sum of the heights below each cell of each level.
    sums: Vec<Vec<f64>>,
}

/// What a quadrant of a rule may become.
#[derive(Debug, Clone, Copy)]
struct Choice {
    symbol: usize,
    change: f64,
    factor: f64,
    /// How much of the squared height that is left it explains.
    gain: f64,
}

/// A quadrant of the rule of a symbol.
type Place = (usize, usize);

impl Problem {
    /// The problem of a map along the Z curve with 4 to the power of `levels` cells.
    pub(super) fn new(wanted: Vec<f64>, levels: usize) -> Self {
        let mut sums = vec![wanted.clone()];
        for _ in 0..levels {
            let below = &sums[sums.len() - 1];
            sums.push(below.chunks_exact(4).map(|four| four.iter().sum()).collect());
        }
        sums.reverse();
        Self { levels, wanted, sums }
    }

    /// How far the map of `code` is from what is wanted, each scaled to 0..1.
    pub(super) fn error(&self, code: &Code) -> f64 {
        let cells = code.cells(self.levels);
        targets::error(&self.wanted, &cells[self.levels].heights)
    }

    /// Better numbers for `code`, in at most `steps` steps.
    pub(super) fn improve(&self, code: &mut Code, steps: usize) {
        improve(code, &self.wanted, self.levels, steps);
    }

    fn misfit(&self, code: &Code) -> f64 {
        misfit(&code.cells(self.levels), &self.wanted)
    }

    /// For each symbol, what a quadrant would best become with it, the best first; none for a rule that is not in use.
    ///
    /// What a symbol itself makes is taken to stay as it is.
    fn choices(&self, code: &Code, (symbol, quadrant): Place) -> Vec<Choice> {
        let cells = code.cells(self.levels);
        let reliefs = code.reliefs(self.levels - 1);
        let count = code.rules.len();
        // Of the equations for change and factor: the first is the same for all symbols but for its last column.
        let (mut cover, mut height) = (0.0, 0.0);
        let mut by = vec![[0.0; 3]; count];
        for level in 0..self.levels {
            let below = 2 * (self.levels - level - 1);
            let size = 1 << below;
            let relief = &reliefs[below / 2];
            let totals: Vec<(f64, f64)> =
                relief.chunks_exact(size).map(|part| (part.iter().sum(), dot(part, part))).collect();
            for cell in (0..cells[level].symbols.len()).filter(|cell| cells[level].symbols[*cell] == symbol) {
                let (base, decay) = (cells[level].heights[cell], cells[level].decays[cell]);
                let child = 4 * cell + quadrant;
                let wanted = &self.wanted[child << below..][..size];
                cover += decay * decay * number(size);
                height += decay * (self.sums[level + 1][child] - base * number(size));
                for ((by, part), (sum, square)) in by.iter_mut().zip(relief.chunks_exact(size)).zip(&totals) {
                    by[0] += decay * decay * sum;
                    by[1] += decay * decay * square;
                    by[2] += decay * (dot(wanted, part) - base * sum);
                }
            }
        }
        if cover <= 1e-12 {
            return Vec::new();
        }
        let choice = |(symbol, [mixed, square, along]): (usize, [f64; 3])| {
            let rest = square - mixed * mixed / cover;
            let factor = if rest > 1e-9 * (1.0 + square) {
                ((along - mixed * height / cover) / rest).clamp(-MOST, MOST)
            } else {
                0.5
            };
            let change = (height - mixed * factor) / cover;
            let explained = 2.0 * (change * height + factor * along)
                - (change * change * cover + 2.0 * change * factor * mixed + factor * factor * square);
            Choice { symbol, change, factor, gain: explained }
        };
        let mut choices: Vec<Choice> = by.into_iter().enumerate().map(choice).collect();
        choices.sort_by(|a, b| b.gain.total_cmp(&a.gain));
        choices
    }

    /// Gives a quadrant of a rule in use another symbol, one that seems good.
    pub(super) fn turn(&self, code: &mut Code, stream: &mut Stream) {
        let used = used(code);
        let place = (used[stream.below(used.len())], stream.below(4));
        let now = code.rules[place.0].symbols[place.1];
        let choices: Vec<Choice> =
            self.choices(code, place).into_iter().filter(|choice| choice.symbol != now).collect();
        // Each is half as likely as the one before.
        let mut rank = 0;
        while rank + 1 < choices.len() && stream.uniform() < 0.5 {
            rank += 1;
        }
        if let Some(choice) = choices.get(rank) {
            set(code, place, *choice);
        }
    }

    /// Does without one of the symbols in use: others take its place. Gives its number.
    pub(super) fn retire(&self, code: &mut Code, stream: &mut Stream) -> Option<usize> {
        let used = used(code);
        let gone = *used.get(1 + stream.below(used.len() - 1))?;
        for place in places(code, |symbol| symbol == gone) {
            if place.0 == gone {
                continue;
            }
            let choices = self.choices(code, place);
            let choice = choices.into_iter().find(|choice| choice.symbol != gone)?;
            set(code, place, choice);
        }
        Some(gone)
    }

    /// Makes `spare`, which is not in use or the next new symbol, a second one of a symbol that stands in several
    /// places, for one of these: likely one where much is missing. Then both are fitted anew.
    pub(super) fn split(&self, code: &mut Code, spare: usize, stream: &mut Stream) {
        let uses = code.uses();
        let several = places(code, |symbol| uses[symbol] > 1);
        if several.is_empty() {
            return;
        }
        let missing = self.missing(code);
        let weight = |place: &Place| missing[place.0 * 4 + place.1];
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
        for place in
            [spare, symbol].into_iter().flat_map(|symbol| (0..4).map(move |quadrant| (symbol, quadrant)))
        {
            self.refit(code, place);
        }
    }

    /// Gives a quadrant what seems best, if that is better.
    pub(super) fn refit(&self, code: &mut Code, place: Place) {
        let Some(choice) = self.choices(code, place).first().copied() else { return };
        let mut made = code.clone();
        set(&mut made, place, choice);
        if self.misfit(&made) < self.misfit(code) {
            *code = made;
        }
    }

    /// What is missing (squared) below each quadrant of each rule, summed over the levels.
    fn missing(&self, code: &Code) -> Vec<f64> {
        let cells: Vec<Level> = code.cells(self.levels);
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

fn set(code: &mut Code, (symbol, quadrant): Place, choice: Choice) {
    let rule = &mut code.rules[symbol];
    rule.symbols[quadrant] = choice.symbol;
    rule.change[quadrant] = choice.change;
    rule.factor[quadrant] = choice.factor;
}

/// The symbols in use; the first is the whole.
fn used(code: &Code) -> Vec<usize> {
    code.uses().iter().enumerate().filter(|(_, uses)| **uses > 0).map(|(symbol, _)| symbol).collect()
}

/// The quadrants of rules in use that become a symbol which `wanted` takes.
fn places(code: &Code, wanted: impl Fn(usize) -> bool) -> Vec<Place> {
    let all = used(code).into_iter().flat_map(|symbol| (0..4).map(move |quadrant| (symbol, quadrant)));
    all.filter(|(symbol, quadrant)| wanted(code.rules[*symbol].symbols[*quadrant])).collect()
}
