//! What all of Burgeon stands on: errors and warnings, limits on foreign input, and files.
//!
//! Input: nothing of Burgeon. Output: an [`Error`] with its place, rule and remedy, a [`Warning`] that a run
//! collects, a [`Budget`] for whoever reads foreign bytes, and a [`Stop`] that ends work nobody waits for. It never
//! prints.

pub mod account;
pub mod budget;
#[cfg(feature = "elementary")]
pub mod elementary;
pub mod error;
pub mod files;
pub mod locks;
pub mod memory;
pub mod names;
pub mod random;
pub mod stop;
pub mod text;
pub mod warning;
pub mod work;

pub use account::{MemoryAccount, MemoryOwner};
pub use budget::{Budget, MemoryReservation};
pub use error::{Error, Result};
pub use stop::Stop;
pub use warning::{Warning, WarningKind};
pub use work::{WorkLimits, WorkWithin};
