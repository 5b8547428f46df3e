//! Scripts: virtual machines, what they offer to a script, and what a script declares.
//!
//! Comes in: Lua files. Goes out: grammars with functions for their guards, successors and interpretations, one
//! set in each virtual machine. Every machine runs the same script, and `derive` is where all of them meet.

mod analysis;
mod convert;
mod data;
mod drawn;
mod freeze;
mod handles;
mod kinds;
mod library;
mod machine;
mod options;
mod param;
mod paths;
mod preset;
mod require;
mod session;
mod system;

pub(crate) use handles::Objects;
pub(crate) use machine::{Flusher, read_column, write_column};
pub use machine::{Machine, Watchdog, make_ready};
pub use options::{Limits, Print, RunOptions};
pub use param::{Control, Param, Setting};
pub use preset::Preset;
pub use session::{Progress, Session};
pub(crate) use system::{Declared, Interpretations, returns_modules};
