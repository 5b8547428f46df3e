//! `burgeon run`: writes files from a script.
//!
//! Input: a script and the names of files. Output: the files, all or none of them. Modelling happens in the library.

mod command;
mod outputs;
mod parts;
mod watch;

pub(crate) use command::RunCommand;
