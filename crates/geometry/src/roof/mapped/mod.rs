//! Roofs over lines of a map: ridges, other edges of the surface, and apexes.
//!
//! Input: a [`RoofMap`] and a plan. Output: heights over the plan, from a constrained triangulation whose coplanar triangles are
//! joined, and the lines that cannot be used. This module neither overhangs nor draws.

mod map_nodes;
mod map_surface;
mod roof_map;
#[cfg(test)]
mod tests;

pub(super) use map_nodes::MapNodes;
pub(super) use map_surface::MappedSurface;
pub use roof_map::{MapLineKind, MapProblem, RoofMap, UnusedLine};
