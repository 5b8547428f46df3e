//! The extruder: sweeps a cross-section along segments, straight or curved.
//!
//! Input: the calls of scripts. Output: closed meshes, or meshes with a count of their open edges. Meshes already drawn
//! never change.

mod bend;
mod joint;
mod object;
mod options;
mod state;
#[cfg(test)]
mod tests;

pub use object::Extruder;
