//! Files for printers and mesh programs: STL, PLY and 3MF, with a count of the open edges of their shapes.
//!
//! z is up, as in the scene. STL and 3MF are in millimetres, because slicers expect them; PLY is in metres.

mod open_edges;
mod placed;
mod ply;
mod stl;
#[cfg(test)]
mod tests;
#[cfg_attr(not(feature = "data"), path = "absent_three_mf.rs")]
mod three_mf;

pub(super) use ply::write as write_ply;
pub(super) use stl::write as write_stl;
pub(super) use three_mf::{check as check_three_mf, write as write_three_mf};
