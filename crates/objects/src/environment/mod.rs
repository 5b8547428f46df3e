//! Environments: what the chains of a system share, such as light, free space, obstacles and water.
//!
//! Input: calls of interpretations, in the order of the chains. Output: answers to rules after the pass. An environment draws
//! nothing.

mod attractors;
mod cell_grid;
mod discs;
mod obstacles;
mod place_key;
mod prism;
mod shadow_voxels;
mod soil;
mod solid;
#[cfg(test)]
mod tests;

pub use attractors::{AttractorOptions, Attractors};
pub use discs::{DiscOptions, Discs};
pub use obstacles::ObstacleSolids;
pub use shadow_voxels::{ShadowVoxelOptions, ShadowVoxels};
pub use soil::{Soil, SoilOptions};
