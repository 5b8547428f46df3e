//! Coordinate systems: the EPSG registry with corrections, projections, and systems in well-known text.
//!
//! Input: a code or a text. Output: a [`Crs`], or the unit of heights. Without the feature `data` there is no registry,
//! and each function returns an error.

#[cfg(feature = "data")]
mod corrections;
#[cfg(feature = "data")]
mod epsg;
#[cfg_attr(not(feature = "data"), path = "absent_prj.rs")]
pub(crate) mod prj;
#[cfg_attr(not(feature = "data"), path = "absent.rs")]
pub(crate) mod projection;
mod system;
#[cfg(feature = "data")]
pub(crate) mod vertical;
#[cfg(feature = "data")]
mod well_known_text;

pub use system::Crs;
pub(crate) use system::REMEDY;
