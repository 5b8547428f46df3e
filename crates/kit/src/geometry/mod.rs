//! Geometries in scripts.
//!
//! Input: text, points and features of data files. Output: immutable objects with read methods. The crate `spatial`
//! implements the computations; this module adds their names, arguments and messages for scripts.

mod construct;
mod methods;
mod object;
mod shape;

pub use construct::{Constructor, constructors};
pub use object::GeometryObject;
pub(crate) use shape::vector;
pub use shape::{Path, Shape};
