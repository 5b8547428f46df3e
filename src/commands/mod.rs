//! Commands: each parses its flags, does its work through the library, and reports the result.
//!
//! Input: the command line. Output: files, standard output, and an exit status: 0 for success, 1 if the script or its
//! data failed or an output could not be written, 2 if the command line is invalid.

mod api;
mod check;
mod command_line;
mod completions;
mod examples;
mod fit;
mod help_examples;
#[cfg_attr(not(feature = "live"), path = "absent.rs")]
mod live;
mod man;
mod mods;
mod new;
#[cfg_attr(not(feature = "live"), path = "absent_open.rs")]
mod open;
mod picture_flags;
mod progress;
mod report;
mod run;
mod setup;
mod shared;
mod short_forms;
mod sources;
mod style;
mod tiles;
mod variations;

pub use command_line::run_command;
