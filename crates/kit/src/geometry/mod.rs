//! Geometries as scripts hold them.
//!
//! Input: text, points, features of data files. Output: objects that never change, with what can be asked of them.
//! What is computed stands in the member `spatial`; here are its names, its arguments and its messages.

mod construct;
mod methods;
mod object;
mod shape;

pub use construct::{Constructor, constructors};
pub use object::GeometryObject;
pub(crate) use shape::vector;
pub use shape::{Path, Shape};
