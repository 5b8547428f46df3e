//! Shapes as values: solids, faces and edges that rules divide.

mod construct;
mod draw;
mod edge_distances;
mod font;
mod methods;
mod object;
mod options;
mod part_sizes;
mod relations;
mod support;
mod text;
mod volumes;

pub(crate) use draw::{draw_building, draw_shape};
pub use font::FontObject;
pub use object::ShapeObject;
pub use volumes::Volumes;
