//! What happens when something is wrong: with the script, its data, its resources or the command line.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod api;
mod book;
mod calls;
mod codes;
mod command_line;
mod data;
mod determinism;
mod elevation;
mod exports;
mod facades;
mod files;
mod fitting;
mod footprints;
mod foreign;
mod geometries;
mod hostile;
mod limits;
mod lots;
mod mods;
mod neighbors;
mod networks;
mod outputs;
mod own_types;
mod packages;
mod params;
mod patterns;
mod places;
mod planets;
mod presets;
mod reports;
mod sandbox;
mod scope;
mod setup;
mod successors;
mod support;
mod syntax;
mod terrain;
mod types;
mod unseen;
mod variations;
mod warnings;
