//! Chains in segments, so that a step costs as much as it changes.

use std::ops::Range;

use crate::chain::{CLOSE, Chain, END, Mark, OPEN, Symbol};
use crate::grammar::Grammar;
use crate::regions::{Region, RegionChange, RegionPath};

/// Number of long segments up to which each is divided in its place.
const FEW_LONG: usize = 4;

/// Part of a chain, of consecutive symbols.
#[derive(Debug, Default)]
pub(crate) struct ChainSegment {
    /// Symbols, parameters and keys. Brackets need not balance.
    pub chain: Chain,
    pub brackets: Brackets,
    /// Set if a symbol has rules.
    has_rules: bool,
    /// Set if a symbol has rules that read the place of the module, which can change although no module does.
    pub is_located: bool,
    /// Set if no rule applies in the next step, because none applied in the last step and no module in reach of the
    /// contexts has changed since.
    pub is_resting: bool,
    /// Indices of the segments that contexts reached in the last step.
    pub reach: Range<usize>,
    /// Effect on the regions of the segments after it.
    pub region_change: RegionChange,
    /// Regions before the segment that decide about its modules, in the last step.
    pub regions: Vec<Region>,
}

impl ChainSegment {
    /// Returns true if a symbol of the segment has rules.
    pub(crate) fn has_rules(&self) -> bool {
        self.has_rules
    }

    /// Wakes the segment if the regions before it have changed, which are `path` now.
    pub(crate) fn enter(&mut self, path: &RegionPath) {
        let around = path.around(self.brackets.closed);
        if self.regions != around {
            self.is_resting &= !self.has_rules;
            self.regions.clear();
            self.regions.extend_from_slice(around);
        }
    }
}

/// Brackets of a segment without a partner, and the number of its ends of chains.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Brackets {
    /// Number of branches that begin before the segment, and end in it.
    pub closed: usize,
    /// Number of branches that begin in the segment, and end after it.
    pub opened: usize,
    /// Number of chains that end in the segment.
    pub ends: usize,
}

impl Brackets {
    fn of(chain: &Chain) -> Self {
        let mut brackets = Self::default();
        for symbol in &chain.symbols {
            match *symbol {
                OPEN => brackets.opened += 1,
                CLOSE if brackets.opened > 0 => brackets.opened -= 1,
                CLOSE => brackets.closed += 1,
                END => brackets.ends += 1,
                _ => {}
            }
        }
        brackets
    }
}

/// Chains of a system, in segments of similar size.
#[derive(Debug)]
pub(crate) struct SegmentedChain {
    pub segments: Vec<ChainSegment>,
    /// Number of symbols of all segments.
    pub symbols: usize,
    /// Number of symbols of a new segment.
    size: usize,
    /// Entry for each symbol: true if its rules read the place of the module; empty if no rule does.
    located: Vec<bool>,
}

impl SegmentedChain {
    /// Divides `chain` into segments of `size` symbols. Only those without rules are resting.
    pub(crate) fn new(chain: &Chain, grammar: &Grammar, size: usize, located: &[bool]) -> Self {
        let mut segments = Vec::with_capacity(chain.symbols.len() / size + 1);
        divide(chain, grammar, size, located, &mut segments);
        Self { segments, symbols: chain.symbols.len(), size, located: located.to_vec() }
    }

    /// Returns true if rules of `symbol` read the place of the module.
    pub(crate) fn is_located(&self, symbol: Symbol) -> bool {
        self.located.get(usize::from(symbol)).is_some_and(|located| *located)
    }

    /// Returns the whole chain, without marks.
    pub(crate) fn joined(&self) -> Chain {
        let total = |column: fn(&Chain) -> usize| -> usize {
            self.segments.iter().map(|segment| column(&segment.chain)).sum()
        };
        let mut joined = Chain {
            symbols: Vec::with_capacity(self.symbols),
            params: Vec::with_capacity(total(|chain| chain.params.len())),
            keys: Vec::with_capacity(total(|chain| chain.keys.len())),
            marks: Vec::new(),
        };
        for ChainSegment { chain, .. } in &self.segments {
            joined.symbols.extend_from_slice(&chain.symbols);
            joined.params.extend_from_slice(&chain.params);
            joined.keys.extend_from_slice(&chain.keys);
        }
        joined
    }

    /// Returns the number of symbols of the segments that are not resting.
    pub(crate) fn awake(&self) -> usize {
        let awake = self.segments.iter().filter(|segment| !segment.is_resting);
        awake.map(|segment| segment.chain.symbols.len()).sum()
    }

