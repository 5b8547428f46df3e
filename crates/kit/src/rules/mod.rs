//! Rewriting without scripts: symbols, chains, patterns and how they match.
//!
//! Comes in: declarations and patterns as text. Goes out: a [`Grammar`] that tells which rules may apply to a
//! module of a [`Chain`]. It never runs Lua: guards and successors are only known to exist.

mod chain;
mod choice;
mod grammar;
mod key;
mod links;
mod matching;
mod pattern;
mod symbols;
mod text;
mod values;

pub use chain::{CLOSE, Chain, DEEPEST, END, Mark, OPEN, Symbol};
pub use choice::Candidates;
pub use grammar::{Choice, Grammar, MOST_RULES, Rule};
pub use key::ModuleKey;
pub use links::Links;
pub use matching::{Bindings, ContextMatcher};
pub use pattern::{Context, Item, Pattern};
pub use symbols::{FIRST_SYMBOL, FRAGMENT, NameScope, QUERY, Signature, Symbols};
pub use text::{chain_text, module_brief, module_text, write_chains};
pub use values::Values;

pub use crate::ColumnValue;
