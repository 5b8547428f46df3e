//! Rules of a system, prepared for derivation.

use std::sync::Arc;

use super::chain::Symbol;
use super::choice::Choice;
use super::context::{CompiledPatterns, ContextElement};
use super::dependent_rules::DependentRules;
use super::ignored::IgnoredSet;
use super::regions::{Region, RegionOpeners};
use super::rule::Rule;
use super::symbols::Symbols;

/// Maximum number of rules of a system, because they are numbered in 16 bits.
pub const MOST_RULES: usize = 65_000;

/// All rules of a system, immutable during derivation.
#[derive(Debug, Clone)]
pub struct Grammar {
    symbols: Arc<Symbols>,
    rules: Vec<Rule>,
    pub(super) openers: RegionOpeners,
    /// Candidates of the symbols of each region, one region after the other.
    by_symbol: Vec<Vec<u16>>,
    patterns: CompiledPatterns,
    /// Choice among these candidates.
    choices: Vec<Choice>,
    /// Set for each symbol that has candidates in a region.
    ruled: Vec<bool>,
    /// Sets of symbols that contexts skip, each stored once. The first is that of the system.
    ignored: Vec<IgnoredSet>,
    /// Number of the set of each rule.
    ignored_numbers: Vec<usize>,
    /// Symbols that all of the sets contain which candidates have, and those that any of them contains.
    pub(super) skipped_by_all: IgnoredSet,
    pub(super) skipped_by_any: IgnoredSet,
    ring: bool,
    arities: Vec<u8>,
    name_hashes: Vec<u64>,
    /// Number of elements of the longest left context.
    left: usize,
    /// Number of elements of the longest right context.
    right: usize,
    /// Contexts in the chain that a step writes.
    new_contexts: NewContexts,
    dependents: Option<DependentRules>,
    runs: bool,
    events: bool,
    random: bool,
}

/// Contexts of a grammar in the chain that a step writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NewContexts {
    /// No rule has one.
    None,
    /// Left contexts, so that modules are rewritten from left to right.
    Left,
    /// Right contexts, so that modules are rewritten from right to left.
    Right,
}

impl Grammar {
    /// Creates a grammar of `rules` in the order of declaration, at most [`MOST_RULES`]. A rule of weight 0 is never a
    /// candidate, so it never applies.
    ///
    /// `ignored` lists the symbols that contexts skip. `random` is set if successors may use random numbers; rules
    /// with weights or propensities are detected automatically.
    pub fn new(symbols: Arc<Symbols>, rules: Vec<Rule>, ignored: &[Symbol], random: bool) -> Self {
        let arities = symbols.arities();
        let mut sets = vec![IgnoredSet::new(ignored, arities.len())];
        let ignored_numbers = rules.iter().map(|rule| {
            let Some(ignored) = &rule.ignored else { return 0 };
            let set = IgnoredSet::new(ignored, arities.len());
            let known = sets.iter().position(|known| known.has_same_symbols(&set));
            known.unwrap_or_else(|| {
                sets.push(set);
                sets.len() - 1
            })
        });
        let ignored_numbers = ignored_numbers.collect();
        let mut patterns = CompiledPatterns::default();
        rules.iter().for_each(|rule| patterns.add(&rule.pattern));
        let random = random || rules.iter().any(|rule| rule.weight.is_some() || rule.propensity().is_some());
        let grammar = Self {
            rules,
            openers: RegionOpeners::default(),
            by_symbol: Vec::new(),
            patterns,
            choices: Vec::new(),
            ruled: Vec::new(),
            skipped_by_all: sets[0].clone(),
            skipped_by_any: sets[0].clone(),
            ignored: sets,
            ignored_numbers,
            ring: false,
            name_hashes: arities.iter().zip(0..).map(|(_, symbol)| symbols.name_hash(symbol)).collect(),
            symbols,
            arities,
            left: 0,
            right: 0,
            new_contexts: NewContexts::None,
            dependents: None,
            runs: false,
            events: false,
            random,
        };
        grammar.with_candidates(|_| true)
    }

    /// Returns the grammar in which the first and the last module of a chain are neighbours if `ring` is set.
    ///
    /// ```
    /// use burgeon_rewriting::ClosureSystem;
    ///
    /// let mut system = ClosureSystem::new(0);
    /// let (on, off) = (system.module("On", &[])?, system.module("Off", &[])?);
    /// system.rule("On < Off", move |_, out| out.push(on, &[]))?;
    /// system.rule("On", move |_, out| out.push(off, &[]))?;
    /// system.ring(true);
    /// let chain = system.chain(|out| [off, off, on].into_iter().for_each(|symbol| out.push(symbol, &[])))?;
    /// assert_eq!(system.text(&system.derive(chain, 1)?), "On Off Off\n");
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    #[must_use]
    pub fn with_ring(self, ring: bool) -> Self {
        Self { ring, ..self }
    }

