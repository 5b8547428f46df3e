//! Geometry without rules or scripts: frames, cross-sections, sweeps, straight skeletons and roofs.
//!
//! Input: points, outlines and cross-sections in metres. Output: faces, lines and meshes, closed or with a
//! list of their open edges. This crate never reads a file, draws a random number or reads a module.

mod cap;
mod face;
mod frame;
mod outline;
pub mod overlay;
mod path;
mod plan;
pub mod planar;
mod quad;
mod repair;
mod ring;
pub mod roof;
mod section;
mod shapes;
mod sides;
mod simplify;
mod sizes;
pub mod skeleton;
mod skin;
mod slits;
pub mod solid;
mod span;
mod strand;
mod surface;
mod sweep;
#[cfg(test)]
mod sweep_tests;
mod union;

pub use face::{CornerShading, face, shaded_face, sphere};
pub use frame::Frame;
pub use path::{Segment, Station};
pub use plan::Plan;
pub use planar::{Line, Point, Polygon, Ring, Rings, hull};
pub use roof::fill;
pub use section::{MOST_POINTS, Section, SectionPoint};
pub use sizes::{SAME, Share, Sizes, Split};
pub use strand::{MOST_SIDES, Strand, tube};
pub use sweep::{Lengthwise, SweepOptions, SweepResult, sweep};
pub use union::{Crossing, Union, UnionCell};

/// Doc tests of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
