//! Terrain: quadtrees of cells by rewriting, expanded where someone looks, and the surface over them.
//!
//! Comes in: a [`World`] with its rules, and what a [`View`] shows of it. Goes out: [`Ground`] with heights at any
//! place, and a [`GroundMesh`] of it. A cell's height depends on the world and its place alone, never on the way to it.
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
pub use world::{Begin, Divide, LevelRules, Rules, Tables, World};
