//! Foundation of all crates: errors and warnings, limits on untrusted input, and files.
//!
//! Input: none of Burgeon's types. Output: an [`Error`] with its location, rule and remedy, a [`Warning`] that a run
//! collects, a [`Budget`] for readers of untrusted data, and a [`Stop`] that cancels work. The crate never prints.

pub mod account;
pub mod budget;
#[cfg(feature = "elementary")]
pub mod elementary;
pub mod error;
pub mod files;
pub mod locks;
pub mod memory;
mod module_key;
pub mod names;
pub mod random;
mod srgb;
pub mod stop;
pub mod text;
pub mod warning;
mod warning_kind;
pub mod work;
pub mod work_progress;

pub use account::{MemoryAccount, MemoryOwner};
pub use budget::{Budget, BudgetCharge, MemoryReservation};
pub use error::{Error, Result};
pub use module_key::{KeyPart, ModuleKey};
pub use srgb::srgb_byte;
pub use stop::Stop;
pub use warning::Warning;
pub use warning_kind::WarningKind;
pub use work::{WorkLimits, WorkWithin, named_thread};
