//! Runs scripts: virtual machines, parallel rewriting, and interpretation in between.
//!
//! Comes in: a script and the [`Registry`](burgeon_kit::Registry) of types that it may use. Goes out: a [`Run`] with
//! its scene. It never knows a type of object by name, and never writes a file.

pub mod derive;
mod interpret;
pub mod run;
pub mod script;
pub mod trace;

pub use run::{Check, Run, RunTimes, check, run_session};
