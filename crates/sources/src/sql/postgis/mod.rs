//! Queries of a PostGIS server.
//!
//! Input: the address of a server that the user allows, and statements with named parameters. Output: the same rows as
//! from the internal database, and layers. Transactions are read-only, values are bound, and connections are reused; a
//! lost connection is reopened once. Every wait for a server ends at the run's limits.

mod address;
mod cells;
mod connection;
mod encryption;
mod errors;
mod layer;
mod numbered;
mod server;
mod tables;

pub use address::{EncryptionMode, ServerAddress};
pub use server::Server;
