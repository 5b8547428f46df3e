//! Surfaces of the streets of a network, and the ground that they cover.
//!
//! Input: a network, and the heights of its streets. Output: carriageways, sidewalks, medians and blocks that share
//! their corners, bridges, footings, and covered areas.

pub(crate) mod areas;
mod footings;
mod junctions;
mod merged;
pub(crate) mod parts;
pub(crate) mod rows;
pub(crate) mod spans;
mod surfaces;
