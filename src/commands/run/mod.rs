//! `burgeon run`: from a script to files.
//!
//! Comes in: a script and the names of files. Goes out: the files, all or none of them. Nothing is modelled here.

mod command;
mod outputs;
mod watch;

pub(crate) use command::RunCommand;
