//! The network as a plane graph: junctions and segments on a grid, growth with its constraints, dead ends, faces.
//!
//! Input: proposals, obstacles, constraints. Output: a network whose streets of one level meet only at junctions.

pub(crate) mod bend;
pub(crate) mod constraints;
pub(crate) mod corner;
pub(crate) mod dead_ends;
pub(crate) mod faces;
pub(crate) mod grid;
pub(crate) mod grow;
pub(crate) mod keeps;
pub(crate) mod merge_cache;
pub(crate) mod network;
pub(crate) mod obstacles;
pub(crate) mod stretches;
