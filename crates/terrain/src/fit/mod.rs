//! Fitting: the search for a rule table whose map resembles a height map.
//!
//! Input: a [`Target`], and the parameters of a [`Search`]. Output: a [`FitResult`], with the error of its
//! table and the table as a Luau module. This module reads no clock and no files: the caller decides when to
//! stop.

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
