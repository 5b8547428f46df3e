//! Fitting: a rule table whose map is like a height map.
//!
//! Comes in: a [`Target`], and how long to [`Search`]. Goes out: a [`FitResult`] table, which tells its error and writes
//! itself as a module for scripts. It reads no clock and no files: who calls it says when to stop.

mod code;
mod moves;
mod result;
mod search;
mod solve;
mod targets;
#[cfg(test)]
mod tests;

pub use result::FitResult;
pub use search::Search;
pub use targets::Target;
