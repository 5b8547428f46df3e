//! Shapes as values: solids, faces and edges that rules divide.

mod component_selector;
mod construct;
mod division;
mod draw;
mod edge_distances;
mod font;
mod holes;
mod methods;
mod object;
mod options;
mod part_sizes;
mod relations;
mod revolve;
mod roofing;
mod smooth_normals;
mod support;
mod sweep_path;
mod text;
mod tiles;
mod trimming;
mod volumes;

pub(crate) use draw::{ShapeTarget, draw_building, draw_shape};
pub use font::FontObject;
pub use object::ShapeObject;
pub use volumes::Volumes;
