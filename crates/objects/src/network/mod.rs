//! A network of streets as scripts have it: `network` in scripts.

mod bridge;
mod draw;
mod grounds;
mod kinds;
mod land;
mod lots;
mod object;

pub use object::Network;
