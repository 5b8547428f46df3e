//! The planet: a globe made by dividing six squares into quadrants, expanded where it is looked at.
//!
//! Comes in: rules, a radius and an eye. Goes out: meshes of the globe. It never expands what nobody looks at.

mod looks;
mod object;

pub use object::{Planet, PlanetOptions};
