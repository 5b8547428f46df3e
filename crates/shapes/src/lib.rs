//! Shapes of a shape grammar: boxes, solids, faces and edges with scopes, and operations that divide and join them.
//!
//! Input: plans, sizes and selectors. Output: new shapes; a shape never changes. This crate never reads a file, draws a
//! random number or knows modules and scripts.

mod body;
mod compact_scope;
mod components;
mod construct;
mod crossings;
mod cut;
mod edge_kind;
mod mesh;
mod operations;
mod own_thread;
mod relations;
mod revolve;
mod scope;
mod shape;
mod sizes;
mod split;
mod split_image;
mod style;
mod text;
mod trim_planes;
mod uv_map;

pub use body::ShapeBody;
pub use components::selector::Selector;
pub use cut::plane::CutPlane;
pub use edge_kind::EdgeKind;
pub use mesh::{PolygonFace, PolygonMesh};
pub use operations::{
    BeveledSolid, CombinedSolid, CutFace, EnvelopeLimit, HoleOutline, Setback, ShapeRoof, SolidOperation,
    SweepPath,
};
pub use revolve::Revolution;
pub use scope::Scope;
pub use shape::Shape;
pub use sizes::{PartSize, PartSizes, SizedParts};
pub use split::{SplitAxis, SplitParts};
pub use split_image::ImageAxis;
pub use style::{FaceStyle, SharedStyle};
pub use text::{Font, TextAlign, TextLayout, TextRemarks};
pub use trim_planes::TrimPlane;
pub use uv_map::UvMap;
