//! Virtual machine: a sandboxed Luau state with the Lua side of the hot path; one per thread.
//!
//! Input: a script and a session. Output: the declared systems, and the results of their rules. This folder
//! rewrites nothing. Scripts reach files and the operating system only through the session.

mod batch_loops;
mod blank;
#[cfg(test)]
mod builtins_tests;
mod convert;
mod current;
mod divisions;
mod driver;
mod environments;
mod expectation;
mod freeze;
mod globals;
mod hooks;
mod host;
mod library;
mod messages;
mod module_places;
mod native;
mod object_methods;
mod prelude;
mod protected;
mod require;
mod row_tables;
mod shown_values;
mod streams;
mod system;
mod table_classes;
mod translation;
mod types;
mod variables;
mod virtual_machine;
mod watchdog;

pub use blank::make_ready;
pub(crate) use current::{Flusher, WorkState};
pub(crate) use driver::{DerivationRequest, Driver};
pub(crate) use environments::Environments;
pub(crate) use hooks::{HookChain, HookView, group_number};
pub(crate) use module_places::ModulePlaces;
pub(crate) use native::native;
pub(crate) use prelude::{CLOSE_CALL, OPEN_CALL};
pub(crate) use system::{
    Axiom, HookFunction, HookMoment, Interpretation, Interpretations, RulePhase, SystemFunctions,
    returns_value, stops_at_depth,
};
pub(crate) use types::{Objects, ReadChain};
pub(crate) use variables::table_of;
pub use virtual_machine::Machine;
pub(crate) use virtual_machine::{compile, read_column, write_column, write_columns};
pub use watchdog::Watchdog;