    /// Returns the grammar in which only rules whose numbers satisfy `is_candidate` can be chosen. The numbers of the
    /// rules and the random keys of modules stay the same, so that several phases of a derivation can share a chain.
    #[must_use]
    pub fn with_candidates(mut self, is_candidate: impl Fn(u16) -> bool) -> Self {
        let symbols = self.arities.len();
        let highest = self.rules.iter().map(Rule::region).max().unwrap_or(0).max(self.openers.highest());
        let mut by_symbol = vec![Vec::new(); symbols * (usize::from(highest) + 1)];
        let mut ruled = vec![false; symbols];
        (self.left, self.right, self.runs, self.events) = (0, 0, false, false);
        self.new_contexts = NewContexts::None;
        for ignored in &mut self.ignored {
            (ignored.needs_left, ignored.needs_right) = (false, false);
        }
        for (number, rule) in (0u16..).zip(&self.rules).filter(|(number, _)| is_candidate(*number)) {
            let left = self.patterns.lefts[usize::from(number)].len();
            let right = self.patterns.rights[usize::from(number)].len();
            self.left = self.left.max(left);
            self.right = self.right.max(right);
            let ignored = &mut self.ignored[self.ignored_numbers[usize::from(number)]];
            ignored.needs_left |= left > 0;
            ignored.needs_right |= right > 0;
            if rule.weight != Some(0.0) {
                self.runs |= rule.pattern.has_run();
                self.events |= rule.propensity().is_some();
                if rule.pattern.has_new_left() {
                    self.new_contexts = NewContexts::Left;
                } else if rule.pattern.has_new_right() {
                    self.new_contexts = NewContexts::Right;
                }
                let symbol = usize::from(rule.pattern.symbol);
                by_symbol[usize::from(rule.region()) * symbols + symbol].push(number);
                ruled[symbol] = true;
            }
        }
        let used = || self.ignored.iter().filter(|set| set.needs_left || set.needs_right);
        self.skipped_by_all = IgnoredSet::of_all(used(), symbols);
        self.skipped_by_any = IgnoredSet::of_any(used(), symbols);
        let among = |of: &Vec<u16>| Choice::among(of.iter().map(|rule| &self.rules[usize::from(*rule)]), of);
        self.choices = by_symbol.iter().map(among).collect();
        self.by_symbol = by_symbol;
        self.ruled = ruled;
        self.dependents = self.find_dependent_rules();
        self
    }

