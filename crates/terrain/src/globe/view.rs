//! Views of a globe.

use glam::DVec3;

/// Viewpoint and detail of a globe.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GlobeView {
    /// Position of the eye (m, from the centre of the globe); `None` for a distance of four radii on all
    /// sides.
    pub eye: Option<DVec3>,
    /// Minimum height (m) of the eye above the ground or the water.
    pub clearance: f64,
    /// Distance of the eye below which a tile is divided, as a multiple of the tile's size.
    pub closeness: f64,
    /// Maximum number of divisions of a face, including the cells of tiles.
    pub levels: u32,
    /// Keeps tiles below the horizon of the eye as coarse as their neighbours allow.
    pub horizon: bool,
}
