//! Merged surfaces by level, with a cache of the most recent result.

use std::sync::{Arc, Mutex};

use glam::DVec2;

use super::mesh;
use super::room::clear_lengths;
use crate::network::StreetNetwork;
use burgeon_base::locks::LockRecovery;
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
    surfaces: Mutex<Option<(u64, MergeOptions, Arc<MergedStreets>)>>,
    clear: Mutex<Option<(u64, ClearLengths)>>,
}

impl Clone for MergeCache {
    /// Creates an empty cache, because the copy of the network may change.
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl StreetNetwork {
    /// Returns the merged surfaces of a network with existing streets; `None` for a network that was grown completely.
    pub(crate) fn merged(&self, options: MergeOptions) -> Option<Arc<MergedStreets>> {
        if !self.has_existing() {
            return None;
        }
        let mut known = self.merge_cache.surfaces.lock().recover();
        if let Some((version, of, merged)) = known.as_ref()
            && (*version, *of) == (self.version(), options)
        {
            return Some(Arc::clone(merged));
        }
        let mut levels: Vec<i32> = self.pieces().map(|(_, piece)| piece.attributes.level).collect();
        levels.sort_unstable();
        levels.dedup();
        levels.retain(|level| *level >= 0);
        let levels = levels.into_iter().map(|level| mesh::level(self, level, options)).collect();
        let merged = Arc::new(MergedStreets { levels });
        *known = Some((self.version(), options, Arc::clone(&merged)));
        Some(merged)
    }

    /// Returns the distance (m) from both ends within which each segment overlaps other streets.
    pub(crate) fn clear_lengths(&self) -> ClearLengths {
        let mut known = self.merge_cache.clear.lock().recover();
        if let Some((version, lengths)) = known.as_ref()
            && *version == self.version()
        {
            return Arc::clone(lengths);
        }
        let lengths: ClearLengths = clear_lengths(self).into();
        *known = Some((self.version(), Arc::clone(&lengths)));
        lengths
    }
}
