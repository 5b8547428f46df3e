//! Terrain: quadtrees of cells, expanded by rewriting around a focus, and the surface over them.
//!
//! Input: a [`World`] with its rules, and a [`View`] of it. Output: [`Ground`] with heights at any point, and
//! a [`GroundMesh`]. A cell's height depends only on the world and the cell's position, never on the order of
//! expansion.
//!
//! Source: Fitzpatrick, "Procedurally Generated Surfaces Using L-Systems".

mod bed;
mod block;
mod cells;
mod channel;
mod cuts;
mod edits;
pub mod fit;
pub mod globe;
mod ground;
mod height_source;
mod local_edits;
mod mesh;
mod noise;
mod river;
mod samples;
mod script;
mod table;
#[cfg(test)]
mod tests;
mod tile;
mod view;
mod world;

pub use bed::GroundBed;
pub use block::{Area, Block};
pub use cells::Cells;
pub use channel::Channel;
pub use cuts::{GroundCut, GroundCuts};
pub use edits::{Edit, Edits};
pub use ground::{Ground, GroundMap};
pub use height_source::HeightSource;
pub use mesh::GroundMesh;
pub use noise::{octaves, octaves_around};
pub use river::{Drainage, Dry};
pub use table::{NumberRange, Quadrants, RuleTable};
pub use tile::{Tile, TilePlace};
pub use view::{DEEPEST, MOST_HEIGHTS, TileRing, View};
pub use world::{Begin, Divide, DivisionRules, LevelRules, Tables, World};
