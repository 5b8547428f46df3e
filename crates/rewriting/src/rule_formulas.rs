//! Formulas of a rule: a guard that only compares numbers, and a successor whose parameters are formulas.

use std::sync::Arc;

use crate::batch::{Batch, Scratch};
use crate::formula::{Formula, ROWS};
use crate::rule::Rule;
use crate::successors::{ReturnShape, Successors};

/// Formulas with the places of the arguments that they read.
#[derive(Debug, Clone)]
pub(crate) struct RuleFormulas {
    formulas: Vec<Formula>,
    /// Place of each argument of the rule.
    places: Vec<ArgumentPlace>,
    /// Indices of the context modules that the formulas read.
    contexts: Vec<usize>,
}

/// Successor of which only the parameters differ.
#[derive(Debug, Clone)]
pub(crate) struct Production {
    parameters: RuleFormulas,
    /// The only shape of the successor.
    shapes: Arc<Vec<ReturnShape>>,
}

/// Place of an argument of a rule.
#[derive(Debug, Clone, Copy)]
struct ArgumentPlace {
    /// Index among the contexts that the formulas read; `None` for the module itself.
    context: Option<usize>,
    /// Index among the parameters of the module.
    parameter: usize,
}

impl RuleFormulas {
    /// Creates formulas of the arguments of `rule`; `None` if it has not as many arguments, or if these are not all parameters of
    /// one module and its contexts before the step.
    pub(crate) fn new(rule: &Rule, formulas: Vec<Formula>) -> Option<Self> {
        let read = || formulas.iter().flat_map(Formula::arguments);
        if rule.skips_arguments() || read().any(|index| index >= rule.arguments()) {
            return None;
        }
        let left = rule.pattern.left.len();
        let of = |context: Option<usize>, bound: usize| {
            (0..bound).map(move |parameter| ArgumentPlace { context, parameter })
        };
        let context = |index: usize| of(Some(index), rule.contexts()[index].bound);
        let rights = (left..rule.contexts().len()).flat_map(context);
        let own = of(None, rule.pattern.own_bound());
        let mut places: Vec<_> = (0..left).flat_map(context).chain(own).chain(rights).collect();
        let mut contexts: Vec<usize> = read().filter_map(|index| places[index].context).collect();
        contexts.sort_unstable();
        contexts.dedup();
        for place in &mut places {
            place.context = place.context.and_then(|context| contexts.binary_search(&context).ok());
        }
        Some(Self { formulas, places, contexts })
    }
}

impl Production {
    /// Creates the successor of `rule` with a shape and the formulas of its parameters; `None` if they do not fit.
    pub(crate) fn new(rule: &Rule, shape: ReturnShape, formulas: Vec<Formula>) -> Option<Self> {
        if shape.params != formulas.len() || formulas.iter().any(Formula::is_truth) {
            return None;
        }
        let parameters = RuleFormulas::new(rule, formulas)?;
        Some(Self { parameters, shapes: Arc::new(vec![shape]) })
    }
}

impl Batch<'_> {
    /// Evaluates the condition of a rule for the applications `members`, and appends 1 to `holds` for each for which it holds,
    /// otherwise 0. Returns false if a value is no number.
    pub(crate) fn evaluate_condition(
        &self,
        rule: u16,
        condition: &RuleFormulas,
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
        formulas: &RuleFormulas,
        members: &[u32],
        scratch: &mut Scratch,
        mut take: impl FnMut(usize, usize, &[f64]),
    ) -> bool {
        let RuleFormulas { formulas, places, contexts } = formulas;
        let bound = self.contexts().of_rule(rule);
        let params = &self.chain.params;
        let Scratch { active, bindings, .. } = scratch;
        // First parameters of the module and of the contexts that the formulas read, for each row.
        let mut begins = [0; ROWS];
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
                let Some(values) = formula.evaluate(members.len(), fill) else { return false };
                take(number, block * ROWS, &values[..members.len()]);
            }
        }
        true
    }
}
