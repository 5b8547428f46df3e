//! Chains in columns: all chains of a system are stored one after the other in a structure of arrays.

use burgeon_base::ModuleKey;

/// Symbol of a module.
pub type Symbol = u16;
/// Symbol that opens a branch.
pub const OPEN: Symbol = 0;
/// Symbol that closes a branch.
pub const CLOSE: Symbol = 1;
/// Symbol that ends a chain.
pub const END: Symbol = 2;

/// Maximum nesting depth of branches in a successor, axiom or context.
pub const DEEPEST: usize = 200;

/// Chains of a system, in columns. Each chain ends with [`END`]; brackets balance within it.
///
/// ```
/// use burgeon_rewriting::{Chain, END, FIRST_SYMBOL};
///
/// // Two chains of modules without parameters.
/// let (a, b) = (FIRST_SYMBOL, FIRST_SYMBOL + 1);
/// let chain = Chain { symbols: vec![a, b, END, b, END], ..Chain::default() };
/// let arities = vec![0; usize::from(b) + 1];
/// assert_eq!((chain.modules(), chain.starts(&arities).len()), (3, 3));
/// assert_eq!(chain.single_chain(1, &arities).symbols, [b, END]);
/// assert_eq!(chain.without_chains(&[1], &arities).symbols, [a, b, END]);
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Chain {
    /// Symbols of all modules, brackets and ends.
    pub symbols: Vec<Symbol>,
    /// Parameters of all modules, in order; the arity of a symbol is the number of its parameters.
    pub params: Vec<f64>,
    /// Random key of each symbol; empty if no rule uses random numbers.
    pub keys: Vec<ModuleKey>,
    /// Marks at which work on the chain can be divided, in order; the first is the beginning.
    pub marks: Vec<Mark>,
}

/// Position in a chain, as the number of symbols, parameters and ends before it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Mark {
    /// Number of symbols before the position.
    pub module: usize,
    /// Number of parameters before the position.
    pub param: usize,
    /// Number of complete chains before the position.
    pub chain: usize,
}

impl Chain {
    /// Empties the columns but keeps their memory.
    pub fn clear(&mut self) {
        self.symbols.clear();
        self.params.clear();
        self.keys.clear();
        self.marks.clear();
    }

    /// Returns the position after the last symbol; `chain` is the number of chains before it.
    #[inline]
    pub fn end(&self, chain: usize) -> Mark {
        Mark { module: self.symbols.len(), param: self.params.len(), chain }
    }

    /// Returns the number of modules, without brackets and ends.
    pub fn modules(&self) -> usize {
        self.symbols.iter().filter(|symbol| **symbol > END).count()
    }

    /// Sets marks that divide the columns into pieces of about `size` symbols. `arities` contains the number of
    /// parameters by symbol.
    pub fn mark(&mut self, size: usize, arities: &[u8]) {
        self.marks.clear();
        let mut here = Mark::default();
        for symbols in self.symbols.chunks(size.max(1)) {
            self.marks.push(here);
            here.module += symbols.len();
            for symbol in symbols {
                here.param += usize::from(arities[usize::from(*symbol)]);
                here.chain += usize::from(*symbol == END);
            }
        }
    }

    /// Returns only the chain at `index`; empty if there is no such chain.
    #[must_use]
    pub fn single_chain(&self, index: usize, arities: &[u8]) -> Self {
        let starts = self.starts(arities);
        let [Some(begin), Some(end)] = [starts.get(index), starts.get(index + 1)] else {
            return Self::default();
        };
        self.part(*begin, *end)
    }

    /// Returns a copy of the columns from `begin` to before `end`, without marks.
    pub(crate) fn part(&self, begin: Mark, end: Mark) -> Self {
        Self {
            symbols: self.symbols[begin.module..end.module].to_vec(),
            params: self.params[begin.param..end.param].to_vec(),
            keys: self.keys.get(begin.module..end.module).unwrap_or_default().to_vec(),
            marks: Vec::new(),
        }
    }

    /// Returns the chains except for those at the indices `left_out`, which are ascending.
    #[must_use]
    pub fn without_chains(&self, left_out: &[usize], arities: &[u8]) -> Self {
        let starts = self.starts(arities);
        let mut kept = Self::default();
        for (index, pair) in starts.windows(2).enumerate() {
            if left_out.binary_search(&index).is_err() {
                let [begin, end] = [pair[0], pair[1]];
                kept.symbols.extend_from_slice(&self.symbols[begin.module..end.module]);
                kept.params.extend_from_slice(&self.params[begin.param..end.param]);
                kept.keys.extend_from_slice(self.keys.get(begin.module..end.module).unwrap_or_default());
            }
        }
        kept
    }

    /// Returns the beginning of each chain, and the end of the last.
    pub fn starts(&self, arities: &[u8]) -> Vec<Mark> {
        let mut starts = vec![Mark::default()];
        let mut here = Mark::default();
        for (module, symbol) in self.symbols.iter().enumerate() {
            here.param += usize::from(arities[usize::from(*symbol)]);
            if *symbol == END {
                here.chain += 1;
                starts.push(Mark { module: module + 1, ..here });
            }
        }
        starts
    }
}
