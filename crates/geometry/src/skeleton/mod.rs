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
#[cfg(test)]
pub mod samples;
mod straight;
#[cfg(test)]
pub(super) mod tests;
mod wavefront;
mod whole;

pub use straight::{Pace, Peak, Skeleton};
