//! Definition file for editors: the scripting API in the syntax of Luau's type checker.
//!
//! If Luau's types cannot express a type, the file declares `any`, so valid scripts have no type errors. The types of
//! arguments are wider than the types of results, because Luau compares the types of lists and tables exactly.

mod document;
mod types;
mod writer;

pub use document::{Definitions, definitions};