    /// Returns the numbers of the rules that can be chosen, by region and symbol.
    pub(crate) fn candidates(&self) -> impl Iterator<Item = u16> + '_ {
        self.by_symbol.iter().flatten().copied()
    }

    /// Returns the declared modules.
    pub fn symbols(&self) -> &Arc<Symbols> {
        &self.symbols
    }

    /// Returns the rules in the order of declaration.
    #[inline]
    pub fn rules(&self) -> &[Rule] {
        &self.rules
    }

    /// Returns the rules of a symbol that can be chosen in a region, in the order of declaration.
    #[inline]
    pub fn rules_in(&self, region: Region, symbol: Symbol) -> &[u16] {
        &self.by_symbol[self.place_of(region, symbol)]
    }

    /// Returns true if a rule of a symbol can be chosen in any region.
    #[inline]
    pub(crate) fn has_rules_of(&self, symbol: Symbol) -> bool {
        self.ruled[usize::from(symbol)]
    }

    /// Returns the rules of the symbol of a region with this index, in the order of declaration.
    #[inline]
    pub(crate) fn rules_at(&self, place: usize) -> &[u16] {
        &self.by_symbol[place]
    }

    /// Returns the method of choosing the rule for the symbol of a region with this index.
    #[inline]
    pub(crate) fn choice_at(&self, place: usize) -> Choice {
        self.choices[place]
    }

    /// Returns the index of a symbol of a region.
    #[inline]
    pub(crate) fn place_of(&self, region: Region, symbol: Symbol) -> usize {
        usize::from(region) * self.arities.len() + usize::from(symbol)
    }

    /// Returns the left context of rule number `rule`, the nearest module first.
    #[inline]
    pub fn left_of(&self, rule: u16) -> &[ContextElement] {
        &self.patterns.lefts[usize::from(rule)]
    }

    /// Returns the modules that rule number `rule` rewrites.
    #[inline]
    pub fn predecessors_of(&self, rule: u16) -> &[ContextElement] {
        &self.patterns.predecessors[usize::from(rule)]
    }

    /// Returns the right context of rule number `rule`.
    #[inline]
    pub fn right_of(&self, rule: u16) -> &[ContextElement] {
        &self.patterns.rights[usize::from(rule)]
    }

    /// Returns the left context of rule number `rule` in the new chain, the nearest module first.
    #[inline]
    pub fn new_left_of(&self, rule: u16) -> &[ContextElement] {
        &self.patterns.new_lefts[usize::from(rule)]
    }

    /// Returns the right context of rule number `rule` in the new chain.
    #[inline]
    pub fn new_right_of(&self, rule: u16) -> &[ContextElement] {
        &self.patterns.new_rights[usize::from(rule)]
    }

    /// Returns the branches, tests and values that patterns name.
    #[inline]
    pub(super) fn patterns(&self) -> &CompiledPatterns {
        &self.patterns
    }

    /// Returns the method of choosing the rule for a module with this symbol in a region.
    ///
    /// ```
    /// use burgeon_rewriting::{Choice, Grammar, Pattern, Rule, Signature, Symbols};
    /// use std::sync::Arc;
    ///
    /// let mut symbols = Symbols::default();
    /// let a = symbols.declare(Signature::new("A", &[])?)?;
    /// let b = symbols.declare(Signature::new("B", &[])?)?;
    /// let patterns = [Pattern::parse("A", &symbols)?, Pattern::parse("A < B", &symbols)?];
    /// let rules = patterns.map(|pattern| Rule::new(pattern, None, false, None)).to_vec();
    /// let grammar = Grammar::new(Arc::new(symbols), rules, &[], false);
    /// assert_eq!((grammar.choice_in(0, a), grammar.choice_in(0, b)), (Choice::Sole(0), Choice::Contexts));
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    #[inline]
    pub fn choice_in(&self, region: Region, symbol: Symbol) -> Choice {
        self.choices[self.place_of(region, symbol)]
    }

    /// Returns true if the contexts of rule number `rule` skip `symbol`.
    #[inline]
    pub fn is_ignored(&self, rule: u16, symbol: Symbol) -> bool {
        self.ignored[self.ignored_set(rule)].contains(symbol)
    }

    /// Returns the sets of symbols that contexts skip.
    #[inline]
    pub(crate) fn ignored_sets(&self) -> &[IgnoredSet] {
        &self.ignored
    }

    /// Returns the number of the set of symbols that the contexts of rule number `rule` skip.
    #[inline]
    pub fn ignored_set(&self, rule: u16) -> usize {
        self.ignored_numbers[usize::from(rule)]
    }

    /// Returns true if the first and the last module of a chain are neighbours.
    #[inline]
    pub fn is_ring(&self) -> bool {
        self.ring
    }

    /// Returns the number of parameters by symbol, including brackets.
    #[inline]
    pub fn arities(&self) -> &[u8] {
        &self.arities
    }

    /// Returns the hashes of the names of modules by symbol, including brackets.
    #[inline]
    pub fn name_hashes(&self) -> &[u64] {
        &self.name_hashes
    }

    /// Returns true if modules need random keys.
    #[inline]
    pub fn draws_random(&self) -> bool {
        self.random
    }

    /// Returns true if a rule has a context.
    #[inline]
    pub fn has_contexts(&self) -> bool {
        self.has_left_contexts() || self.has_right_contexts() || self.new_contexts != NewContexts::None
    }

    /// Returns the contexts of rules in the chain that a step writes.
    #[inline]
    pub fn new_contexts(&self) -> NewContexts {
        self.new_contexts
    }

    /// Returns the rules with contexts in the new chain, if one call can apply them to modules that depend on one another.
    #[inline]
    pub fn dependent_rules(&self) -> Option<&DependentRules> {
        self.dependents.as_ref()
    }

    /// Returns true if each step rewrites one module of each chain, drawn by the propensities of the rules.
    #[inline]
    pub fn has_events(&self) -> bool {
        self.events
    }

    /// Returns true if a rule rewrites several modules at once.
    #[inline]
    pub fn has_runs(&self) -> bool {
        self.runs
    }

    /// Returns true if a rule has a left context.
    #[inline]
    pub fn has_left_contexts(&self) -> bool {
        self.left > 0
    }

    /// Returns true if a rule has a right context.
    #[inline]
    pub fn has_right_contexts(&self) -> bool {
        self.right > 0
    }

    /// Returns the number of elements of the longest left context.
    pub(crate) fn longest_left(&self) -> usize {
        self.left
    }

    /// Returns the number of elements of the longest right context.
    pub(crate) fn longest_right(&self) -> usize {
        self.right
    }
}
