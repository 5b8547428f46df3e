//! What objects warn of while they are interpreted.
//!
//! Threads come to the modules in any order, and finding the line of a call takes running its rule once more. So of each
//! text that modules with the same symbol give rise to, the first in the order of the chains counts, and is told with
//! how many there were.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use crate::rules::Symbol;
use crate::warning::Warning;

/// A warning of an object, and what gave rise to it.
pub(crate) struct Notice {
    pub warning: Warning,
    /// The place of the module in the chain, and that of its parameters.
    pub module: (usize, usize),
    /// The entry of the batch and the number of its recorded call, if it was one.
    pub call: Option<(usize, usize)>,
}

/// The warnings of a pass: by symbol and text the first module with its warning.
#[derive(Default)]
pub(super) struct Notices(Mutex<BTreeMap<(Symbol, String), (usize, Warning)>>);

impl Notices {
    /// Adds what the module at place `module`, which has this symbol, gave rise to; `locate` finds its line, and is
    /// asked only where no earlier module is known.
    pub(super) fn add(
        &self,
        symbol: Symbol,
        module: usize,
        warning: Warning,
        locate: impl FnOnce(Warning) -> Warning,
    ) {
        let key = (symbol, warning.message().to_owned());
        {
            let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
            if let Some((first, known)) = known.get_mut(&key)
                && *first <= module
            {
                return known.again(warning.count());
            }
        }
        let mut warning = locate(warning);
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        match known.get_mut(&key) {
            Some((first, known)) if *first <= module => known.again(warning.count()),
            Some(later) => {
                warning.again(later.1.count());
                *later = (module, warning);
            }
            None => drop(known.insert(key, (module, warning))),
        }
    }

    /// All of them, by symbol.
    pub(super) fn into_list(self) -> impl Iterator<Item = Warning> {
        let known = self.0.into_inner().unwrap_or_else(PoisonError::into_inner);
        known.into_values().map(|(_, warning)| warning)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::warning::WarningKind;

    #[test]
    fn the_first_module_counts_whichever_comes_first() {
        for order in [[3, 1, 2], [1, 2, 3], [2, 3, 1]] {
            let notices = Notices::default();
            for module in order {
                let warning = Warning::new(WarningKind::DrawsNothing, "nothing is drawn");
                notices.add(7, module, warning, |warning| warning.rule(format!("A{module}")));
            }
            let texts: Vec<String> = notices.into_list().map(|warning| warning.to_string()).collect();
            assert_eq!(texts, ["rule A1: nothing is drawn (3 times)"]);
        }
    }
}
