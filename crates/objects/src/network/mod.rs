//! A network of streets as scripts have it: `network` in scripts.

mod draw;
mod lots;
mod object;

pub use object::Network;
