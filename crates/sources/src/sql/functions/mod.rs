//! Functions of geometries, with the names and meanings of PostGIS.
//!
//! Each function is an entry of one table, with its name, arguments, result and help. SQLite and the book both use this
//! table. If an argument is null, the result is null.

mod aggregates;
mod argument;
mod call;
mod decimals;
mod forms;
mod groups;
mod index_functions;
mod lists;
mod making;
mod measures;
mod numbers;
mod operators;
mod parts;
mod registry;
mod relations;
mod spatial_function;
mod state;
mod table;
mod text;
mod texts;

pub(crate) use groups::BOOLEAN_LIST;
pub(crate) use lists::NAMES as ROW_FUNCTIONS;
pub(crate) use registry::{find, is_allowed, names, register};
pub use spatial_function::SpatialFunction;
pub(crate) use state::{ConnectionState, Indexes};
pub use table::FUNCTIONS;
