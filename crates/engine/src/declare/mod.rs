//! Inputs of a run and declarations of its script, without a virtual machine.
//!
//! Input: the options of a run and the text of its files. Output: a [`Session`], which all virtual machines
//! of the run share: parameters, data and the analysis of every file. This folder runs no Lua.

mod api;
pub(crate) mod bytecode;
mod camera;
mod curves_file;
mod data;
mod deprecations;
mod file_access;
mod file_loader;
mod found_files;
mod json_text;
mod options;
mod packages;
mod param;
mod part;
pub(crate) mod paths;
mod point_control;
mod positions;
mod preset;
mod progress;
mod queries;
mod scripts;
mod session;
mod stamps;
mod types;
mod usage;

pub(crate) use api::has_name;
pub use api::{API_VERSION, api_version};
pub(crate) use camera::declare_camera;
pub use curves_file::CurvesFile;
pub use file_loader::FileLoader;
pub use json_text::{JsonMembers, JsonText, PlacedPoints, json_excerpt};
pub use options::{FileLimit, Limits, ParamValues, Print, RunInputs, RunOptions, RunReports, TraceRequest};
pub use param::{Control, Param, Setting};
pub use part::{FeatureChoice, FeaturePart};
pub use point_control::PointControl;
pub use preset::Preset;
pub use progress::RunProgress;
pub(crate) use scripts::SourceFile;
pub use session::Session;
pub(crate) use types::{contested_method, qualified_name};
