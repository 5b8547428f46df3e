//! Commands: each parses its flags, does its work through the library, and reports the result.
//!
//! Input: the command line. Output: files, standard output, and an exit status: 0 for success, 1 if the script or its
//! data failed or an output could not be written, 2 if the command line is invalid.

mod api;
mod check;
mod command_line;
mod completions;
mod fit;
#[cfg_attr(not(feature = "live"), path = "absent.rs")]
mod live;
mod mods;
mod new;
mod picture_flags;
mod progress;
mod report;
mod run;
mod setup;
mod shared;
mod sources;
mod tiles;
mod variations;

pub(crate) use command_line::main;
