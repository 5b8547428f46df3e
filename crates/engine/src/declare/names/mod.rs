//! The names that every script has besides types of objects: each declared once, with its type and what it does.
//!
//! `burgeon api` tells what stands here, what scripts are refused lists it, and the analysis takes from it which functions
//! are pure. The standard library's names stand in its own file, from which [`names`] reads them.

mod burgeon;
mod luau;
mod name;
mod standard;

pub(crate) use burgeon::{DERIVED, EXTEND, LAYER, LSYSTEM, OBJECT, PARAM, RULE, SOURCE, SYSTEM};
pub(crate) use luau::LOCKED;
pub use name::{Name, NameKind, NameMember, names};
pub(crate) use name::{deprecated_names, is_pure_function, is_pure_library};
