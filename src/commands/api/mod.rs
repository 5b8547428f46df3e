//! `burgeon api`: what scripts can use, from the same declarations that install it.
//!
//! Comes in: a name, or none. Goes out: text or JSON. Nothing of what is told is written here.

mod book;
mod command;
mod entry;
mod pictures;
mod text;
#[cfg(test)]
mod units;

pub(crate) use command::ApiCommand;
