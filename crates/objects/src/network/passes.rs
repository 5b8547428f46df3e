//! The work of a network before, during and after a pass over the chains, and its warnings.

use std::sync::OnceLock;

use super::object::Network;
use burgeon_base::error::Result;
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_kit::Warn;

impl Network {
    pub(super) fn restart(&mut self) {
        self.growths.clear();
        self.proposals.begin();
        self.walk.restart();
    }

    pub(super) fn open_branch(&mut self) {
        self.walk.open_branch();
    }

    pub(super) fn close_branch(&mut self) -> Result<()> {
        self.walk.close_branch();
        Ok(())
    }

    /// Ends a pass. Warns if the pass proposed streets and none was built, or if most were refused.
    pub(super) fn finish(&mut self) -> Result<()> {
        if self.fit.get().is_some_and(|(version, _)| *version != self.network.version()) {
            self.fit = OnceLock::new();
        }
        // Missing ground is reported when the streets are drawn.
        if !self.has_warned_of_hiding
            && let Ok(Some(warning)) = self.hidden_warning()
        {
            self.has_warned_of_hiding = true;
            self.warnings.push(warning);
        }
        self.warnings.extend(self.walk.tally().warning());
        self.warnings.extend(self.bare_warning());
        if !self.has_warned_of_refusals
            && let Some(warning) = self.proposals.warning(self.network.size())
        {
            self.has_warned_of_refusals = true;
            self.warnings.push(warning);
        }
        Ok(())
    }

    /// Returns the warning that there is no block to fill.
    fn bare_warning(&self) -> Option<Warning> {
        let is_bare =
            self.options.block_color.is_some() && self.network.size() > 0 && self.network.faces().is_empty();
        is_bare.then(|| {
            let text = format!(
                "network: {} street segments enclose no block, so `block_color` fills nothing",
                self.network.size()
            );
            Warning::new(WarningKind::DrawsNothing, text)
                .help(
                    "connect more streets: grow or walk farther, or join dead ends within a greater distance",
                )
                .of_pass()
        })
    }
}

impl Warn for Network {
    fn take_warnings(&mut self) -> Vec<Warning> {
        std::mem::take(&mut self.warnings)
    }
}
