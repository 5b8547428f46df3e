//! Error messages for users: location, rule, module, message and remedy.
//!
//! Input: a fault where it is detected. Output: text or JSON. No code compares the text.

mod columns;
mod constructors;
mod excerpt;
mod kind;
mod message;
mod source_place;
mod suggest;

pub use self::kind::{ErrorKind, Limit};
pub use self::suggest::{did_you_mean, nearest};
pub use excerpt::Excerpt;
pub use message::{Error, Result, shorten};
pub use source_place::SourcePlace;
