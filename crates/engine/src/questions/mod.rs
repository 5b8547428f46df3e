//! Questions to data: what scripts ask in SQL, and the rows that answer them.
//!
//! Input: a text of SQL with the values of its parameters, and something that can answer it, a [`RowSource`]. Goes
//! out: [`Rows`], the same for the same question for as long as they are kept, and which of their columns fits which
//! parameter of a module. It never runs Lua, and knows no database. A question that names modules is about a state of the
//! chains, a [`ChainView`].

mod cache;
#[cfg_attr(not(feature = "data"), allow(dead_code, reason = "nobody can ask"))]
mod chains;
mod fit;
mod question;

pub(crate) use cache::{AskedRows, RowCache};
pub(crate) use chains::ChainView;
#[cfg(feature = "data")]
pub(crate) use chains::NamedModule;
pub(crate) use fit::{fit, listed};
pub use question::{Question, RowSource, Rows};
