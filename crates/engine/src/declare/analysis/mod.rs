//! Reads a script before it runs: finds mistakes that can be seen without running it, and prepares its rules.
//!
//! Four things are changed in the text, and no line break is: a rule's `return A(x), { B(y) }` becomes one call
//! with all parameters, since its modules and brackets, its shape, can be seen from the text; its other
//! returns are told apart into nothing, nil and lists; and an assignment in a function to a variable from
//! outside it is preceded by a check that no rule is running.

mod blocks;
mod calls;
mod expressions;
mod files;
mod held;
mod inference;
mod inspection;
mod own_types;
mod prepare;
mod pure;
mod queries;
mod script;
mod syntax;
mod walk;

pub(crate) use files::{CheckedFile, call_problems};
pub(crate) use inspection::inspects_tables;
pub(crate) use pure::has_metatables;
pub(crate) use queries::QueryCall;
pub(crate) use script::{Analysis, Globals, ScriptReader, analyse, unmarked};
