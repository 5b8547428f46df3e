//! Resolution of placeholder modules: queries, and fragments of the module to their left.
//!
//! A chain contains placeholders only until the axiom or the step that made them is complete. Then other
//! modules replace them, and rules, interpretations and users see only these modules. The queries of all
//! chains are collected without duplicates, run by all threads, and inserted together.

mod fragment;
mod query;
mod resolve;
mod sites;

pub(super) use resolve::{Resolution, resolve};
