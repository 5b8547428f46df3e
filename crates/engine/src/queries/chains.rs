//! Chains as seen by queries, in which the modules of a symbol are the rows of a table.
//!
//! A rule sees its chain at the start of the step. An interpretation sees the current chain. Both see the
//! final chains of systems that are already derived.

use std::sync::Arc;

use burgeon_base::error::Result;
use burgeon_rewriting::{Chain, END, NameScope, Symbol, Symbols};

/// Chain of a system.
#[derive(Debug, Clone)]
struct SystemChain {
    system: usize,
    symbols: Arc<Symbols>,
    chain: Arc<Chain>,
    /// Indices of chains that are skipped because of faulty data, ascending.
    left_out: Arc<[usize]>,
}

/// Module that a query names.
#[derive(Debug)]
pub(crate) struct NamedModule {
    /// Name in the query.
    pub word: String,
    pub symbol: Symbol,
}

/// State of all chains of a run.
#[derive(Debug, Clone, Default)]
pub(crate) struct ChainView {
    /// Number of derived systems, and number of states of the system being derived.
    number: [u32; 2],
    symbols: Arc<Symbols>,
    chains: Vec<SystemChain>,
}

impl ChainView {
    /// Returns the view once `system` is derived, without its earlier chains.
    pub(crate) fn with_derived(
        &self,
        system: usize,
        symbols: &Arc<Symbols>,
        chain: &Arc<Chain>,
        left_out: &Arc<[usize]>,
    ) -> Self {
        let mut view = self.without(system, symbols);
        view.number = [self.number[0] + 1, 0];
        view.chains.push(SystemChain {
            system,
            symbols: Arc::clone(symbols),
            chain: Arc::clone(chain),
            left_out: Arc::clone(left_out),
        });
        view
    }

    /// Returns the view while `system` is derived, before its axiom is made.
    pub(crate) fn with_begun(&self, system: usize, symbols: &Arc<Symbols>) -> Self {
        self.without(system, symbols)
    }

    /// Returns the view while `system` is derived, in state `number`, counted from 1. Chains in `left_out`
    /// are hidden.
    pub(crate) fn with_current(
        &self,
        system: usize,
        symbols: &Arc<Symbols>,
        chain: &Arc<Chain>,
        left_out: Vec<usize>,
        number: u32,
    ) -> Self {
        let mut view = self.without(system, symbols);
        view.number[1] = number;
        view.chains.push(SystemChain {
            system,
            symbols: Arc::clone(symbols),
            chain: Arc::clone(chain),
            left_out: left_out.into(),
        });
        view
    }

    fn without(&self, system: usize, symbols: &Arc<Symbols>) -> Self {
        let mut chains = self.chains.clone();
        chains.retain(|known| known.system != system);
        Self { number: self.number, symbols: Arc::clone(symbols), chains }
    }

    /// Returns the number of this state in the run, from 1; the same in every virtual machine.
    pub(crate) fn number(&self) -> u64 {
        (u64::from(self.number[0]) << 32 | u64::from(self.number[1])) + 1
    }

    /// Returns the modules that `words` name in `scope`.
    pub(crate) fn find_modules(&self, words: &[String], scope: Option<&NameScope>) -> Vec<NamedModule> {
        let named =
            |word: &String| Some(NamedModule { word: word.clone(), symbol: self.find(word, scope).ok()? });
        // Most words are not names of modules, and the error for an unknown name is expensive.
        words.iter().filter(|word| self.symbols.has(word)).filter_map(named).collect()
    }

    /// Returns the module that a word of a query names in `scope`.
    pub(crate) fn find(&self, word: &str, scope: Option<&NameScope>) -> Result<Symbol> {
        match scope {
            Some(scope) => self.symbols.find_in(word, scope),
            None => self.symbols.find(word),
        }
    }

    /// Returns the declared modules.
    pub(crate) fn symbols(&self) -> &Symbols {
        &self.symbols
    }

    /// Returns the parameters of each module with a symbol, in the order of systems and chains, without
    /// skipped chains.
    pub(crate) fn modules(&self, wanted: Symbol) -> impl Iterator<Item = &[f64]> {
        self.chains.iter().flat_map(move |SystemChain { symbols, chain, left_out, .. }| {
            let arities = symbols.arities();
            let (mut param, mut number) = (0, 0);
            chain.symbols.iter().filter_map(move |symbol| {
                let begin = param;
                param += usize::from(arities[usize::from(*symbol)]);
                number += usize::from(*symbol == END);
                let is_seen = *symbol == wanted && left_out.binary_search(&number).is_err();
                is_seen.then(|| &chain.params[begin..param])
            })
        })
    }
}
