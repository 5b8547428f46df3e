//! Check of a tileset by a reader of its own.

mod glb;
mod implicit;
mod instances;
#[cfg_attr(not(feature = "parquet"), path = "absent_rows.rs")]
mod rows;
mod subtree;
mod table;
mod terrain;
mod tileset;
mod unpack;

pub use glb::{GlbModel, GlbTable};
pub use tileset::{TilesetReport, check_tileset};
