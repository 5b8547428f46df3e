//! The street network of scripts: `network`.

mod answers;
mod areas;
mod bridge;
mod cache;
mod draw;
mod existing;
mod grounds;
mod kinds;
mod land;
mod lines;
mod lots;
mod object;
mod overlaps;
mod passes;
mod proposals;
mod sites;
mod streets;
mod walk;
mod walked;

pub use object::Network;
