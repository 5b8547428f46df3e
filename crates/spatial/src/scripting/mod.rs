//! Geometries as scripts hold them: their type, constructors, arguments and methods.

mod construct;
mod lines;
mod list;
mod methods;
mod object;
mod polygon;
mod shape;

pub use construct::constructors;
pub use lines::Lines;
pub use list::GeometryList;
pub use object::GeometryObject;
pub use polygon::{PolygonArgument, rings};
pub use shape::{Path, Shape};
