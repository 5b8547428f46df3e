//! Sweeps: surfaces of cross-sections that move along paths, round tubes, and generalised cylinders.
//!
//! Input: a section and stations, or a strand of points. Output: closed meshes, or a list of their open edges.

pub(crate) mod axis;
pub(crate) mod contour;
pub(crate) mod control_point;
pub(crate) mod cylinder;
pub(crate) mod options;
pub(crate) mod path;
mod quad;
mod ring;
mod span;
pub(crate) mod strand;
mod surface;
pub(crate) mod sweep;
#[cfg(test)]
mod tests;
