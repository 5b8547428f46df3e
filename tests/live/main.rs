//! Server of the live view, tested with the real binary: requests, saves, parameters, exports and tilesets; and `run
//! --watch`.
#![cfg(feature = "live")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod connections;
mod curves;
mod packages;
mod params;
mod parts;
mod printed;
mod requests;
mod saves;
mod support;
mod tileset;
mod tracing;
mod watching;
