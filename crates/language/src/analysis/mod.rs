//! Static analysis of scripts: finds errors without running a script, and prepares its rules.
//!
//! Input: the text of a script, the names that it may use, and a function that compiles to bytecode. Output: an
//! [`Analysis`] with the text to run and facts about its functions; then the problems of its calls. It never runs a script.
//!
//! The analysis changes the text but no line break. If the modules and brackets of a rule's `return A(x), { B(y) }`,
//! its shape, are visible in the text, the return becomes one call with all parameters. Other returns are marked as nil
//! or as a list. An assignment in a function to a variable outside of the function is preceded by a check that no rule
//! is running. Functions of rules are marked as prepared, those that only calculate with
//! numbers with their formulas, and successors in strings get their line number. Loops over
//! tables check the order of keys, and assignments to `self` check that the state can store the value.

mod blocks;
mod calls;
mod division;
mod doubtful;
mod endings;
mod expressions;
mod files;
mod formulas;
mod globals;
mod held;
mod inference;
mod inspection;
mod own_types;
mod parameters;
mod prepare;
mod pure;
mod queries;
mod results;
mod script;
mod syntax;
mod truncated;
mod walk;

pub use files::{CheckedFile, call_problems};
pub use globals::Globals;
pub use inspection::{asks_for_chains, calls_with_text, inspects_tables, observes_steps};
pub use parameters::sql_parameters;
pub use pure::has_metatables;
pub use script::{Analysis, Compile, ScriptReader, analyse, split_line};
pub use walk::QueryCall;
