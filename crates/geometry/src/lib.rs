//! Geometry without rules or scripts: frames, curves, cross-sections, sweeps, trees of tubes, straight skeletons and roofs.
//!
//! Input: points, outlines and cross-sections in metres. Output: faces, lines and meshes, closed or with a
//! list of their open edges. This crate never reads a file, draws a random number or reads a module.

mod closed_mesh;
mod cross_section;
mod curves;
mod face;
mod frame;
mod joints;
mod limits;
pub mod overlay;
mod patches;
pub mod planar;
mod plans;
pub mod roof;
mod sizes;
pub mod skeleton;
pub mod solid;
mod sweeps;
mod union;

pub use closed_mesh::{AlongSegment, ClosedMesh};
pub use cross_section::point::SectionPoint;
pub use cross_section::section::{MOST_POINTS, Section};
pub use curves::curve::{Curve, CurveKind};
pub use curves::frames::rotation_minimizing;
pub use curves::ramp::{Ramp, RampKind};
pub use face::{CornerShading, face, shaded_face, sphere};
pub use frame::Frame;
pub use joints::axis::{AxisPoint, JoinedTubes, JointAxis};
pub use joints::tubes::joined_tubes;
pub use patches::surface::{SplineSurface, SurfaceGrid, SurfaceKind};
pub use planar::{Line, Point, Polygon, Ring, Rings, hull};
pub use plans::plan::Plan;
pub use roof::fill;
pub use sizes::{SAME, Share, Sizes, Split};
pub use sweeps::contour::check_contour;
pub use sweeps::control_point::CylinderPoint;
pub use sweeps::cylinder::generalized_cylinder;
pub use sweeps::options::{Lengthwise, SweepOptions, SweepResult};
pub use sweeps::path::{Segment, Station};
pub use sweeps::strand::{MOST_SIDES, Strand, tube};
pub use sweeps::sweep::sweep;
pub use union::{Crossing, Union, UnionCell};

/// Doc tests of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
