//! Remedies for slips that people make who know other languages: syntax, names, and values of the wrong type.
//!
//! Input: the error that Luau or the analysis reports, and the script. Output: a remedy for it.

mod blocks;
mod code;
mod names;
mod syntax;
mod values;

pub use names::{remedy_of_name, remedy_of_system_method};
pub use syntax::explain_syntax;
pub use values::remedy_of_value;
