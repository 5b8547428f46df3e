//! A network of streets as scripts have it: `network` in scripts.

mod draw;
mod kinds;
mod lots;
mod object;

pub use object::Network;
