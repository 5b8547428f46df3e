//! Shapes of the streets of a network, before surfaces are made of them.
//!
//! Input: a network. Output: the heights of its streets, the corners of its junctions, and the length of each segment
//! that is free of other streets.

mod clearance;
pub(crate) mod profile;
pub(crate) mod shapes;
