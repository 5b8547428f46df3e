//! Geometry without rules or scripts: frames, cross-sections, sweeps, straight skeletons and roofs.
//!
//! Input: points, outlines and cross-sections in metres. Output: faces, lines and meshes, closed or with a
//! list of their open edges. This crate never reads a file, draws a random number or reads a module.

mod cross_section;
mod face;
mod frame;
mod limits;
pub mod overlay;
pub mod planar;
mod plans;
pub mod roof;
mod sizes;
pub mod skeleton;
pub mod solid;
mod sweeps;
mod union;

pub use cross_section::point::SectionPoint;
pub use cross_section::section::{MOST_POINTS, Section};
pub use face::{CornerShading, face, shaded_face, sphere};
pub use frame::Frame;
pub use planar::{Line, Point, Polygon, Ring, Rings, hull};
pub use plans::plan::Plan;
pub use roof::fill;
pub use sizes::{SAME, Share, Sizes, Split};
pub use sweeps::options::{Lengthwise, SweepOptions, SweepResult};
pub use sweeps::path::{Segment, Station};
pub use sweeps::strand::{MOST_SIDES, Strand, tube};
pub use sweeps::sweep::sweep;
pub use union::{Crossing, Union, UnionCell};

/// Doc tests of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
