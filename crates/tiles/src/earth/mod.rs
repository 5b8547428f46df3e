//! Coordinates of a run on the WGS 84 ellipsoid, and in the local axes of a tile.

mod ellipsoid;
mod geoid;
mod map;
mod place;

pub use ellipsoid::{east_north_up, from_degrees};
pub use geoid::GeoidGrid;
pub use map::{EarthMap, LocalMap, TileAxes};
pub use place::place_scene;
