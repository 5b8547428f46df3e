//! Random keys of the entries of a pass, and the work of their rules.

use std::time::Duration;

use mlua::Table;

use super::InterpretationPass;
use crate::results::Use;
use burgeon_base::locks::LockRecovery;
use burgeon_rewriting::{CLOSE, Chain, END, ModuleKey, OPEN, Symbol};

impl InterpretationPass {
    /// Returns the random key of the entry at `module` with rule `id`.
    ///
    /// The end of a chain has the chain's own key. A bracket uses the key of the nearest module inside it.
    pub(super) fn key(&self, module: usize, id: u16) -> ModuleKey {
        let Chain { symbols, keys, .. } = &*self.chain;
        let end =
            || symbols[module..].iter().position(|symbol| *symbol == END).map_or(module, |at| module + at);
        if id == self.plan.interpretations.begin {
            return keys[end()].at_place(0).interpretation();
        }
        let is_module = |symbol: &Symbol| *symbol != OPEN && *symbol != CLOSE;
        let (nearest, place) = match symbols[module] {
            OPEN => {
                let away = symbols[module..].iter().position(is_module).unwrap_or(0);
                (module + away, 2 * away + 1)
            }
            CLOSE => {
                let away = symbols[..module].iter().rev().position(is_module);
                let within = away.filter(|away| symbols[module - 1 - away] != END);
                within.map_or_else(|| (end(), 2), |away| (module - 1 - away, 2 * away + 4))
            }
            _ => return keys[module].interpretation(),
        };
        keys[nearest].at_place(place).interpretation()
    }

    /// Adds a batch of entries with the rules `ids` to the work of the rules. The batch took `time`;
    /// `applying` is the part measured for each entry, and the remaining time, spent in Lua, is divided
    /// evenly.
    pub(super) fn count_uses(&self, ids: &[u16], time: Duration, applying: Vec<Duration>) {
        let mut uses = self.uses.lock().recover();
        if !self.plan.profiled {
            ids.iter().for_each(|id| uses[usize::from(*id)].applied += 1);
            return;
        }
        let count = u32::try_from(ids.len().max(1)).unwrap_or(u32::MAX);
        let each = time.saturating_sub(applying.iter().sum()) / count;
        let applying = applying.into_iter().chain(std::iter::repeat(Duration::ZERO));
        for (id, own) in ids.iter().zip(applying) {
            uses[usize::from(*id)] += Use { applied: 1, made: 0, time: each + own };
        }
    }

    /// Adds the rules that have run in addition to those of entries to the work of the rules.
    pub(super) fn count_more(&self, more: &Table) -> mlua::Result<()> {
        let mut uses = self.uses.lock().recover();
        for pair in more.pairs::<usize, usize>() {
            let (number, count) = pair?;
            uses[number - 1] += Use { applied: count, ..Use::default() };
        }
        Ok(())
    }
}
