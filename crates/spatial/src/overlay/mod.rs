//! Set operations on geometries of any type.
//!
//! Input: two geometries. Output: their intersection, union, difference or symmetric difference as areas,
//! lines and points. All operations use one [subdivision](burgeon_geometry::overlay::Subdivision) of the
//! plane by the edges of both.

mod arranged;
mod combine;
mod convert;
mod operand;
mod relate;

pub use combine::union_all;
pub(crate) use convert::{area_of, geometry_of};
pub(crate) use operand::{LEAST_EXTENT, Operand, dissolved, filled};
pub(crate) use relate::relate;
