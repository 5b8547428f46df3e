//! Merged surfaces of all levels of a network.

use std::sync::Arc;

use super::mesh;
use crate::plan::merge_cache::{MergeOptions, MergedStreets};
use crate::plan::network::StreetNetwork;
use burgeon_base::locks::LockRecovery;

impl StreetNetwork {
    /// Returns the merged surfaces of a network with existing streets; `None` for a network that was grown completely.
    pub(crate) fn merge_levels(&self, options: MergeOptions) -> Option<Arc<MergedStreets>> {
        if !self.has_existing() {
            return None;
        }
        let mut known = self.merge_cache.surfaces.lock().recover();
        let (_, _, merged) = match &mut *known {
            Some(present) if (present.0, present.1) == (self.version(), options) => present,
            other => other.insert((self.version(), options, Arc::new(self.merged_streets(options)))),
        };
        Some(Arc::clone(merged))
    }

    fn merged_streets(&self, options: MergeOptions) -> MergedStreets {
        let mut levels: Vec<i32> = self.pieces().map(|(_, piece)| piece.attributes.level).collect();
        levels.sort_unstable();
        levels.dedup();
        levels.retain(|level| *level >= 0);
        let levels = levels.into_iter().map(|level| mesh::level(self, level, options)).collect();
        MergedStreets { levels }
    }
}
