//! Grammars whose rules apply in regions.

use crate::chain::Symbol;
use crate::grammar::Grammar;
use crate::regions::{Region, RegionOpeners};

impl Grammar {
    /// Returns the grammar in which `openers` open regions: a rule applies only in the region of its system, see
    /// [`Rule::in_region`](crate::Rule::in_region). Contexts see the modules of all regions.
    ///
    /// ```
    /// use burgeon_rewriting::ClosureSystem;
    ///
    /// let mut plant = ClosureSystem::new(0);
    /// let (apex, leaf, stem) = (plant.module("Apex", &[])?, plant.module("Leaf", &[])?, plant.module("Stem", &[])?);
    /// plant.rule("Apex", move |_, out| {
    ///     out.push(stem, &[]);
    ///     out.open();
    ///     out.push(leaf, &[]);
    ///     out.push(apex, &[]);
    ///     out.close();
    ///     out.push(apex, &[]);
    /// })?;
    /// plant.open_region(leaf, 1);
    /// plant.add_rules_to(1);
    /// plant.rule("Apex", move |_, out| [stem, stem, apex].iter().for_each(|symbol| out.push(*symbol, &[])))?;
    /// let chain = plant.chain(|out| out.push(apex, &[]))?;
    /// let expected = "Stem [ Leaf Stem Stem Apex ] Stem [ Leaf Apex ] Apex\n";
    /// assert_eq!(plant.text(&plant.derive(chain, 2)?), expected);
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    #[must_use]
    pub fn with_regions(mut self, openers: &[(Symbol, Region)]) -> Self {
        self.openers = RegionOpeners::new(openers, self.arities().len());
        let mut candidates = vec![false; self.rules().len()];
        self.candidates().for_each(|number| candidates[usize::from(number)] = true);
        self.with_candidates(|number| candidates[usize::from(number)])
    }

    /// Returns the modules that open regions.
    #[inline]
    pub fn region_openers(&self) -> &RegionOpeners {
        &self.openers
    }
}
