//! `burgeon tiles status`: reports the progress of all processes.

use burgeon::Result;
use burgeon::tiles::{TileFolder, TilePlan, TileStatus};
use clap::{Args, ValueHint};
use serde_json::json;

use super::super::report;
use super::inputs::tile_folder;

/// Reports the progress of all processes that make the tiles of a plan
#[derive(Args)]
pub(super) struct StatusCommand {
    /// Folder of the plan
    #[arg(value_parser = tile_folder(), value_hint = ValueHint::AnyPath)]
    folder: TileFolder,

    /// Prints machine-readable JSON instead of text
    #[arg(long)]
    pub(super) json: bool,
}

impl StatusCommand {
    pub(super) fn run(&self) -> Result<()> {
        let folder = &self.folder;
        let plan = TilePlan::read(&folder.plan())?;
        let status = TileStatus::read(folder, &plan)?;
        if self.json {
            let slowest =
                status.slowest.iter().map(|(tile, seconds)| json!({ "tile": tile, "seconds": seconds }));
            let failed =
                status.failed.iter().map(|(tile, why)| json!({ "tile": tile.to_string(), "cause": why }));
            let document = json!({
                "ok": true, "done": status.done, "failed": failed.collect::<Vec<_>>(), "open": status.open,
                "part": status.part, "tiles_a_minute": status.rate, "slowest": slowest.collect::<Vec<_>>(),
            });
            return report::print(&format!("{document}\n"));
        }
        let percent = status.part * 100.0;
        let mut text = format!(
            "{} tiles are done, {} failed, {} are open: {percent:.1} % of the cost\n",
            status.done,
            status.failed.len(),
            status.open
        );
        if let Some(rate) = status.rate {
            text += &format!("{rate:.0} tiles a minute\n");
        }
        for (tile, seconds) in &status.slowest {
            text += &format!("slow: {tile} took {seconds:.1} s\n");
        }
        for (tile, why) in &status.failed {
            text += &format!("failed: {tile}: {why}\n");
        }
        report::print(&text)
    }
}
