//! Functions that create values of a type, besides the constructor that has its name.

use crate::Value;
use burgeon_base::error::Result;

/// A function for scripts that creates a value of its arguments.
#[derive(Debug, Clone, Copy)]
pub struct Constructor {
    /// Its name in scripts.
    pub name: &'static str,
    /// The function.
    pub make: fn(&[Value]) -> Result<Value>,
}
