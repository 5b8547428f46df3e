//! The rule table during the search, and its map.
//!
//! Cells are numbered along the Z curve: the quadrants of cell `b` are cells `4 * b` to `4 * b + 3` of the
//! next level, so the descendants of any cell are contiguous.

/// Successor of a symbol.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SymbolRule {
    /// Symbol of each quadrant.
    pub symbols: [usize; 4],
    /// Addition to the height (0 to 1), as a multiple of the decay.
    pub change: [f64; 4],
    /// Factor of the decay.
    pub factor: [f64; 4],
}

/// Rules without names and random choices. The root cell has symbol 0 and a decay of 1.
#[derive(Debug, PartialEq)]
pub(super) struct Code {
    /// Successor of each symbol.
    pub rules: Vec<SymbolRule>,
    /// Height of the root cell, on a scale where the target ranges from 0 to 1.
    pub height: f64,
}

impl Clone for Code {
    fn clone(&self) -> Self {
        Self { rules: self.rules.clone(), height: self.height }
    }

    // Searches copy codes often, so the memory of the rules is used again.
    fn clone_from(&mut self, other: &Self) {
        self.rules.clone_from(&other.rules);
        self.height = other.height;
    }
}

/// Cells of one level.
#[derive(Debug, Clone, Default)]
pub(super) struct CellLevel {
    pub symbols: Vec<usize>,
    pub heights: Vec<f64>,
    pub decays: Vec<f64>,
}

impl Code {
    /// Returns the cells of levels 0 to `levels`.
    pub(super) fn cells(&self, levels: usize) -> Vec<CellLevel> {
        let root = CellLevel { symbols: vec![0], heights: vec![self.height], decays: vec![1.0] };
        let mut all = vec![root];
        for level in 0..levels {
            let above = &all[level];
            let count = above.symbols.len() * 4;
            let mut made = CellLevel {
                symbols: Vec::with_capacity(count),
                heights: Vec::with_capacity(count),
                decays: Vec::with_capacity(count),
            };
            for ((symbol, height), decay) in above.symbols.iter().zip(&above.heights).zip(&above.decays) {
                let rule = &self.rules[*symbol];
                made.symbols.extend(rule.symbols);
                made.heights.extend(rule.change.map(|change| height + change * decay));
                made.decays.extend(rule.factor.map(|factor| factor * decay));
            }
            all.push(made);
        }
        all
    }

    /// Returns the relief that each symbol adds to a cell of decay 1 after `count` more divisions, for each
    /// `count` up to `levels`, one symbol after the other.
    pub(super) fn reliefs(&self, levels: usize) -> Vec<Vec<f64>> {
        let mut all = vec![vec![0.0; self.rules.len()]];
        for level in 0..levels {
            let below = &all[level];
            let size = 1 << (2 * level);
            let mut made = Vec::with_capacity(self.rules.len() * size * 4);
            for rule in &self.rules {
                for quadrant in 0..4 {
                    let (change, factor) = (rule.change[quadrant], rule.factor[quadrant]);
                    let part = &below[rule.symbols[quadrant] * size..][..size];
                    made.extend(part.iter().map(|height| change + factor * height));
                }
            }
            all.push(made);
        }
        all
    }

    /// Equalizes the maximum factors into and out of each symbol by scaling its relief; the map does not
    /// change. Afterwards, excessive factors remain only in cycles of rules.
    pub(super) fn balance(&mut self) {
        for symbol in 1..self.rules.len() {
            let (mut into, mut out) = (0.0f64, 0.0f64);
            for (from, rule) in self.rules.iter().enumerate() {
                for (to, factor) in rule.symbols.iter().zip(rule.factor) {
                    if from != symbol && *to == symbol {
                        into = into.max(factor.abs());
                    } else if from == symbol && *to != symbol {
                        out = out.max(factor.abs());
                    }
                }
            }
            if into < 1e-6 || out < 1e-6 {
                continue;
            }
            let stretch = (into / out).sqrt();
            for (from, rule) in self.rules.iter_mut().enumerate() {
                if from == symbol {
                    rule.change = rule.change.map(|change| change * stretch);
                    rule.factor = rule.factor.map(|factor| factor * stretch);
                }
                for (to, factor) in rule.symbols.iter().zip(&mut rule.factor) {
                    if *to == symbol {
                        *factor /= stretch;
                    }
                }
            }
        }
    }

    /// Returns the number of quadrants of used rules with each symbol; the root counts as one.
    pub(super) fn uses(&self) -> Vec<usize> {
        let mut uses = vec![0; self.rules.len()];
        uses[0] = 1;
        let mut open = vec![0];
        while let Some(symbol) = open.pop() {
            for child in self.rules[symbol].symbols {
                uses[child] += 1;
                if uses[child] == 1 {
                    open.push(child);
                }
            }
        }
        uses
    }

    /// Removes unused symbols, and numbers the others in breadth-first order from the root.
    pub(super) fn tidy(&self) -> Self {
        let mut order = vec![0];
        let mut next = 0;
        while next < order.len() {
            for child in self.rules[order[next]].symbols {
                if !order.contains(&child) {
                    order.push(child);
                }
            }
            next += 1;
        }
        let place = |symbol: usize| order.iter().position(|known| *known == symbol).unwrap_or(0);
        let rule = |symbol: &usize| SymbolRule {
            symbols: self.rules[*symbol].symbols.map(place),
            ..self.rules[*symbol]
        };
        Self { rules: order.iter().map(rule).collect(), height: self.height }
    }

    /// Rounds all numbers to six decimals, which are shorter to write.
    pub(super) fn rounded(&self) -> Self {
        let round = |number: f64| (number * 1e6).round() / 1e6;
        let rule = |rule: &SymbolRule| SymbolRule {
            symbols: rule.symbols,
            change: rule.change.map(round),
            factor: rule.factor.map(round),
        };
        Self { rules: self.rules.iter().map(rule).collect(), height: round(self.height) }
    }
}

/// Returns the index of a cell along the Z curve.
pub(super) fn z_order_index(x: usize, y: usize) -> usize {
    let spread = |number: usize| (0..16).map(|bit| (number >> bit & 1) << (2 * bit)).sum::<usize>();
    spread(x) + 2 * spread(y)
}
