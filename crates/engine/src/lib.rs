//! Runs scripts: virtual machines, parallel rewriting and interpretation passes.
//!
//! Input: a script and the [`Registry`](burgeon_kit::Registry) of object types that it may use. Output: a
//! [`Run`] with its scene. The engine never refers to an object type by name, and never writes a file.

mod check;
mod checkpoints;
mod declare;
mod derive;
mod machine;
mod parts;
mod placeholders;
mod queries;
mod recipe;
pub mod results;
pub mod run;
mod texture_sets;
pub mod trace;

/// Inputs of a run, declarations of its script, and the virtual machines that run it.
pub mod script {
    pub use crate::checkpoints::DerivationStore;
    pub use crate::declare::{
        API_VERSION, Control, CurvesFile, FeatureChoice, FeaturePart, FileLimit, FileLoader, JsonMembers,
        JsonText, Limits, Param, ParamValues, PlacedPoints, PointControl, Preset, Print, RunInputs,
        RunOptions, RunProgress, RunReports, Session, Setting, TraceRequest, api_version, json_excerpt,
    };
    pub use crate::machine::{Machine, Watchdog, make_ready};
    pub use crate::queries::{RowSource, SqlQuery};
    pub use crate::recipe::RecipeDraft;
    pub use burgeon_kit::PointRows;
}

pub use check::{ScriptCheck, check, check_package, declared_types, declared_types_of_package};
pub use parts::each_part;
pub use run::{Run, RunTimes, run_session};
