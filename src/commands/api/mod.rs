//! `burgeon api`: the scripting API, from the same declarations that install it.
//!
//! Input: a name, or none. Output: text or JSON. The descriptions are not written here.

mod book;
mod command;
mod entry;
mod pictures;
mod text;
#[cfg(test)]
mod units;

pub(crate) use command::ApiCommand;
#[cfg(feature = "live")]
pub(crate) use command::names_json;
