//! Check of a tileset by a reader of its own.

mod glb;
mod implicit;
mod instances;
mod subtree;
mod tileset;
mod unpack;

pub use glb::{GlbModel, GlbTable};
pub use tileset::{TilesetReport, check_tileset};
