//! `burgeon mods`: the packages that scripts can use.
//!
//! Comes in: folders of packages. Goes out: what they are, what is wrong with them, and one more of them. What packages
//! mean is decided by the library; here it is only told.

mod command;
mod create;
mod text;

pub(crate) use command::ModsCommand;
