//! Globes: six faces of a cube, each a quadtree of cells, as the equal parts of a sphere.
//!
//! Comes in: a [`World`](super::World) whose rules divide each face, a radius and an eye. Goes out: a [`Globe`] with
//! heights in any direction, and a [`GlobeMesh`] of it without gaps. Nothing of it shows where the faces meet.

mod expand;
mod faces;
#[allow(clippy::module_inception, reason = "a globe is the main type of its stage")]
mod globe;
mod leaves;
mod mesh;
mod sphere;
#[cfg(test)]
mod tests;
mod view;

pub use globe::{Globe, within};
pub use leaves::{DEEPEST, DETAIL};
pub use mesh::{GlobeMesh, Pieces};
pub use sphere::latitude;
pub use view::GlobeView;
