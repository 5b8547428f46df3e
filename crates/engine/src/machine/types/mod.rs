//! Object types in the virtual machine, and script values for objects.
//!
//! Input: kinds from the registry, and declarations of a script. Output: constructors and methods that
//! scripts call. This folder refers to no kind by name.

mod extensions;
mod geometries;
mod handles;
mod kinds;
mod mentions;
mod module_lists;
mod script_types;

pub(crate) use extensions::Extension;
pub(super) use extensions::{claim, extend_type};
pub(crate) use geometries::POINTS;
pub(super) use geometries::install_functions;
pub(super) use handles::{DerivedHandle, methods_key, read_often};
pub(crate) use handles::{ObjectHandle, Objects};
pub(super) use kinds::{install_kind, named_fields, no_table};
pub(super) use mentions::object_of_system;
pub(crate) use module_lists::{READ_MODULE, ReadChain, ReadableChain};
pub(super) use script_types::{ScriptTypeEntry, declare_type};
