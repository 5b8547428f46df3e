//! Errors and warnings of an interpretation pass, with the rule, the module and the line.

use super::InterpretationPass;
use super::notices::ObjectNotice;
use super::pass::applier;
use crate::machine::Machine;
use burgeon_base::error::{Error, SourcePlace};
use burgeon_rewriting::{END, module_brief};

impl InterpretationPass {
    /// Adds the warnings of objects in the last batch.
    pub(super) fn note_all(&self, machine: &Machine, notices: &[ObjectNotice]) {
        for (index, notice) in notices.iter().enumerate() {
            let mut earlier = notices[..index].iter().rev().take_while(|it| it.module == notice.module);
            let is_first = !earlier.any(|it| it.warning.says_the_same(&notice.warning));
            self.note(machine, notice, is_first);
        }
    }

    /// Adds one warning of an object in the last batch. `is_first` marks the first warning of its module with
    /// this text.
    fn note(&self, machine: &Machine, notice: &ObjectNotice, is_first: bool) {
        let (module, param) = notice.module;
        let symbol = self.chain.symbols[module];
        self.notices.add((symbol, module), is_first, notice.warning.clone(), |warning| {
            let warning = warning.at(notice.call.and_then(|call| Self::line_of(machine, call)));
            if symbol <= END {
                return warning;
            }
            let warning = warning.module(self.module_brief(machine, module, param), self.step);
            match self.interpretation_at(module) {
                Some(known) => {
                    warning.at_place(known.place.as_ref()).rule(format!("{} (interpretation)", known.name))
                }
                None => warning,
            }
        });
    }

    /// Adds the line of the failed recorded call to an error. Runs the rule again to find the line.
    pub(super) fn find_line(&self, machine: &Machine, error: Error) -> Error {
        let failed = machine.current.flusher.borrow_mut().as_deref_mut().and_then(|it| applier(it)?.failed());
        let Some(call) = failed else { return error };
        error.rather_at(Self::line_of(machine, call))
    }

    /// Returns the line of a recorded call of the last batch, given its entry and number. Runs the rule again
    /// to find it.
    fn line_of(machine: &Machine, call: (usize, usize)) -> Option<SourcePlace> {
        let prelude = machine.prelude();
        let place = match prelude.relive.call::<()>(call) {
            Err(raised) => machine.translate(raised).into_place(),
            Ok(()) => None,
        };
        // If ending the batch fails too, the machine is dropped with the run.
        let _ = prelude.finish.call::<()>(());
        place
    }

    /// Adds the interpretation rule and the module to an error.
    pub(super) fn blame(
        &self,
        machine: &Machine,
        error: Error,
        id: Option<u16>,
        entry: Option<(usize, usize)>,
    ) -> Error {
        let Some((module, param)) = entry else { return error };
        let symbol = self.chain.symbols[module];
        let interpretations = &self.plan.interpretations;
        if symbol <= END || id == Some(interpretations.begin) {
            let known = id.and_then(|id| interpretations.list.get(usize::from(id)));
            return match known {
                Some(known) => error.at_place(known.place.as_ref()).rule(&known.name),
                None => error,
            };
        }
        let error = match id.and_then(|id| interpretations.list.get(usize::from(id))) {
            Some(known) => {
                error.at_place(known.place.as_ref()).rule(format!("{} (interpretation)", known.name))
            }
            None => error,
        };
        error.module(self.module_brief(machine, module, param), self.step)
    }

    /// Returns the text of a module of the chain whose parameters begin at `param`.
    fn module_brief(&self, machine: &Machine, module: usize, param: usize) -> String {
        let (grammar, symbol) = (&self.plan.steps.grammar, self.chain.symbols[module]);
        let arity = usize::from(grammar.arities()[usize::from(symbol)]);
        let params = &self.chain.params[param..param + arity];
        module_brief(grammar.symbols(), &machine.session.values, symbol, params)
    }
}
