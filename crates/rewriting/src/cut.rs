//! Removal of the rest of branches from a cut on.

use crate::batch::NO_RULE;
use crate::chain::{CLOSE, Chain, END, OPEN, Symbol};

/// Chain from which branches were cut.
#[derive(Debug, Clone, PartialEq)]
pub struct CutChain {
    /// Chain without the modules that were cut.
    pub chain: Chain,
    /// For each symbol of the previous chain, [`NO_RULE`] and the number of symbols that it became, 1 or 0.
    pub applied: Vec<(u16, u32)>,
}

/// Removes each module with the symbol `cut` and everything that follows it in its branch: up to the bracket that closes
/// the branch, or to the end of the chain. Returns `None` if the chain has no such module.
///
/// ```
/// use burgeon_rewriting::{CLOSE, Chain, END, FIRST_SYMBOL, OPEN, cut};
///
/// let (a, b, c) = (FIRST_SYMBOL, FIRST_SYMBOL + 1, FIRST_SYMBOL + 2);
/// let arities = vec![0; usize::from(c) + 1];
/// let chain = Chain { symbols: vec![a, OPEN, b, c, OPEN, b, CLOSE, b, CLOSE, a, END], ..Chain::default() };
/// let made = cut(&chain, c, &arities).expect("the chain has a cut");
/// assert_eq!(made.chain.symbols, [a, OPEN, b, CLOSE, a, END]);
/// assert_eq!(cut(&made.chain, c, &arities), None);
/// ```
pub fn cut(chain: &Chain, cut: Symbol, arities: &[u8]) -> Option<CutChain> {
    let mut here = chain.symbols.iter().position(|symbol| *symbol == cut)?;
    let mut made = CutChain { chain: Chain::default(), applied: vec![(NO_RULE, 1); chain.symbols.len()] };
    let mut kept = 0;
    let mut param = 0;
    let params_of = |symbols: &[Symbol]| -> usize {
        symbols.iter().map(|symbol| usize::from(arities[usize::from(*symbol)])).sum()
    };
    loop {
        let params = params_of(&chain.symbols[kept..here]);
        made.chain.symbols.extend_from_slice(&chain.symbols[kept..here]);
        made.chain.params.extend_from_slice(&chain.params[param..param + params]);
        made.chain.keys.extend_from_slice(chain.keys.get(kept..here).unwrap_or_default());
        if here == chain.symbols.len() {
            return Some(made);
        }
        kept = end_of_branch(&chain.symbols, here);
        param += params + params_of(&chain.symbols[here..kept]);
        made.applied[here..kept].fill((NO_RULE, 0));
        let rest = &chain.symbols[kept..];
        here = kept + rest.iter().position(|symbol| *symbol == cut).unwrap_or(rest.len());
    }
}

/// Returns the index of the symbol that ends the branch of the module at `index`.
fn end_of_branch(symbols: &[Symbol], index: usize) -> usize {
    let mut depth = 0_usize;
    for (place, symbol) in symbols.iter().enumerate().skip(index) {
        match *symbol {
            OPEN => depth += 1,
            CLOSE if depth > 0 => depth -= 1,
            CLOSE | END => return place,
            _ => {}
        }
    }
    symbols.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chain::Mark;
    use crate::symbols::FIRST_SYMBOL;
    use burgeon_base::ModuleKey;

    #[test]
    fn a_cut_takes_the_parameters_and_keys_of_what_it_erases() {
        let (a, c) = (FIRST_SYMBOL, FIRST_SYMBOL + 1);
        let mut arities = vec![0; usize::from(FIRST_SYMBOL)];
        arities.extend([1, 0]);
        let symbols = vec![a, OPEN, c, a, CLOSE, a, c, a, END, a, END];
        let keys = (0..symbols.len()).map(|index| ModuleKey(index as u64)).collect();
        let chain = Chain { symbols, params: vec![1.0, 2.0, 3.0, 4.0, 5.0], keys, marks: Vec::new() };
        let made = cut(&chain, c, &arities).unwrap();
        assert_eq!(made.chain.symbols, [a, OPEN, CLOSE, a, END, a, END]);
        assert_eq!(made.chain.params, [1.0, 3.0, 5.0]);
        assert_eq!(made.chain.keys, [0, 1, 4, 5, 8, 9, 10].map(ModuleKey));
        assert_eq!(made.chain.marks, Vec::<Mark>::new());
        let counts: Vec<u32> = made.applied.iter().map(|(_, count)| *count).collect();
        assert_eq!(counts, [1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 1]);
    }
}
