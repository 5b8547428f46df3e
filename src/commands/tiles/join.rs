//! `burgeon tiles join`: writes the tileset and the missing features.

use burgeon::Result;
use burgeon::tiles::{TileFolder, TilePlan, Tiling, join_tiles};
use clap::{Args, ValueEnum, ValueHint};
use serde_json::json;

use super::super::report;
use super::inputs::tile_folder;

/// Way in which a tileset lists its tiles.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum TilingFlag {
    /// Each tile in JSON files
    Explicit,
    /// Tiles with sides up to 8 km in .subtree files
    Implicit,
    /// Explicit, and implicit.json with the same contents
    Both,
}

impl From<TilingFlag> for Tiling {
    fn from(flag: TilingFlag) -> Self {
        match flag {
            TilingFlag::Explicit => Self::Explicit,
            TilingFlag::Implicit => Self::Implicit,
            TilingFlag::Both => Self::Both,
        }
    }
}

/// Writes tileset.json from the tiles that were made, and lists the missing features as GeoJSON and CSV
#[derive(Args)]
pub(super) struct JoinCommand {
    /// Folder of the plan
    #[arg(value_parser = tile_folder(), value_hint = ValueHint::AnyPath)]
    folder: TileFolder,

    /// Tiling of the tileset
    #[arg(long, value_enum, default_value_t = TilingFlag::Explicit)]
    tiling: TilingFlag,

    /// Prints machine-readable JSON instead of text
    #[arg(long)]
    pub(super) json: bool,
}

impl JoinCommand {
    pub(super) fn run(&self) -> Result<()> {
        let folder = &self.folder;
        let plan = TilePlan::read(&folder.plan())?;
        let joined = join_tiles(folder, &plan, self.tiling.into())?;
        if self.json {
            let document = json!({
                "ok": true, "tiles": joined.tiles, "coarse": joined.coarse, "terrain": joined.terrain, "empty": joined.empty, "failed": joined.failed, "open": joined.open,
                "features": joined.features, "missing": joined.missing, "tilesets": joined.tilesets,
                "subtrees": joined.subtrees,
            });
            return report::print(&format!("{document}\n"));
        }
        report::eprint(&format!(
            "{} tiles with {} features, and {} coarser ones; {} tiles are empty, {} failed, {} are not made\n",
            joined.tiles, joined.features, joined.coarse, joined.empty, joined.failed, joined.open
        ));
        if joined.missing > 0 {
            report::eprint(&format!(
                "warning: {} features are missing: missing.csv lists them with their causes\n",
                joined.missing
            ));
        }
        Ok(())
    }
}
