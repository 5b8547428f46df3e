//! Types of objects in the virtual machine, and the objects that scripts hold.
//!
//! Comes in: kinds from the registry, and what a script declares. Goes out: constructors and methods that scripts call. What
//! they do is a matter of the kinds; no kind is known by its name.

mod handles;
mod kinds;
mod script_types;

pub(crate) use handles::Objects;
pub(super) use handles::{DerivedHandle, ObjectHandle, methods_key};
pub(super) use kinds::{install_kind, named_fields, no_table};
pub(super) use script_types::{ScriptFunction, ScriptTypeEntry, declare_type, extend_type};
