//! Set operations on geometries of any kinds.
//!
//! Comes in: two geometries. Goes out: the area, the lines and the points that both have, either, or only one. All comes of
//! one [subdivision](burgeon_geometry::overlay::Subdivision) of the plane by the edges of both.

mod arranged;
mod combine;
mod convert;
mod operand;
mod relate;

pub use combine::union_all;
pub(crate) use convert::{area_of, geometry_of};
pub(crate) use operand::{LEAST_EXTENT, Operand, dissolved, filled};
pub(crate) use relate::relate;
