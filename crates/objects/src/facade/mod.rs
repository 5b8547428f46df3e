//! Facades by a wall grammar of five rules: panel, bordered, extruded, list and grid.
//!
//! Input: walls composed by scripts, and a frontage's width and height. Output: a [`FacadeLayout`] of faces and models.
//! The layout does not depend on the frontage's position on a building.
//!
//! Method: T. Larive and V. Gaildrat, "Wall grammar for building generation", 2006.

pub mod bordered;
pub mod extruded;
pub mod fixture;
pub mod grid;
pub mod join;
#[cfg(test)]
mod join_tests;
mod kinds;
pub mod lay;
mod levels;
pub mod list;
pub mod panel;
pub mod size;
pub mod template;
#[cfg(test)]
mod tests;
pub mod wall;

pub use join::{FaceMesh, Joiner};
pub(super) use kinds::kinds;
pub use lay::{FacadeFace, FacadeLayout, Rectangle};
pub use template::{Facade, Template, Templates};
pub use wall::Wall;
