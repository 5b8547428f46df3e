//! The names that every script has besides types of objects: each declared once, with its type and what it does.
//!
//! What is told of them, what scripts are refused, what is known of a call before it is made, and what editors complete
//! follows from here. The standard library's names stand in its own file.

mod burgeon;
mod luau;
mod name;
mod standard;

pub use burgeon::{DERIVED, EXTEND, LAYER, LSYSTEM, OBJECT, PARAM, RULE, SOURCE, SYSTEM, VECTOR};
pub use luau::LOCKED;
pub use name::{Effect, Name, NameKind, Operator, deprecated_names, is_pure_function, library_effect, names};
