//! Modules that stand for others: those of the rows of a query, or of the parts of what is to their left.
//!
//! A chain has such modules only until the axiom or the step that made them is done: then the modules that they stand
//! for take their places, and rules, interpretations and people see these. All questions of all chains are gathered,
//! asked once each by all threads, and put in together.

mod fragment;
mod query;
mod resolve;
mod sites;

pub(super) use resolve::{Resolution, resolve};
