//! Merged surfaces by level, and the cache of the last ones.

use std::sync::{Arc, Mutex};

use glam::DVec2;

use super::mesh;
use super::room::clear_lengths;
use crate::network::StreetNetwork;
use burgeon_base::locks::LockRecovery;
use burgeon_geometry::Rings;

/// The surfaces of all levels on the ground and above it.
#[derive(Debug, Default)]
pub(crate) struct MergedStreets {
    /// That on the ground first, if there is one.
    pub(crate) levels: Vec<MergedLevel>,
}

/// The surfaces of the streets of one level, which share all their vertices.
#[derive(Debug, Default)]
pub(crate) struct MergedLevel {
    pub(crate) level: i32,
    /// Positions (m).
    pub(crate) points: Vec<DVec2>,
    /// Triangles of carriageways, counter-clockwise, by depth.
    pub(crate) carriageways: Vec<(u32, Vec<[u32; 3]>)>,
    /// Triangles of sidewalks.
    pub(crate) walks: Vec<[u32; 3]>,
    /// Edges between a carriageway, on the right, and what is no carriageway.
    pub(crate) kerbs: Vec<[u32; 2]>,
    /// Edges between the streets, on the right, and what lies beside them.
    pub(crate) edges: Vec<[u32; 2]>,
    /// The blocks; only on the ground.
    pub(crate) blocks: Vec<MergedBlock>,
}

/// An area that streets enclose.
#[derive(Debug, Default)]
pub(crate) struct MergedBlock {
    /// Its rings (m), the outer one first, counter-clockwise.
    pub(crate) rings: Rings<DVec2>,
    /// Its triangles, by the points of the level.
    pub(crate) triangles: Vec<[u32; 3]>,
}

/// What surfaces depend on besides the network.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MergeOptions {
    /// The radius (m) of circles to turn in at dead ends.
    pub(crate) turning: f64,
    /// The greatest length (m) of an edge; infinite where the streets are level.
    pub(crate) longest: f64,
}

/// For each piece, how far (m) from its ends it is not free of other streets.
pub(crate) type ClearLengths = Arc<[[f64; 2]]>;

/// What was made last, with the version of the network.
#[derive(Debug, Default)]
pub(crate) struct MergeCache {
    surfaces: Mutex<Option<(u64, MergeOptions, Arc<MergedStreets>)>>,
    clear: Mutex<Option<(u64, ClearLengths)>>,
}

impl Clone for MergeCache {
    /// An empty one: the copy may become another network.
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl StreetNetwork {
    /// The merged surfaces of a network with existing streets; `None` of one that has grown as a whole.
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

    /// For each piece, how far (m) from its ends it is not free of other streets.
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
