//! Environments that the chains of a system share.

use burgeon_base::error::Result;

/// Capability to be an environment of a system: interpretations of all its chains change it, and rules read it as the last
/// pass has left it.
///
/// [`Object::begin`](crate::Object::begin) prepares it for a pass.
pub trait Environment {
    /// Completes a pass, before rules read the environment.
    fn end_pass(&mut self) -> Result<()>;
}
