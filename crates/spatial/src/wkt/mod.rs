//! Well-known text: geometries as people write them.

mod read;
mod write;

pub use write::write_number;
