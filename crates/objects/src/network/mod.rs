//! A network of streets as scripts have it: `network` in scripts.

mod draw;
mod kinds;
mod lots;
mod object;
mod sites;

pub use object::Network;
