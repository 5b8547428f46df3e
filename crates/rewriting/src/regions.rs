//! Regions of a chain, to each of which the rules of one system apply.
//!
//! A region begins after a module that opens it, and extends to the end of its branch or chain. The branches in it belong to
//! it, and a region within it takes precedence.

use crate::chain::{CLOSE, Chain, END, OPEN, Symbol};

/// Number of a region's system; 0 outside of all regions.
pub type Region = u16;

/// Modules that open regions.
#[derive(Debug, Clone, Default)]
pub struct RegionOpeners {
    /// Region that a symbol opens, by symbol; empty if none does.
    by_symbol: Vec<Option<Region>>,
}

impl RegionOpeners {
    /// Creates the openers of a chain with `symbols` symbols. Each of `openers` opens the region of the system with that number.
    ///
    /// ```
    /// use burgeon_rewriting::{CLOSE, Chain, END, FIRST_SYMBOL, OPEN, RegionOpeners};
    ///
    /// let (a, leaf) = (FIRST_SYMBOL, FIRST_SYMBOL + 1);
    /// let openers = RegionOpeners::new(&[(leaf, 1)], usize::from(leaf) + 1);
    /// let symbols = vec![a, OPEN, leaf, a, OPEN, a, CLOSE, CLOSE, a, END];
    /// let chain = Chain { symbols, ..Chain::default() };
    /// assert_eq!(openers.regions(&chain), [0, 0, 0, 1, 1, 1, 1, 1, 0, 0]);
    /// ```
    pub fn new(openers: &[(Symbol, Region)], symbols: usize) -> Self {
        let mut by_symbol = vec![None; if openers.is_empty() { 0 } else { symbols }];
        for (symbol, region) in openers {
            by_symbol[usize::from(*symbol)] = Some(*region);
        }
        Self { by_symbol }
    }

    /// Returns true if no module opens a region.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.by_symbol.is_empty()
    }

    /// Returns the region that modules with this symbol open, if they do.
    #[inline]
    pub fn opened_by(&self, symbol: Symbol) -> Option<Region> {
        self.by_symbol.get(usize::from(symbol)).copied().flatten()
    }

    /// Returns the highest number of a region.
    pub(crate) fn highest(&self) -> Region {
        self.by_symbol.iter().flatten().copied().max().unwrap_or(0)
    }

    /// Returns the region of each symbol of `chain`; empty if no module opens a region. A bracket has the region of the
    /// modules before it.
    pub fn regions(&self, chain: &Chain) -> Vec<Region> {
        let mut regions = Vec::new();
        if !self.is_empty() {
            regions.reserve_exact(chain.symbols.len());
            RegionPath::default().pass(&chain.symbols, self, &mut regions);
        }
        regions
    }
}

/// Regions at a position of a chain: of each branch around it, and of the position itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct RegionPath(Vec<Region>);

impl Default for RegionPath {
    fn default() -> Self {
        Self(vec![0])
    }
}

impl RegionPath {
    /// Moves past `symbols`, and adds the region of each of them to `regions`.
    pub(crate) fn pass(&mut self, symbols: &[Symbol], openers: &RegionOpeners, regions: &mut Vec<Region>) {
        let Self(outer) = self;
        let mut present = outer.pop().unwrap_or(0);
        for symbol in symbols {
            regions.push(present);
            match *symbol {
                OPEN => outer.push(present),
                CLOSE => present = outer.pop().unwrap_or(0),
                END => {
                    outer.clear();
                    present = 0;
                }
                symbol => present = openers.opened_by(symbol).unwrap_or(present),
            }
        }
        outer.push(present);
    }

    /// Moves past a part of the chain.
    pub(crate) fn skip(&mut self, part: &RegionChange) {
        let Self(levels) = self;
        if part.has_end {
            levels.clear();
        } else {
            levels.truncate(levels.len().saturating_sub(part.closed));
        }
        let base = levels.pop().unwrap_or(0);
        levels.extend(part.levels.iter().map(|level| level.unwrap_or(base)));
    }

    /// Returns the regions that decide about a part that closes `closed` branches which begin before it.
    pub(crate) fn around(&self, closed: usize) -> &[Region] {
        &self.0[self.0.len().saturating_sub(closed + 1)..]
    }
}

/// Effect of a part of a chain on the regions after it.
#[derive(Debug, Clone, Default)]
pub(crate) struct RegionChange {
    /// Set if a chain ends in the part.
    has_end: bool,
    /// Number of branches that begin before the part, and end in it.
    closed: usize,
    /// Regions at the end of the part, of the outermost branch there and of those that begin in the part; `None` for the
    /// region of that branch before the part.
    levels: Vec<Option<Region>>,
}

impl RegionChange {
    /// Returns the effect of `symbols`; without openers, one that is not used.
    pub(crate) fn of(symbols: &[Symbol], openers: &RegionOpeners) -> Self {
        if openers.is_empty() {
            return Self::default();
        }
        let mut change = Self { has_end: false, closed: 0, levels: Vec::new() };
        let mut present = None;
        for symbol in symbols {
            match *symbol {
                OPEN => change.levels.push(present),
                CLOSE => match change.levels.pop() {
                    Some(outer) => present = outer,
                    None => {
                        change.closed += 1;
                        present = None;
                    }
                },
                END => {
                    change.levels.clear();
                    (change.has_end, present) = (true, Some(0));
                }
                symbol => present = openers.opened_by(symbol).or(present),
            }
        }
        change.levels.push(present);
        change
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ModuleKey;

    #[test]
    fn the_effect_of_parts_is_that_of_their_symbols() {
        let (a, b, c) = (7, 8, 9);
        let openers = RegionOpeners::new(&[(b, 1), (c, 2)], 10);
        let mut crossed = 0;
        for seed in 0..3000 {
            let mut stream = ModuleKey::seed(seed).stream();
            let mut below = |count: usize| (stream.uniform() * count as f64) as usize;
            let (mut symbols, mut depth) = (Vec::new(), 0);
            for _ in 0..60 {
                match below(8) {
                    0 | 1 => {
                        symbols.push(OPEN);
                        depth += 1;
                    }
                    2 | 3 if depth > 0 => {
                        symbols.push(CLOSE);
                        depth -= 1;
                    }
                    4 if below(4) == 0 => {
                        symbols.extend(vec![CLOSE; depth]);
                        symbols.push(END);
                        depth = 0;
                    }
                    other => symbols.push([a, a, b, c][other % 4]),
                }
            }
            let expected = openers.regions(&Chain { symbols: symbols.clone(), ..Chain::default() });
            let mut found = Vec::new();
            let mut path = RegionPath::default();
            let mut rest = symbols.as_slice();
            while !rest.is_empty() {
                let (part, others) = rest.split_at(rest.len().min(1 + below(9)));
                rest = others;
                let change = RegionChange::of(part, &openers);
                // What is around the part decides alone.
                let mut near = RegionPath(path.around(change.closed).to_vec());
                near.pass(part, &openers, &mut found);
                path.skip(&change);
                crossed += usize::from(change.closed > 1);
            }
            assert_eq!(found, expected, "seed {seed}: {symbols:?}");
        }
        assert!(crossed > 1000, "{crossed}");
    }
}
