//! The chain between two steps of a series, for those who follow what changes.

use crate::chain::{Chain, Mark};
use crate::grammar::Grammar;
use crate::regions::{Region, RegionPath};
use crate::segments::SegmentedChain;
use burgeon_base::error::Result;

/// Follower of a series whose rules read the places of modules.
#[allow(missing_debug_implementations, reason = "contains a function")]
pub struct PlaceFollower<'a> {
    /// Entry for each symbol: true if its rules read the place of the module.
    pub located: &'a [bool],
    /// Function that is called after each step, with the chain, the number of the step, and true if another step follows. The
    /// series ends if it returns `false`.
    pub follow: &'a mut dyn FnMut(&SeriesChain<'_>, usize, bool) -> Result<bool>,
}

/// Chain between two steps of a series.
#[derive(Debug)]
pub struct SeriesChain<'a> {
    pub(crate) segments: &'a SegmentedChain,
    pub(crate) grammar: &'a Grammar,
    pub(crate) unchanged: usize,
}

impl SeriesChain<'_> {
    /// Returns the number of symbols at the beginning that are the same as before the step, with their parameters and keys.
    pub fn unchanged(&self) -> usize {
        self.unchanged
    }

    /// Returns the number of symbols up to the last module whose rules read places; 0 if there is none.
    pub fn located_end(&self) -> usize {
        let mut end = self.segments.symbols;
        for segment in self.segments.segments.iter().rev() {
            let begin = end - segment.chain.symbols.len();
            if segment.is_located {
                let is_located = |symbol: &u16| self.segments.is_located(*symbol);
                let last = segment.chain.symbols.iter().rposition(is_located);
                return last.map_or(begin, |last| begin + last + 1);
            }
            end = begin;
        }
        0
    }

    /// Returns the regions of the symbols from number `begin` to number `end`; empty if no module opens a region.
    pub fn regions(&self, begin: usize, end: usize) -> Vec<Region> {
        let openers = self.grammar.region_openers();
        let (mut regions, mut path, mut first) = (Vec::new(), RegionPath::default(), 0);
        for segment in self.segments.segments.iter().take_while(|_| !openers.is_empty()) {
            let symbols = &segment.chain.symbols;
            if first >= end {
                break;
            }
            if first + symbols.len() <= begin {
                path.skip(&segment.region_change);
            } else {
                let (before, part) = symbols.split_at(begin.saturating_sub(first));
                path.pass(before, openers, &mut Vec::new());
                path.pass(&part[..part.len().min(end - first.max(begin))], openers, &mut regions);
            }
            first += symbols.len();
        }
        regions
    }

    /// Returns the symbols from `begin`, a position between two of them, to number `end`, without marks.
    pub fn part(&self, begin: Mark, end: usize) -> Chain {
        let mut part = Chain::default();
        let arities = self.grammar.arities();
        let mut first = 0;
        for segment in &self.segments.segments {
            let Chain { symbols, params, keys, .. } = &segment.chain;
            if first >= end {
                break;
            }
            if first + symbols.len() > begin.module {
                let from = begin.module.saturating_sub(first);
                let to = symbols.len().min(end - first);
                let params_of = |symbols: &[u16]| -> usize {
                    symbols.iter().map(|symbol| usize::from(arities[usize::from(*symbol)])).sum()
                };
                let param = params_of(&symbols[..from]);
                let param_end = param + params_of(&symbols[from..to]);
                part.symbols.extend_from_slice(&symbols[from..to]);
                part.params.extend_from_slice(&params[param..param_end]);
                part.keys.extend_from_slice(keys.get(from..to).unwrap_or_default());
            }
            first += symbols.len();
        }
        part
    }
}

/// Returns the number of equal symbols at the beginning of both chains, with their parameters and keys.
pub(crate) fn equal_symbols(one: &Chain, two: &Chain, arities: &[u8]) -> usize {
    let mut param = 0;
    let has_keys = !one.keys.is_empty() && !two.keys.is_empty();
    for (index, (a, b)) in one.symbols.iter().zip(&two.symbols).enumerate() {
        let end = param + usize::from(arities[usize::from(*a)]);
        let is_equal = a == b
            && (!has_keys || one.keys[index] == two.keys[index])
            && one.params[param..end]
                .iter()
                .zip(&two.params[param..end])
                .all(|(a, b)| a.to_bits() == b.to_bits());
        if !is_equal {
            return index;
        }
        param = end;
    }
    one.symbols.len().min(two.symbols.len())
}
