//! Tiles: the features of a country as 3D Tiles 1.1, made by any number of processes.
//!
//! Input: the features of a layer, and a function that builds the scene of a range of features. Output: a folder with a
//! plan, tiles with manifests, a tileset and lists of what is missing. The crate never runs a script, and never writes a clock,
//! a host name or an absolute path.
//!
//! - [`plan`]: a [`TileDivision`] divides the features by a quadtree into the [`PlannedTile`]s of a [`TilePlan`].
//! - [`make`]: [`make_tile`] writes a tile, its [tables](make::TileTables) and its [`TileManifest`], unless they fit the plan already.
//!   [`TerrainHeights`](make::TerrainHeights) builds the tiles of a [terrain](plan::PlannedTerrain).
//! - [`join`]: [`join_tiles`] writes the tileset and the missing features.
//! - [`check`]: [`check_tileset`] proves that the tileset is what the plan says.
//! - [`measure`]: distances between levels of detail.
//! - [`earth`]: coordinates of a run on the WGS 84 ellipsoid.
//!
//! Specification: Open Geospatial Consortium, "3D Tiles Specification 1.1", 2023.

pub mod check;
pub mod earth;
mod folder;
pub mod join;
pub mod make;
pub mod measure;
pub mod plan;
mod status;

pub use check::{TilesetReport, check_tileset};
pub use earth::{EarthMap, TileAxes};
pub use folder::TileFolder;
pub use join::{JoinReport, Tiling, join_tiles};
pub use make::{TileManifest, TileOutcome, make_tile};
pub use plan::{PlannedTile, TileDivision, TileId, TilePlan};
pub use status::TileStatus;
