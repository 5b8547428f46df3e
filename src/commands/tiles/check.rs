//! `burgeon tiles check`: checks a tileset against its plan.

use burgeon::tiles::{TileFolder, TilePlan, check_tileset};
use burgeon::{Error, Result};
use clap::{Args, ValueHint};
use serde_json::json;

use super::super::report;
use super::inputs::tile_folder;

/// Checks that a tileset contains what its plan says, and that volumes contain their content
#[derive(Args)]
pub(super) struct CheckTilesCommand {
    /// Folder of the tileset
    #[arg(value_parser = tile_folder(), value_hint = ValueHint::AnyPath)]
    folder: TileFolder,

    /// Prints machine-readable JSON instead of text
    #[arg(long)]
    pub(super) json: bool,
}

impl CheckTilesCommand {
    pub(super) fn run(&self) -> Result<()> {
        let folder = &self.folder;
        let plan = TilePlan::read(&folder.plan())?;
        let checked = check_tileset(folder, &plan)?;
        if !checked.problems.is_empty() {
            let problems = checked.problems.iter().map(|problem| {
                Error::data(problem)
                    .help("join again; if a file of tiles is named, remove it and make the tiles first; if that does not help, report a bug")
            });
            return Err(Error::several(problems.collect()));
        }
        if self.json {
            let document = json!({
                "ok": true, "tiles": checked.tiles, "coarse": checked.coarse, "terrain": checked.terrain, "points": checked.points, "triangles": checked.triangles,
                "features": checked.features, "missing": checked.missing, "tables": checked.tables,
            });
            return report::print(&format!("{document}\n"));
        }
        report::eprint(&format!(
            "{} tiles with {} features, and {} coarser ones; {} triangles; {} points are inside their volumes; {} features are missing\n",
            checked.tiles,
            checked.features,
            checked.coarse,
            checked.triangles,
            checked.points,
            checked.missing
        ));
        Ok(())
    }
}
