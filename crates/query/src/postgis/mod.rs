//! Questions that are put to a PostGIS server.
//!
//! Comes in: the address of a server that the user allows, statements with named parameters. Goes out: the same rows that
//! the database within the program gives, and layers. Transactions are read-only, values are bound, connections are kept
//! and used again; a connection that was lost is opened once more. Every wait for a server ends with the run's limits.

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
