//! Interpretation: the modules of the chains change the objects, in order.
//!
//! Input: chains and objects. Output: the same chains and the changed objects. Rules record their method
//! calls in columns, which are applied here. A module therefore crosses between Lua and Rust only if it reads
//! from the object.

mod apply;
mod blame;
mod entries;
mod flush;
mod memory;
mod notices;
mod part;
mod pass;
mod surroundings;

pub(crate) use apply::Applier;
pub(crate) use memory::PassMemory;
pub(crate) use pass::{InterpretationPass, PassOutcome};
