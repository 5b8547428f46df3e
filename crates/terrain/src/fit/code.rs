//! The rule table that is searched for, and the map that it makes.
//!
//! Cells are numbered along the Z curve: the quadrants of cell `b` are cells `4 * b` to `4 * b + 3` of the next level,
//! so the cells below any cell lie side by side.

/// What a symbol becomes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SymbolRule {
    /// The symbol of each quadrant.
    pub symbols: [usize; 4],
    /// What is added to the height (of 0 to 1), as a multiple of the decay.
    pub change: [f64; 4],
    /// What the decay is multiplied by.
    pub factor: [f64; 4],
}

/// Rules without names and chance. The whole is symbol 0 with a decay of 1.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Code {
    /// What each symbol becomes.
    pub rules: Vec<SymbolRule>,
    /// The height of the whole, where the lowest of the target is 0 and the highest 1.
    pub height: f64,
}

/// The cells of one level.
#[derive(Debug, Clone, Default)]
pub(super) struct CellLevel {
    pub symbols: Vec<usize>,
    pub heights: Vec<f64>,
    pub decays: Vec<f64>,
}

impl Code {
    /// The cells of levels 0 to `levels`.
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

    /// What each symbol adds to a cell of decay 1 that is divided `count` times more, for each `count` up to `levels`:
    /// symbol after symbol.
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

    /// Gives the factors into and out of each symbol the same greatest size, by stretching what the symbol makes; the map
    /// stays as it is. So factors that would have to be too great are so only where a rule comes back to itself.
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

    /// How many quadrants of rules in use become each symbol; the whole counts as one.
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

    /// The same without symbols that are not in use, in the order in which the whole comes to them.
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

    /// The same with numbers of six decimals, which are shorter to write.
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

/// The place of a cell along the Z curve.
pub(super) fn along(x: usize, y: usize) -> usize {
    let spread = |number: usize| (0..16).map(|bit| (number >> bit & 1) << (2 * bit)).sum::<usize>();
    spread(x) + 2 * spread(y)
}
