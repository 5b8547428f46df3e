//! A network of streets as scripts have it: `network` in scripts.

mod draw;
mod kinds;
mod object;

pub use object::Network;
