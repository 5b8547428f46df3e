//! Reads a script before it runs: finds mistakes that can be seen without running it, and prepares its rules.
//!
//! Input: the text of a script, what it may use, and what makes bytecode of it. Output: an [`Analysis`], the text
//! that is to run and what is known of its functions; then what is wrong with its calls. It never runs a script, and knows
//! no virtual machine.
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
mod parameters;
mod prepare;
mod pure;
mod queries;
mod script;
mod syntax;
mod walk;

pub use files::{CheckedFile, call_problems};
pub use inspection::{calls_with_text, inspects_tables};
pub use parameters::sql_parameters;
pub use pure::has_metatables;
pub use queries::QueryCall;
pub use script::{Analysis, Compile, Globals, ScriptReader, analyse, unmarked};
