//! What a person is told when something is wrong: where, in which rule, on which module, and what to do.
//!
//! Input: what went wrong, as it is found. Output: a text or JSON. No code compares the text.

mod kind;
mod message;
mod suggest;

pub use self::kind::{ErrorKind, Limit};
pub use self::suggest::{did_you_mean, nearest};
pub use message::{Error, Result, SourcePlace, shortened};
