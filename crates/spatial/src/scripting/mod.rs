//! Geometries as scripts hold them: their type, constructors, arguments and methods.

mod construct;
mod geometry_input;
mod lines;
mod list;
mod methods;
mod object;
mod polygon;

pub use construct::constructors;
pub use geometry_input::{GeometryInput, Path};
pub use lines::Lines;
pub use list::GeometryList;
pub use object::GeometryObject;
pub use polygon::{PolygonArgument, rings};
