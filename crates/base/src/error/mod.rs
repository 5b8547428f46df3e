//! Error messages for users: location, rule, module, message and remedy.
//!
//! Input: a fault where it is detected. Output: text or JSON. No code compares the text.

mod constructors;
mod kind;
mod message;
mod suggest;

pub use self::kind::{ErrorKind, Limit};
pub use self::suggest::{did_you_mean, nearest};
pub use message::{Error, Result, SourcePlace, shorten};
