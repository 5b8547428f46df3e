//! Interpretation: the modules of the chains, in order, change the objects.
//!
//! Input: chains and objects. Output: the same chains and changed objects. Rules record their method calls
//! in columns, and the calls are applied here, so that a module crosses between Lua and Rust only if it asks the
//! object something.

mod apply;
mod notices;
mod pass;

pub(crate) use apply::Applier;
pub(crate) use pass::InterpretationPass;
