//! Operations that change the geometry of shapes.

mod array;
mod bevel;
mod cut_hole;
mod extrude;
mod flat_faces;
mod inset;
mod manifold_points;
mod merge;
mod molding;
mod plans;
mod project;
mod reduce;
mod regions;
mod roof;
mod solids;
mod source_planes;
mod strips;
mod sweep;
mod transform;
mod trim;

pub use bevel::BeveledSolid;
pub use cut_hole::{CutFace, HoleOutline};
pub use inset::Setback;
pub(crate) use merge::{SAME_POINT, merge_coplanar, weld};
pub use regions::EnvelopeLimit;
pub use roof::ShapeRoof;
pub use solids::{CombinedSolid, SolidOperation};
pub use sweep::SweepPath;
