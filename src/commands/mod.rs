//! The commands: each reads its flags, does its work through the library, and says what came of it.
//!
//! Comes in: the command line. Goes out: files, standard output, and an exit status: 0 done, 1 the script or its
//! data failed or something could not be written, 2 the command line is wrong.

mod api;
mod check;
mod command_line;
mod completions;
mod fit;
#[cfg_attr(not(feature = "live"), path = "absent.rs")]
mod live;
mod mods;
mod new;
mod progress;
mod report;
mod run;
mod setup;
mod shared;
mod sources;
mod variations;

pub(crate) use command_line::main;
