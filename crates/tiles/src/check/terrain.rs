//! Check of the terrain tiles of a tileset.

use std::collections::{BTreeMap, BTreeSet};

use burgeon_base::error::Result;

use super::tileset::{ParentTile, ShownContent, TilesetCheck};
use crate::folder::TERRAIN;
use crate::make::TileManifest;
use crate::plan::{PlannedTile, TileId, TilePlan};

/// Terrain tiles of a check.
#[derive(Default)]
pub(super) struct TerrainCheck {
    /// Tiles of the plan by the names of their contents.
    plan: BTreeMap<String, PlannedTile>,
    /// Tiles with content in this tileset.
    seen: BTreeSet<TileId>,
}

impl TerrainCheck {
    pub(super) fn new(plan: &TilePlan) -> Result<Self> {
        let tiles = plan.terrain_tiles()?;
        let named = tiles.into_iter().map(|tile| (crate::folder::content_name(TERRAIN, tile.id), tile));
        Ok(Self { plan: named.collect(), seen: BTreeSet::new() })
    }
}

impl TilesetCheck<'_> {
    /// Checks the content of a terrain tile, if it is one: its place, its volume, and that its error is at least the measured distance
    /// from the tiles inside.
    pub(super) fn terrain(&mut self, content: &ShownContent<'_>, tile: &ParentTile) -> Result<bool> {
        let uri = content.uri;
        let Some(planned) = self.terrain.plan.get(uri).cloned() else { return Ok(false) };
        if !self.terrain.seen.insert(planned.id) {
            self.problem(format!("{uri} is in the tileset twice"));
        }
        if content.has_children && !content.replaces {
            self.problem(format!("{uri} is shown together with finer terrain"));
        }
        if !self.reads {
            return Ok(true);
        }
        let folder = self.folder.terrain();
        let Some(manifest) = TileManifest::fitting(&folder, &planned)? else {
            self.problem(format!("{uri} has no manifest that fits the plan"));
            return Ok(true);
        };
        let measured = manifest.errors.first().copied().unwrap_or(0.0);
        if content.has_children && tile.error < measured {
            self.problem(format!("{uri} has the error {}, but {measured} was measured", tile.error));
        }
        let Some(file) = manifest.content else {
            self.problem(format!("{uri}: the manifest has no content"));
            return Ok(true);
        };
        if let Some(model) = self.model(uri, &folder.content(planned.id), &file, tile)? {
            self.report.terrain += 1;
            self.report.points += model.points;
            self.report.triangles += model.triangles;
        }
        Ok(true)
    }

    /// Checks that all terrain tiles with content are in the tileset, and prepares for the next tileset.
    pub(super) fn terrain_rest(&mut self) -> Result<()> {
        let folder = self.folder.terrain();
        let seen = std::mem::take(&mut self.terrain.seen);
        let rest: Vec<PlannedTile> =
            self.terrain.plan.values().filter(|tile| !seen.contains(&tile.id)).cloned().collect();
        for tile in rest {
            if TileManifest::fitting(&folder, &tile)?.is_some_and(|manifest| manifest.content.is_some()) {
                self.problem(format!(
                    "terrain tile {} was made, but is not in the tileset: join again",
                    tile.id
                ));
            }
        }
        Ok(())
    }
}
