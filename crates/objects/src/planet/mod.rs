//! The planet: a globe whose six square faces are divided into quadrants, expanded near the eye.
//!
//! Input: rules, a radius and an eye position. Output: meshes of the globe. Tiles out of view are never expanded.

mod looks;
mod object;
mod options;

pub use object::Planet;
pub use options::PlanetOptions;
