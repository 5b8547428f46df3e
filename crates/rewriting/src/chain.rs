//! Chains as columns: all chains of a system stand one after the other in one structure of arrays.

use super::key::ModuleKey;

/// A module's symbol.
pub type Symbol = u16;
/// Opens a branch.
pub const OPEN: Symbol = 0;
/// Closes a branch.
pub const CLOSE: Symbol = 1;
/// Ends a chain.
pub const END: Symbol = 2;

/// How deep the branches of one successor, axiom or context may be nested.
pub const DEEPEST: usize = 200;

/// The chains of a system, in columns. Each chain ends with [`END`]; brackets balance within it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Chain {
    /// One for each module, bracket and end.
    pub symbols: Vec<Symbol>,
    /// The parameters of all modules, in order; a symbol's arity tells how many are its own.
    pub params: Vec<f64>,
    /// The random key of each symbol; empty where no rule draws random numbers.
    pub keys: Vec<ModuleKey>,
    /// Places where work on the chain may be divided, in order; the first is the beginning.
    pub marks: Vec<Mark>,
}

/// A place in a chain, by the number of symbols, parameters and ends before it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Mark {
    /// Symbols before it.
    pub module: usize,
    /// Parameters before it.
    pub param: usize,
    /// Whole chains before it.
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

    /// The place behind the last symbol, given the number of chains before it.
    #[inline]
    pub fn end(&self, chain: usize) -> Mark {
        Mark { module: self.symbols.len(), param: self.params.len(), chain }
    }

    /// The number of modules, without brackets and ends.
    pub fn modules(&self) -> usize {
        self.symbols.iter().filter(|symbol| **symbol > END).count()
    }

    /// Divides the columns into pieces of about `size` symbols. `arities` gives the parameters by symbol.
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

    /// Chain number `index` alone; empty if there is none.
    #[must_use]
    pub fn only(&self, index: usize, arities: &[u8]) -> Self {
        let starts = self.starts(arities);
        let [Some(begin), Some(end)] = [starts.get(index), starts.get(index + 1)] else {
            return Self::default();
        };
        let keys = if self.keys.is_empty() { &[] } else { &self.keys[begin.module..end.module] };
        Self {
            symbols: self.symbols[begin.module..end.module].to_vec(),
            params: self.params[begin.param..end.param].to_vec(),
            keys: keys.to_vec(),
            marks: Vec::new(),
        }
    }

    /// Where each chain begins; one more for the end of the last.
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
