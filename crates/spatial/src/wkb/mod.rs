//! Well-known binary: the format of geometries in databases.

mod arc;
mod read;
#[cfg(test)]
mod tests;
mod write;

pub use arc::{NEAR, add_arc};
pub use read::{read, srid};
