//! Ordinals by symbol of the modules of a successor.

use crate::chain::Symbol;

/// Counter of the modules of a successor by symbol. The lineage of a module counts only modules with the same name, so
/// that other modules can be added to a successor without a change of its random numbers.
///
/// ```
/// use burgeon_rewriting::Ordinals;
///
/// let mut ordinals = Ordinals::default();
/// let (apex, leaf) = (9, 7);
/// assert_eq!([apex, leaf, apex, apex].map(|symbol| ordinals.next(symbol)), [0, 0, 1, 2]);
/// ordinals.clear();
/// assert_eq!(ordinals.next(apex), 0);
/// ```
#[derive(Debug, Clone, Default)]
pub struct Ordinals {
    /// Number of modules by symbol.
    counts: Vec<u32>,
    /// Symbols that have a count.
    counted: Vec<Symbol>,
}

impl Ordinals {
    /// Returns the ordinal of the next module of the successor, among the modules with its symbol.
    #[inline]
    pub fn next(&mut self, symbol: Symbol) -> usize {
        let index = usize::from(symbol);
        if index >= self.counts.len() {
            self.counts.resize(index + 1, 0);
        }
        let count = &mut self.counts[index];
        if *count == 0 {
            self.counted.push(symbol);
        }
        *count += 1;
        *count as usize - 1
    }

    /// Begins another successor.
    #[inline]
    pub fn clear(&mut self) {
        for symbol in self.counted.drain(..) {
            self.counts[usize::from(symbol)] = 0;
        }
    }
}
