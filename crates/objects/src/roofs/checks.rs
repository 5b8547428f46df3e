//! Heights, and the checks that several methods of a footprint need.

use burgeon_base::error::{Error, Result};
use burgeon_kit::{Expectation, Parameter, Value};

/// Maximum height (m) of walls and roofs.
const HIGHEST: f64 = 2000.0;

/// A height (m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Height(pub f64);

impl Parameter for Height {
    fn luau() -> String {
        f64::luau()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        f64::from_value(value).map(Self)
    }

    fn into_value(self) -> Value {
        self.0.into_value()
    }
}

/// Fails if a height (m) is not above 0 or exceeds the maximum.
pub(crate) fn check_height(what: &str, height: f64) -> Result<()> {
    if height > 0.0 && height <= HIGHEST {
        return Ok(());
    }
    let error = Error::argument(format!("{what} is {} m", Value::Number(height)));
    Err(error.help(format!("give metres above 0, up to {HIGHEST}")).of_data())
}

/// Creates the error for an unknown kind.
pub(crate) fn unknown_kind(what: &str, kind: &str, known: &[&'static str]) -> Error {
    Error::not_found("kind", kind, known.iter().copied(), format!("{what}: unknown kind {kind:?}"))
        .help(format!("use {}", known.join(", ")))
}
