//! Rules without their successors.

use super::chain::Symbol;
use super::formula::RuleFormula;
use super::formula_set::{FormulaSet, Production};
use super::pattern::{Item, Pattern};
use super::regions::Region;
use super::successors::ReturnShape;
use burgeon_base::error::SourcePlace;

/// Rate at which a rule applies to each of its modules (events per unit of time).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Propensity {
    /// The same for all modules.
    Constant(f64),
    /// Result of a function of the rule, see [`Rules::propensity`](crate::Rules::propensity).
    Computed,
}

/// A production without its successor, which is a function in each of the script's virtual machines.
#[derive(Debug, Clone)]
pub struct Rule {
    /// Pattern with the predecessor and its contexts.
    pub pattern: Pattern,
    /// Weight among the weighted candidates; a rule without a weight always wins.
    pub weight: Option<f64>,
    /// Set if a guard decides in addition to the contexts.
    pub guarded: bool,
    /// Source location of the declaration.
    pub place: Option<SourcePlace>,
    /// Symbols that the contexts of this rule skip, if they are not those of the system.
    pub(super) ignored: Option<Vec<Symbol>>,
    propensity: Option<Propensity>,
    condition: Option<FormulaSet>,
    production: Option<Production>,
    region: Region,
    contexts: Vec<Item>,
    has_contexts: bool,
    has_new_contexts: bool,
    tests_modules: bool,
    skips_arguments: bool,
    run_length: usize,
}

impl Rule {
    /// Creates a rule for `pattern`.
    pub fn new(pattern: Pattern, weight: Option<f64>, guarded: bool, place: Option<SourcePlace>) -> Self {
        let contexts = pattern.context_items();
        let has_contexts = pattern.has_left() || pattern.has_right();
        let has_new_contexts = pattern.has_new_left() || pattern.has_new_right();
        let tests_modules =
            pattern.has_run() || pattern.predecessors.iter().any(|item| item.plain().is_none());
        let run_length = pattern.predecessors.len().max(1);
        let skips_arguments =
            tests_modules || has_new_contexts || contexts.iter().any(|item| !item.values.is_empty());
        Self {
            pattern,
            weight,
            guarded,
            place,
            ignored: None,
            propensity: None,
            condition: None,
            production: None,
            region: 0,
            contexts,
            has_contexts,
            has_new_contexts,
            tests_modules,
            skips_arguments,
            run_length,
        }
    }

    /// Returns the rule whose contexts skip the modules with these symbols, in place of those that the grammar ignores.
    ///
    /// ```
    /// use burgeon_rewriting::ClosureSystem;
    ///
    /// let mut system = ClosureSystem::new(0);
    /// let (a, b, c) = (system.module("A", &[])?, system.module("B", &[])?, system.module("C", &[])?);
    /// system.rule("A < B", move |_, out| out.push(a, &[]))?;
    /// system.rule("A < C", move |_, out| out.push(a, &[]))?;
    /// system.ignore_in_last_rule(&[b])?;
    /// let chain = system.chain(|out| [a, b, c].into_iter().for_each(|symbol| out.push(symbol, &[])))?;
    /// assert_eq!(system.text(&system.derive(chain, 1)?), "A A A\n");
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    #[must_use]
    pub fn ignoring(self, symbols: Vec<Symbol>) -> Self {
        Self { ignored: Some(symbols), ..self }
    }

    /// Returns the rule that applies to one module at a time, at a rate.
    #[must_use]
    pub fn with_propensity(self, propensity: Propensity) -> Self {
        Self { propensity: Some(propensity), ..self }
    }

    /// Returns the rule whose guard is a condition, which is evaluated in its place. The guard is still needed for arguments that
    /// are no numbers.
    #[must_use]
    pub fn with_condition(mut self, condition: RuleFormula) -> Self {
        if self.guarded && condition.is_truth() {
            self.condition = self.formula_set(vec![condition]);
        }
        self
    }

    /// Returns the rule whose successor always has a shape, with formulas of the parameters, which are evaluated in place of its
    /// function. The function is still needed for values that are no numbers.
    #[must_use]
    pub fn with_production(mut self, shape: ReturnShape, parameters: Vec<RuleFormula>) -> Self {
        let parameters = self.formula_set(parameters);
        self.production = parameters.and_then(|parameters| Production::new(shape, parameters));
        self
    }

    /// Returns formulas of the arguments; `None` if these are not all parameters of one module and its contexts before the step.
    fn formula_set(&self, formulas: Vec<RuleFormula>) -> Option<FormulaSet> {
        if self.skips_arguments { None } else { FormulaSet::new(&self.pattern, &self.contexts, formulas) }
    }

    /// Returns the condition of the guard, if the guard is one.
    #[inline]
    pub(super) fn condition(&self) -> Option<&FormulaSet> {
        self.condition.as_ref()
    }

    /// Returns the successor, if its parameters are formulas.
    #[inline]
    pub(super) fn production(&self) -> Option<&Production> {
        self.production.as_ref()
    }

    /// Returns the rate of the rule, if it applies to one module at a time.
    #[inline]
    pub fn propensity(&self) -> Option<Propensity> {
        self.propensity
    }

    /// Returns true if the rule has a context in the chain that the step writes.
    #[inline]
    pub fn has_new_contexts(&self) -> bool {
        self.has_new_contexts
    }

    /// Returns true if the rule has a context in the chain before the step, which can also be only an end of the chain.
    #[inline]
    pub fn has_contexts(&self) -> bool {
        self.has_contexts
    }

    /// Returns true if the symbol of the first module does not decide alone whether the predecessor matches: if there
    /// are several modules, or values.
    #[inline]
    pub fn tests_modules(&self) -> bool {
        self.tests_modules
    }

    /// Returns true if the arguments of a module are not all of its parameters, or if several modules provide them.
    #[inline]
    pub(super) fn skips_arguments(&self) -> bool {
        self.skips_arguments
    }

    /// Returns the number of modules that the rule rewrites at once.
    #[inline]
    pub fn run_length(&self) -> usize {
        self.run_length
    }

    /// Returns the context modules, in the order in which the pattern names them.
    pub fn contexts(&self) -> &[Item] {
        &self.contexts
    }

    /// Returns the number of arguments of the rule's functions, without `this`.
    #[inline]
    pub fn arguments(&self) -> usize {
        self.pattern.formals.len()
    }

    /// Returns the rule that applies only in the regions with this number, see [`Grammar::with_regions`](crate::Grammar::with_regions). A rule that
    /// rewrites several modules applies if the first of them is in such a region.
    #[must_use]
    pub fn in_region(mut self, region: Region) -> Self {
        self.region = region;
        self
    }

    /// Returns the number of the regions in which the rule applies; 0 outside of all regions.
    #[inline]
    pub fn region(&self) -> Region {
        self.region
    }
}
