//! The extruder: sweeps a cross-section along segments, straight or curved.
//!
//! Comes in: the calls of scripts. Goes out: closed meshes, or the edges where they are open. It never changes what it
//! has drawn.

mod object;
mod state;
#[cfg(test)]
mod tests;

pub use object::Extruder;
