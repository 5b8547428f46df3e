//! Burgeon: procedural modelling by rewriting.
#![recursion_limit = "256"]

pub mod derive;
pub mod error;
pub mod export;
pub mod geometry;
mod interpret;
pub mod objects;
pub mod picture;
pub mod rules;
mod run;
pub mod scene;
pub mod script;

pub use error::{Error, Result};
pub use run::{Run, RunTimes, check, run, run_session};
