//! Files of a folder of tiles.

use std::path::{Path, PathBuf};

use crate::plan::{TableFormat, TileId};

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
        self.0.join(content_name("", tile))
    }

    /// Returns the path of a table of the features of a tile.
    pub fn table(&self, tile: TileId, format: TableFormat) -> PathBuf {
        self.0.join(format!("tiles/{}.{}", path_of(tile), format.extension()))
    }

    /// Returns the path of the manifest of a tile.
    pub fn manifest(&self, tile: TileId) -> PathBuf {
        self.0.join(format!("tiles/{}.json", path_of(tile)))
    }

    /// Returns the folder of the terrain tiles.
    #[must_use]
    pub fn terrain(&self) -> Self {
        Self(self.0.join(TERRAIN))
    }

    /// Returns the path of the tileset.
    pub fn tileset(&self) -> PathBuf {
        self.0.join("tileset.json")
    }

    /// Returns the path of the tileset with implicit tiling that stands beside an explicit one.
    pub fn implicit_tileset(&self) -> PathBuf {
        self.0.join(IMPLICIT_NAME)
    }

    /// Returns the folder of the subtrees of implicit tiling.
    pub fn subtrees(&self) -> PathBuf {
        self.0.join("subtrees")
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

/// Name of the tileset with implicit tiling that stands beside an explicit one.
pub(crate) const IMPLICIT_NAME: &str = "implicit.json";

/// Folder of the terrain tiles, and name of their tileset without its extension.
pub(crate) const TERRAIN: &str = "terrain";

/// Returns the path of the content of a tile, relative to the folder that contains the folder `within`.
pub(crate) fn content_name(within: &str, tile: TileId) -> String {
    let name = format!("tiles/{}.glb", path_of(tile));
    if within.is_empty() { name } else { format!("{within}/{name}") }
}

/// Returns the template of the paths of contents, or of subtrees, in a tile with implicit tiling.
pub(crate) fn template(folder: &str, root: TileId, extension: &str) -> String {
    format!("{folder}/{root}/{{level}}/{{x}}/{{y}}.{extension}")
}

/// Returns the path of a tile: its level, column and row in the largest tile that contains it, as templates have it, after
/// those of that tile.
fn path_of(tile: TileId) -> String {
    let root = tile.anchor();
    match tile.level >= root.level && root.level == TileId::ANCHOR {
        true => format!("{root}/{}", tile.within(root)),
        false => tile.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contents_have_the_paths_of_their_templates_and_no_two_are_the_same() {
        let tile = TileId { level: 12, x: 2051, y: 2046 };
        assert_eq!(content_name("", tile), "tiles/9/256/255/3/3/6.glb");
        let filled = template("tiles", tile.anchor(), "glb").replace("{level}", "3").replace("{x}", "3");
        assert_eq!(filled.replace("{y}", "6"), content_name("", tile));
        assert_eq!(content_name("", tile.ancestor(9)), "tiles/9/256/255/0/0/0.glb");
        assert_eq!(content_name("", tile.ancestor(8)), "tiles/8/128/127.glb");
    }
}
