//! Check of a tileset by a reader of its own.

mod glb;
mod instances;
mod tileset;

pub use glb::{GlbModel, GlbTable};
pub use tileset::{TilesetReport, check_tileset};
