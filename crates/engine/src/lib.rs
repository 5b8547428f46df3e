//! Runs scripts: virtual machines, parallel rewriting, and interpretation in between.
//!
//! Input: a script and the [`Registry`](burgeon_kit::Registry) of types that it may use. Output: a [`Run`] with
//! its scene. It never knows a type of object by name, and never writes a file.

mod check;
mod declare;
mod derive;
mod machine;
mod placeholders;
mod questions;
pub mod results;
pub mod run;
pub mod trace;

/// What a run is told, what its script declares, and the virtual machines that run it.
pub mod script {
    pub use crate::declare::{
        API_VERSION, Control, Limits, Param, ParamValues, Preset, Print, RunInputs, RunOptions, RunProgress,
        RunReports, Session, Setting, TraceRequest, api_version,
    };
    pub use crate::machine::{Machine, Watchdog, make_ready};
    pub use crate::questions::{Question, RowSource, Rows};
}

pub use check::{ScriptCheck, check, check_package, declared_types, declared_types_of_package};
pub use run::{Run, RunTimes, run_session};
