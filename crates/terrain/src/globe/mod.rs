//! Globes: six faces of a cube, each a quadtree of cells, projected to equal parts of a sphere.
//!
//! Input: a [`World`](super::World) whose rules divide each face, a radius and an eye. Output: a [`Globe`]
//! with heights in any direction, and a [`GlobeMesh`] without gaps or visible seams between the faces.

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

pub use globe::{Globe, place_within};
pub use leaves::{DEEPEST, DETAIL};
pub use mesh::{GlobeMesh, Pieces};
pub use sphere::latitude;
pub use view::GlobeView;
