//! Merged surfaces by level, and a cache of the most recent ones in each network.

use std::sync::{Arc, Mutex};

use glam::DVec2;

use burgeon_geometry::Rings;

/// Surfaces of all levels on and above the ground.
#[derive(Debug, Default)]
pub(crate) struct MergedStreets {
    /// Levels in ascending order: the ground first, if there are streets on it.
    pub(crate) levels: Vec<MergedLevel>,
}

/// Surfaces of the streets of one level, with shared vertices.
#[derive(Debug, Default)]
pub(crate) struct MergedLevel {
    pub(crate) level: i32,
    /// Positions (m).
    pub(crate) points: Vec<DVec2>,
    /// Triangles of carriageways, counter-clockwise, by depth.
    pub(crate) carriageways: Vec<(u32, Vec<[u32; 3]>)>,
    /// Triangles of sidewalks.
    pub(crate) walks: Vec<[u32; 3]>,
    /// Edges of carriageways, with the carriageway on the right.
    pub(crate) kerbs: Vec<[u32; 2]>,
    /// Outer edges of streets, with the street on the right.
    pub(crate) edges: Vec<[u32; 2]>,
    /// Blocks; only on the ground.
    pub(crate) blocks: Vec<MergedBlock>,
}

/// Area enclosed by streets.
#[derive(Debug, Default)]
pub(crate) struct MergedBlock {
    /// Rings (m), the outer one first, counter-clockwise.
    pub(crate) rings: Rings<DVec2>,
    /// Triangles, as indices into the points of the level.
    pub(crate) triangles: Vec<[u32; 3]>,
}

/// Options that affect the surfaces, in addition to the network.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MergeOptions {
    /// Radius (m) of turning circles at dead ends.
    pub(crate) turning: f64,
    /// Maximum length (m) of an edge; infinite if the streets are level.
    pub(crate) longest: f64,
}

/// Distance (m) from both ends within which each segment overlaps other streets.
pub(crate) type ClearLengths = Arc<[[f64; 2]]>;

/// Most recent results, with the version of the network.
#[derive(Debug, Default)]
pub(crate) struct MergeCache {
    pub(crate) surfaces: Mutex<Option<(u64, MergeOptions, Arc<MergedStreets>)>>,
    pub(crate) clear: Mutex<Option<(u64, ClearLengths)>>,
}

impl Clone for MergeCache {
    /// Creates an empty cache, because the copy of the network may change.
    fn clone(&self) -> Self {
        Self::default()
    }
}
