//! Surroundings of the modules of a pass: contexts, and the regions of sub-systems with their rules and scales.

use super::InterpretationPass;
use crate::machine::Interpretation;
use burgeon_base::error::{Error, Result};
use burgeon_kit::{Object, Rescale, Value, Values};
use burgeon_rewriting::{Bindings, ContextMatcher, Region};

impl InterpretationPass {
    /// Returns the parameters of the context modules of interpretation rule `rule` around `module`; `None` if the contexts
    /// do not match.
    pub(super) fn context(&self, rule: u16, module: usize) -> Option<Vec<f64>> {
        let grammar = self.plan.interpretations.grammar.as_ref()?;
        let contexts = ContextMatcher { chain: &self.chain, links: &self.links, grammar };
        if !contexts.matches(rule, module) {
            return None;
        }
        let mut bindings = Bindings::default();
        contexts.of_rule(rule).bind(module, &mut bindings);
        let mut params = Vec::new();
        for (item, bound) in grammar.rules()[usize::from(rule)].contexts().iter().zip(bindings) {
            item.push_arguments(&self.chain.params, self.links.param[bound as usize] as usize, &mut params);
        }
        Some(params)
    }

    /// Returns the region of the symbol at `index`.
    #[inline]
    pub(super) fn region(&self, index: usize) -> Region {
        self.regions.get(index).copied().unwrap_or(0)
    }

    /// Returns the interpretation of the symbol at `index`, if it has one.
    pub(super) fn interpretation_at(&self, index: usize) -> Option<&Interpretation> {
        let interpretations = &self.plan.interpretations;
        let place = interpretations.place_of(self.region(index), self.chain.symbols[index]);
        interpretations.list.get(usize::from(*interpretations.by_symbol.get(place)?))
    }

    /// Scales `object` for the region that the module at `index` opens, whose parameters are `params`.
    #[cold]
    pub(super) fn rescale(
        &self,
        object: &mut dyn Object,
        index: usize,
        params: &[f64],
        values: &Values,
    ) -> Result<()> {
        let symbol = self.chain.symbols[index];
        let openers = &self.plan.interpretations.openers;
        let Some(opener) = openers.iter().find(|opener| opener.symbol == symbol) else { return Ok(()) };
        let scale = opener.scale.and_then(|scale| params.get(scale));
        let scaled = match scale.map(|scale| values.unpack(*scale)) {
            None | Some(Value::Nil) => Ok(()),
            Some(Value::Number(factor)) => match object.capability_mut::<dyn Rescale>() {
                Some(object) => object.rescale(factor),
                None => Err(Error::internal("the object cannot be scaled")),
            },
            Some(other) => {
                let error = Error::argument(format!("the scale must be a number, not {other}"));
                Err(error.help("use 0.5 for half of the size"))
            }
        };
        scaled.map_err(|error| error.at_place(opener.place.as_ref()))
    }
}
