//! Calls that a running interpretation makes at once, because their results are needed.

use super::apply::Applier;
use super::notices::ObjectNotice;
use crate::machine::{Flusher, returns_value, stops_at_depth};
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_rewriting::Symbol;

/// Maximum number of method calls of one application.
const MOST_CALLS: usize = 1 << 24;

/// Returns the warning about an interpretation that returns the module that cuts branches.
fn cuts_nothing() -> Warning {
    Warning::new(
        WarningKind::NoEffect,
        "Cut, which an interpretation returned, cuts nothing: interpretations do not change the chain",
    )
    .help("return Cut() from a rule")
}

impl Flusher for Applier {
    fn flush(&mut self, entry: usize, called: usize) -> Result<()> {
        let so_far = if self.flushed.0 == entry { self.flushed.1 } else { 0 };
        // A call that runs immediately is not recorded, so it is counted here.
        self.flushed = (entry, so_far + called + 1);
        if self.flushed.1 > MOST_CALLS {
            let message = format!(
                "one application of an interpretation rule calls more than {MOST_CALLS} methods, which is the limit"
            );
            return Err(Error::limit(Limit::Size, message)
                .help("look for an endless loop, or let more modules draw the parts"));
        }
        self.read(entry, called)?;
        self.waits = true;
        let applied = self.apply(entry, self.position);
        self.waits = false;
        applied?;
        self.count()
    }

    fn chain(&self) -> usize {
        self.chain
    }

    fn warn(&mut self, said: Vec<Warning>) {
        self.note(said, None);
    }

    fn lost(&mut self, entry: usize, value: &str) {
        if let Some(module) = self.entries.get(entry).copied() {
            self.notices.push(ObjectNotice { warning: returns_value(value), module, call: None });
        }
    }

    fn context(&self, entry: usize, rule: u16) -> Option<Vec<f64>> {
        let (module, _) = *self.entries.get(entry)?;
        self.pass.context(rule, module)
    }

    fn report(&mut self, entry: usize, name: &str, value: f64) -> Result<()> {
        let (module, _) = *self.entries.get(entry).ok_or_else(|| Error::internal("unknown entry"))?;
        self.reports.add(self.pass.chain_of(module), name, value);
        Ok(())
    }

    fn note_undrawn(&mut self, entry: usize, symbol: Symbol) {
        if self.pass.plan.cut != Some(symbol) {
            self.pass.note_undrawn(symbol);
        } else if let Some(module) = self.entries.get(entry).copied() {
            self.notices.push(ObjectNotice { warning: cuts_nothing(), module, call: None });
        }
    }

    fn note_depth(&mut self, entry: usize, rule: u16, module: &str, max_depth: usize) {
        let Some(at) = self.entries.get(entry).copied() else { return };
        let mut warning = stops_at_depth("interpretation", max_depth, "returns more modules")
            .module(module, self.pass.step);
        if let Some(known) = self.pass.plan.interpretations.list.get(usize::from(rule)) {
            warning = warning.at_place(known.place.as_ref()).rule(format!("{} (interpretation)", known.name));
        }
        self.notices.push(ObjectNotice { warning, module: at, call: None });
    }
}
