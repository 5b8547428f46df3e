//! Distances between levels of detail.

mod cover;
mod drawing;
mod hausdorff;
mod tree;

pub use drawing::{FeatureDrawings, draws_the_same};
pub use hausdorff::{hausdorff, one_sided};
pub use tree::TriangleTree;
