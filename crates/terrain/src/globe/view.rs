//! What is seen of a globe.

use glam::DVec3;

/// From where a globe is seen, and how closely.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GlobeView {
    /// Position of the eye (m, from the centre of the globe); four radii away on all sides, if there is none.
    pub eye: Option<DVec3>,
    /// Minimum height (m) of the eye above the ground or the water.
    pub clearance: f64,
    /// A tile is divided while the eye is nearer to it than so many times its size.
    pub closeness: f64,
    /// Maximum number of times that a face is divided, the cells of tiles included.
    pub levels: u32,
    /// Tiles below the horizon of the eye stay as coarse as their neighbours need.
    pub horizon: bool,
}
