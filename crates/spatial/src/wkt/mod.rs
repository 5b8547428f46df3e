//! Well-known text: the human-readable format of geometries.

mod read;
mod write;

pub use write::write_number;
