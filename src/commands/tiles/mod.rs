//! `burgeon tiles`: the features of a country as 3D Tiles, made by any number of processes.
//!
//! Input: a script and the files of its features. Output: a folder with a plan, tiles and a tileset. The library plans, writes
//! and checks; this module runs the script for each tile.

mod build;
mod check;
mod command;
mod ground;
mod inputs;
mod join;
mod make;
mod plan;
mod status;

pub(crate) use command::TilesCommand;
