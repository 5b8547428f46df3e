//! Set operations on geometries of any kinds.
//!
//! Comes in: two geometries. Goes out: what both have, either, or only one. Areas are computed by i_overlay; lines and
//! points by an [arrangement] of the edges of both.

mod areas;
mod arrangement;
mod combine;
mod inside;
mod operand;
mod relate;

pub use combine::union_all;
pub(crate) use operand::{LEAST_EXTENT, Operand, dissolved, filled, with_width};
pub(crate) use relate::relate;
