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
mod methods;
mod object;
mod options;
mod overlaps;
mod passes;
mod proposals;
mod sites;
mod streets;
mod vertices;
mod walk;
mod walked;

pub use object::Network;
