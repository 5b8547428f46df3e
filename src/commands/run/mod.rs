//! `burgeon run`: writes files from a script.
//!
//! Input: a script and the names of files. Output: the files, all or none of them, or a film. Modelling happens in the library.

mod command;
mod deadline;
mod films;
mod levels;
mod outputs;
mod parts;
mod standard;
mod watch;

pub(crate) use command::RunCommand;
pub(super) use outputs::{attributes, systems};
