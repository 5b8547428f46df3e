//! Warnings of objects during interpretation.
//!
//! Threads reach the modules in any order, and finding the line of a call requires running its rule again.
//! Equal texts from modules with the same symbol are therefore merged: the first module in the order of the
//! chains is reported, with the number of occurrences.

use std::collections::BTreeMap;
use std::sync::Mutex;

use burgeon_base::locks::LockRecovery;
use burgeon_base::warning::Warning;
use burgeon_rewriting::Symbol;

/// Warning of an object, with its cause.
pub(crate) struct ObjectNotice {
    pub warning: Warning,
    /// Index of the module in the chain, and index of its first parameter.
    pub module: (usize, usize),
    /// Entry of the batch and number of the recorded call, if a recorded call caused the warning.
    pub call: Option<(usize, usize)>,
}

/// Warnings of a pass, by the symbol of the module and by text.
#[derive(Default)]
pub(super) struct Notices(Mutex<BTreeMap<(Symbol, String), WarningRecord>>);

/// Occurrences of one text.
struct WarningRecord {
    /// Index of the first module that caused the warning.
    first: usize,
    warning: Warning,
    /// Number of modules that caused the warning.
    modules: usize,
}

impl Notices {
    /// Adds a warning of `module`, which has the symbol `symbol`. `is_first` marks the first warning of the
    /// module with this text. `locate` adds the line, and runs only if no earlier module is known.
    pub(super) fn add(
        &self,
        (symbol, module): (Symbol, usize),
        is_first: bool,
        warning: Warning,
        locate: impl FnOnce(Warning) -> Warning,
    ) {
        let key = (symbol, warning.message().to_owned());
        let (modules, count) = (usize::from(is_first), warning.count());
        let again = |known: &mut BTreeMap<_, WarningRecord>| match known.get_mut(&key) {
            Some(known) if known.first <= module => {
                known.warning.add_occurrences(count);
                known.modules += modules;
                true
            }
            _ => false,
        };
        let lock = || self.0.lock().recover();
        if again(&mut lock()) {
            return;
        }
        // The lock is released, because `locate` runs the rule again.
        let mut new = WarningRecord { first: module, warning: locate(warning), modules };
        let mut known = lock();
        if again(&mut known) {
            return;
        }
        if let Some(later) = known.get(&key) {
            new.warning.add_occurrences(later.warning.count());
            new.modules += later.modules;
        }
        known.insert(key, new);
    }

    /// Returns all warnings, by symbol. `of_symbol` counts the modules with a symbol.
    pub(super) fn into_list(self, of_symbol: impl Fn(Symbol) -> usize) -> impl Iterator<Item = Warning> {
        let known = self.0.into_inner().recover();
        known.into_iter().filter_map(move |((symbol, _), known)| {
            let some = known.warning.is_of_all() && known.modules < of_symbol(symbol);
            (!some).then_some(known.warning)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use burgeon_base::warning::WarningKind;

    #[test]
    fn the_first_module_counts_whichever_comes_first_and_all_have_to_draw_nothing() {
        for order in [[3, 1, 2], [1, 2, 3], [2, 3, 1]] {
            for all in [3, 4] {
                let notices = Notices::default();
                for module in order {
                    let warning = Warning::new(WarningKind::DrawsNothing, "nothing is drawn").of_all();
                    notices.add((7, module), true, warning, |warning| warning.rule(format!("A{module}")));
                }
                let texts: Vec<String> = notices.into_list(|_| all).map(|it| it.to_string()).collect();
                let expected: &[&str] = if all == 3 { &["rule A1: nothing is drawn (3 times)"] } else { &[] };
                assert_eq!(texts, expected);
            }
        }
    }
}
