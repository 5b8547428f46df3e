//! Files of a folder of tiles.

use std::path::{Path, PathBuf};

use crate::plan::TileId;

/// Folder of a plan, its tiles and its tileset.
#[derive(Debug, Clone)]
pub struct TileFolder(pub PathBuf);

impl TileFolder {
    /// Returns the path of the plan.
    pub fn plan(&self) -> PathBuf {
        self.0.join("plan.json")
    }

    /// Returns the path of the content of a tile.
    pub fn content(&self, tile: TileId) -> PathBuf {
        self.0.join(content_name(tile))
    }

    /// Returns the path of the manifest of a tile.
    pub fn manifest(&self, tile: TileId) -> PathBuf {
        self.0.join(format!("tiles/{tile}.json"))
    }

    /// Returns the path of the tileset.
    pub fn tileset(&self) -> PathBuf {
        self.0.join("tileset.json")
    }

    /// Returns the path of the times of a share, which are for people and no output.
    pub fn log(&self, share: &str) -> PathBuf {
        self.0.join(format!("log/{share}.tsv"))
    }

    /// Returns the folder of the times.
    pub fn logs(&self) -> PathBuf {
        self.0.join("log")
    }

    /// Returns the folder.
    pub fn path(&self) -> &Path {
        &self.0
    }
}

/// Returns the path of the content of a tile, relative to the folder.
pub(crate) fn content_name(tile: TileId) -> String {
    format!("tiles/{tile}.glb")
}
