//! Evaluation of the formulas of rules for the modules of a batch.

use crate::batch::{Batch, Scratch};
use crate::formula::{FormulaColumns, ROWS};
use crate::formula_set::{ArgumentPlace, FormulaSet, Production};
use crate::successors::Successors;

impl Batch<'_> {
    /// Evaluates the condition of a rule for the applications `members`, and appends 1 to `holds` for each for which it holds,
    /// otherwise 0. Returns false if a value is no number.
    pub(crate) fn evaluate_condition(
        &self,
        rule: u16,
        condition: &FormulaSet,
        members: &[u32],
        scratch: &mut Scratch,
        holds: &mut Vec<u32>,
    ) -> bool {
        self.evaluate(rule, condition, members, scratch, |_, _, values| {
            holds.extend(values.iter().map(|value| u32::from(*value != 0.0)));
        })
    }

    /// Makes the successors of a rule for the applications `members`. Returns false if a value is no number.
    pub(crate) fn produce(
        &self,
        rule: u16,
        production: &Production,
        members: &[u32],
        scratch: &mut Scratch,
        made: &mut Successors,
    ) -> bool {
        made.clear();
        let Production { parameters, shapes } = production;
        let count = parameters.formulas.len();
        made.params.resize(members.len() * count, 0.0);
        let params = &mut made.params;
        let is_made = self.evaluate(rule, parameters, members, scratch, |number, first, values| {
            let column = params[first * count + number..].iter_mut().step_by(count);
            column.zip(values).for_each(|(place, value)| *place = *value);
        });
        if is_made {
            made.ends.resize(members.len(), Successors::SHAPE);
            made.shapes.clone_from(shapes);
        }
        is_made
    }

    /// Evaluates formulas for the applications `members`. `take` gets the number of a formula, the index of the first of some
    /// applications, and their values. Returns false if a value is no number.
    fn evaluate(
        &self,
        rule: u16,
        formulas: &FormulaSet,
        members: &[u32],
        scratch: &mut Scratch,
        mut take: impl FnMut(usize, usize, &[f64]),
    ) -> bool {
        let FormulaSet { formulas, places, contexts } = formulas;
        let bound = self.contexts().of_rule(rule);
        let params = &self.chain.params;
        let Scratch { active, bindings, .. } = scratch;
        // First parameters of the module and of the contexts that the formulas read, for each row.
        let mut begins = [0; ROWS];
        let mut columns = FormulaColumns::default();
        let mut context_begins: Vec<u32> = Vec::new();
        for (block, members) in members.chunks(ROWS).enumerate() {
            context_begins.clear();
            for (index, begin) in members.iter().zip(&mut begins) {
                let active = active[*index as usize];
                *begin = active.param;
                if !contexts.is_empty() {
                    bound.bind(active.module as usize, bindings);
                    let begin = |context: &usize| self.links.param[bindings[*context] as usize];
                    context_begins.extend(contexts.iter().map(begin));
                }
            }
            let fill = |index: usize, column: &mut [f64]| {
                let ArgumentPlace { context, parameter } = places[index];
                match context {
                    None => column.iter_mut().zip(&begins).for_each(|(value, begin)| {
                        *value = params[*begin as usize + parameter];
                    }),
                    Some(context) => {
                        let begins = context_begins.iter().skip(context).step_by(contexts.len());
                        column.iter_mut().zip(begins).for_each(|(value, begin)| {
                            *value = params[*begin as usize + parameter];
                        });
                    }
                }
            };
            for (number, formula) in formulas.iter().enumerate() {
                let Some(values) = formula.evaluate(members.len(), &mut columns, fill) else { return false };
                take(number, block * ROWS, values);
            }
        }
        true
    }
}
