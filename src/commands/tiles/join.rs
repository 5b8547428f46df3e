//! `burgeon tiles join`: writes the tileset and the missing features.

use std::path::PathBuf;

use burgeon::Result;
use burgeon::tiles::{TileFolder, TilePlan, join_tiles};
use clap::Args;
use serde_json::json;

use super::super::report;

/// Writes tileset.json from the tiles that were made, and lists the missing features as GeoJSON and CSV
#[derive(Args)]
pub(super) struct JoinCommand {
    /// Folder of the plan
    folder: PathBuf,

    /// Prints machine-readable JSON instead of text
    #[arg(long)]
    pub(super) json: bool,
}

impl JoinCommand {
    pub(super) fn run(&self) -> Result<()> {
        let folder = TileFolder(self.folder.clone());
        let plan = TilePlan::read(&folder.plan())?;
        let joined = join_tiles(&folder, &plan)?;
        if self.json {
            let document = json!({
                "ok": true, "tiles": joined.tiles, "empty": joined.empty, "failed": joined.failed, "open": joined.open,
                "features": joined.features, "missing": joined.missing, "tilesets": joined.tilesets,
            });
            return report::print(&format!("{document}\n"));
        }
        report::eprint(&format!(
            "{} tiles with {} features; {} tiles are empty, {} failed, {} are not made\n",
            joined.tiles, joined.features, joined.empty, joined.failed, joined.open
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