    /// Replaces the content of the segment at `index`, and returns the earlier content for reuse.
    pub(crate) fn replace(&mut self, index: usize, chain: Chain, grammar: &Grammar) -> Chain {
        let segment = &mut self.segments[index];
        self.symbols = self.symbols - segment.chain.symbols.len() + chain.symbols.len();
        segment.brackets = Brackets::of(&chain);
        segment.region_change = RegionChange::of(&chain.symbols, grammar.region_openers());
        segment.has_rules = has_rules(&chain, grammar);
        segment.is_located = has_located(&chain, &self.located);
        std::mem::replace(&mut segment.chain, chain)
    }

    /// Wakes the segments whose contexts reached one of the segments at the indices `changed`, which are ascending.
    pub(crate) fn wake(&mut self, changed: &[usize]) {
        for segment in self.segments.iter_mut().filter(|segment| segment.is_resting && segment.has_rules) {
            let first = changed.partition_point(|index| *index < segment.reach.start);
            segment.is_resting = changed.get(first).is_none_or(|index| *index >= segment.reach.end);
        }
    }

    /// Divides those of the segments at the indices `changed`, which are ascending, that have become long, and joins all
    /// segments if many have become short. The parts, or all segments after joining, are awake if they have rules.
    pub(crate) fn balance(&mut self, changed: &[usize], grammar: &Grammar) {
        let is_long = |index: &&usize| self.segments[**index].chain.symbols.len() > 2 * self.size;
        let long: Vec<usize> = changed.iter().filter(is_long).copied().collect();
        if long.len() > FEW_LONG {
            self.divide_all(&long, grammar);
        } else {
            for index in long.iter().rev() {
                self.divide(*index, grammar);
            }
        }
        if self.is_sparse() {
            self.join(grammar);
        }
    }

    /// Divides the whole chain anew.
    pub(crate) fn join(&mut self, grammar: &Grammar) {
        *self = Self::new(&self.joined(), grammar, self.size, &self.located);
    }

    /// Divides the segment at `index` if it has become long. Returns the number of its parts.
    pub(crate) fn divide(&mut self, index: usize, grammar: &Grammar) -> usize {
        if self.segments[index].chain.symbols.len() <= 2 * self.size {
            return 1;
        }
        let mut parts = Vec::new();
        divide(&self.segments[index].chain, grammar, self.size, &self.located, &mut parts);
        let count = parts.len();
        for segment in &mut self.segments {
            let reach = &mut segment.reach;
            *reach = match reach.start > index {
                true => reach.start + count - 1..reach.end + count - 1,
                false if reach.end > index => reach.start..reach.end + count - 1,
                false => continue,
            };
        }
        self.segments.splice(index..=index, parts);
        count
    }

    /// Returns true if many segments have become short.
    pub(crate) fn is_sparse(&self) -> bool {
        self.segments.len() > 64 && self.segments.len() * self.size > 4 * self.symbols
    }

    /// Divides the segments at the indices `long`, which are ascending, in one pass over all segments.
    fn divide_all(&mut self, long: &[usize], grammar: &Grammar) {
        let mut next = long.iter().copied().peekable();
        for (index, segment) in std::mem::take(&mut self.segments).into_iter().enumerate() {
            match next.next_if_eq(&index) {
                Some(_) => divide(&segment.chain, grammar, self.size, &self.located, &mut self.segments),
                None => self.segments.push(segment),
            }
        }
        // The indices of the segments in reach have changed.
        for segment in self.segments.iter_mut().filter(|_| grammar.has_contexts()) {
            segment.is_resting = !segment.has_rules;
        }
    }
}

/// Adds segments of `size` symbols of `chain` to `segments`.
fn divide(chain: &Chain, grammar: &Grammar, size: usize, located: &[bool], segments: &mut Vec<ChainSegment>) {
    let arities = grammar.arities();
    let (mut begin, mut param) = (0, 0);
    for symbols in chain.symbols.chunks(size) {
        let end = begin + symbols.len();
        let params: usize = symbols.iter().map(|symbol| usize::from(arities[usize::from(*symbol)])).sum();
        let from = Mark { module: begin, param, chain: 0 };
        let chain = chain.part(from, Mark { module: end, param: param + params, chain: 0 });
        (begin, param) = (end, param + params);
        let has_rules = has_rules(&chain, grammar);
        segments.push(ChainSegment {
            brackets: Brackets::of(&chain),
            region_change: RegionChange::of(&chain.symbols, grammar.region_openers()),
            regions: Vec::new(),
            has_rules,
            is_located: has_located(&chain, located),
            is_resting: !has_rules,
            chain,
            reach: 0..0,
        });
    }
}

/// Returns true if a symbol of `chain` has rules.
fn has_rules(chain: &Chain, grammar: &Grammar) -> bool {
    chain.symbols.iter().any(|symbol| grammar.has_rules_of(*symbol))
}

/// Returns true if `chain` has one of the symbols whose rules read places.
fn has_located(chain: &Chain, located: &[bool]) -> bool {
    !located.is_empty() && chain.symbols.iter().any(|symbol| located[usize::from(*symbol)])
}
