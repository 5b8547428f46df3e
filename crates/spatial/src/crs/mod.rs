//! Coordinate reference systems: the EPSG registry with corrections, projections, and systems in well-known text.
//!
//! Input: a code or a text. Output: a [`Crs`], or the unit of heights. Without the feature `projections` there is no registry,
//! and each function returns an error.

#[cfg(feature = "projections")]
mod corrections;
#[cfg(feature = "projections")]
mod epsg;
mod frame;
#[cfg_attr(not(feature = "projections"), path = "absent_prj.rs")]
mod prj;
#[cfg_attr(not(feature = "projections"), path = "absent.rs")]
mod projection;
mod system;
#[cfg(feature = "projections")]
mod vertical;
#[cfg(feature = "projections")]
mod well_known_text;
mod world_place;

pub use frame::{Passage, ReferenceFrame};
pub use prj::{crs_of_text, height_unit};
pub use projection::definition;
pub use system::{Crs, REMEDY};
#[cfg(feature = "projections")]
pub use vertical::unit_of_system;
pub use world_place::WorldPlace;
