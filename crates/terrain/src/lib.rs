//! Terrain: quadtrees of cells, expanded by rewriting around a focus, and the surface over them.
//!
//! Input: a [`World`] with its rules, and a [`View`] of it. Output: [`Ground`] with heights at any point, and
//! a [`GroundMesh`]. A cell's height depends only on the world and the cell's position, never on the order of
//! expansion.
//!
//! Source: Fitzpatrick, "Procedurally Generated Surfaces Using L-Systems".

mod channel;
mod division;
mod edits;
pub mod fit;
pub mod globe;
mod mesh;
mod river;
#[cfg(test)]
mod tests;
mod tiles;

pub use channel::Channel;
pub use division::block::{Area, Block, CellSymbol};
pub use division::height_source::HeightSource;
pub use division::noise::{octaves, octaves_along, octaves_around};
pub use division::table::{NumberRange, Quadrants, RuleTable};
pub use division::world::{Begin, DEEPEST, Divide, DivisionRules, LevelRules, Tables, World};
pub use edits::bed::GroundBed;
pub use edits::edit::Edit;
pub use edits::store::Edits;
pub use mesh::cuts::{GroundCut, GroundCuts};
pub use mesh::ground_mesh::GroundMesh;
pub use river::{Drainage, Dry};
pub use tiles::ground::{Ground, GroundMap};
pub use tiles::reader::{GroundReader, GroundReading};
pub use tiles::tile::{Tile, TilePlace};
pub use tiles::view::{MOST_HEIGHTS, TileRing, View};
