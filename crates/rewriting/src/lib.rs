//! Rewriting of L-systems: parallel, parametric, context-sensitive and stochastic, without a scripting language.
//!
//! Input: modules and patterns as text, and the functions of rules as an implementation of [`Rules`]. Output: the next
//! [`Chain`], the same for any number of threads. The crate never depends on a virtual machine, objects or geometry.
//!
//! - [`Symbols`] are the declared modules. A [`Pattern`] is the left side of a rule; a [`Grammar`] contains the rules
//!   of a system.
//! - A [`Chain`] contains all modules of a system in columns. [`Links`] find the neighbours of its modules once per
//!   step, and a [`ContextMatcher`] uses them to match contexts.
//! - A [`Stepper`] performs steps: it chooses the rule of each module, applies the rules in batches, and splices the
//!   [`Successors`] into the next chain. [`Helpers`] are threads that process pieces of a step.
//! - In a [`StepSeries`], a step costs as much as it changes.
//! - Modules can open regions, to which the rules of other systems apply, see [`Grammar::with_regions`].
//! - [`derive()`] runs [`Phase`]s, of which rewriting is one, until nothing can change.
//! - Random numbers come from the [`ModuleKey`] of a module, which depends only on the seed and the lineage. A named
//!   stream of a module also depends on its [`KeyPart`]s.
//! - Functions of rules can read the [`StepNumber`] of the step that is running.
//! - A [`ClosureSystem`] is a whole system whose rules are closures.
//!
//! Lindenmayer's algae, whose lengths are the Fibonacci numbers:
//!
//! ```
//! use burgeon_rewriting::ClosureSystem;
//!
//! let mut algae = ClosureSystem::new(0);
//! let (a, b) = (algae.module("A", &[])?, algae.module("B", &[])?);
//! algae.rule("A", move |_, out| {
//!     out.push(a, &[]);
//!     out.push(b, &[]);
//! })?;
//! algae.rule("B", move |_, out| out.push(a, &[]))?;
//!
//! let mut chain = algae.chain(|out| out.push(a, &[]))?;
//! for length in [2, 3, 5, 8, 13] {
//!     chain = algae.derive(chain, 1)?;
//!     assert_eq!(chain.modules(), length);
//! }
//! assert_eq!(algae.text(&chain), "A B A A B A B A A B A A B\n");
//! # Ok::<(), burgeon_base::Error>(())
//! ```

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}

mod amounts;
mod batch;
mod chain;
mod choice;
mod choose;
mod closures;
mod column_value;
mod compatible;
mod context;
mod cut;
mod dependent_batch;
mod dependent_candidates;
mod dependent_rules;
mod dependents;
mod evaluate;
mod event_chain;
mod events;
mod events_between;
mod failed_chains;
mod formula;
mod formula_set;
mod grammar;
mod grammar_regions;
mod ignored;
mod links;
mod matching;
mod new_chain;
mod new_contexts;
mod ordinals;
mod output;
mod pattern;
mod pattern_reader;
mod phases;
mod plan;
mod propensities;
mod regions;
mod rewrite_dependents;
mod rule;
mod rules;
mod runs;
mod segments;
mod series;
mod series_chain;
mod series_pause;
mod splice;
mod step;
mod step_number;
mod successors;
mod symbols;
mod text;
mod uses;
mod windows;

pub use amounts::MOST_PROPENSITY;
pub use batch::{NO_RULE, Scratch};
pub use burgeon_base::{KeyPart, ModuleKey};
pub use chain::{CLOSE, Chain, DEEPEST, END, Mark, OPEN, Symbol};
pub use choice::{Candidates, Choice};
pub use closures::{AppliedModule, ClosureSystem};
pub use column_value::ColumnValue;
pub use context::ContextElement;
pub use cut::{CutChain, cut};
pub use dependent_rules::{DependentRules, NewContext};
pub use dependents::DependentModules;
pub use events::{BetweenEvents, EventSeries, EventsOutcome};
pub use events_between::{ChainsBetween, EventsNext};
pub use failed_chains::FailedChains;
pub use formula::{FormulaColumns, RuleFormula};
pub use grammar::{Grammar, MOST_RULES, NewContexts};
pub use links::Links;
pub use matching::{Bindings, ContextMatcher, RuleContexts};
pub use ordinals::Ordinals;
pub use pattern::{Context, Item, Pattern, PatternValue, SymbolSet};
pub use phases::{DerivedChain, Phase, PhaseOutcome, Phases, derive};
pub use plan::StepPlan;
pub use regions::{Region, RegionOpeners};
pub use rule::{Propensity, Rule};
pub use rules::{Applications, RuleFailure, Rules};
pub use series::{SeriesOutcome, StepSeries};
pub use series_chain::{PlaceFollower, SeriesChain};
pub use step::{Helpers, NoHelpers, StepOutcome, StepWork, Stepper};
pub use step_number::StepNumber;
pub use successors::{ReturnShape, Successors};
pub use symbols::{FIRST_SYMBOL, NameScope, PLACEHOLDERS, Signature, Symbols, placeholder};
pub use text::{PlainNumbers, ShowParameters, chain_text, module_brief, module_text, write_chains};
pub use uses::Use;
