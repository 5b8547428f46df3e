//! Formulas of a rule: a guard that only compares numbers, and a successor whose parameters are formulas.

use std::sync::Arc;

use crate::formula::RuleFormula;
use crate::pattern::{Item, Pattern};
use crate::successors::ReturnShape;

/// Formulas with the places of the arguments that they read.
#[derive(Debug, Clone)]
pub(crate) struct FormulaSet {
    pub(crate) formulas: Vec<RuleFormula>,
    /// Place of each argument of the rule.
    pub(crate) places: Vec<ArgumentPlace>,
    /// Indices of the context modules that the formulas read.
    pub(crate) contexts: Vec<usize>,
}

/// Successor of which only the parameters differ.
#[derive(Debug, Clone)]
pub(crate) struct Production {
    pub(crate) parameters: FormulaSet,
    /// The only shape of the successor.
    pub(crate) shapes: Arc<Vec<ReturnShape>>,
}

/// Place of an argument of a rule.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ArgumentPlace {
    /// Index among the contexts that the formulas read; `None` for the module itself.
    pub(crate) context: Option<usize>,
    /// Index among the parameters of the module.
    pub(crate) parameter: usize,
}

impl FormulaSet {
    /// Creates formulas of the arguments of a rule with a pattern and its context modules, all of whose parameters are arguments;
    /// `None` if a formula reads others.
    pub(crate) fn new(pattern: &Pattern, items: &[Item], formulas: Vec<RuleFormula>) -> Option<Self> {
        let read = || formulas.iter().flat_map(RuleFormula::arguments);
        if read().any(|index| index >= pattern.formals.len()) {
            return None;
        }
        let left = pattern.left.len();
        let of = |context: Option<usize>, bound: usize| {
            (0..bound).map(move |parameter| ArgumentPlace { context, parameter })
        };
        let context = |index: usize| of(Some(index), items[index].bound);
        let rights = (left..items.len()).flat_map(context);
        let own = of(None, pattern.own_bound());
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
    /// Creates the successor with a shape and the formulas of its parameters; `None` if they do not fit.
    pub(crate) fn new(shape: ReturnShape, parameters: FormulaSet) -> Option<Self> {
        let formulas = &parameters.formulas;
        let fits = shape.params == formulas.len() && !formulas.iter().any(RuleFormula::is_truth);
        fits.then(|| Self { parameters, shapes: Arc::new(vec![shape]) })
    }
}
