//! The terrain: ground made by dividing a square into quadrants, expanded in the view.
//!
//! Input: rules, edits and a view. Output: tiles with their plants, and heights. Tiles out of view are never expanded.

mod beds;
mod build;
pub(super) mod cells;
mod edits;
pub(super) mod looks;
pub(super) mod mask;
mod object;
mod options;
mod plants;
mod river;
pub(super) mod rules;
mod show;
mod sides;
mod streets;
mod view;
mod water;

pub use edits::EditFile;
pub use looks::GroundCover;
pub use mask::Mask;
pub use object::Terrain;
pub(super) use object::{lost_focus, round_length};
pub use options::TerrainOptions;
pub use plants::Plants;
pub use rules::{LayerRules, RuleLayer, RuleLayers};
pub use streets::{GroundStreets, StreetsOnGround};
pub use water::Water;
