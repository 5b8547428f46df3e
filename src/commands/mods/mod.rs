//! `burgeon mods`: the packages that scripts can use.
//!
//! Input: folders of packages. Output: descriptions and problems of packages, and new packages. The library implements
//! packages; this module only reports them.

mod command;
mod create;
mod text;

pub(crate) use command::ModsCommand;
