//! Straight skeletons: the faces of a roof over a polygon with holes.
//!
//! Input: rings, and the pace of each edge. Output: one face for each edge. Every result is verified.

mod coarse;
mod edge;
mod events;
mod exact;
mod faces;
mod fronts;
mod lines;
mod meeting;
mod propagation;
mod queue;
#[cfg(test)]
pub mod samples;
#[allow(clippy::module_inception, reason = "a skeleton is the main type of its stage")]
mod skeleton;
mod straight;
#[cfg(test)]
pub(super) mod tests;
mod wavefront;
mod whole;

pub use skeleton::{Pace, Peak, Skeleton};
