//! Options of roofs: their kinds, directions and objects on them, for footprints and shapes.
//!
//! Input: tables of scripts. Output: shapes of roofs for the geometry crate. Never draws.

mod checks;
mod detail;
mod direction;
#[cfg(test)]
mod kind_tests;
mod kinds;
mod lines;
mod options;
mod storeys;

pub(crate) use checks::{Height, check_height, unknown_kind};
pub use detail::RoofDetail;
pub(crate) use kinds::{is_curved, roof_shape};
pub(crate) use lines::roof_map;
pub use lines::{RoofLines, RoofPoints};
pub use options::Roof;
