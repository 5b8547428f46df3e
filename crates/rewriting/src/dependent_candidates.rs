//! Candidates of a grammar that one call can apply to modules of which each depends on others of the same step.

use crate::choice::Choice;
use crate::dependent_rules::{DependentRules, NewContext};
use crate::grammar::{Grammar, NewContexts};

impl Grammar {
    /// Returns the candidates with contexts in the new chain; `None` if there are none, or if one has another form than
    /// [`DependentRules`] requires.
    pub(crate) fn find_dependent_rules(&self) -> Option<DependentRules> {
        if self.new_contexts() == NewContexts::None || self.has_runs() || self.has_events() {
            return None;
        }
        let symbols = self.arities().len();
        let contexts: Vec<_> =
            self.rules().iter().map(|rule| NewContext::of(&rule.pattern, symbols)).collect();
        let mut found = None;
        let depends = |number: &u16| {
            let rule = &self.rules()[usize::from(*number)];
            self.choice_in(rule.region(), rule.pattern.symbol) == Choice::NewContexts
        };
        for number in self.candidates().filter(depends) {
            let rule = &self.rules()[usize::from(number)];
            if rule.weight.is_some() {
                return None;
            }
            if !rule.has_new_contexts() {
                continue;
            }
            let key = (rule.pattern.has_new_right(), self.ignored_set(number));
            if contexts[usize::from(number)].is_none() || found.is_some_and(|known| known != key) {
                return None;
            }
            found = Some(key);
        }
        let (is_backward, set) = found?;
        Some(DependentRules::new(is_backward, (set, self.ignored_sets()[set].clone()), contexts))
    }
}
