//! Functions for geometries, with the names and meanings of PostGIS.
//!
//! Each stands in one table with its name, what it takes and gives, and its help; SQLite gets them from there, and so does
//! the book. Nothing comes of nothing: where an argument is NULL, so is the result.

mod aggregates;
mod argument;
mod call;
mod forms;
mod making;
mod measures;
mod numbers;
mod parts;
mod registry;
mod relations;
mod simple;
mod table;

pub(crate) use argument::GeometryArgument;
pub(crate) use call::{FunctionCall, FunctionResult};
pub(crate) use registry::{find, is_allowed, is_predicate, names, register};
pub use table::{FUNCTIONS, SpatialFunction};
