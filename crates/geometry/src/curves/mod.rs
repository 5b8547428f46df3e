//! Functions of one variable, and curves in space, as piecewise cubic polynomials.
//!
//! Input: points. Output: values, tangents and lengths, and frames with minimal rotation. Nothing here draws.

mod cubic;
pub(crate) mod curve;
pub(crate) mod frames;
mod pieces;
pub(crate) mod ramp;
mod ramp_mix;
